// Pinned states beside the one now: their inputs, results, and differences in the units of these.
import {remember} from "./address.js";
import {ask} from "./ask.js";
import {$, make} from "./dom.js";
import {download} from "./files.js";
import {keyResults} from "./results.js";
import {goTo} from "./scene.js";
import {differences, page} from "./state.js";
import {printed} from "./typed.js";

const LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

export function pin() {
  const letter = [...LETTERS].find(each => !page.pins.some(pinned => pinned.letter === each));
  if (!letter) return;
  page.pins.push({letter, input: page.shown, found: page.found});
  changed();
}

function changed() {
  remember();
  keyResults();
}

// Of an address: their results are solved anew, one after the other.
export async function pinAll(pins) {
  const solved = [];
  for (const {letter, input} of pins.slice(0, LETTERS.length)) {
    const found = await ask("solve", input);
    if (!found.errors) solved.push({letter, input, found});
  }
  page.pins = solved;
  if (page.found) changed();
}

// Every line of numbers of one unit: what it is, and how each state reads it.
function linesOf(found) {
  const groups = [["", found.key], ...found.rows.map(({name, key}) => [`${name}: `, key])];
  return groups.flatMap(([before, key]) => key.flatMap(({name, parts}) =>
    [...Map.groupBy(parts, part => part.unit)].map(([unit, several]) => ({id: `${before}${name} ${unit}`, name: `${before}${name}`, unit, parts: several}))));
}

export const textOf = parts => parts.map(part => part.number.replaceAll("-", "−")).join(" / ");

// By how much a state's numbers differ from those now; a dash where they are not as many.
export function differenceOf(parts, other) {
  return parts.map(part => {
    const own = other.find(each => each.of === part.of)?.values ?? [];
    const sizes = part.values.map((value, k) => own[k] - value);
    return own.length === part.values.length && [...new Set(sizes.map(signed))].join(" to ") || "-";
  }).join(" / ");
}

const signed = value => printed(Math.abs(value) < 5e-5 ? 0 : value, 3, {signDisplay: "exceptZero"});

export function states() {
  const {pins, found, shown} = page;
  $("states").hidden = !pins.length;
  if (!pins.length) return;
  const heads = pins.map(each => make("th", {scope: "col", className: "r"}, `${each.letter} `, ...buttonsOf(each)));
  const now = make("th", {scope: "col", className: "r"}, "now");
  $("pinned").tHead.replaceChildren(make("tr", {}, "", make("th", {scope: "col"}, "result"), now, ...heads));
  const inputs = pins.map(({input}) => make("td", {className: "r"}, differences(input, shown) || "these inputs"));
  const first = make("tr", {}, "", make("th", {scope: "row"}, "what differs"), make("td", {}), ...inputs);
  $("pinned").tBodies[0].replaceChildren(first, ...linesOf(found).map(({id, name, unit, parts}) => {
    const cells = pins.map(pinned => {
      const other = linesOf(pinned.found).find(each => each.id === id)?.parts ?? [];
      return make("td", {className: "r"}, other.length ? textOf(other) : "-", make("small", {className: "change"}, `${differenceOf(parts, other)} ${unit}`));
    });
    const whose = parts.map(part => part.of).filter(Boolean).join(" / ");
    const head = make("th", {scope: "row"}, unit ? `${name}, ${unit}` : name, make("small", {}, whose));
    return make("tr", {}, "", head, make("td", {className: "r"}, textOf(parts)), ...cells);
  }));
}

function buttonsOf(pinned) {
  const {letter, input} = pinned;
  const go = make("button", {type: "button", id: `go to ${letter}`, ariaLabel: `Go to state ${letter}`}, "Go to");
  go.onclick = () => goTo(input);
  const out = make("button", {type: "button", id: `unpin ${letter}`, ariaLabel: `Unpin state ${letter}`}, "×");
  out.onclick = () => { page.pins = page.pins.filter(each => each !== pinned); changed(); };
  return [go, out];
}

const quoted = text => /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;

// One line a number, one column a state; bare numbers, with all their digits.
export function statesAsTable() {
  const every = [{letter: "now", input: page.shown, found: page.found}, ...page.pins];
  const lines = every.map(({found}) => new Map(linesOf(found).flatMap(({name, unit, parts}) => parts.flatMap(({of, values}) =>
    values.map((value, k) => [[name, of, values.length > 1 ? ["least", "largest"][k] : "", unit].map(quoted).join(","), value])))));
  const names = [...new Set(lines.flatMap(each => [...each.keys()]))];
  const rows = names.map(name => [name, ...lines.map(each => each.get(name) ?? "")].join(","));
  const what = ["what differs", "", "", "", ...every.map(({input}) => quoted(differences(input, page.shown)))];
  return [["result", "of", "which", "unit", ...every.map(each => each.letter)].join(","), what.join(","), ...rows, ""].join("\n");
}

export function wireStates() {
  $("pin").onclick = pin;
  $("states csv").onclick = () => download("states.csv", statesAsTable(), "text/csv");
}
