// A switch for each effect and choice, what each changes, and those that are missing and can be added.
import {$, make} from "./dom.js";
import {change} from "./scene.js";
import {NOT_YET} from "./solving.js";
import {page} from "./state.js";

export function switchOf({effect, words, what, is_in, can}) {
  const box = make("input", {type: "checkbox", id: `effect ${effect}`, checked: is_in, disabled: !can});
  box.onchange = async () => { await switched(effect, box.checked) || (box.checked = is_in); };
  const share = make("span", {id: `change ${effect}`}, page.found.is_solved ? NOT_YET : "");
  const form = formOf(effect), more = make("button", {type: "button", className: "link", id: `numbers ${effect}`, ariaLabel: `Numbers of ${words}`}, "numbers");
  more.onclick = () => opened(formOf(effect));
  return make("div", {className: "switch", title: what}, "", box, make("label", {htmlFor: box.id}, words), ...(form ? [more] : []), share);
}

const formOf = effect => document.querySelector(`#others details[id$=", ${effect}"]`);

function opened(form) {
  form?.setAttribute("open", "");
  form?.querySelector("summary").focus();
}

async function switched(effect, is_on) {
  const told = await change("switch", {label: page.now.label, effect, is_on});
  if (!told) return false;
  $("said").textContent = told.said;
  if (is_on) formOf(effect)?.setAttribute("open", "");
  return true;
}

export function effects(told) {
  for (const {effect, most, verdict} of told) $(`change ${effect}`).textContent = most || verdict;
  $("effects").tBodies[0].replaceChildren(...told.map(({what, changes, verdict, why}) => make(
    "tr", {}, "", make("td", {}, what, make("small", {}, why)),
    ...changes.map(text => make("td", {className: "r"}, text)), make("td", {}, verdict))));
  missing(told.filter(each => each.is_missing));
}

function missing(effects) {
  $("missing").hidden = !effects.length;
  $("missing").replaceChildren(...effects.map(({effect, most}) => {
    const words = page.found.effects.find(each => each.effect === effect).words;
    const add = make("button", {type: "button", id: `add ${effect}`, title: "Not in the model"}, `Add ${words} (${most})`);
    add.onclick = async () => { await switched(effect, true) && opened(formOf(effect)); };
    return add;
  }));
}
