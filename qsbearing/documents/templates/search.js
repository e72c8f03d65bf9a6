"use strict";
// Search through SECTIONS: [address, title of the page, heading, words] of each section. Every word that is asked for
// must be there; headings count more than titles, and these more than text.
(() => {
  const field = document.getElementById("search");
  const list = document.getElementById("found");
  const MOST = 12;
  const plain = SECTIONS.map((section) => section.slice(1).map((text) => text.toLowerCase()));
  const score = ([title, heading, text], words) => words.reduce((sum, word) => {
    const times = text.split(word).length - 1;
    const own = (heading.includes(word) ? 12 : 0) + (title.includes(word) ? 6 : 0) + Math.min(times, 5);
    return sum && own ? sum + own : 0;
  }, 1);
  const excerpt = (text, words) => {
    const lower = text.toLowerCase();
    const places = words.map((word) => lower.indexOf(word)).filter((at) => at >= 0);
    const start = Math.max(0, Math.min(...places, lower.length) - 60);
    const part = document.createElement("span");
    const shown = text.slice(start, start + 180);
    const marks = new RegExp(words.map((word) => word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")).join("|"), "gi");
    let after = 0;
    if (start) part.append("… ");
    for (const found of shown.matchAll(marks)) {
      const mark = document.createElement("mark");
      mark.textContent = found[0];
      part.append(shown.slice(after, found.index), mark);
      after = found.index + found[0].length;
    }
    part.append(`${shown.slice(after)} …`);
    return part;
  };
  const entry = (section, words) => {
    const [address, title, heading, text] = section;
    const item = document.createElement("li");
    const link = document.createElement("a");
    link.href = address;
    link.textContent = heading ? `${title}: ${heading}` : title;
    item.append(link, excerpt(text, words));
    return item;
  };
  const search = () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    list.hidden = !words.length;
    if (!words.length) return list.replaceChildren();
    const scored = plain.map((section, i) => [score(section, words), i]).filter(([points]) => points > 1);
    scored.sort(([a, i], [b, j]) => b - a || i - j);
    const items = scored.slice(0, MOST).map(([, i]) => entry(SECTIONS[i], words));
    if (!items.length) {
      const none = document.createElement("li");
      none.textContent = "Nothing has all these words.";
      items.push(none);
    }
    return list.replaceChildren(...items);
  };
  field.addEventListener("input", search);
  document.addEventListener("keydown", (event) => {
    if (event.key === "/" && !/^(INPUT|TEXTAREA|SELECT)$/.test(document.activeElement.tagName)) {
      event.preventDefault();
      field.focus();
    }
    if (event.key === "Escape" && !list.hidden) {
      field.value = "";
      search();
    }
  });
  search(); // a browser may bring back what was typed
})();
