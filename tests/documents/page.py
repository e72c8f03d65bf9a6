"""An HTML page as its parser sees it, and what is wrong with it: nesting, headings, links, words for pictures, network.

Python's own parser reads the page; none of the code that made it is used.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from html.parser import HTMLParser

VOID = {"meta", "link", "img", "br", "input", "hr", "base", "source", "col", "wbr"}
LOADING = {"src", "srcset", "poster", "data", "background", "action", "formaction", "ping", "xlink:href"}
"""Attributes from which a browser loads something."""


@dataclass
class Page(HTMLParser):
    """A page read through."""

    headings: list[tuple[int, str]] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    tables: list[list[list[str]]] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    text: str = ""
    facts: list[tuple[str, str]] = field(default_factory=list)
    """Names and what they are."""
    notes: list[tuple[str, str]] = field(default_factory=list)
    """Below tables: marks and what they say."""
    beside: frozenset[str] = frozenset()
    """Files of the same folder that it may lead to and load."""

    def __post_init__(self) -> None:
        super().__init__()
        self._open: list[str] = []

    @classmethod
    def of(cls, html: str, beside: Iterable[str] = ()) -> Page:
        page = cls(beside=frozenset(beside))
        page.feed(html)
        page.close()
        page.faults += [f"<{tag}> is never closed" for tag in page._open]
        page._judge()
        return page

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        own = dict(attrs)
        inside_svg = "svg" in self._open
        if tag not in VOID:
            self._open.append(tag)
        if "id" in own:
            self.names.append(str(own["id"]))
        for name in LOADING & set(own):
            target = str(own[name])
            if not target.startswith(("data:", "#")) and target not in self.beside:
                self.faults.append(f"<{tag} {name}={target[:40]}> is loaded from elsewhere")
        if tag == "link" or (tag == "script" and own.get("src", "") not in {"", *self.beside}):
            self.faults.append(f"<{tag}> from elsewhere")
        if tag == "a" and not inside_svg:
            self.links.append(str(own.get("href")))
        if own.get("role") == "img" and not own.get("aria-label"):
            self.faults.append("a picture without words")
        if tag in ("svg", "img") and not inside_svg and "picture" not in self._picture_above():
            self.faults.append(f"<{tag}> outside of a described picture")
        if re.fullmatch("h[1-6]", tag):
            self.headings.append((int(tag[1]), ""))
        elif tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append([])
        elif tag in ("td", "th"):
            self.tables[-1][-1].append("")
        self._described = own.get("role") == "img" if tag == "div" else getattr(self, "_described", False)

    def _picture_above(self) -> str:
        return "picture" if getattr(self, "_described", False) else ""

    def handle_endtag(self, tag: str) -> None:
        if not self._open or self._open[-1] != tag:
            self.faults.append(f"</{tag}> where <{self._open[-1] if self._open else 'nothing'}> is open")
            return
        self._open.pop()
        if tag == "div":
            self._described = False

    def handle_data(self, data: str) -> None:
        if not self._open or self._open[-1] in ("style", "script"):
            if self._open and self._open[-1] == "style" and re.search(r"url\((?!#)|@import", data):
                self.faults.append("a style is loaded from elsewhere")
            return
        data = data.replace("\N{NO-BREAK SPACE}", " ").replace(
            "\N{WORD JOINER}", ""
        )  # they keep a quantity on one line
        data = data.replace("\N{MINUS SIGN}", "-")  # as programs read numbers
        self.text += data
        if "li" in self._open and self._open[-1] == "b":
            self.notes.append((data, ""))
        elif self._open[-1] == "li" and self.notes:
            mark, known = self.notes[-1]
            self.notes[-1] = mark, (known + data).strip()
        if self._open[-1] in ("dt", "dd"):
            if self._open[-1] == "dt":
                self.facts.append((data, ""))
            else:
                name, known = self.facts[-1]
                self.facts[-1] = name, known + data
        if self.headings and re.search(r"h[1-6]", " ".join(self._open)):
            level, text = self.headings[-1]
            self.headings[-1] = (level, text + data)
        if "td" in self._open or "th" in self._open:
            self.tables[-1][-1][-1] += data

    def _judge(self) -> None:
        twice = sorted({name for name in self.names if self.names.count(name) > 1})
        self.faults += [f"two things are called {name}" for name in twice[:5]]
        for link in self.links:
            if link.startswith("#"):
                if link[1:] not in self.names:
                    self.faults.append(f"{link} leads nowhere")
            elif not re.match("https://", link) and link.partition("#")[0] not in self.beside:
                self.faults.append(f"{link} leads out of the page")
        levels = [level for level, _ in self.headings]
        if levels[:1] != [1] or levels.count(1) != 1:
            self.faults.append("not one heading of the first level, at the start")
        for before, after in itertools.pairwise(levels):
            if after > before + 1:
                self.faults.append(f"a heading of level {after} after one of level {before}")
