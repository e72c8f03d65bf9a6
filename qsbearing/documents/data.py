"""A document as plain data, which both forms are made from; a link to nowhere is an error of whoever wrote it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from qsbearing.documents import model
from qsbearing.documents.inline import runs, with_minus

Plain = dict[str, Any]


class BrokenLinkError(ValueError):
    """A link points at a section that the document does not have."""


def data(document: model.Document) -> Plain:
    """The document as plain data; pictures are numbered, their bytes kept apart in `pictures`."""
    counted = _Counted(document.is_numbered)
    plain = {
        "title": with_minus(document.title),
        "kind": document.kind,
        "summary": runs(document.summary),
        "head": _blocks(document.head, 1, counted),
        "blocks": _blocks(document.sections, 1, counted),
        "contents": [
            {"title": runs(section.title), "name": section.name, "level": level}
            for section, level in document.walk()
            if level <= document.depth
        ],
        "depth": document.depth,
        "numbered": document.is_numbered,
        "front": document.has_front_page,
        "made_from": document.made_from,
        "pictures": counted.pictures,
    }
    lost = sorted({href for href in links(plain) if href.startswith("#") and href[1:] not in document.names})
    if lost:
        raise BrokenLinkError(f"{document.title}: no section for {', '.join(lost)}")
    return plain


@dataclass
class _Counted:
    """Pictures so far, and the numbers of captions."""

    is_numbered: bool
    pictures: list[model.Picture] = field(default_factory=list)
    captions: dict[str, int] = field(default_factory=lambda: {"Table": 0, "Figure": 0})

    def caption(self, kind: str, text: str) -> list[dict[str, Any]]:
        if not text:
            return []
        text = type(text)(text.rstrip(".") + ("." if kind == "Figure" else ""))
        if not self.is_numbered:
            return runs(text)
        self.captions[kind] += 1
        return [{"text": f"{kind} {self.captions[kind]}. ", "styles": ["strong"], "href": None}, *runs(text)]


def _blocks(blocks: Sequence[model.Block], level: int, counted: _Counted) -> list[Plain]:
    return [_block(block, level, counted) for block in blocks]


def _block(block: model.Block, level: int, counted: _Counted) -> Plain:
    match block:
        case model.Section():
            return {
                "is": "section", "title": runs(block.title), "name": block.name, "level": level,
                "whole": block.is_whole, "spare": block.is_spare, "blocks": _blocks(block.blocks, level + 1, counted),
            }  # fmt: skip
        case model.Paragraph():
            return {"is": "paragraph", "text": runs(block.text), "small": block.is_small}
        case model.Bullets():
            return {"is": "list", "items": [runs(item) for item in block.items], "numbered": block.numbered}
        case model.Code():
            return {"is": "code", "text": block.text, "language": block.language}
        case model.Callout():
            rest = block.text.removeprefix(block.lead).strip() if type(block.text) is str else block.text
            lead = "" if rest is block.text else block.lead
            # A sentence stands on a line of its own, a word before what it leads.
            return {
                "is": "remark", "text": runs(rest), "status": block.status, "lead": lead,
                "headline": lead.endswith("."),
            }  # fmt: skip
        case model.Facts():
            return {"is": "facts", "pairs": [[runs(name), _cell(value)] for name, value in block.pairs]}
        case model.Trace():
            return {"is": "trace", "record": block.record, "command": block.command, "with": block.made_with}
        case model.Table():
            return {
                "is": "table", "headings": [runs(heading) for heading in block.headings], "align": block.alignment,
                "caption": counted.caption("Table", block.caption),
                "notes": [[mark, runs(text)] for mark, text in block.notes],
                "tools": block.tools, "stack": block.stack,
                "rows": [
                    {"across": runs(row.text)} if isinstance(row, model.RowGroup) else {"cells": list(map(_cell, row))}
                    for row in block.rows
                ],
            }  # fmt: skip
        case model.Shares():
            return {"is": "shares", "parts": [{"name": name, "part": part} for name, part in block.parts]}
        case model.Columns():
            columns = [_blocks(column, level, counted) for column in block.columns]
            return {"is": "columns", "columns": columns, "fitted": block.are_fitted}
        case model.Picture():
            counted.pictures.append(block)
            return {
                "is": "picture", "number": len(counted.pictures) - 1, "alt": block.alt,
                "caption": counted.caption("Figure", block.caption), "form": block.form, "width": block.width,
            }  # fmt: skip
    raise TypeError(f"{type(block).__name__} is no piece of a document")


def _cell(cell: model.Cell) -> Plain:
    if isinstance(cell, model.Badge):
        return {"badge": cell.word, "status": cell.kind}
    if isinstance(cell, model.Bar):
        return {"bar": cell.length, "limit": 1.0 / model.LONGEST_BAR, "word": cell.word, "status": cell.status}
    return {"text": runs(cell)}


def links(plain: Any) -> list[str]:
    """Where the runs of plain data lead."""
    if isinstance(plain, dict):
        own = [plain["href"]] if plain.get("href") else []
        return own + [link for value in plain.values() for link in links(value)]
    if isinstance(plain, list):
        return [link for value in plain for link in links(value)]
    return []
