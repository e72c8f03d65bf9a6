// The scene as it changes: taken over from an answer, settled, undone.
import {remember} from "./address.js";
import {ask} from "./ask.js";
import {$, kept} from "./dom.js";
import {show} from "./inputs.js";
import {answered, refused} from "./solving.js";
import {page} from "./state.js";

// What a person did is done: it can be undone, the address tells it, and the fields follow where the tables have others
// than before.
export function settle() {
  const text = JSON.stringify(page.now);
  if (text === page.settled) return;
  if (page.settled) page.past.push(page.settled);
  page.future = [];
  settled(text);
}

function settled(text) {
  page.settled = text;
  $("undo").disabled = page.past.length === 0;
  $("redo").disabled = page.future.length === 0;
  remember();
}

function taken(told, label) {
  page.now = {document: told.document, label};
  $("refused").replaceChildren();
  settle();
  kept(() => show(told));
}

// Another file or bearing in place of the scene; what is wrong with it is no fault of the fields that are there.
export async function take(question, given, what) {
  const told = await ask(question, given);
  if (told.errors) return refused(what ?? given.label, told.errors), false;
  taken(told, given.label ?? page.now.label);
  return true;
}

// The scene with a change that the server makes: a switch, or another way of a channel.
export async function change(question, given) {
  const told = await answered(question, {document: page.now.document, ...given});
  if (told) taken(told, page.now.label);
  return told;
}

// Fields and sliders anew around what the tables have now; wrong numbers stay, to be corrected.
export async function renew() {
  const told = await answered("show", {document: page.now.document});
  if (!told) return;
  settle();
  kept(() => show(told));
}

async function stepped(from, to) {
  if (!from.length) return;
  to.push(page.settled);
  page.now = JSON.parse(from.at(-1));
  settled(from.pop());
  const told = await ask("show", {document: page.now.document});
  kept(() => show(told));
}

export const undo = () => stepped(page.past, page.future);
export const redo = () => stepped(page.future, page.past);

// To an input that was there before.
export async function goTo(input) {
  page.now = structuredClone(input);
  await renew();
}
