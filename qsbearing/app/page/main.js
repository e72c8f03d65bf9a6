// The page begins here.
import {remember, unpacked} from "./address.js";
import {TOKEN, ask} from "./ask.js";
import {$, make} from "./dom.js";
import {wireFiles} from "./files.js";
import {show} from "./inputs.js";
import "./map.js";
import {wireRequirements} from "./requirements.js";
import "./set_drawing.js";
import {redo, settle, take, undo} from "./scene.js";
import {refused} from "./solving.js";
import {page} from "./state.js";
import {pinAll, wireStates} from "./states.js";

globalThis.workbench = {page, take, remember};  // for whoever looks from the browser's console

const FOLDED = matchMedia("(max-width: 60rem)");  // as in the style

$("undo").onclick = undo;
$("redo").onclick = redo;
document.onkeydown = event => {
  if (!(event.ctrlKey || event.metaKey) || event.target.type === "text") return;
  const step = {z: event.shiftKey ? redo : undo, y: redo}[event.key.toLowerCase()];
  if (step) { event.preventDefault(); step(); }
};
$("inputs").onsubmit = event => event.preventDefault();
wireFiles();
wireStates();
const fold = () => { $("switches").open = !FOLDED.matches; };
FOLDED.onchange = fold;
fold();

// The state that the address has; else nothing.
async function ofAddress() {
  if (location.hash.length < 2) return null;
  const state = await unpacked(location.hash.slice(1));
  if (!state) return refused("The address", [{text: "what stands behind # is no state of this page"}]), null;
  let told = await ask("check", state.now);
  if (told.errors) told = await ask("show", {document: state.now.document});  // wrong numbers stay, to be corrected
  if (told.errors) return refused("The address", told.errors), null;
  return {told, state};
}

async function begin(first) {
  const {told, state} = await ofAddress() ?? {told: first, state: {now: {label: first.label}, pins: [], row: 0}};
  page.now = {document: told.document, label: state.now.label};
  page.row = state.row;
  page.pins = state.pins.map(each => ({...each, found: {key: [], rows: []}}));  // until they are solved
  settle();
  show(told);
  if (state.pins.length) await pinAll(state.pins);
}

fetch("/start", {headers: TOKEN}).then(answer => answer.json()).then(told => {
  if (told.errors) return refused("The page", told.errors);
  $("entries").replaceChildren(...told.catalogue.map(name => make("option", {value: name})));
  $("effects").tHead.rows[0].append(...[...told.quantities, "verdict"].map(name => make("th", {scope: "col"}, name)));
  wireRequirements(told);
  globalThis.onhashchange = () => begin(told);
  return begin(told);
});
