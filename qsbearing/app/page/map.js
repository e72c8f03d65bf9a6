// A result over two inputs as colours with lines of equal value; the state of the page is a point in it, which is dragged.
import {ask} from "./ask.js";
import {$, at, leaves, make, put} from "./dom.js";
import {svg} from "./set_drawing.js";
import {page} from "./state.js";
import {STEPS, nice, printed, rounded, settle, type} from "./typed.js";

const HEIGHT = 380, WIDEST = 760, MARGIN = {left: 70, right: 86, top: 14, bottom: 46};  // px
const COLOURS = ["#f7fbff", "#c6dbef", "#6baed6", "#2171b5", "#08306b"].map(each => [1, 3, 5].map(k => parseInt(each.slice(k, k + 2), 16)));
const SHORT = 5000, PIECE = 1500, CALM = 400;  // ms: a map that is drawn anew unasked, one question, until nothing moves
let known = null, map = null, running = null, calm = 0, drag = null, unsettled = "";

const called = field => `${/\d/.test(field.group) ? `${field.group.replaceAll("_", " ")}, ` : ""}${field.words}`;
const unitOf = field => (field.unit ? `, ${field.unit}` : "");
const pick = name => $(`map-${name}`);

// What a map is of: all inputs but its two.
const others = ({document}, x, y) => JSON.stringify([...leaves(document)].filter(([path]) => path !== x.path.join(".") && path !== y.path.join(".")));

function prepare() {
  const axis = (name, words) => make("fieldset", {}, "", make("legend", {}, words),
    make("select", {id: `map-${name}`, ariaLabel: `${words}, input`, onchange: () => ends(name)}),
    make("label", {}, "from ", make("input", {id: `map-${name}-low`, type: "number", step: "any"})),
    make("label", {}, "to ", make("input", {id: `map-${name}-high`, type: "number", step: "any"})));
  $("map").append(make("div", {id: "map-picks"}, "", axis("x", "To the right"), axis("y", "Upwards"),
    make("fieldset", {}, "", make("legend", {}, "Result"), make("select", {id: "map-result", ariaLabel: "Result"}),
      make("label", {}, "points each way ", make("input", {id: "map-points", type: "number", step: 1})),
      make("button", {id: "map-draw", type: "button", onclick: draw}, "Draw"),
      make("button", {id: "map-stop", type: "button", hidden: true, onclick: () => running?.abort()}, "Stop"))),
  make("div", {id: "map-far"}, "", make("progress", {id: "map-progress", max: 1, value: 0, ariaLabel: "Points that are solved", hidden: true}), make("span", {id: "map-said", role: "status"})),
  make("div", {id: "map-plot", className: "canvas", hidden: true}, "", make("canvas", {ariaHidden: "true"}), svg("svg", {role: "group", "aria-label": "Map"})));
  const plot = $("map-plot").querySelector("svg");
  plot.onpointerdown = take;
  plot.onpointermove = event => drag !== null && move(event);
  plot.onpointerup = plot.onpointercancel = drop;
  plot.onkeydown = key;
  document.addEventListener("keyup", () => { if (unsettled) settle(unsettled); unsettled = ""; });
  new ResizeObserver(() => map && render()).observe($("map-plot"));
}

// Inputs and results to choose from; what was chosen stays where it is still there.
async function choices() {
  const told = await ask("map_choices", page.now);
  if (told.errors) return say(told.errors.map(({text}) => text).join("\n"));
  if (!known) pick("points").value = told.points.usual;
  Object.assign(pick("points"), {min: told.points.fewest, max: told.points.most});
  const by = new Map([...page.fields.values()].map(field => [field.key, field]));
  const inputs = told.inputs.map(each => by.get(each)).filter(Boolean);
  for (const name of ["x", "y"]) {
    filled(name, inputs.map(field => ({value: field.key, words: field.words + unitOf(field), group: field.group.replaceAll("_", " ")})), told.first[name]);
    if (!known) ends(name);
  }
  filled("result", told.results.map(({name, words, unit, group}) => ({value: name, words: unit ? `${words}, ${unit}` : words, group})), told.first.result);
  known = {by, results: new Map(told.results.map(each => [each.name, each]))};
}

function filled(name, options, first) {
  const before = pick(name).value, groups = Map.groupBy(options, each => each.group);
  pick(name).replaceChildren(...[...groups].flatMap(([group, own]) => {
    const made = own.map(({value, words}) => make("option", {value}, words));
    return group ? [make("optgroup", {label: group}, "", ...made)] : made;
  }));
  pick(name).value = options.some(({value}) => value === before) ? before : first;
}

// The ends of an axis: those of the input's slider.
function ends(name) {
  const field = [...page.fields.values()].find(each => each.key === pick(name).value);
  if (!field) return;
  pick(`${name}-low`).value = field.low;
  pick(`${name}-high`).value = field.high;
}

const say = text => { $("map-said").textContent = text; };

async function draw() {
  running?.abort();
  const mine = running = new AbortController(), [x, y] = ["x", "y"].map(name => known.by.get(pick(name).value));
  const result = known.results.get(pick("result").value), asked = structuredClone(page.now), began = Date.now();
  const {min, max} = pick("points"), count = Math.min(Math.max(Math.round(Number(pick("points").value)) || 0, Number(min)), Number(max));
  const along = name => {
    const [low, high] = ["low", "high"].map(end => Number(pick(`${name}-${end}`).value));
    return Array.from({length: count}, (_, k) => Number((low + (high - low) * k / (count - 1)).toPrecision(12)));
  };
  const [xs, ys] = [along("x"), along("y")];
  if (xs[0] >= xs.at(-1) || ys[0] >= ys.at(-1)) return say("An axis goes from a number to a larger one.");
  if (x === y) return say("Choose two different inputs.");
  map = {x, y, xs, ys, result, others: others(asked, x, y), values: ys.map(() => Array(count).fill(undefined)), why: new Map(), took: Infinity};
  Object.assign($("map-progress"), {hidden: false, max: count * count, value: 0});
  $("map-stop").hidden = false;
  let done = 0, piece = 3;
  while (done < count * count && !mine.signal.aborted) {
    const row = Math.floor(done / count), from = done % count, since = Date.now();
    const rows = from || piece < count ? 1 : Math.min(Math.floor(piece / count), count - row), to = rows > 1 ? count : Math.min(from + piece, count);
    say(`${done} of ${count * count} points`);
    const told = await ask("map_values", {...asked, x: x.path, y: y.path, result: result.name, xs: xs.slice(from, to), ys: ys.slice(row, row + rows)}, mine.signal);
    if (mine.signal.aborted) break;
    if (told.errors) { mine.abort(); finish(told.errors.map(({text}) => text).join("\n")); return; }
    told.values.forEach((own, k) => own.forEach((value, n) => { map.values[row + k][from + n] = value; }));
    told.why.flat().forEach(why => map.why.set(why, (map.why.get(why) ?? 0) + 1));
    done += rows * (to - from);
    piece = Math.max(1, Math.round(rows * (to - from) * Math.min(PIECE / (Date.now() - since), 8)));
    $("map-progress").value = done;
    render();
  }
  if (running !== mine) return;  // another one goes on
  if (!mine.signal.aborted) map.took = Date.now() - began;
  finish(mine.signal.aborted ? `Stopped after ${done} of ${count * count} points.` : `${done} points.`);
}

function finish(text) {
  $("map-progress").hidden = $("map-stop").hidden = true;
  const holes = map.values.flat().filter(value => value === null).length, [why] = [...map.why].filter(([each]) => each).sort((one, other) => other[1] - one[1])[0] ?? [];
  say(`${text}${holes ? ` Hatched: no result${why ? ` (${why})` : ""}.` : ""}`);
  follow();
}

// Sizes and scales of what is drawn.
function frame() {
  const {xs, ys, values} = map, width = Math.min($("map-plot").clientWidth || WIDEST, WIDEST), found = values.flat().filter(Number.isFinite);
  const [low, high] = [Math.min(...found), Math.max(...found)], isLog = low > 0 && high > 50 * low;
  const [w, h] = [width - MARGIN.left - MARGIN.right, HEIGHT - MARGIN.top - MARGIN.bottom], on = isLog ? Math.log : value => value;
  const levels = [];
  if (found.length && high > low) {
    const step = nice((high - low) / 8);
    if (isLog) for (let ten = 10 ** Math.floor(Math.log10(low)); ten <= high; ten *= 10) levels.push(...[1, 2, 5].map(each => each * ten));
    else for (let level = Math.ceil(low / step) * step; level <= high; level += step) levels.push(rounded(level, step));
  }
  return {
    width, w, h, low, high, levels: levels.filter(level => level > low && level < high),
    X: x => MARGIN.left + (x - xs[0]) / (xs.at(-1) - xs[0]) * w, Y: y => MARGIN.top + (ys.at(-1) - y) / (ys.at(-1) - ys[0]) * h,
    part: value => high > low ? (on(value) - on(low)) / (on(high) - on(low)) : 0.5};
}

function colour(part) {
  const at = Math.min(Math.max(part, 0), 1) * (COLOURS.length - 1), k = Math.min(Math.floor(at), COLOURS.length - 2);
  return COLOURS[k].map((one, n) => Math.round(one + (at - k) * (COLOURS[k + 1][n] - one)));
}

// Between the points of the grid; undefined where a point is not solved yet, null where one has no result.
function between(i, j, u, v) {
  const {values} = map, four = [values[j][i], values[j][i + 1], values[j + 1][i], values[j + 1][i + 1]];
  if (four.includes(undefined)) return undefined;
  if (four.includes(null)) return null;
  return (four[0] * (1 - u) + four[1] * u) * (1 - v) + (four[2] * (1 - u) + four[3] * u) * v;
}

function valueAt(x, y) {
  const {xs, ys} = map, count = xs.length - 1;
  const [a, b] = [(x - xs[0]) / (xs.at(-1) - xs[0]) * count, (y - ys[0]) / (ys.at(-1) - ys[0]) * count];
  if (!(a >= 0 && a <= count && b >= 0 && b <= count)) return undefined;
  const [i, j] = [Math.min(Math.floor(a), count - 1), Math.min(Math.floor(b), count - 1)];
  return between(i, j, a - i, b - j);
}

function paint({width, w, h, part}) {
  const canvas = $("map-plot").querySelector("canvas"), count = map.xs.length - 1;
  Object.assign(canvas, {width, height: HEIGHT});
  const context = canvas.getContext("2d"), image = context.createImageData(Math.max(Math.floor(w), 1), h);
  for (let row = 0; row < h; row++) {
    const b = (1 - row / h) * count, j = Math.min(Math.floor(b), count - 1);
    for (let column = 0; column < image.width; column++) {
      const a = column / w * count, i = Math.min(Math.floor(a), count - 1), value = between(i, j, a - i, b - j);
      if (value === undefined) continue;
      const rgb = value === null ? ((row + column) % 8 < 2 ? [122, 132, 141] : [241, 244, 246]) : colour(part(value));
      image.data.set([...rgb, 255], 4 * (row * image.width + column));
    }
  }
  context.putImageData(image, MARGIN.left, MARGIN.top);
}

// Where a value is crossed along the edges of each field of the grid.
function line(level, {X, Y}) {
  const {xs, ys, values} = map, pieces = [];
  for (let j = 0; j < ys.length - 1; j++) for (let i = 0; i < xs.length - 1; i++) {
    const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]], own = corners.map(([m, n]) => values[n][m]);
    if (!own.every(Number.isFinite)) continue;
    const cuts = corners.flatMap(([m, n], k) => {
      const [p, q] = corners[(k + 1) % 4], [one, other] = [own[k], own[(k + 1) % 4]];
      if ((one < level) === (other < level)) return [];
      const part = (level - one) / (other - one);
      return [[X(xs[m] + part * (xs[p] - xs[m])), Y(ys[n] + part * (ys[q] - ys[n]))]];
    });
    for (let k = 0; k + 1 < cuts.length; k += 2) pieces.push([cuts[k], cuts[k + 1]]);
  }
  return pieces;
}

function render() {
  if (!map) return;
  $("map-plot").hidden = false;
  const on = frame(), {width, w, h, X, Y, levels} = on, plot = $("map-plot").querySelector("svg"), {xs, ys, x, y, result} = map;
  paint(on);
  for (const [name, value] of Object.entries({width, height: HEIGHT, viewBox: `0 0 ${width} ${HEIGHT}`})) plot.setAttribute(name, value);
  const texts = [], lines = levels.map((level, k) => {
    const pieces = line(level, on);
    const [at] = pieces[Math.floor(pieces.length * (0.3 + 0.4 * (k % 3) / 2))] ?? [];
    if (at && texts.every(([p, q]) => Math.hypot(p - at[0], q - at[1]) > 24)) texts.push([...at, printed(level)]);
    return svg("path", {class: "level", d: pieces.map(([[a, b], [c, d]]) => `M${a.toFixed(1)} ${b.toFixed(1)}L${c.toFixed(1)} ${d.toFixed(1)}`).join("")});
  });
  const ticks = (low, high, count) => {
    const step = nice((high - low) / count);
    return Array.from({length: Math.floor(high / step + 1e-9) - Math.ceil(low / step - 1e-9) + 1}, (_, k) => rounded((Math.ceil(low / step - 1e-9) + k) * step, step));
  };
  const [foot, right] = [MARGIN.top + h, MARGIN.left + w];
  const bar = Array.from({length: 40}, (_, k) => svg("rect", {x: right + 14, y: foot - (k + 1) * h / 40, width: 12, height: h / 40 + 0.5, fill: `rgb(${colour((k + 0.5) / 40)})`}));
  const focused = document.activeElement?.id === "map-point";
  plot.replaceChildren(
    svg("rect", {class: "area", x: MARGIN.left, y: MARGIN.top, width: w, height: h}),
    svg("g", {"aria-hidden": true, class: "scale"}, ...lines, ...texts.map(([p, q, text]) => svg("text", {class: "on-line", x: p, y: q + 4}, text)),
      ...ticks(xs[0], xs.at(-1), w / 80).map(each => svg("text", {x: X(each), y: foot + 16}, printed(each))),
      ...ticks(ys[0], ys.at(-1), h / 50).map(each => svg("text", {class: "left", x: MARGIN.left - 6, y: Y(each) + 4}, printed(each))),
      svg("text", {x: MARGIN.left + w / 2, y: foot + 36, class: "title"}, called(x) + unitOf(x)),
      svg("text", {x: 14, y: MARGIN.top + h / 2, transform: `rotate(-90 14 ${MARGIN.top + h / 2})`, class: "title"}, called(y) + unitOf(y)),
      ...(on.high >= on.low ? bar : []), ...levels.map(each => svg("text", {class: "unit", x: right + 30, y: foot - on.part(each) * h + 4}, printed(each)))),
    svg("g", {id: "map-point", class: "state", tabindex: 0, role: "slider"}, svg("circle", {class: "ring", r: 14}), svg("circle", {class: "dot", r: 7}), svg("text", {y: -14})));
  plot.setAttribute("aria-label", `Map of ${result.words} over ${called(x)} and ${called(y)}`);
  follow();
  if (focused) $("map-point").focus();
}

// The point is where the inputs are; the map is grey where it is of others.
function follow() {
  const point = $("map-point");
  if (!map || !point) return;
  const {x, y, xs, ys, result} = map, {X, Y} = frame(), [a, b] = [at(x.path, page.now.document), at(y.path, page.now.document)];
  const isOld = others(page.now, x, y) !== map.others;
  for (const each of [$("map-plot").querySelector("canvas"), $("map-plot").querySelector(".scale")]) each.classList.toggle("stale", isOld);
  point.toggleAttribute("hidden", !Number.isFinite(a) || !Number.isFinite(b));
  if (!Number.isFinite(a) || !Number.isFinite(b)) return;
  const within = (value, all) => Math.min(Math.max(value, all[0]), all.at(-1)), value = isOld ? undefined : valueAt(a, b);
  const text = Number.isFinite(value) ? `≈ ${printed(value, 3)} ${result.unit}`.trim() : "";
  point.setAttribute("transform", `translate(${X(within(a, xs)).toFixed(1)} ${Y(within(b, ys)).toFixed(1)})`);
  const label = point.querySelector("text");
  label.textContent = text;
  label.setAttribute("x", X(within(a, xs)) > MARGIN.left + frame().w - 60 ? -40 : 0);
  label.setAttribute("y", Y(within(b, ys)) < MARGIN.top + 34 ? 28 : -16);
  const said = {
    "aria-label": `State in the map: ${called(x)} by left and right, ${called(y)} by up and down`, "aria-valuenow": a, "aria-valuemin": Math.min(a, xs[0]), "aria-valuemax": Math.max(a, xs.at(-1)),
    "aria-valuetext": `${called(x)} ${printed(a)} ${x.unit}, ${called(y)} ${printed(b)} ${y.unit}${text ? `: ${result.words} ${text}` : ""}`};
  for (const [name, each] of Object.entries(said)) point.setAttribute(name, each);
}

// Both numbers at once: the first goes into its field and the tables, and the second takes both on their way.
function go(a, b) {
  const {x, y} = map;
  if (a === at(x.path, page.now.document) && b === at(y.path, page.now.document)) return;
  $(x.key).value = a;
  put(x.path, a, page.now.document);
  type(y.key, b);
}

const steps = () => [map.xs, map.ys].map(all => nice((all.at(-1) - all[0]) / 200));

function take(event) {
  if (event.button || !map || !event.target.closest(".area, .state")) return;
  event.currentTarget.setPointerCapture(event.pointerId);
  event.preventDefault();
  $("map-point").focus();
  drag = event.target.closest(".state") ? null : undefined;
  drag = {isMoved: false, x: event.clientX, y: event.clientY, isOnPoint: drag === null};
  if (!drag.isOnPoint) move(event);
}

function move(event) {
  if (!drag.isMoved && drag.isOnPoint && Math.hypot(event.clientX - drag.x, event.clientY - drag.y) < 3) return;
  drag.isMoved = true;
  const box = $("map-plot").querySelector("svg").getBoundingClientRect(), {w, h} = frame(), {xs, ys} = map, [one, other] = steps();
  const within = part => Math.min(Math.max(part, 0), 1);
  const [u, v] = [within((event.clientX - box.left - MARGIN.left) / w), within((event.clientY - box.top - MARGIN.top) / h)];
  go(rounded(xs[0] + u * (xs.at(-1) - xs[0]), one), rounded(ys.at(-1) - v * (ys.at(-1) - ys[0]), other));
}

function drop() {
  const isMoved = drag?.isMoved;
  drag = null;
  if (isMoved) settle(map.y.key);
}

function key(event) {
  const turns = STEPS[event.key];
  if (!turns || !event.target.closest(".state") || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  const [one, other] = steps(), [a, b] = [at(map.x.path, page.now.document), at(map.y.path, page.now.document)];
  const isAcross = ["ArrowLeft", "ArrowRight"].includes(event.key);
  go(isAcross ? rounded(a + turns * one, one) : a, isAcross ? b : rounded(b + turns * other, other));
  unsettled = map.y.key;
}

$("map").addEventListener("toggle", async () => {
  if (!$("map").open || known) return;
  if (!pick("draw")) prepare();
  await choices();
  if (known) draw();
});
document.addEventListener("changed", follow);
// Once nothing moves, a map that took no time is drawn anew for other inputs.
document.addEventListener("solved", () => {
  clearTimeout(calm);
  if (!$("map").open || !known) return;
  calm = setTimeout(async () => {
    if (drag || (map && others(page.now, map.x, map.y) === map.others)) return;
    await choices();
    if (!map || map.took < SHORT) draw();
    else say("The map is of other inputs: draw it again.");
  }, CALM);
});
