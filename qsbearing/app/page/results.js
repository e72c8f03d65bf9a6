// Results of the last input that was solved: key results, those of one row of a set among them, beside those pinned.
import {$, kept, make} from "./dom.js";
import {switchOf} from "./effects.js";
import {MAIN, PICTURES, SLOW, fresh, rest} from "./solving.js";
import {differences, isSet, page} from "./state.js";

const OF_ROW = ["section", "angles", "loads", "ellipses"];  // of a set

export function results() {
  const {found, now} = page;
  for (const id of SLOW) $(id).classList.add("stale");
  fresh([...MAIN, ...PICTURES.filter(id => !found.pictures.includes(id))]);
  $("of").className = "";
  $("of").textContent = found.is_solved ? "Solved: the results are of the inputs shown." : "No results: see the remark.";
  $("name").textContent = (!isSet() && now.document.bearing?.name) || now.label || "Bearing";
  Object.assign($("section"), {innerHTML: found.picture});
  for (const id of PICTURES) if (id !== "section" && !found.pictures.includes(id)) $(id).replaceChildren();
  $("requirements").innerHTML = found.requirements;
  $("requirements").hidden = !found.requirements;
  $("warnings").innerHTML = found.warnings;
  $("boxes").replaceChildren(...found.effects.map(switchOf));
  page.row = Math.min(page.row, Math.max(found.rows.length - 1, 0));
  keyResults();
}

export function keyResults() {
  const {found, pinned, row, shown} = page;
  $("pin").disabled = !found.is_solved && !pinned;
  $("pin").setAttribute("aria-pressed", String(Boolean(pinned)));
  $("pin").textContent = pinned ? "Unpin" : "Pin";
  $("said").textContent = pinned ? `Pinned: ${differences(pinned.input, shown) || "these inputs"}.` : "";
  cards("key", found.key, pinned?.key);
  $("rows").hidden = !found.rows.length;
  $("tabs").replaceChildren(...found.rows.map(({name}, number) => {
    const tab = make("button", {type: "button", id: `tab ${number}`, ariaPressed: String(number === row)}, name);
    tab.onclick = () => { page.row = number; kept(keyResults); rest(++page.turn, OF_ROW); };
    return tab;
  }));
  cards("row", found.rows[row]?.key ?? [], pinned?.rows[row]?.key);
}

function cards(id, own, before) {
  $(id).replaceChildren(...own.map(({name, condition, parts, note}) => {
    const old = before && (before.find(each => each.name === name)?.parts ?? []);
    const lines = [...Map.groupBy(parts, part => part.unit)].map(([unit, several]) => numbers(unit, several, old));
    return make("div", {className: "card", title: condition}, "", make("div", {className: "name"}, name),
      make("div", {className: "numbers"}, "", ...lines), ...(note ? [make("small", {className: "note"}, note)] : []));
  }));
}

// Numbers of one unit in a line; below it what was pinned, and by how much they differ from that.
function numbers(unit, parts, before) {
  const line = make("div", {}, "", make("b", {}, parts.map(part => part.number).join(" / ")), ` ${unit}`);
  const whose = parts.map(part => part.of).filter(Boolean).join(" / ");
  if (whose) line.append(make("small", {}, whose));
  if (!before) return line;
  const old = parts.map(({of}) => before.find(part => part.of === of && part.unit === unit));
  line.append(make("small", {}, `pinned ${old.map(part => part?.number ?? "-").join(" / ")}`));
  const pairs = parts.map(({values}, k) => [values, old[k]?.values ?? []]);
  const inPerCent = unit !== "deg" && pairs.every(([one, other]) => other.every((value, k) => value * one[k] > 0 || value === one[k]));
  const change = (value, old) => signed(inPerCent ? 100 * (value / old - 1) || 0 : value - old);
  const texts = pairs.map(([one, other]) => one.length === other.length && [...new Set(one.map((value, k) => change(value, other[k])))].join(" to ") || "-");
  line.append(make("small", {className: "change"}, `difference ${texts.join(" / ")} ${inPerCent ? "%" : unit}`));
  return line;
}

function signed(value) {
  const text = String(Number(Math.abs(value).toPrecision(3)));
  return Math.abs(value) < 5e-5 ? "0" : (value < 0 ? "−" : "+") + text;
}
