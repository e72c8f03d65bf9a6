// A switch for each effect and choice, and the table of what each changes.
import {$, make} from "./dom.js";
import {take} from "./scene.js";
import {NOT_YET} from "./solving.js";
import {page} from "./state.js";

export function switchOf({effect, words, what, is_in, can}) {
  const box = make("input", {type: "checkbox", id: `effect ${effect}`, checked: is_in, disabled: !can});
  box.onchange = async () => { await take("switch", {...page.now, effect, is_on: box.checked}) || (box.checked = is_in); };
  const change = make("span", {id: `change ${effect}`}, page.found.is_solved ? NOT_YET : "");
  return make("div", {className: "switch", title: what}, "", box, make("label", {htmlFor: box.id}, words), change);
}

export function effects(told) {
  for (const {effect, most, verdict} of told) $(`change ${effect}`).textContent = most || verdict;
  $("effects").tBodies[0].replaceChildren(...told.map(({what, changes, verdict, why}) => make(
    "tr", {}, "", make("td", {}, what, make("small", {}, why)),
    ...changes.map(text => make("td", {className: "r"}, text)), make("td", {}, verdict))));
}
