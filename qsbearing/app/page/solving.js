// The scene is solved while it changes; what is of another input than the fields have is grey, and is said to be.
import {ask} from "./ask.js";
import {$, kept, make, tell} from "./dom.js";
import {effects} from "./effects.js";
import {results} from "./results.js";
import {differences, page} from "./state.js";

export const PICTURES = ["shaft", "section", "stiffness", "life", "angles", "loads", "ellipses", "grooves"];
export const MAIN = ["section", "required", "key", "every-row", "row", "warnings"], SLOW = [...PICTURES, "effects", "tables"];
export const NOT_YET = "not yet solved";

const lineOf = text => make("li", {}, text);

// What is wrong with the scene, each fault at its field.
export function complain(errors) {
  for (const each of document.querySelectorAll("[aria-invalid]")) each.removeAttribute("aria-invalid");
  for (const each of document.querySelectorAll(".wrong")) each.textContent = "";
  const elsewhere = [];
  for (const {key, text} of errors) {
    const field = key && ($(key) ?? document.querySelector(`input[id^="${CSS.escape(key)}."]`));
    if (!field) { elsewhere.push(text); continue; }
    field.setAttribute("aria-invalid", "true");
    field.setAttribute("aria-describedby", `${field.id} wrong`);
    field.closest("details")?.setAttribute("open", "");
    $(`${field.id} wrong`).textContent += text + "\n";
  }
  $("errors").replaceChildren(...elsewhere.map(lineOf));
  if (errors.length) grey("Not solved.");
  tell("refused", errors);
}

// An answer; nothing where what is asked is wrong, which is told at its fields.
export async function answered(question, given) {
  const told = await ask(question, given);
  if (told.errors) return complain(told.errors), null;
  return told;
}

// What is wrong with a file that is not taken over: it is none of the fields' faults, and the scene stays as it is.
export function refused(what, errors) {
  $("refused").replaceChildren(...[`${what || "The file"} is not opened. The scene stays as it was.`, ...errors.map(({text}) => text)].map(lineOf));
}

// What is on the page is grey as long as it is of another input than the fields have, and is said to be of that.
function grey(why) {
  const {shown, now} = page;
  if (!shown || JSON.stringify(shown) === JSON.stringify(now)) return;
  for (const id of [...MAIN, ...SLOW]) $(id).classList.add("stale");
  for (const each of document.querySelectorAll("#boxes span")) each.textContent = NOT_YET;
  $("pin").disabled = true;
  $("of").className = "old";
  $("of").textContent = `${why} The results are of ${differences(shown, now) || shown.label || "the scene before"}.`;
}

export function fresh(ids) {
  for (const id of ids) $(id).classList.remove("stale");
}

// One question at a time: while it is out the slider may move on, and only where it is then is asked next.
export async function solve() {
  page.again = true;
  page.turn += 1;
  page.late.abort();  // nobody waits for what is to be read of the input before
  grey("Solving ...");
  tell("changed");
  if (page.busy) return;
  page.busy = true;
  while (page.again) {
    page.again = false;
    const asked = JSON.stringify(page.now), told = await ask("solve", page.now);
    complain(told.errors ?? []);
    if (!told.errors) {
      [page.shown, page.found] = [JSON.parse(asked), told];
      kept(results);
      if (JSON.stringify(page.now) === asked) rest(page.turn);
      else grey("Solving ...");
    }
    await new Promise(done => requestAnimationFrame(done));
  }
  page.busy = false;
}

// What takes longer follows when nothing moves.
export async function rest(mine, only) {
  page.late.abort();
  const {signal} = page.late = new AbortController(), input = page.shown;
  if (only) for (const id of only) $(id).classList.add("stale");
  await new Promise(done => setTimeout(done, 60));
  for (const name of page.found.pictures) {
    if (only && !only.includes(name) && !$(name).classList.contains("stale")) continue;
    if (mine !== page.turn) return;
    const told = await ask("picture", {...input, name, row: page.row}, signal);
    if (told.errors || mine !== page.turn) return;
    Object.assign($(name), {role: "img", ariaLabel: told.alt, innerHTML: told.picture});
    fresh([name]);
  }
  for (const question of ["rest", "effects"]) {
    const place = question === "rest" ? "tables" : "effects";
    if (!$(place).classList.contains("stale") || mine !== page.turn) continue;
    const told = await ask(question, input, signal);
    if (mine !== page.turn || told.errors) return;
    if (question === "rest") $("tables").innerHTML = told.tables;
    else effects(told.effects);
    fresh([place]);
  }
}
