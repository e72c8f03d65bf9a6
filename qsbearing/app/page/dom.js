// Elements of the page, and tables within tables.
export const $ = id => document.getElementById(id);

// What follows the inputs, such as a drawing, hears of them: shown, changed, refused, solved.
export const tell = (event, detail) => document.dispatchEvent(new CustomEvent(event, {detail}));

export function make(tag, attributes = {}, text = "", ...children) {
  const made = Object.assign(document.createElement(tag), attributes);
  if (text) made.textContent = text;
  made.append(...children);
  return made;
}

// What has the focus is made anew, and has it still.
export function kept(change) {
  const id = document.activeElement?.id;
  change();
  if (id && document.activeElement?.id !== id) $(id)?.focus();
}

export const at = (path, table) => path.reduce((inner, name) => inner?.[name], table);

export function put(path, value, table) {
  for (const name of path.slice(0, -1)) {
    if (typeof table[name] !== "object") table[name] = {};
    table = table[name];
  }
  if (value === undefined) delete table[path.at(-1)];
  else table[path.at(-1)] = value;
}

// Every value of tables, by its path.
export function leaves(table, before = "", into = new Map()) {
  for (const [name, value] of Object.entries(table ?? {})) {
    const path = before ? `${before}.${name}` : name;
    if (value && typeof value === "object") leaves(value, path, into);
    else into.set(path, value);
  }
  return into;
}
