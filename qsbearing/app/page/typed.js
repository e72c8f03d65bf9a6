// A number that a drawing or a map changes goes into its field, and from there on the way of every number typed.
import {$} from "./dom.js";

const told = (field, event) => field?.dispatchEvent(new Event(event, {bubbles: true}));

// While it is dragged; `settle` follows.
export function type(key, value) {
  const field = $(key);
  if (!field) return;
  field.value = value;
  told(field, "input");
}

export const settle = key => told($(key), "change");

export function choose(key, word) {
  const field = $(key);
  if (!field) return;
  field.value = word;
  told(field, "change");
}

// Where it can be typed.
export function open(key) {
  const field = $(key);
  for (let holder = field?.closest("details"); holder; holder = holder.parentElement.closest("details")) holder.open = true;
  field?.scrollIntoView({block: "center"});
  field?.focus();
  field?.select?.();
}

// A step of about so much, as people count: 1, 2 or 5 of a power of ten.
export function nice(value) {
  const ten = 10 ** Math.floor(Math.log10(value));
  return ten * ([1, 2, 5].find(step => step * ten >= value * 0.999) ?? 10);
}

export const rounded = (value, step) => Number((Math.round(value / step) * step).toPrecision(12)) || 0;

// A number for reading, in so many digits; a word as it is.
export const printed = (value, digits = 6, more = {}) => typeof value !== "number" ? value
  : Number(value.toPrecision(digits)).toLocaleString("en-GB", {maximumFractionDigits: 9, ...more}).replace("-", "−");

// By keys: how many steps each is worth.
export const STEPS = {ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10};
