// What the page knows. The scene is the page's own.
import {leaves} from "./dom.js";
import {printed} from "./typed.js";

export const page = {
  now: {document: {}, label: ""}, settled: "", past: [], future: [], busy: false, again: false, turn: 0,
  shown: null, found: null,  // the input of the results on the page, and these
  pins: [],                  // states that stand beside them: a letter, the input, and what was found of it
  loaded: new Set(),         // channels that carry a load which is 0 so far
  row: 0, fields: new Map(), late: new AbortController(),
};

export const isSet = () => "rows" in page.now.document;

// What an input has that is not so in another one.
export function differences(one, other) {
  const before = leaves(one.document), after = leaves(other.document);
  const keys = [...new Set([...before.keys(), ...after.keys()])].filter(key => before.get(key) !== after.get(key));
  const told = keys.slice(0, 3).map(key => {
    const {words, group, unit} = page.fields.get(key) ?? {words: key.replace(/^require\./, "limit "), group: "", unit: ""};
    const name = /\d/.test(group) ? `${group}, ${words}` : words;
    if (!before.has(key)) return `no ${name}`;
    return `${name} ${printed(before.get(key), 12)} ${unit}`.trim();
  });
  return [...told, ...(keys.length > 3 ? ["..."] : [])].join(", ");
}
