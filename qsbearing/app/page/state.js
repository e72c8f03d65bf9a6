// What the page knows. The scene is the page's own.
import {leaves} from "./dom.js";

export const page = {
  now: {document: {}, label: ""}, settled: "", past: [], busy: false, again: false, turn: 0,
  shown: null, found: null, pinned: null,  // the input of the results on the page; these; those to compare with
  row: 0, fields: new Map(), late: new AbortController(),
};

export const isSet = () => "rows" in page.now.document;

// What an input has that is not so in another one.
export function differences(one, other) {
  const before = leaves(one.document), after = leaves(other.document);
  const keys = [...new Set([...before.keys(), ...after.keys()])].filter(key => before.get(key) !== after.get(key));
  const told = keys.slice(0, 3).map(key => {
    const {words, group, unit} = page.fields.get(key) ?? {words: key, group: "", unit: ""};
    const name = /\d/.test(group) ? `${group}, ${words}` : words, value = before.get(key);
    if (!before.has(key)) return `no ${name}`;
    return `${name} ${typeof value === "number" ? value.toLocaleString("en-GB", {maximumFractionDigits: 9}) : value} ${unit}`.trim();
  });
  return [...told, ...(keys.length > 3 ? ["..."] : [])].join(", ");
}
