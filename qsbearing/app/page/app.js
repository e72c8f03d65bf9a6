"use strict";
// The scene is the page's own: the server is told it with each question and keeps nothing.
const $ = id => document.getElementById(id);
const TOKEN = {"X-Token": new URLSearchParams(location.search).get("token") ?? ""};
const PICTURES = ["shaft", "section", "stiffness", "life", "angles", "loads", "ellipses"];
const OF_ROW = ["section", "angles", "loads", "ellipses"];  // of a set
const MAIN = ["section", "requirements", "key", "every-row", "row", "warnings"], SLOW = [...PICTURES, "effects", "tables"];
const NOT_YET = "not yet solved";
let now = {document: {}, label: ""}, settled = "", past = [], busy = false, again = false, turn = 0;
let shown = null, found = null, pinned = null;  // the input of the results on the page; these; those to compare with
let row = 0, fields = new Map(), late = new AbortController();

async function ask(question, given, signal) {
  try {
    const answer = await fetch("/" + question, {
      method: "POST", headers: {"Content-Type": "application/json", ...TOKEN}, body: JSON.stringify(given), signal});
    return await answer.json();
  } catch (error) {
    return {errors: [{key: "", text: "The program that makes this page no longer answers: start it again"}]};
  }
}

function make(tag, attributes = {}, text = "", ...children) {
  const made = Object.assign(document.createElement(tag), attributes);
  if (text) made.textContent = text;
  made.append(...children);
  return made;
}

// Drawing and map follow the inputs by these events.
const tell = (event, detail) => document.dispatchEvent(new CustomEvent(event, {detail}));

const at = (path, table = now.document) => path.reduce((inner, name) => inner?.[name], table);

function put(path, value) {
  let table = now.document;
  for (const name of path.slice(0, -1)) table = table[name] ??= {};
  if (value === undefined) delete table[path.at(-1)];
  else table[path.at(-1)] = value;
}

// What a person did is done: it can be undone, and the fields follow where the tables have others than before.
function settle() {
  const text = JSON.stringify(now);
  if (text === settled) return;
  if (settled) past.push(settled);
  settled = text;
  $("undo").disabled = past.length === 0;
}

async function take(question, given) {
  const told = await ask(question, given);
  if (told.errors) return complain(told.errors), false;
  now = {document: told.document, label: given.label ?? now.label};
  settle();
  kept(() => show(told));
  return true;
}

// What has the focus is made anew, and has it still.
function kept(change) {
  const id = document.activeElement?.id;
  change();
  if (id && document.activeElement?.id !== id) $(id)?.focus();
}

const isSet = () => "rows" in now.document;

function show(told) {
  $("note").textContent = told.note;
  $("entry").disabled = isSet();  // rows may have bearings of their own
  const open = new Set([...document.querySelectorAll("details[open]")].map(each => each.id));
  fields = new Map(told.fields.map(field => [field.path.join("."), field]));
  for (const place of ["daily", "others"]) {
    const groups = Map.groupBy(told.fields.filter(field => field.is_daily === (place === "daily")), field => field.group);
    $(place).replaceChildren(...[...groups].map(([title, own]) => {
      const words = title.replaceAll("_", " ") || "scene";
      if (place === "daily") return make("fieldset", {}, "", make("legend", {}, words), ...own.map(fieldOf));
      const head = make("summary", {}, words === "effects" ? "choices of the model" : words, make("span", {}, title === "bearing" ? sizes() : ""));
      return make("details", {id: `table ${title}`, open: open.has(`table ${title}`)}, "", head, ...own.map(fieldOf));
    }));
  }
  const first = make("option", {value: ""}, "choose ...");
  $("add").replaceChildren(first, ...told.addable.map((key, number) => make("option", {value: number}, key.path.join("."))));
  $("add").onchange = () => add(told.addable[$("add").value]);
  tell("shown", told);
  solve();
}

function sizes() {
  const {ball_count, ball_diameter_mm, pitch_diameter_mm, free_contact_angle_deg: angle} = now.document.bearing ?? {};
  return ball_count ? `: ${ball_count} × ${ball_diameter_mm} on ${pitch_diameter_mm} mm${angle ? `, ${angle}°` : ""}` : "";
}

function fieldOf({path, key: id, words, unit, options, low, high, step, is_needed}) {
  const value = at(path), field = make("div", {className: options ? "field words" : "field"});
  field.append(make("label", {htmlFor: id, title: id}, words));
  let range = "";
  if (options) {
    const input = make(options.length ? "select" : "input", {id});
    if (options.length) input.append(...[...new Set([value, ...options])].map(word => make("option", {value: word}, word)));
    input.value = value;
    input.onchange = () => { put(path, input.value); renew(); };
    field.append(input);
  } else {
    const number = make("input", {id, type: "number", step: "any", value});
    range = make("input", {id: `${id} slider`, type: "range", min: low, max: high, step, value, ariaLabel: `${words}, slider`});
    range.dataset.slides = id;
    range.oninput = () => { number.value = range.value; put(path, Number(range.value)); solve(); };
    range.onchange = settle;
    number.oninput = () => { put(path, number.value === "" ? "" : Number(number.value)); solve(); };
    number.onchange = renew;
    field.append(number, make("span", {}, unit));
  }
  if (!is_needed) {
    const remove = make("button", {id: `${id} out`, type: "button", title: `Leave out ${words}`, ariaLabel: `Leave out ${words}`}, "×");
    remove.onclick = () => { put(path, undefined); renew(); };
    field.append(remove);
  }
  field.append(range, make("span", {className: "wrong", id: `${id} wrong`}));
  return field;
}

// Fields and sliders anew around what the tables have now; wrong numbers stay, to be corrected.
async function renew() {
  const told = await ask("show", {document: now.document});
  if (told.errors) return complain(told.errors);
  settle();
  kept(() => show(told));
}

function add(key) {
  for (const path of key.replaces) if (at(path.slice(0, -1))) put(path, undefined);
  put(key.path, key.value);
  renew().then(() => {
    const field = $(key.path.join("."));
    field?.closest("details")?.setAttribute("open", "");
    field?.focus();
  });
}

function complain(errors) {
  for (const each of document.querySelectorAll("[aria-invalid]")) each.removeAttribute("aria-invalid");
  for (const each of document.querySelectorAll(".wrong")) each.textContent = "";
  const elsewhere = [];
  for (const {key, text} of errors) {
    const field = key && $(key);
    if (!field) { elsewhere.push(text); continue; }
    field.setAttribute("aria-invalid", "true");
    field.setAttribute("aria-describedby", `${key} wrong`);
    field.closest("details")?.setAttribute("open", "");
    $(`${key} wrong`).textContent += text + "\n";
  }
  $("errors").replaceChildren(...elsewhere.map(text => make("li", {}, text)));
  if (errors.length) grey("Not solved.");
  tell("refused", errors);
}

// What is on the page is grey as long as it is of another input than the fields have, and is said to be of that.
function grey(why) {
  if (!shown || JSON.stringify(shown) === JSON.stringify(now)) return;
  for (const id of [...MAIN, ...SLOW]) $(id).classList.add("stale");
  for (const each of document.querySelectorAll("#boxes span")) each.textContent = NOT_YET;
  $("pin").disabled = true;
  $("of").className = "old";
  $("of").textContent = `${why} The results are of ${differences(shown, now) || shown.label || "the scene before"}.`;
}

// What an input has that is not so in another one.
function differences(one, other) {
  const before = leaves(one.document), after = leaves(other.document);
  const keys = [...new Set([...before.keys(), ...after.keys()])].filter(key => before.get(key) !== after.get(key));
  const told = keys.slice(0, 3).map(key => {
    const {words, group, unit} = fields.get(key) ?? {words: key, group: "", unit: ""};
    const name = /\d/.test(group) ? `${group}, ${words}` : words, value = before.get(key);
    if (!before.has(key)) return `no ${name}`;
    return `${name} ${typeof value === "number" ? value.toLocaleString("en-GB", {maximumFractionDigits: 9}) : value} ${unit}`.trim();
  });
  return [...told, ...(keys.length > 3 ? ["..."] : [])].join(", ");
}

function leaves(table, before = "", into = new Map()) {
  for (const [name, value] of Object.entries(table ?? {})) {
    const path = before ? `${before}.${name}` : name;
    if (value && typeof value === "object") leaves(value, path, into);
    else into.set(path, value);
  }
  return into;
}

function fresh(ids) {
  for (const id of ids) $(id).classList.remove("stale");
}

// One question at a time: while it is out the slider may move on, and only where it is then is asked next.
async function solve() {
  again = true;
  turn += 1;
  late.abort();  // nobody waits for what is to be read of the input before
  grey("Solving ...");
  tell("changed", now);
  if (busy) return;
  busy = true;
  while (again) {
    again = false;
    const asked = JSON.stringify(now), told = await ask("solve", now);
    complain(told.errors ?? []);
    if (!told.errors) {
      [shown, found] = [JSON.parse(asked), told];
      kept(results);
      if (JSON.stringify(now) === asked) rest(turn);
      else grey("Solving ...");
    }
    await new Promise(done => requestAnimationFrame(done));
  }
  busy = false;
}

// The results on the page are those of `shown`.
function results() {
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
  row = Math.min(row, Math.max(found.rows.length - 1, 0));
  keyResults();
  tell("solved", {input: shown, found});
}

// Key results, those of one row of a set among them, beside those that are pinned.
function keyResults() {
  $("pin").disabled = !found.is_solved && !pinned;
  $("pin").setAttribute("aria-pressed", String(Boolean(pinned)));
  $("pin").textContent = pinned ? "Unpin" : "Pin";
  $("said").textContent = pinned ? `Pinned: ${differences(pinned.input, shown) || "these inputs"}.` : "";
  cards("key", found.key, pinned?.key);
  $("rows").hidden = !found.rows.length;
  $("every-row").innerHTML = found.every_row;
  $("tabs").replaceChildren(...found.rows.map(({name}, number) => {
    const tab = make("button", {type: "button", id: `tab ${number}`, ariaPressed: String(number === row)}, name);
    tab.onclick = () => { row = number; kept(keyResults); rest(++turn, OF_ROW); };
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

// What takes longer follows when nothing moves.
async function rest(mine, only) {
  late.abort();
  const {signal} = late = new AbortController(), input = shown;
  if (only) for (const id of only) $(id).classList.add("stale");
  await new Promise(done => setTimeout(done, 60));
  for (const name of found.pictures) {
    if (only && !only.includes(name) && !$(name).classList.contains("stale")) continue;
    if (mine !== turn) return;
    const told = await ask("picture", {...input, name, row}, signal);
    if (told.errors || mine !== turn) return;
    Object.assign($(name), {role: "img", ariaLabel: told.alt, innerHTML: told.picture});
    fresh([name]);
  }
  for (const question of ["rest", "effects"]) {
    if (!$(question === "rest" ? "tables" : "effects").classList.contains("stale") || mine !== turn) continue;
    const told = await ask(question, input, signal);
    if (mine !== turn || told.errors) return;
    if (question === "rest") $("tables").innerHTML = told.tables;
    else effects(told.effects);
    fresh([question === "rest" ? "tables" : "effects"]);
  }
}

function switchOf({effect, words, what, is_in, can}) {
  const box = make("input", {type: "checkbox", id: `effect ${effect}`, checked: is_in, disabled: !can});
  box.onchange = async () => { await take("switch", {...now, effect, is_on: box.checked}) || (box.checked = is_in); };
  const change = make("span", {id: `change ${effect}`}, found.is_solved ? NOT_YET : "");
  return make("div", {className: "switch", title: what}, "", box, make("label", {htmlFor: box.id}, words), change);
}

function effects(told) {
  for (const {effect, most, verdict} of told) $(`change ${effect}`).textContent = most || verdict;
  $("effects").tBodies[0].replaceChildren(...told.map(({what, changes, verdict, why}) => make(
    "tr", {}, "", make("td", {}, what, make("small", {}, why)),
    ...changes.map(text => make("td", {className: "r"}, text)), make("td", {}, verdict))));
}

async function undo() {
  if (!past.length) return;
  now = JSON.parse(settled = past.pop());
  $("undo").disabled = past.length === 0;
  const told = await ask("show", {document: now.document});
  kept(() => show(told));
}

async function saved(use) {
  const told = await ask("save", now);
  if (told.errors) return complain(told.errors);
  use(told);
}

$("pin").onclick = () => {
  pinned = pinned ? null : {input: shown, ...found};
  keyResults();
};
$("undo").onclick = undo;
document.onkeydown = event => {
  if (event.key === "z" && (event.ctrlKey || event.metaKey) && event.target.type !== "text") { event.preventDefault(); undo(); }
};
$("save").onclick = () => saved(({file, text}) => {
  const link = make("a", {download: file, href: URL.createObjectURL(new Blob([text], {type: "application/toml"}))});
  link.click();
  URL.revokeObjectURL(link.href);
});
$("command").onclick = () => saved(({command}) => {
  $("typed").textContent = command;
  $("typed").hidden = false;
  navigator.clipboard?.writeText(command).then(() => { $("said").textContent = "The command is in the clipboard."; }, () => {});
});
$("open").onchange = async () => {
  const [file] = $("open").files;
  if (file && file.size > 1e6) complain([{key: "", text: `${file.name} is longer than 1 MB: this is no scene`}]);
  else if (file) await take("open", {text: await file.text(), label: file.name.replace(/\.toml$/i, "")});
  $("open").value = "";
};
$("entry").onchange = () => take("check", {document: {...now.document, bearing: {name: $("entry").value}}, label: ""});
$("inputs").onsubmit = event => event.preventDefault();
fetch("/start", {headers: TOKEN}).then(answer => answer.json()).then(told => {
  if (told.errors) return complain(told.errors);
  $("entries").replaceChildren(...told.catalogue.map(name => make("option", {value: name})));
  $("effects").tHead.rows[0].append(...[...told.quantities, "verdict"].map(name => make("th", {scope: "col"}, name)));
  now = {document: told.document, label: told.label};
  settle();
  show(told);
});
