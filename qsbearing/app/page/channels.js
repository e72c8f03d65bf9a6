// The five channels, each with a load, at a place or free, and the preload.
import {make} from "./dom.js";
import {fieldOf} from "./inputs.js";
import {change} from "./scene.js";
import {page} from "./state.js";

export function channelOf(channel) {
  const {name, held_by, ways} = channel, way = wayOf(channel);
  const choice = ways.length > 3 ? listed(channel, way) : beside(channel, held_by ? "" : way);
  const row = make("div", {className: "channel", role: "group", ariaLabel: name}, "", make("span", {className: "what"}, name), choice);
  const own = page.fields.get(ways.find(each => each.way === way)?.path);
  if (held_by) row.append(make("span", {className: "held"}, `held by the ${held_by}`));
  else if (own) row.append(fieldOf(own, true));
  return row;
}

// A load of 0 is that of a free channel, unless somebody has just chosen to load it.
function wayOf({name, way, ways}) {
  const [load] = ways;
  return way === "free" && page.loaded.has(name) && page.fields.has(load.path) ? load.way : way;
}

function beside(channel, way) {
  return make("span", {className: "ways"}, "", ...channel.ways.map(each => {
    const id = `way ${channel.name} ${each.way}`;
    const radio = make("input", {type: "radio", name: `way ${channel.name}`, id, checked: each.way === way, ariaLabel: `${channel.name}: ${each.says ?? each.words}`});
    radio.onchange = () => choose(channel, each);
    return make("label", {}, "", radio, each.words);
  }));
}

function listed(channel, way) {
  const list = make("select", {id: `way ${channel.name}`, ariaLabel: channel.name}, "", ...channel.ways.map(each => make("option", {value: each.way}, each.words)));
  list.value = way;
  list.onchange = () => choose(channel, channel.ways.find(each => each.way === list.value));
  return list;
}

// It begins with what the results have: so nothing moves until a number is changed.
async function choose({name}, {way, takes}) {
  if (way === "load") page.loaded.add(name);
  else page.loaded.delete(name);
  const value = page.found?.channels[name]?.[takes] ?? null;
  await change("way", {channel: name, way, value});
}
