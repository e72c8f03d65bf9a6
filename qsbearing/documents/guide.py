"""The guide: its pages, as Markdown."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from qsbearing.documents.formula import in_text
from qsbearing.documents.model import anchor_of

FOLDER = Path(__file__).parents[1] / "guide"
BUILT = FOLDER.parent / "site" / "built"
"""Where a wheel carries the site."""
OF_GUIDE = "../../guide/"
"""Where it finds the pictures of its pages there."""
FIRST = "index"
"""The page that comes first, if there is one; its links give the order of the others."""

BEGINNINGS = (
    "tutorial",
    "getting started",
    "quick start",
    "quickstart",
    "start",
    "introduction",
    "intro",
    "first steps",
)
"""Words under which a newcomer looks for the first page."""

Lists = Mapping[str, Callable[[], str]]


@dataclass(frozen=True)
class Page:
    """A page of the guide."""

    topic: str
    title: str
    path: Path
    lists: Lists = field(default_factory=dict)

    @property
    def text(self) -> str:
        """Its Markdown with its lists, without what only tells the tools where a table was made."""
        text = self.path.read_text(encoding="utf-8")
        for name, lines in self.lists.items():
            mark = f"<!-- list: {name} -->\n"
            text = text.replace(mark, lines()) if mark in text else text
        return re.sub(r"<!--.*?-->\n?", "", text, flags=re.DOTALL)

    def plain(self, section: str = "") -> str:
        """It, or one of its sections by the name that links give it, with its formulas as lines of text; empty where
        there is no such section."""
        if not section:
            return in_text(self.text)
        parts = re.split(r"^(?=## )", in_text(self.text), flags=re.MULTILINE)
        return next((each for each in parts if anchor_of(each.partition("\n")[0]) == section), "")


def topics(folder: Path = FOLDER, lists: Lists | None = None) -> dict[str, Page]:
    """The pages by topic, in the order of reading.

    Args:
        lists: what makes the lines of a list that the code knows, by the name in its mark `<!-- list: name -->`.
    """
    pages = {}
    for path in sorted(folder.glob("*.md")):
        title = next((line[2:] for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("# ")), "")
        pages[path.stem] = Page(path.stem, title.strip() or path.stem, path, lists or {})
    if FIRST in pages:
        named = [FIRST, *re.findall(r"\]\((\w+)\.md", pages[FIRST].text)]
        order = {topic: place for place, topic in enumerate(named)}  # the last place: lists follow pictures
        pages = dict(sorted(pages.items(), key=lambda each: order.get(each[0], len(order))))
    return pages


def beside_pages() -> list[str]:
    """Pictures and notebooks that pages show or lead to, by their place in the guide's folder."""
    paths = (path for path in FOLDER.rglob("*") if path.suffix in {".svg", ".png", ".ipynb"})
    return sorted(path.relative_to(FOLDER).as_posix() for path in paths)


def bring_beside(folder: Path) -> None:
    """Copy them to a folder of pages."""
    for name in beside_pages():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(FOLDER / name, folder / name)


def skill_text() -> str:
    """What a language model is told of the commands."""
    return (FOLDER / "skill" / "SKILL.md").read_text(encoding="utf-8")


def meant_by(word: str, pages: Mapping[str, Page]) -> str:
    """What to read about a word that is no topic and no slip of one: pages whose headings have it; empty where there
    are none."""
    plain = word.lower().replace("_", " ").replace("-", " ")
    if plain in BEGINNINGS and "ten_minutes" in pages:
        return "Begin with ten_minutes"
    has_word = re.compile(rf"\b{re.escape(plain)}", re.IGNORECASE).search
    places: list[str] = []
    for page in pages.values():
        if page.topic == FIRST:  # which leads to all others
            continue
        headings = re.findall(r"^## (.*)", page.text, re.MULTILINE)
        if has_word(page.title):
            places.append(page.topic)
        else:
            places += [f"{page.topic}#{anchor_of(each)}" for each in headings if has_word(each)][:1]
    return f"See {', '.join(places)}" if places else ""
