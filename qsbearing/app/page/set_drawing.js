// Rows and shaft of a set, to scale. What can be moved is a slider; what it moves is a field of the page.
import {$, at, kept, make} from "./dom.js";
import {page} from "./state.js";
import {STEPS, choose, nice, open, printed, rounded, settle, type} from "./typed.js";

const ASIDE = 46, TALLEST = 230, ARROW = 34, LINE = 16, LETTER = 6.3, GRIP = 12, DISC = 12, NARROWEST = 608;  // px
const HOW = "Drag rows, loads, ends and edges, or move them by arrow keys; a double click or Enter opens the number.";
let things = [], faults = new Map(), last = new Map();
let view = null, drag = null, unsettled = "";  // the scale stays while something is dragged

const part = (thing, moves) => thing.parts.find(each => each.moves === moves);
const fieldOf = one => one && page.fields.get(one.path.join("."));

// What is typed; of what is no number the last one that was.
function number(one, otherwise = 0) {
  const value = one && at(one.path, page.now.document), name = one?.path.join(".");
  if (Number.isFinite(value)) last.set(name, value);
  return last.get(name) ?? otherwise;
}

export function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) if (value !== undefined) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const path = (points, attributes) => svg("path", {d: `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}`, ...attributes});

// Where everything is, in mm: sections end to end, the rest where it says.
function placed() {
  let x = number(part(things.find(({kind}) => kind === "start") ?? {parts: []}, "along"));
  return things.map(thing => {
    if (thing.kind !== "section") return {...thing, x: number(part(thing, "along")), across: number(part(thing, "across"))};
    const of = side => ["begins", "ends"].map(end => number(part(thing, `${side} ${end}`), NaN));
    const begins = x, [outer, inner] = ["outer", "inner"].map(side => {
      const [one, other] = of(side);
      return [one || 0, Number.isNaN(other) ? one || 0 : other];
    });
    x += Math.max(number(part(thing, "length")), 0);
    return {...thing, begins, ends: x, outer, inner};
  });
}

function radius(all, x) {
  const on = all.find(each => each.kind === "section" && x >= each.begins && x <= each.ends);
  if (!on) return 0;
  const along = (x - on.begins) / (on.ends - on.begins || 1);
  return (on.outer[0] + along * (on.outer[1] - on.outer[0])) / 2;
}

// Scale and height: as long as the page is wide, unless it would be too tall.
function scaled(all, width) {
  const rows = all.filter(each => each.size), sections = all.filter(each => each.kind === "section");
  const half = Math.max(...sections.map(each => Math.max(...each.outer) / 2), ...rows.map(({size}) => (size.pitch + size.box) / 2), ...all.map(each => (each.across || 0) / 2), 1);
  const xs = [...sections.flatMap(each => [each.begins, each.ends]), ...all.filter(each => "x" in each && each.kind !== "start").map(each => each.x),
    ...rows.flatMap(({x, size}) => [x - size.box / 2, x + size.box / 2])];
  const [low, high] = [Math.min(...xs), Math.max(...xs)];
  const size = Math.min((width - 2 * ASIDE) / Math.max(high - low, 1), TALLEST / (2 * half));
  return {low, high, half, size, left: (width - (high - low) * size) / 2};
}

// From a text to its thing, upright where that is beneath it.
const leaderTo = ({x, half}, to, low, high) => path([[Math.min(Math.max(to, x - half), x + half), low], [to, high]], {class: "leader"});

// Each text as low as it can stand beside those before it.
function levels(texts, width) {
  const ends = [];
  for (const text of texts.sort((one, other) => one.x - other.x)) {
    const half = text.words.length * LETTER / 2 + 5;
    text.x = Math.min(Math.max(text.x, half), width - half);
    text.level = ends.findIndex(end => end < text.x - half);
    if (text.level < 0) text.level = ends.length;
    ends[text.level] = text.x + half;
    text.half = half - 5;
  }
  return ends.length;
}

function draw() {
  const figure = $("drawing");
  figure.hidden = !things.length;
  if (!things.length) return;
  if (!figure.firstChild) prepare(figure);
  const canvas = figure.querySelector("svg"), width = Math.max(canvas.parentNode.clientWidth, NARROWEST), all = placed();
  if (!drag || !view) view = scaled(all, width);
  const X = x => view.left + (x - view.low) * view.size;
  const above = all.filter(({kind}) => ["load", "gear", "belt", "mass", "operation"].includes(kind));
  const below = all.filter(({kind}) => ["point", "support"].includes(kind));
  const texts = new Map([...above, ...below].map(each => [each, {x: X(each.x), words: said(each)}]));
  const up = levels(above.map(each => texts.get(each)), width), down = levels(below.map(each => texts.get(each)), width);
  const middle = LINE * up + ARROW + 30 + view.half * view.size, foot = middle + view.half * view.size + 6;
  const axis = foot + ARROW + down * LINE, drawn = {all, texts, X, Y: r => middle - r * view.size, foot};
  for (const [name, value] of Object.entries({width, height: axis + 34, viewBox: `0 0 ${width} ${axis + 34}`})) canvas.setAttribute(name, value);
  const sections = all.filter(({kind}) => kind === "section");
  kept(() => canvas.replaceChildren(
    ...sections.map(each => steel(each, drawn)),
    path([[X(view.low) - 8, middle], [X(view.high) + 8, middle]], {class: "centre"}), ...scale(X, axis),
    ...sections.flatMap(each => edges(each, drawn)), ...all.filter(({kind}) => kind === "start").map(each => start(each, drawn)),
    ...all.filter(({kind}) => kind === "row").flatMap(each => row(each, drawn)),
    ...below.map(each => mark(each, drawn)), ...above.flatMap(each => standing(each, drawn))));
  tell();
}

function prepare(figure) {
  const canvas = svg("svg", {role: "group", "aria-label": "Drawing of rows and shaft", "aria-describedby": "drawn-how"});
  figure.append(make("p", {id: "drawn-how"}, HOW), make("p", {id: "drawn-now"}), make("div", {className: "canvas"}, "", canvas));
  canvas.onpointerdown = event => take(event, canvas);
  canvas.onpointermove = event => move(event, canvas);
  canvas.onpointerup = canvas.onpointercancel = drop;
  canvas.ondblclick = event => open(document.elementFromPoint(event.clientX, event.clientY)?.closest(".handle")?.dataset.key);
  canvas.onclick = event => turn(event.target.closest(".turn"));
  canvas.onkeydown = key;
  canvas.onfocus = canvas.onpointerover = tell;
  canvas.addEventListener("focusin", tell);
  document.addEventListener("keyup", () => { if (unsettled) settle(unsettled); unsettled = ""; });
  new ResizeObserver(() => drag || draw()).observe(figure);
}

// A part that moves: by how much its number changes for a pixel to the right, and for one upwards.
function handle(thing, one, right, upwards, ...children) {
  const field = fieldOf(one);
  if (!field) return svg("g", {}, ...children);
  const value = number(one), text = `${printed(value)} ${field.unit}`;
  return svg("g", {
    id: `drawn ${field.key}`, class: faults.has(field.key) ? "handle wrong" : "handle", tabindex: 0, role: "slider",
    "aria-label": `${thing.name}, ${field.words}`, "aria-valuenow": value, "aria-valuetext": text,
    "aria-valuemin": Math.min(field.low, value), "aria-valuemax": Math.max(field.high, value),
    "aria-orientation": upwards ? "vertical" : "horizontal", "data-key": field.key, "data-right": right, "data-upwards": upwards,
  }, ...children);
}

function steel({outer, inner, begins, ends}, {X, Y}) {
  const half = sign => path([[X(begins), Y(sign * outer[0] / 2)], [X(ends), Y(sign * outer[1] / 2)], [X(ends), Y(sign * inner[1] / 2)], [X(begins), Y(sign * inner[0] / 2)]], {class: "steel"});
  return svg("g", {"aria-hidden": true}, half(1), half(-1));
}

// Edges of a section, its diameters, and the face where it ends, its length.
function edges(section, {all, X, Y}) {
  const {begins, ends} = section, per = 1 / view.size, middle = (begins + ends) / 2;
  const free = [0.5, 0.3, 0.7, 0.15, 0.85].map(along => begins + along * (ends - begins));
  const inTheWay = x => all.some(({size, across, x: at}) => (size || across) && Math.abs(at - x) < (size ? size.box / 2 : 0) + 14 * per);
  const edge = side => ["begins", "ends"].flatMap(end => {
    const own = part(section, `${side} ${end}`), isCone = Boolean(part(section, `${side} ends`));
    if (!own || (side === "inner" && !number(own))) return [];
    const [from, to] = !isCone ? [begins, ends] : end === "begins" ? [begins, middle] : [middle, ends];
    const at = x => section[side][0] / 2 + (x - begins) / (ends - begins || 1) * (section[side][1] - section[side][0]) / 2;
    const knob = free.find(x => x >= from && x <= to && !inTheWay(x)) ?? (from + to) / 2;
    const line = [[X(from), Y(at(from))], [X(to), Y(at(to))]];
    return [handle(section, own, 0, 2 * per, path(line, {class: "hit"}), path(line, {class: "edge"}),
      svg("rect", {class: "knob", x: X(knob) - 7, y: Y(at(knob)) - 3, width: 14, height: 6, rx: 3}))];
  });
  const face = [[X(ends), Y(section.outer[1] / 2)], [X(ends), Y(-section.outer[1] / 2)]];
  const length = handle(section, part(section, "length"), per, 0, path(face, {class: "hit"}), path(face, {class: "edge"}),
    svg("rect", {class: "knob", x: X(ends) - 3, y: Y(-section.outer[1] / 3) - 7, width: 6, height: 14, rx: 3}));
  return [...edge("outer"), ...edge("inner"), length];
}

function start(thing, {all, X, Y}) {
  const first = all.find(({kind}) => kind === "section"), face = [[X(first.begins), Y(first.outer[0] / 2)], [X(first.begins), Y(-first.outer[0] / 2)]];
  return handle(thing, part(thing, "along"), 1 / view.size, 0, path(face, {class: "hit"}), path(face, {class: "edge"}),
    svg("rect", {class: "knob", x: X(first.begins) - 3, y: Y(-first.outer[0] / 3) - 7, width: 6, height: 14, rx: 3}));
}

// Both halves of its section with the lines of action, its number, and above it which way it carries.
function row(thing, {X, Y}) {
  const {x, size, name} = thing, turns = part(thing, "turns"), word = (turns && at(turns.path, page.now.document)) ?? "";
  if (!size) return [];
  const side = size.box * view.size, ball = size.ball * view.size, sign = {"+": 1, "-": -1}[word?.[0]] ?? 0;
  const angle = sign ? size.angle * Math.PI / 180 : 0, [dx, dy] = [sign * Math.sin(angle), Math.cos(angle)].map(each => 0.85 * ball * each);
  const half = up => [
    svg("rect", {class: "ring", x: X(x) - side / 2, y: Y(up * size.pitch / 2) - side / 2, width: side, height: side}),
    svg("circle", {class: "ball", cx: X(x), cy: Y(up * size.pitch / 2), r: ball / 2}),
    path([[X(x) - dx, Y(up * size.pitch / 2) + up * dy], [X(x) + dx, Y(up * size.pitch / 2) - up * dy]], {class: "action"})];
  const under = Y(-(size.pitch + size.box) / 2), over = Y((size.pitch + size.box) / 2) - 14;
  const moves = handle(thing, part(thing, "along"), 1 / view.size, 0,
    ...[1, -1].flatMap(half), svg("text", {x: X(x), y: under + 14, class: "name"}, name.replace(/\D+/, "")));
  const field = fieldOf(turns);
  if (!field) return [moves];
  const glyph = {"+": "→", "-": "←"}[word?.[0]] ?? word;
  const button = svg("g", {id: `turns ${field.key}`, class: "turn", tabindex: 0, role: "button", "aria-label": `${name}, ${field.words} ${word}: choose another`,
    "data-key": field.key, "data-next": turns.words[(turns.words.indexOf(word) + 1) % turns.words.length]},
    svg("rect", {class: "plate", x: X(x) - Math.max(12, glyph.length * 4), y: over - 11, width: Math.max(24, glyph.length * 8), height: 20, rx: 5}),
    svg("text", {x: X(x), y: over + 4}, glyph));
  return [moves, button];
}

// A point or a support, named below.
function mark(thing, {all, texts, X, Y, foot}) {
  const {x, kind} = thing, text = texts.get(thing), {x: at, level, words} = text, low = foot + ARROW - 8 + level * LINE;
  const bottom = Y(-radius(all, x)), shape = kind === "point"
    ? svg("circle", {class: "point", cx: X(x), cy: Y(0), r: 4.5})
    : path([[X(x), bottom], [X(x) - 7, bottom + 12], [X(x) + 7, bottom + 12], [X(x), bottom]], {class: "spring"});
  return handle(thing, part(thing, "along"), 1 / view.size, 0, leaderTo(text, X(x), low - 12, kind === "point" ? Y(0) : bottom + 12),
    shape, svg("text", {x: at, y: low}, words));
}

// A load with an arrow for each of its forces, a gear or pulley as a disc, a mass; named above.
function standing(thing, {all, texts, X, Y}) {
  const {x, kind, across} = thing, text = texts.get(thing), {x: at, level, words} = text, top = LINE * (level + 1);
  const size = radius(all, x), surface = Y(size), shapes = [];
  const arrow = (x1, y1, x2, y2) => path([[x1, y1], [x2, y2]], {class: "arrow", "marker-end": "url(#drawn-head)"});
  for (const each of thing.parts) {
    const value = number(each), sign = Math.sign(value);
    if (!sign) continue;
    if (each.moves === "x") shapes.push(arrow(X(x), Y(0), X(x) + sign * ARROW, Y(0)));
    if (each.moves === "y") shapes.push(sign > 0 ? arrow(X(x), Y(-size) + ARROW, X(x), Y(-size) + 5) : arrow(X(x), surface - ARROW, X(x), surface - 5));
    if (each.moves === "z") shapes.push(svg("circle", {class: "across", cx: X(x), cy: Y(0), r: 6}), sign > 0
      ? svg("circle", {class: "point", cx: X(x), cy: Y(0), r: 2})
      : svg("path", {class: "arrow", d: `M${X(x) - 4} ${Y(0) - 4}l8 8m0 -8l-8 8`}));
    if (each.moves === "turn") shapes.push(svg("path", {class: "arrow", "marker-end": "url(#drawn-head)", d: `M${X(x) - 9} ${Y(0) + 7}a11 11 0 1 1 18 0`}));
  }
  const disc = part(thing, "across"), made = [];
  if (disc) {
    for (const up of [1, -1]) {
      const [one, other] = [Y(up * size), Y(up * across / 2)];
      shapes.push(svg("rect", {class: "disc", x: X(x) - DISC / 2, y: Math.min(one, other), width: DISC, height: Math.abs(one - other)}));
    }
    const rim = [[X(x) - DISC / 2, Y(across / 2)], [X(x) + DISC / 2, Y(across / 2)]];
    made.push(handle(thing, disc, 0, 2 / view.size, path(rim, {class: "hit"}), svg("rect", {class: "knob", x: X(x) - 7, y: Y(across / 2) - 3, width: 14, height: 6, rx: 3})));
  }
  if (kind === "mass") shapes.push(svg("rect", {class: "point", x: X(x) - 6, y: Y(0) - 6, width: 12, height: 12}));
  if (kind === "operation" || !shapes.length) shapes.push(path([[X(x), Y(0) - 6], [X(x) + 6, Y(0)], [X(x), Y(0) + 6], [X(x) - 6, Y(0)], [X(x), Y(0) - 6]], {class: "point"}));
  const leader = leaderTo(text, X(x), top + 4, disc ? Y(across / 2) : kind === "load" ? surface : Y(0));
  return [handle(thing, part(thing, "along"), 1 / view.size, 0, leader, ...shapes, svg("text", {x: at, y: top}, words)), ...made];
}

// A thing's name, and what of its numbers is not zero.
function said(thing) {
  const own = thing.parts.filter(each => !["along", "across"].includes(each.moves) && number(each) && fieldOf(each));
  const values = own.map(each => `${fieldOf(each).words} ${printed(number(each))} ${fieldOf(each).unit}`);
  return [thing.name, ...values].join(", ").replace(", ", values.length ? ": " : ", ");
}

function scale(X, y) {
  const step = nice((view.high - view.low) / Math.min((X(view.high) - X(view.low)) / 45, 8)), ticks = [];
  for (let x = Math.ceil(view.low / step) * step; x <= view.high + step / 1e3; x += step) {
    ticks.push(path([[X(x), y], [X(x), y + 4]], {class: "axis"}), svg("text", {x: X(x), y: y + 16}, printed(rounded(x, step))));
  }
  const head = svg("defs", {}, svg("marker", {id: "drawn-head", viewBox: "0 0 8 8", refX: 6, refY: 4, markerWidth: 10, markerHeight: 10, markerUnits: "userSpaceOnUse", orient: "auto-start-reverse"}, svg("path", {d: "M0 0L8 4L0 8z"})));
  return [head, svg("g", {"aria-hidden": true, class: "scale"}, path([[X(view.low), y], [X(view.high), y]], {class: "axis"}), ...ticks,
    svg("text", {x: X(view.high) + 18, y: y + 16, class: "unit"}, "mm"))];
}

// What has the focus, or is under the pointer, with its number; and what is wrong with any.
function tell(event) {
  const own = event?.target.closest?.(".handle, .turn") ?? document.activeElement?.closest?.("#drawing .handle, #drawing .turn");
  const wrong = [...faults].filter(([key]) => key && $(key)).map(([, text]) => text);
  const label = own?.getAttribute("aria-label") ?? "", value = own?.getAttribute("aria-valuetext");
  $("drawn-now").textContent = [value ? `${label}: ${value}` : label, ...wrong].filter(Boolean).join("\n");
  $("drawn-now").classList.toggle("wrong", wrong.length > 0);
}

const stepOf = own => nice(Math.max(Math.abs(Number(own.dataset.right)), Math.abs(Number(own.dataset.upwards))) / 2);

function take(event, canvas) {
  const own = event.target.closest(".handle");
  if (!own || event.button) return;
  own.focus();
  const {key, right, upwards} = own.dataset;
  drag = {key, right: Number(right), upwards: Number(upwards), x: event.clientX, y: event.clientY, step: stepOf(own), value: Number(own.getAttribute("aria-valuenow")), at: null};
  event.preventDefault();
}

function move(event, canvas) {
  if (!drag) return;
  const {x, y, right, upwards, value, step, key} = drag;
  if (drag.at === null && Math.hypot(event.clientX - x, event.clientY - y) < 3) return;
  if (drag.at === null) canvas.setPointerCapture(event.pointerId);
  const to = rounded(value + (event.clientX - x) * right - (event.clientY - y) * upwards, step);
  if (to === drag.at) return;
  drag.at = to;
  type(key, to);
}

function drop() {
  const done = drag;
  drag = null;
  if (done && done.at !== null) settle(done.key), draw();
}

function key(event) {
  const own = event.target.closest(".handle, .turn");
  if (!own || event.ctrlKey || event.metaKey || event.altKey) return;
  const steps = STEPS[event.key];
  if (own.classList.contains("turn")) {
    if (event.key === "Enter" || event.key === " ") turn(own), event.preventDefault();
  } else if (event.key === "Enter") {
    event.preventDefault();
    open(own.dataset.key);
  } else if (event.key === "Escape" && drag) {
    type(drag.key, drag.value);
    drop();
  } else if (steps) {
    event.preventDefault();
    unsettled = own.dataset.key;
    type(unsettled, rounded(Number(own.getAttribute("aria-valuenow")) + steps * stepOf(own), stepOf(own)));
  }
}

function turn(own) {
  if (own) choose(own.dataset.key, own.dataset.next);
}

document.addEventListener("shown", ({detail}) => {
  const old = new Map(things.map(({name, size}) => [name, size]));
  things = detail.drawing.map(each => ({...each, size: each.size ?? old.get(each.name)}));
});
document.addEventListener("changed", draw);
document.addEventListener("refused", ({detail}) => { faults = new Map(detail.map(({key, text}) => [key, text])); if (things.length) draw(); });
