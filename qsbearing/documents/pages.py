"""Several documents as pages of one folder: each leads to the one before and after, and to a search through all that
needs no network."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from qsbearing.documents.data import BrokenLinkError, data, links
from qsbearing.documents.html import TEMPLATES, html
from qsbearing.documents.model import Document

SEARCH = "search.js"


def pages(documents: Mapping[str, Document], home: str) -> dict[str, str]:
    """The text of each file by its name.

    Args:
        documents: by the names of their files, in the order of reading.
        home: the file that all pages lead back to; its sections stand beside each other.

    Raises:
        BrokenLinkError: a link points at a page or section that there is not.
    """
    names = list(documents)
    plain = {name: data(each) for name, each in documents.items()}
    places = set(names) | {f"{name}#{section.name}" for name, each in documents.items() for section, _ in each.walk()}
    # Those within a page are checked where its data are made.
    inner = {link for link in links(list(plain.values())) if ":" not in link and not link.startswith("#")}
    lost = sorted(inner - places)
    if lost:
        raise BrokenLinkError(f"no page or section for {', '.join(lost)}")
    files = {}
    for number, (name, each) in enumerate(documents.items()):
        around = {
            "home": home,
            "search": SEARCH,
            "is_home": name == home,
            "before": _named(documents, names[number - 1]) if number else None,
            "after": _named(documents, names[number + 1]) if number + 1 < len(names) else None,
        }
        files[name] = html(each, around)
    entries = [entry for name, each in plain.items() for entry in _entries(name, each)]
    script = (TEMPLATES / SEARCH).read_text(encoding="utf-8")
    files[SEARCH] = f"const SECTIONS = {json.dumps(entries, ensure_ascii=False)};\n{script}"
    return files


def _named(documents: Mapping[str, Document], name: str) -> tuple[str, str]:
    return name, documents[name].title


def _entries(name: str, page: dict[str, Any]) -> Iterator[tuple[str, str, str, str]]:
    """Of a page and each of its sections: where it is, the page's title, its heading, its own words."""
    title = page["title"]
    yield name, title, "", _own_words(page["head"])
    for section in _sections(page["blocks"]):
        yield f"{name}#{section['name']}", title, _words(section["title"]), _own_words(section["blocks"])


def _sections(blocks: list[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    for block in blocks:
        if block["is"] == "section":
            yield block
            yield from _sections(block["blocks"])


def _own_words(blocks: list[dict[str, Any]]) -> str:
    return " ".join(_words(block) for block in blocks if block["is"] != "section")


def _words(piece: Any) -> str:
    """What people read of a piece of a document."""
    if isinstance(piece, dict):
        own = piece["text"] if isinstance(piece.get("text"), str) else ""
        return " ".join(filter(None, [own, *(_words(each) for each in piece.values() if not isinstance(each, str))]))
    if isinstance(piece, list):
        # Runs of a line follow each other without a space.
        is_line = all(isinstance(each, dict) and "styles" in each for each in piece)
        return ("" if is_line else " ").join(filter(None, map(_words, piece)))
    return ""
