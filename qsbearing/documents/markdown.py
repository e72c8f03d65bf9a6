"""A Markdown page as pieces of a document."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from qsbearing.documents.drawing import width_of
from qsbearing.documents.inline import parser, runs_of
from qsbearing.documents.model import (
    Block,
    Bullets,
    Callout,
    Cell,
    Code,
    Formula,
    Md,
    Paragraph,
    Picture,
    Section,
    Table,
    anchor_of,
)

FORMS = (".svg", ".png")
LINE = 60
"""Letters in a row of text beyond which a narrow page stacks its cells."""
Links = Callable[[str], str | None]
"""From a page's link to where it points in the document; None where the document has no such place."""


def sections(text: str, folder: Path, links: Links, prefix: str = "") -> list[Section]:
    """The sections of a page, nested as its headings are; its first heading is the outermost.

    Args:
        text: Markdown: headings, paragraphs, lists, tables, code, pictures, quotations.
        folder: where the page's pictures are.
        links: from the links of the page to those of the document.
        prefix: put before the names of the sections below the first, so that pages do not share names.

    Raises:
        OSError: a picture is not there.
    """
    page = _Page(parser().parse(text), folder, links, prefix)
    return page.sections()


class _Page:
    """The tokens of a page, read from the front."""

    def __init__(self, tokens: Sequence[Any], folder: Path, links: Links, prefix: str) -> None:
        self.tokens, self.folder, self.links, self.prefix = list(tokens), folder, links, prefix
        self.at = 0

    def sections(self) -> list[Section]:
        """All that is on the page, by its headings."""
        sections: list[Section] = []
        while self.at < len(self.tokens):
            if self.tokens[self.at].type == "heading_open":
                sections.append(self.section(first=not sections))
            else:
                self.at += 1  # what stands before the first heading is a comment
        return sections

    def section(self, first: bool = False) -> Section:
        level = int(self.tokens[self.at].tag[1])
        title = self.line(self.tokens[self.at + 1])
        self.at += 3
        blocks: list[Block] = []
        while self.at < len(self.tokens):
            token = self.tokens[self.at]
            if token.type == "heading_open":
                if int(token.tag[1]) <= level:
                    break
                blocks.append(self.section())
            else:
                blocks += self.block()
        plain = "".join(run["text"] for run in runs_of(_parsed(title)))
        own = anchor_of(plain)
        return Section(title, blocks, self.prefix if first and self.prefix else f"{self.prefix}-{own}".strip("-"))

    def block(self) -> list[Block]:
        """The piece at hand, and past it."""
        token = self.tokens[self.at]
        if token.type == "paragraph_open":
            inline = self.tokens[self.at + 1]
            self.at += 3
            return self.paragraph(inline)
        if token.type in ("fence", "code_block"):
            self.at += 1
            return [Code(token.content.rstrip("\n"), token.info.split()[0] if token.info else "")]
        if token.type == "math_block":
            self.at += 1
            return [Formula(token.content.strip())]
        if token.type in ("bullet_list_open", "ordered_list_open"):
            return [self.bullets()]
        if token.type == "table_open":
            return [self.table()]
        if token.type == "blockquote_open":
            inside = self.until("blockquote_close")
            return [Callout(self.line(each)) for each in inside if each.type == "inline"]
        self.at += 1  # comments, rules
        return []

    def until(self, kind: str) -> list[Any]:
        """The tokens up to the end of what begins here, however often the like begins within."""
        start, level = self.at, self.tokens[self.at].level
        while not (self.tokens[self.at].type == kind and self.tokens[self.at].level == level):
            self.at += 1
        self.at += 1
        return self.tokens[start + 1 : self.at - 1]

    def paragraph(self, inline: Any) -> list[Block]:
        """A paragraph, or the pictures that it consists of."""
        pictures = [child for child in inline.children if child.type == "image"]
        return [self.picture(each) for each in pictures] if pictures else [Paragraph(self.line(inline))]

    def picture(self, token: Any) -> Picture:
        path = self.folder / str(token.attrGet("src"))
        if path.suffix not in FORMS:
            raise OSError(f"{path} is not a picture that a document can hold: {', '.join(FORMS)}")
        data = path.read_bytes()
        width = width_of(data) if path.suffix == ".svg" else 0.85
        return Picture(data, token.content, token.attrGet("title") or "", path.suffix[1:], width)

    def bullets(self) -> Bullets:
        numbered = self.tokens[self.at].type == "ordered_list_open"
        inside = self.until("ordered_list_close" if numbered else "bullet_list_close")
        return Bullets([self.line(each) for each in inside if each.type == "inline"], numbered)

    def table(self) -> Table:
        inside = self.until("table_close")
        rows: list[list[Cell]] = []
        align = ""
        for at, token in enumerate(inside):
            if token.type == "tr_open":
                rows.append([])
            elif token.type in ("th_open", "td_open"):
                rows[-1].append(self.line(inside[at + 1]))
                if token.type == "th_open":
                    side = re.search(r"text-align:(\w)", str(token.attrGet("style") or ""))
                    align += side.group(1) if side else ""
        headings = [str(cell) for cell in rows[0]]
        width = len(headings)
        if len(align) != width:  # the page says nothing: numbers to the right
            align = "".join("r" if _are_numbers([row[i] for row in rows[1:]]) else "l" for i in range(width))
        longest = max((sum(map(len, map(str, row))) for row in rows), default=0)
        is_text = longest > LINE and align.count("r") <= width // 2
        return Table([Md(heading) for heading in headings], rows[1:], align, stack=is_text)

    def line(self, inline: Any) -> Md:
        """A line's Markdown, its links led into the document; one that leads nowhere there is left as text."""

        def lead(match: re.Match[str]) -> str:
            target = self.links(match.group(2))
            return match.group(1) if target is None else f"[{match.group(1)}]({target})"

        return Md(re.sub(r"(?<!!)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)", lead, inline.content))


def _parsed(text: str) -> Any:
    return parser().parseInline(text)[0].children


def _are_numbers(cells: Sequence[Cell]) -> bool:
    texts = [str(cell).strip() for cell in cells]
    return any(texts) and all(not text or re.match(r"[+\-−±<>≤~]?\s*\d", text) for text in texts)
