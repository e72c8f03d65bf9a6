// The page begins here.
import {TOKEN} from "./ask.js";
import {$, make} from "./dom.js";
import {wireFiles} from "./files.js";
import {show} from "./inputs.js";
import {keyResults} from "./results.js";
import {settle, take, undo} from "./scene.js";
import {complain} from "./solving.js";
import {page} from "./state.js";

globalThis.workbench = {page, take};  // for whoever looks from the browser's console

$("pin").onclick = () => {
  page.pinned = page.pinned ? null : {input: page.shown, ...page.found};
  keyResults();
};
$("undo").onclick = undo;
document.onkeydown = event => {
  if (event.key === "z" && (event.ctrlKey || event.metaKey) && event.target.type !== "text") { event.preventDefault(); undo(); }
};
$("inputs").onsubmit = event => event.preventDefault();
wireFiles();
fetch("/start", {headers: TOKEN}).then(answer => answer.json()).then(told => {
  if (told.errors) return complain(told.errors);
  $("entries").replaceChildren(...told.catalogue.map(name => make("option", {value: name})));
  $("effects").tHead.rows[0].append(...[...told.quantities, "verdict"].map(name => make("th", {scope: "col"}, name)));
  page.now = {document: told.document, label: told.label};
  settle();
  show(told);
});
