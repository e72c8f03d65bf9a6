"use strict";
// Sorting and filtering of the tables marked for it, and the section being read marked in the contents. Without this
// script tables are whole and in their own order.
(() => {
  const number = (text) => {
    const found = text.replace(/\u2212/g, "-").match(/^\s*[±<>≤]?\s*([+-]?\d[\d,]*\.?\d*(?:e[+-]?\d+)?)/i);
    return found ? Number(found[1].replace(/,/g, "")) : NaN;
  };
  const compare = (a, b) => {
    const [x, y] = [number(a), number(b)];
    if (!Number.isNaN(x) && !Number.isNaN(y)) return x - y;
    return a.localeCompare(b, "en", { numeric: true });
  };
  const label = (text, control) => {
    const found = document.createElement("label");
    found.append(text, control);
    return found;
  };
  const prepare = (table, index) => {
    const body = table.tBodies[0];
    const rows = [...body.rows];
    const texts = rows.map((row) => [...row.cells].map((cell) => cell.textContent.trim()));
    const heads = [...table.tHead.rows[0].cells];

    heads.forEach((head, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => {
        const down = head.getAttribute("aria-sort") === "ascending";
        heads.forEach((each) => each.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", down ? "descending" : "ascending");
        const order = rows.map((_, i) => i).sort((i, j) => {
          const [a, b] = [texts[i][column], texts[j][column]];
          if (!a || !b) return (a ? 0 : 1) - (b ? 0 : 1); // empty cells last, whichever way
          return (down ? -1 : 1) * compare(a, b) || i - j;
        });
        body.append(...order.map((i) => rows[i]));
      });
    });

    const search = document.createElement("input");
    search.type = "search";
    search.id = `filter-${index}`;
    search.placeholder = "words, any order";
    const choices = heads.map((head, column) => {
      const badges = rows.map((row) => row.cells[column].querySelector(".badge")).filter(Boolean);
      if (!badges.length) return null;
      const select = document.createElement("select");
      select.append(new Option("all", ""));
      [...new Set(badges.map((badge) => badge.textContent))].sort().forEach((word) => select.append(new Option(word, word)));
      return { column, select, title: head.textContent.trim() };
    }).filter(Boolean);
    const count = document.createElement("output");
    count.setAttribute("aria-live", "polite");
    const filter = () => {
      const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
      let shown = 0;
      rows.forEach((row, i) => {
        const text = texts[i].join(" ").toLowerCase();
        const fits = words.every((word) => text.includes(word))
          && choices.every(({ column, select }) => !select.value || texts[i][column] === select.value);
        row.hidden = !fits;
        shown += fits;
      });
      count.textContent = `${shown} of ${rows.length} rows`;
    };
    const tools = document.createElement("div");
    tools.className = "tools";
    tools.append(label("Show rows with", search), ...choices.map(({ select, title }) => label(title, select)), count);
    table.closest(".table").before(tools);
    [search, ...choices.map(({ select }) => select)].forEach((control) => control.addEventListener("input", filter));
    filter();
  };
  document.querySelectorAll("table[data-tools]").forEach(prepare);
  // The contents mark the section being read: the last whose heading has passed the top third of the window.
  const entries = [...document.querySelectorAll("nav a")].map((link) => [link, document.getElementById(link.hash.slice(1))]);
  const mark = () => {
    const passed = entries.filter(([, heading]) => heading.getBoundingClientRect().top < window.innerHeight / 3);
    const [current] = passed.at(-1) || [];
    entries.forEach(([link]) => (link === current ? link.setAttribute("aria-current", "true") : link.removeAttribute("aria-current")));
    const list = document.querySelector("nav");
    if (current && getComputedStyle(list).position === "sticky") {
      const [box, own] = [list.getBoundingClientRect(), current.getBoundingClientRect()];
      if (own.top < box.top || own.bottom > box.bottom) list.scrollTop += own.top - box.top - box.height / 3;
    }
  };
  window.addEventListener("scroll", mark, { passive: true });
  mark();
  // On a small screen the contents would fill the first page.
  if (window.matchMedia("(max-width: 69.9rem)").matches) document.querySelector("nav details").open = false;
})();
