"use strict";
// The scene is the page's own: the server is told it with each question and keeps nothing.
const $ = id => document.getElementById(id);
const TOKEN = {"X-Token": new URLSearchParams(location.search).get("token") ?? ""};
const PICTURES = ["angles", "loads", "stiffness", "life", "ellipses", "shaft"];
const MAIN = ["section", "key", "warnings"], SLOW = [...PICTURES, "effects", "tables"], PATIENCE = 150;
let now = {document: {}, label: ""}, settled = "", past = [], busy = false, again = false, turn = 0;
let shown = null, waits = 0;  // the input that the results on the page are of; a timer

async function ask(question, given) {
  try {
    const answer = await fetch("/" + question, {
      method: "POST", headers: {"Content-Type": "application/json", ...TOKEN}, body: JSON.stringify(given)});
    return await answer.json();
  } catch (error) {
    return {errors: [{key: "", text: "The program that makes this page no longer answers: start it again"}]};
  }
}

function make(tag, attributes = {}, text = "") {
  const made = Object.assign(document.createElement(tag), attributes);
  if (text) made.textContent = text;
  return made;
}

const at = (path, table = now.document) => path.reduce((found, name) => found?.[name], table);

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
  const found = await ask(question, given);
  if (found.errors) return complain(found.errors), false;
  now = {document: found.document, label: given.label ?? now.label};
  settle();
  show(found);
  return true;
}

const isSet = () => "rows" in now.document;

function show(found) {
  const groups = new Map();
  $("note").textContent = found.note;
  $("entry").disabled = isSet();  // rows may have bearings of their own
  $("effects").closest("section").hidden = isSet();
  for (const field of found.fields) {
    const title = field.path.slice(0, -1).join(", ").replaceAll("_", " ") || "scene";
    if (!groups.has(title)) groups.set(title, []);
    groups.get(title).push(fieldOf(field));
  }
  const focused = document.activeElement?.id;
  $("inputs").replaceChildren(...[...groups].map(([title, fields]) => {
    const set = make("fieldset");
    set.append(make("legend", {}, title), ...fields);
    return set;
  }));
  if (focused) document.getElementById(focused)?.focus();
  const first = make("option", {value: ""}, "choose ...");
  $("add").replaceChildren(first, ...found.addable.map((key, number) => make("option", {value: number}, key.path.join("."))));
  $("add").onchange = () => add(found.addable[$("add").value]);
  solve();
}

function fieldOf({path, words, unit, options, low, high, step, is_needed}) {
  const id = path.join("."), value = at(path), row = make("div", {className: "field"});
  const label = make("label", {htmlFor: id, title: id}, words);
  row.append(label);
  if (options) {
    const input = make(options.length ? "select" : "input", {id});
    if (options.length) input.append(...[...new Set([value, ...options])].map(word => make("option", {value: word}, word)));
    input.value = value;
    input.onchange = () => { put(path, input.value); renew(); };
    row.append(input);
  } else {
    const range = make("input", {id: `${id} slider`, type: "range", min: low, max: high, step, value, ariaLabel: `${words}, slider`});
    const number = make("input", {id, type: "number", step: "any", value});
    range.dataset.slides = id;
    range.oninput = () => { number.value = range.value; put(path, Number(range.value)); solve(); };
    range.onchange = settle;
    number.oninput = () => { put(path, number.value === "" ? "" : Number(number.value)); solve(); };
    number.onchange = renew;
    row.append(range, number, make("span", {}, unit));
  }
  if (!is_needed) {
    const remove = make("button", {id: `${id} out`, type: "button", title: `Leave out ${words}`, ariaLabel: `Leave out ${words}`}, "×");
    remove.onclick = () => { put(path, undefined); renew(); };
    row.append(remove);
  }
  row.append(make("span", {className: "wrong", id: `${id} wrong`}));
  return row;
}

// Fields and sliders anew around what the tables have now; wrong numbers stay, to be corrected.
async function renew() {
  const found = await ask("show", {document: now.document});
  if (found.errors) return complain(found.errors);
  settle();
  show(found);
}

function add(key) {
  for (const path of key.replaces) if (at(path.slice(0, -1))) put(path, undefined);
  put(key.path, key.value);
  renew().then(() => document.getElementById(key.path.join("."))?.focus());
}

function complain(errors) {
  for (const each of document.querySelectorAll("[aria-invalid]")) each.removeAttribute("aria-invalid");
  for (const each of document.querySelectorAll(".wrong")) each.textContent = "";
  const elsewhere = [];
  for (const {key, text} of errors) {
    const field = document.getElementById(key);
    if (!field || !key) { elsewhere.push(text); continue; }
    field.setAttribute("aria-invalid", "true");
    field.setAttribute("aria-describedby", `${key} wrong`);
    document.getElementById(`${key} wrong`).textContent += text + "\n";
  }
  $("errors").replaceChildren(...elsewhere.map(text => make("li", {}, text)));
  if (errors.length) grey("Not solved.");
}

// What is on the page is grey as long as it is of another input than the fields have, and is said to be of that.
function grey(why) {
  if (!shown || JSON.stringify(shown) === JSON.stringify(now)) return;
  for (const id of [...MAIN, ...SLOW]) $(id).classList.add("stale");
  const before = leaves(shown.document), after = leaves(now.document);
  const other = [...new Set([...before.keys(), ...after.keys()])].filter(key => before.get(key) !== after.get(key));
  const told = other.slice(0, 3).map(key => before.has(key) ? `${key} = ${before.get(key)}` : `without ${key}`);
  if (other.length > 3) told.push("...");
  $("of").textContent = `${why} The results shown are those of ${told.join(", ") || shown.label || "the scene before"}.`;
}

function leaves(table, before = "", found = new Map()) {
  for (const [name, value] of Object.entries(table ?? {})) {
    const path = before ? `${before}.${name}` : name;
    if (value && typeof value === "object" && !Array.isArray(value)) leaves(value, path, found);
    else found.set(path, Array.isArray(value) ? JSON.stringify(value) : value);
  }
  return found;
}

function fresh(ids) {
  for (const id of ids) $(id).classList.remove("stale");
}

// One question at a time: while it is out the slider may move on, and only where it is then is asked next.
async function solve() {
  again = true;
  turn += 1;
  if (busy) return;
  busy = true;
  while (again) {
    again = false;
    const asked = JSON.stringify(now);
    clearTimeout(waits);
    waits = setTimeout(() => grey("Solving ..."), PATIENCE);
    const found = await ask("solve", now);
    clearTimeout(waits);
    complain(found.errors ?? []);
    if (!found.errors) {
      shown = JSON.parse(asked);
      for (const id of SLOW) $(id).classList.add("stale");
      fresh(MAIN);
      $("of").textContent = "";
      $("name").textContent = (!isSet() && now.document.bearing?.name) || now.label || "Bearing";
      Object.assign($("section"), {innerHTML: found.picture, hidden: found.picture === ""});
      for (const id of ["key", "warnings"]) $(id).innerHTML = found[id];
      const others = PICTURES.filter(id => !found.pictures.includes(id));
      for (const id of others) $(id).replaceChildren();
      fresh(others);
      rest(turn, found.pictures);
    }
    await new Promise(done => requestAnimationFrame(done));
  }
  busy = false;
}

// What takes longer follows when nothing moves.
async function rest(mine, pictures) {
  await new Promise(done => setTimeout(done, 60));
  for (const name of pictures) {
    if (mine !== turn) return;
    const found = await ask("picture", {...now, name});
    if (found.errors || mine !== turn) return;
    Object.assign($(name), {role: "img", ariaLabel: found.alt, innerHTML: found.picture});
    fresh([name]);
  }
  if (mine !== turn) return;
  const found = await ask("rest", now);
  if (mine !== turn || found.errors) return;
  $("tables").innerHTML = found.tables;
  $("effects").tBodies[0].replaceChildren(...found.effects.map(effectOf));
  fresh(["tables", "effects"]);
}

function effectOf({effect, what, is_in, can, changes, verdict, why}) {
  const row = make("tr"), cell = make("td"), box = make("input", {type: "checkbox", id: `effect ${effect}`, checked: is_in, disabled: !can});
  box.onchange = async () => { await take("switch", {...now, effect, is_on: box.checked}) || (box.checked = is_in); };
  cell.append(box);
  const name = make("td");
  name.append(make("label", {htmlFor: box.id}, what), make("small", {}, why));
  row.append(cell, name, ...changes.map(text => make("td", {className: "r"}, text)), make("td", {}, verdict));
  return row;
}

async function undo() {
  if (!past.length) return;
  now = JSON.parse(settled = past.pop());
  $("undo").disabled = past.length === 0;
  show(await ask("show", {document: now.document}));
}

async function saved(use) {
  const found = await ask("save", now);
  if (found.errors) return complain(found.errors);
  use(found);
}

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
fetch("/start", {headers: TOKEN}).then(answer => answer.json()).then(found => {
  if (found.errors) return complain(found.errors);
  $("entries").replaceChildren(...found.catalogue.map(name => make("option", {value: name})));
  $("effects").tHead.rows[0].append(...[...found.quantities, "verdict"].map(name => make("th", {scope: "col"}, name)));
  now = {document: found.document, label: found.label};
  settle();
  show(found);
});
