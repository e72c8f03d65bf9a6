// Results of the last input that was solved: key results, those of one row of a set among them, beside the last pinned.
import {remember} from "./address.js";
import {$, kept, make, tell} from "./dom.js";
import {switchOf} from "./effects.js";
import {requirements} from "./requirements.js";
import {MAIN, PICTURES, SLOW, fresh, rest} from "./solving.js";
import {isSet, page} from "./state.js";
import {differenceOf, states, textOf} from "./states.js";

const OF_ROW = ["section", "angles", "loads", "ellipses", "grooves"];  // of a set

export function results() {
  const {found, now} = page;
  for (const id of SLOW) $(id).classList.add("stale");
  fresh([...MAIN, ...PICTURES.filter(id => !found.pictures.includes(id))]);
  const {headline} = found.required;
  $("of").className = "";
  $("of").textContent = found.is_solved ? ["Solved: the results are of the inputs shown.", headline].filter(Boolean).join(" ") : "No results: see the remark.";
  $("name").textContent = (!isSet() && now.document.bearing?.name) || now.label || "Bearing";
  Object.assign($("section"), {innerHTML: found.picture});
  for (const id of PICTURES) if (id !== "section" && !found.pictures.includes(id)) $(id).replaceChildren();
  requirements();
  $("warnings").innerHTML = found.warnings;
  $("boxes").replaceChildren(...found.effects.map(switchOf));
  $("missing").hidden = true;
  page.row = Math.min(page.row, Math.max(found.rows.length - 1, 0));
  keyResults();
  tell("solved", {input: page.shown, found});
}

export function keyResults() {
  const {found, row} = page, reference = page.pins.at(-1);
  $("pin").disabled = !found.is_solved;
  cards("key", found.key, reference, each => each.key);
  $("rows").hidden = !found.rows.length;
  $("every-row").innerHTML = found.every_row;
  $("tabs").replaceChildren(...found.rows.map(({name}, number) => {
    const tab = make("button", {type: "button", id: `tab ${number}`, ariaPressed: String(number === row)}, name);
    tab.onclick = () => { page.row = number; remember(); kept(keyResults); rest(++page.turn, OF_ROW); };
    return tab;
  }));
  cards("row", found.rows[row]?.key ?? [], reference, each => each.rows[row]?.key ?? []);
  states();
}

function cards(id, own, reference, keyOf) {
  const before = reference && keyOf(reference.found);
  $(id).replaceChildren(...own.map(({name, condition, parts, note}) => {
    const old = before && (before.find(each => each.name === name)?.parts ?? []);
    const lines = [...Map.groupBy(parts, part => part.unit)].map(([unit, several]) => numbers(unit, several, reference?.letter, old?.filter(each => each.unit === unit)));
    return make("div", {className: "card", title: condition}, "", make("div", {className: "name"}, name),
      make("div", {className: "numbers"}, "", ...lines), ...(note ? [make("small", {className: "note"}, note)] : []));
  }));
}

// Numbers of one unit in a line; below it by how much the pinned state differs.
function numbers(unit, parts, letter, before) {
  const line = make("div", {}, "", make("b", {}, textOf(parts)), ` ${unit}`);
  const whose = parts.map(part => part.of).filter(Boolean).join(" / ");
  if (whose) line.append(make("small", {}, whose));
  if (before?.length) line.append(make("small", {className: "change"}, `${letter} ${differenceOf(parts, before)} ${unit}`));
  return line;
}
