"""Page 1 of the guide's reports as structure: which parts, in which order, on one page of paper."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Sequence
from functools import cache
from io import BytesIO

import pytest

from qsbearing.documents.model import Bar, Block, Columns, Document, Facts, Paragraph, Picture, Section, Table
from qsbearing.documents.pdf import pdf
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.reports.layout import side_by_side
from qsbearing.reports.of_any import document_of_any
from qsbearing.studies.chooser.choose_set import solve_any
from tests.drawing import drawing
from tests.guide.pages import GUIDE, blocks

FILES = {
    "my": "ten_minutes",
    "required": "design",
    "fitted": "how_to",
    "free": "elastic_rings",
    "spectrum": "readings",
    "pair": "sets",
    "spindle": "spindle",
    "tight": "heat",
}
"""Files of the guide and their pages: a bearing, with requirements, fits, elastic rings, over a spectrum; a pair; a
spindle; a heat balance."""
GLANCE, HEAT = "How it stands under load", "Temperatures over the speed"
LEFT_OUT, NUMBERS, SPEED = "What the model leaves out", "In numbers", "Over the speed"
LIMITS = ("Callout", "Table", "Paragraph")
USUAL = (*LIMITS, GLANCE, "Picture", LEFT_OUT, "Table", "Paragraph", NUMBERS, "Facts")
PARTS: dict[str, Sequence[str]] = {
    "my": (*USUAL, SPEED, "Picture", "Paragraph"),
    "required": (
        "Callout", "Table", "Paragraph", "Paragraph", "Paragraph", GLANCE, "Picture", LEFT_OUT, "Table", "Paragraph",
        NUMBERS, "Facts", SPEED, "Picture", "Paragraph",
    ),
    "fitted": (*USUAL, SPEED, "Picture", "Paragraph"),
    "free": (*LIMITS, GLANCE, "Picture", LEFT_OUT, "Paragraph", "Paragraph", NUMBERS, "Facts", "Paragraph"),
    "spectrum": ("Callout", "Table", "Paragraph", *USUAL, SPEED, "Picture", "Paragraph"),
    "pair": (*USUAL, SPEED, "Picture", "Paragraph"),
    "spindle": (
        *LIMITS, *3 * ("Paragraph",), GLANCE, "Picture", "What gives way at the tool", "Shares", "Paragraph", LEFT_OUT,
        "Table", "Paragraph", NUMBERS, "Facts", SPEED, "Picture", "Paragraph",
    ),
    "tight": (*LIMITS, HEAT, "Picture", LEFT_OUT, "Table", "Paragraph", NUMBERS, "Facts", "Paragraph"),
}  # fmt: skip
MOST_PAGES = 6


@cache
def report_of(name: str, more: str = "", is_drawn: bool = False) -> Document:
    """Args: is_drawn: whether its pictures are, which is up to whoever asks."""
    texts = [each.text for each in blocks(GUIDE / f"{FILES[name]}.md") if each.language == "toml"]
    named = [text for text in texts if text.startswith(f"# {name}.toml")] or texts[:1]
    if name == "my":
        named = [text for text in texts if text.startswith("# my.toml")] or texts
    source = "".join(named) + more
    requested = scene_or_set_of(tomllib.loads(source), f"{name}.toml", name)
    return document_of_any(solve_any(requested), requested, source, f"qsbearing report {name}.toml --out DIR")


def pages_of(name: str, more: str = "") -> list[str]:
    """Texts of its pages of paper, as they are with pictures that are drawn."""
    pypdf = pytest.importorskip("pypdf")
    with drawing():
        made = pdf(report_of(name, more, is_drawn=True))
    return [page.extract_text() for page in pypdf.PdfReader(BytesIO(made)).pages]


def test_tables_of_a_page_stand_beside_each_other_as_far_as_they_fit() -> None:
    """Two small ones in a line of text, a wide one below; so in PDF, by measured widths."""
    pypdf = pytest.importorskip("pypdf")
    small = [Table(("", "value"), [(name, "1")], "lr", f"{name} of all") for name in ("first", "second")]
    wide = Table([f"column {n}" for n in range(9)], [["12,345,678.912345"] * 9], "r" * 9, "wide of all")
    made = pdf(Document("page", "kind", [Section("Results", side_by_side([*small, wide]))], has_front_page=True))
    pages = [page.extract_text(extraction_mode="layout") for page in pypdf.PdfReader(BytesIO(made)).pages]
    lines = [line for page in pages for line in page.splitlines() if " of all" in line]
    assert [[each for each in ("first", "second", "wide") if each in line] for line in lines] == [
        ["first", "second"],
        ["wide"],
    ]


def walked(found: Sequence[Block]) -> Iterator[Block]:
    """Blocks in the order of reading, those of sections and columns after them."""
    for each in found:
        yield each
        if isinstance(each, Section):
            yield from walked(each.blocks)
        elif isinstance(each, Columns):
            for column in each.columns:
                yield from walked(column)


def parts_of(document: Document) -> list[str]:
    every = (each for each in walked(document.head) if not isinstance(each, Columns))
    return [each.title if isinstance(each, Section) else type(each).__name__ for each in every]


@pytest.mark.parametrize("name", FILES)
def test_page_one_has_its_parts_in_their_order(name: str) -> None:
    document = report_of(name)
    assert tuple(parts_of(document)) == tuple(PARTS[name])
    assert [section.title for section in document.sections][:2] == ["Remarks", "Results"]
    assert document.sections[-1].title == "Made with"


@pytest.mark.parametrize("name", FILES)
def test_page_one_is_a_page_and_few_follow(name: str) -> None:
    """Remarks begin page 2, whatever the length of page 1's tables; with all pictures as they are."""
    pages = pages_of(name)
    assert "Pages: Remarks 2" in " ".join(pages[0].split()), "the last line of page 1"
    assert pages[1].split("\n")[1].startswith("Remarks")
    assert len(pages) <= MOST_PAGES
    has_curves = name not in ("free", "tight", "spindle")  # it stands still, has temperatures, needs what they take
    assert (SPEED in pages[0]) == has_curves


def test_every_limit_has_a_bar_and_its_sources_are_named() -> None:
    head = list(walked(report_of("required").head))
    table = next(each for each in head if isinstance(each, Table))
    rows = [row for row in table.rows if not hasattr(row, "text")]
    assert len(rows) == 9 and sum(isinstance(cell, Bar) for row in rows for cell in row) == 8, "one is open, unread"  # type: ignore[union-attr]
    small = " ".join(each.text for each in head if isinstance(each, Paragraph) and each.is_small)
    assert "house rule 12" in small and "ISO 76" in small and "Not checked: " in small


def test_known_facts_of_the_field_stand_on_page_one() -> None:
    """Those that the file asks for, or that follow from it anyway."""
    (facts,) = (each for each in walked(report_of("my").head) if isinstance(each, Facts))
    names = [name for name, _ in facts.pairs]
    for expected in ("maximum contact pressure", "required friction coefficient", "basic reference rating life"):
        assert expected in names
    assert dict(facts.pairs)["speed factor n·dm"] == "840,000 mm/min"


def test_a_picture_of_page_one_is_not_drawn_again() -> None:
    for name in ("my", "spindle"):
        document = report_of(name)
        alts = [each.alt for each in walked([*document.head, *document.sections]) if isinstance(each, Picture)]
        assert len(set(alts)) == len(alts)


def test_curves_give_way_to_many_requirements() -> None:
    """On paper page 1 has no room for them beside these, a screen has; later pages have more of them anyway."""
    more = "".join(f"inner.{name} = {bound}\n" for name, bound in LIMITED.items())
    first, second = pages_of("required", more)[:2]
    assert SPEED not in first and "Pages: Remarks 2" in " ".join(first.split())
    assert second.split("\n")[1].startswith("Remarks")
    assert SPEED in parts_of(report_of("required", more))


LIMITED = {
    "load_N": '"<= 900"',
    "approach_um": '"<= 90"',
    "semi_major_axis_mm": '"<= 9"',
    "semi_minor_axis_mm": '"<= 1"',
    "angle_deg": '"<= 40"',
}
"""Further requirements, all met."""
