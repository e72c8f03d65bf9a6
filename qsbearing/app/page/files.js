// What goes out of the page and comes in: files, the report, the link, and the command of the scene.
import {$, make} from "./dom.js";
import {take} from "./scene.js";
import {answered, refused} from "./solving.js";
import {page} from "./state.js";

async function saved(question, use) {
  const told = await answered(question, page.now);
  if (told) use(told);
}

export function download(file, text, type) {
  const link = make("a", {download: file, href: URL.createObjectURL(new Blob([text], {type}))});
  link.click();
  URL.revokeObjectURL(link.href);
}

function copied(text, what) {
  $("typed").textContent = text;
  $("typed").hidden = false;
  navigator.clipboard?.writeText(text).then(() => { $("said").textContent = `The ${what} is in the clipboard.`; }, () => {});
}

export function wireFiles() {
  $("save").onclick = () => saved("save", ({file, text}) => download(file, text, "application/toml"));
  $("report").onclick = async () => {
    $("said").textContent = "Writing the report ...";
    await saved("report", ({file, text}) => download(file, text, "text/html"));
    $("said").textContent = "";
  };
  $("table").onclick = () => saved("table", ({file, text}) => download(file, text, "text/csv"));
  $("link").onclick = () => copied(location.href, "link");
  $("command").onclick = () => saved("save", ({command}) => copied(command, "command"));
  $("open").onchange = async () => {
    const [file] = $("open").files;
    if (file && file.size > 1e6) refused(file.name, [{text: "is longer than 1 MB: this is no scene"}]);
    else if (file) await take("open", {text: await file.text(), label: file.name.replace(/\.toml$/i, "")}, file.name);
    $("open").value = "";
  };
  $("entry").onchange = () => take("bearing", {document: page.now.document, label: "", name: $("entry").value}, $("entry").value);
}
