// The scene as it changes: taken over from an answer, settled, undone.
import {ask} from "./ask.js";
import {$, kept} from "./dom.js";
import {show} from "./inputs.js";
import {complain} from "./solving.js";
import {page} from "./state.js";

// What a person did is done: it can be undone, and the fields follow where the tables have others than before.
export function settle() {
  const text = JSON.stringify(page.now);
  if (text === page.settled) return;
  if (page.settled) page.past.push(page.settled);
  page.settled = text;
  $("undo").disabled = page.past.length === 0;
}

export async function take(question, given) {
  const told = await ask(question, given);
  if (told.errors) return complain(told.errors), false;
  page.now = {document: told.document, label: given.label ?? page.now.label};
  settle();
  kept(() => show(told));
  return true;
}

// Fields and sliders anew around what the tables have now; wrong numbers stay, to be corrected.
export async function renew() {
  const told = await ask("show", {document: page.now.document});
  if (told.errors) return complain(told.errors);
  settle();
  kept(() => show(told));
}

export async function undo() {
  if (!page.past.length) return;
  page.now = JSON.parse(page.settled = page.past.pop());
  $("undo").disabled = page.past.length === 0;
  const told = await ask("show", {document: page.now.document});
  kept(() => show(told));
}
