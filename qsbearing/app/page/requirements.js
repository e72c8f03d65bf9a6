// What is required of results, each with its answer, edited in place.
import {ask} from "./ask.js";
import {$, at, make, put} from "./dom.js";
import {renew} from "./scene.js";
import {solve} from "./solving.js";
import {page} from "./state.js";

let ends = [];

// The limits of the scene now, by their paths.
function limits() {
  const table = page.now.document.require ?? {};
  return Object.entries(table).flatMap(([name, own]) => ends.filter(({end}) => end in own).map(each => ({...each, path: ["require", name, each.end]})));
}

export function requirements() {
  const own = limits(), body = $("required").tBodies[0], rows = [...body.rows].map(row => row.dataset.of);
  if (own.map(({path}) => path.join(".")).join() !== rows.join()) body.replaceChildren(...own.map(rowOf));
  for (const {path} of own) {
    const field = $(path.join("."));
    if (document.activeElement !== field) field.value = at(path, page.now.document);
  }
  $("required").hidden = !own.length;
  answers(own);
}

function rowOf({path, sign}) {
  const id = path.join("."), [, name] = path, field = make("input", {id, type: "number", step: "any", ariaLabel: `${name} ${sign}`});
  field.oninput = () => { put(path, field.value === "" ? "" : Number(field.value), page.now.document); solve(); };
  field.onchange = renew;
  const out = make("button", {id: `${id} out`, type: "button", title: `Leave out ${name}`, ariaLabel: `Leave out ${name} ${sign}`}, "×");
  out.onclick = () => { leaveOut(path); renew(); };
  const row = make("tr", {}, "", make("td", {}, name, make("small", {})), make("td", {className: "r"}), make("td", {className: "asked"}, `${sign} `, field, make("span", {}), make("span", {className: "wrong", id: `${id} wrong`})),
    make("td", {}, "", make("span", {className: "bar"})), make("td", {}), make("td", {}, "", out));
  row.dataset.of = id;
  return row;
}

function leaveOut(path) {
  const tables = page.now.document, [, name] = path;
  put(path, undefined, tables);
  if (!ends.some(({end}) => end in tables.require[name])) put(path.slice(0, -1), undefined, tables);
  if (!Object.keys(tables.require).length) delete tables.require;
}

// How the last results answer them; of one that they were not asked, nothing.
function answers(own) {
  const told = page.found?.required, by = new Map((told?.answers ?? []).map(each => [each.path.join("."), each]));
  $("headline").textContent = own.length ? told?.headline || "not yet solved" : "none";
  $("open-ones").innerHTML = own.length ? told?.open ?? "" : "";
  for (const row of $("required").tBodies[0].rows) {
    const answer = by.get(row.dataset.of), [what, found, asked, used, said] = row.cells;
    what.querySelector("small").textContent = [answer?.of, answer?.source].filter(Boolean).join("; ");
    found.textContent = answer?.found ?? "-";
    asked.querySelector("span").textContent = answer ? ` ${answer.unit}` : "";
    const bar = used.firstChild;
    bar.hidden = answer?.used == null;
    bar.className = `bar ${answer?.look ?? ""}`;
    bar.style.setProperty("--used", Math.min(answer?.used ?? 0, 1.25));
    said.replaceChildren(make("strong", {className: answer?.look ?? ""}, answer?.verdict ?? "not yet solved"));
  }
}

export function wireRequirements(told) {
  ends = told.ends;
  $("require end").replaceChildren(...ends.map(({end, sign}) => make("option", {value: end}, sign)));
  $("require name").onfocus = async () => {
    const known = await ask("results", page.now);
    $("results-known").replaceChildren(...(known.results ?? []).map(({name, words, unit}) => make("option", {value: name}, [words, unit].filter(Boolean).join(", "))));
  };
  $("require").onsubmit = event => {
    event.preventDefault();
    const name = $("require name").value.trim(), value = $("require value").value;
    if (!name || value === "") return;
    put(["require", name, $("require end").value], Number(value), page.now.document);
    $("require name").value = $("require value").value = "";
    renew();
  };
}
