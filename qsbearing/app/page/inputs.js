// Fields of the scene, as the server describes them.
import {$, at, make, put} from "./dom.js";
import {renew, settle} from "./scene.js";
import {solve} from "./solving.js";
import {isSet, page} from "./state.js";

export function show(told) {
  $("note").textContent = told.note;
  $("entry").disabled = isSet();  // rows may have bearings of their own
  const open = new Set([...document.querySelectorAll("details[open]")].map(each => each.id));
  page.fields = new Map(told.fields.map(field => [field.path.join("."), field]));
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
  solve();
}

function sizes() {
  const {ball_count, ball_diameter_mm, pitch_diameter_mm, free_contact_angle_deg: angle} = page.now.document.bearing ?? {};
  return ball_count ? `: ${ball_count} × ${ball_diameter_mm} on ${pitch_diameter_mm} mm${angle ? `, ${angle}°` : ""}` : "";
}

function fieldOf({path, key: id, words, unit, options, low, high, step, is_needed}) {
  const value = at(path, page.now.document), field = make("div", {className: options ? "field words" : "field"});
  const give = given => put(path, given, page.now.document);
  field.append(make("label", {htmlFor: id, title: id}, words));
  let range = "";
  if (options) {
    const input = make(options.length ? "select" : "input", {id});
    if (options.length) input.append(...[...new Set([value, ...options])].map(word => make("option", {value: word}, word)));
    input.value = value;
    input.onchange = () => { give(input.value); renew(); };
    field.append(input);
  } else {
    const number = make("input", {id, type: "number", step: "any", value});
    range = make("input", {id: `${id} slider`, type: "range", min: low, max: high, step, value, ariaLabel: `${words}, slider`});
    range.dataset.slides = id;
    range.oninput = () => { number.value = range.value; give(Number(range.value)); solve(); };
    range.onchange = settle;
    number.oninput = () => { give(number.value === "" ? "" : Number(number.value)); solve(); };
    number.onchange = renew;
    field.append(number, make("span", {}, unit));
  }
  if (!is_needed) {
    const remove = make("button", {id: `${id} out`, type: "button", title: `Leave out ${words}`, ariaLabel: `Leave out ${words}`}, "×");
    remove.onclick = () => { give(undefined); renew(); };
    field.append(remove);
  }
  field.append(range, make("span", {className: "wrong", id: `${id} wrong`}));
  return field;
}

function add(key) {
  const tables = page.now.document;
  for (const path of key.replaces) if (at(path.slice(0, -1), tables)) put(path, undefined, tables);
  put(key.path, key.value, tables);
  renew().then(() => {
    const field = $(key.path.join("."));
    field?.closest("details")?.setAttribute("open", "");
    field?.focus();
  });
}
