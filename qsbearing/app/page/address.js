// The scene and the pinned inputs in the address, behind #, compressed: a reload or a link brings them back.
import {page} from "./state.js";

let last = 0;

async function through(stream, bytes) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

export async function packed(state) {
  const bytes = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(JSON.stringify(state)));
  return btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join(""))
    .replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

// Nothing where it is none.
export async function unpacked(text) {
  try {
    const letters = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = await through(new DecompressionStream("deflate-raw"), Uint8Array.from(letters, each => each.charCodeAt(0)));
    const {now, pins, row} = JSON.parse(new TextDecoder().decode(bytes));
    const isInput = each => typeof each?.label === "string" && typeof each.document === "object" && each.document !== null;
    const good = isInput(now) && Array.isArray(pins) && pins.every(each => isInput(each.input) && typeof each.letter === "string");
    return good ? {now, pins, row: Number(row) || 0} : null;
  } catch {
    return null;
  }
}

export async function remember() {
  const mine = ++last, pins = page.pins.map(({letter, input}) => ({letter, input}));
  const text = await packed({now: page.now, pins, row: page.row});
  if (mine === last) history.replaceState(null, "", `${location.pathname}${location.search}#${text}`);
}
