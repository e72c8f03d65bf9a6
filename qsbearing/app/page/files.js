// What goes out of the page and comes in: files, and the command of the scene.
import {ask} from "./ask.js";
import {$, make} from "./dom.js";
import {take} from "./scene.js";
import {complain} from "./solving.js";
import {page} from "./state.js";

async function saved(use) {
  const told = await ask("save", page.now);
  if (told.errors) return complain(told.errors);
  use(told);
}

function download(file, text, type) {
  const link = make("a", {download: file, href: URL.createObjectURL(new Blob([text], {type}))});
  link.click();
  URL.revokeObjectURL(link.href);
}

export function wireFiles() {
  $("save").onclick = () => saved(({file, text}) => download(file, text, "application/toml"));
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
  $("entry").onchange = () => take("check", {document: {...page.now.document, bearing: {name: $("entry").value}}, label: ""});
}
