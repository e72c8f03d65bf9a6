// Fields of the scene, as the server describes them.
import {channelOf} from "./channels.js";
import {$, at, make, put, tell} from "./dom.js";
import {requirements} from "./requirements.js";
import {renew, settle} from "./scene.js";
import {solve} from "./solving.js";
import {isSet, page} from "./state.js";

export function show(told) {
  $("note").textContent = told.note;
  $("entry").disabled = isSet();  // rows may have bearings of their own
  const open = new Set([...document.querySelectorAll("#inputs details[open]")].map(each => each.id));
  page.fields = new Map(told.fields.map(field => [field.path.join("."), field]));
  const plain = told.fields.filter(field => !field.channel);
  for (const place of ["daily", "others"]) {
    const groups = Map.groupBy(plain.filter(field => field.is_daily === (place === "daily")), field => field.group);
    $(place).replaceChildren(...[...groups].map(([title, own]) => {
      const words = title.replaceAll("_", " ") || "scene";
      const channels = title === "operation" && place === "daily" ? told.channels.map(channelOf) : [];
      if (place === "daily") return make("fieldset", {}, "", make("legend", {}, words), ...own.map(each => fieldOf(each)), ...channels);
      const head = make("summary", {}, words === "effects" ? "choices of the model" : words, make("span", {}, title === "bearing" ? sizes() : ""));
      return make("details", {id: `table ${title}`, open: open.has(`table ${title}`)}, "", head, ...own.map(each => fieldOf(each)));
    }));
  }
  const first = make("option", {value: ""}, "choose ...");
  $("add").replaceChildren(first, ...told.addable.map((key, number) => make("option", {value: number}, key.path.join("."))));
  $("add").onchange = () => addedKey(told.addable[$("add").value]);
  addedKey();
  requirements();
  tell("shown", told);
  solve();
}

function sizes() {
  const {ball_count, ball_diameter_mm, pitch_diameter_mm, free_contact_angle_deg: angle} = page.now.document.bearing ?? {};
  return ball_count ? `: ${ball_count} × ${ball_diameter_mm} on ${pitch_diameter_mm} mm${angle ? `, ${angle}°` : ""}` : "";
}

// A value for a field: what it stands in place of goes, what is usual beside it comes.
function give({path, replaces, brings}, value) {
  const tables = page.now.document;
  for (const other of value === undefined ? [] : replaces) put(other, undefined, tables);
  for (const {path: beside, value: usual, words} of value === undefined ? [] : brings) {
    if (at(beside, tables) !== undefined) continue;
    put(beside, usual, tables);
    $("said").textContent = `Assumed: ${words}.`;
  }
  put(path, value, tables);
}

export function fieldOf(own, isChannel = false) {
  const {path, key: id, words, unit, options, note, low, high, step, is_needed, is_given} = own;
  const value = is_given ? at(path, page.now.document) : "", field = make("div", {className: options ? "field words" : "field"});
  if (!isChannel) field.append(make("label", {htmlFor: id, title: note ? `${id}: ${note}` : id}, words));
  let range = "";
  if (options) {
    const input = make(options.length ? "select" : "input", {id});
    const every = [...new Set([...(is_given && is_needed ? [value] : ["", value]), ...options])];
    if (options.length) input.append(...every.map(word => make("option", {value: word}, word || "not given")));
    input.value = value;
    input.onchange = () => { give(own, input.value || undefined); renew(); };
    field.append(input);
  } else {
    const number = make("input", {id, type: "number", step: "any", value});
    if (isChannel) number.ariaLabel = words;
    const read = empty => number.value === "" ? empty : Number(number.value);
    number.oninput = () => { give(own, read(is_given ? "" : undefined)); solve(); };
    number.onchange = () => { give(own, read(is_needed || is_given && isChannel ? "" : undefined)); renew(); };
    field.append(number, make("span", {}, unit));
    if (is_given) {
      range = make("input", {id: `${id} slider`, type: "range", min: low, max: high, step, value, ariaLabel: `${words}, slider`});
      range.dataset.slides = id;
      range.oninput = () => { number.value = range.value; give(own, Number(range.value)); solve(); };
      range.onchange = settle;
    }
  }
  if (!is_needed && is_given && !isChannel) {
    const remove = make("button", {id: `${id} out`, type: "button", title: `Leave out ${words}`, ariaLabel: `Leave out ${words}`}, "×");
    remove.onclick = () => { give(own, undefined); renew(); };
    field.append(remove);
  }
  field.append(range, make("span", {className: "wrong", id: `${id} wrong`}));
  return field;
}

// A key begins with the number that is typed for it, not before.
function addedKey(key) {
  const number = $("added"), name = key?.path.join(".");
  number.hidden = !key;
  number.value = "";
  $("added unit").textContent = key?.unit ?? "";
  if (!key) return;
  number.ariaLabel = `${name}, its number`;
  number.focus();
  number.onchange = () => {
    if (number.value === "") return;
    const tables = page.now.document;
    for (const path of key.replaces) if (at(path.slice(0, -1), tables)) put(path, undefined, tables);
    put(key.path, Number(number.value), tables);
    renew().then(() => {
      const field = $(name);
      field?.closest("details")?.setAttribute("open", "");
      field?.focus();
    });
  };
}
