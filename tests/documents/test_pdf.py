"""PDF: what it says, its fonts, its pages; read by a reader that shares nothing with what wrote it."""

from __future__ import annotations

import dataclasses
import re
from io import BytesIO
from typing import Any

import pytest

from qsbearing.documents.model import Badge, Block, Callout, Document, Facts, Paragraph, RowGroup, Section, Table, Trace
from qsbearing.documents.pdf import pdf
from tests.documents.example import NASTY, curve, document

pypdf = pytest.importorskip("pypdf")


def fonts(reader: Any) -> dict[str, bool]:
    """Every font of every page, and whether the file holds it."""
    found = {}
    for page in reader.pages:
        for font in page["/Resources"].get("/Font", {}).values():
            font = font.get_object()
            for each in font.get("/DescendantFonts", [font]):
                each = each.get_object()
                descriptor = each.get("/FontDescriptor", {})
                held = any(key in descriptor for key in ("/FontFile", "/FontFile2", "/FontFile3"))
                found[str(each["/BaseFont"])] = held
    return found


def test_a_pdf_says_all_and_holds_its_fonts() -> None:
    reader = pypdf.PdfReader(BytesIO(pdf(document(), strict=True)))
    held = fonts(reader)
    assert held
    assert all(held.values()), held
    text = "\n".join(page.extract_text() for page in reader.pages)
    squeezed = re.sub(r"[\s\u200b]", "", text)
    for said in ("One of everything", "Plain, leaning, heavy, typed_code", "αi = 41.49°", "−2.5", NASTY):
        assert re.sub(r"\s", "", said) in squeezed, said
    assert reader.metadata.title == "One of everything"
    assert [entry.title for entry in reader.outline if not isinstance(entry, list)] == ["Words", "Numbers", "Pictures"]
    for number, page in enumerate(reader.pages, 1):
        assert page.extract_text().split()[-3:] == [str(number), "of", str(len(reader.pages))]
    assert reader.metadata.creation_date is None, "two of the same content are the same"
    assert "/StructTreeRoot" in reader.trailer["/Root"]  # tagged, for those who listen


def test_no_row_of_a_table_is_alone_on_a_page() -> None:
    """At whatever height of a page its tables begin."""
    long = "a cell of more than one line " * 5
    tables = []
    for n in range(70):
        rows = [[f"row{n}.{k}.", long] for k in range(8)]
        tables.append(Table(("", "text"), [*rows[:4], RowGroup("across"), *rows[4:]]))
    fillers = [Paragraph("filler " * (n % 37)) for n, _ in enumerate(tables)]
    blocks = [each for pair in zip(fillers, tables, strict=True) for each in pair]
    reader = pypdf.PdfReader(BytesIO(pdf(document(*blocks), strict=True)))
    pages = [re.sub(r"[\s\u200b]", "", page.extract_text()) for page in reader.pages]
    found = [[page.count(f"row{n}.") for page in pages if f"row{n}." in page] for n in range(len(tables))]
    assert {sum(each) for each in found} == {8}
    assert sum(len(each) > 1 for each in found) > 5, "tables that break"
    assert all(min(each) > 1 for each in found)
    assert not any(
        page.removesuffix(f"{number}of{len(pages)}").endswith("across") for number, page in enumerate(pages, 1)
    )


def test_notes_are_on_the_page_of_the_last_row() -> None:
    """Whole, wherever the page ends."""
    tables = []
    for n in range(30):
        rows = [[f"row{n}-{k}.", "word " * 20] for k in range(14)]
        notes = [(mark, f"note{n}{mark}. {'word ' * 30}") for mark in "abcd"]
        tables.append(Table(("", "text"), rows, notes=notes))
    reader = pypdf.PdfReader(BytesIO(pdf(Document("Notes", "Test", [Section("Tables", tables)]), strict=True)))
    pages = [re.sub(r"[\s\u200b]", "", page.extract_text()) for page in reader.pages]
    assert any(f"row{n}-0." in page and f"row{n}-13." not in page for page in pages for n in range(30)), "some break"
    for n in range(30):
        (last,) = [page for page in pages if f"row{n}-13." in page]
        assert all(f"note{n}{mark}." in last for mark in "abcd")


def test_a_record_is_on_the_page_of_what_it_stands_below() -> None:
    """The last row of a table, or a paragraph; and it makes no column of a narrow table wider."""
    blocks: list[Block] = []
    for n in range(150):
        blocks += [
            Paragraph("filler " * (20 + 7 * n % 97)),
            Table(("", "text"), [[f"row{n}-{k}.", "word"] for k in range(3)]),
        ]
        blocks += [Paragraph(f"last{n}.")] if n % 2 else []
        blocks.append(Trace(f"record{n}.json", "fem-check run patch_test --level release " * 2))
    reader = pypdf.PdfReader(BytesIO(pdf(Document("Records", "Test", [Section("Tables", blocks)]), strict=True)))
    pages = [re.sub(r"[\s\u200b]", "", page.extract_text()) for page in reader.pages]
    for n in range(150):
        (below,) = [page for page in pages if f"record{n}.json" in page]
        assert (f"last{n}." if n % 2 else f"row{n}-2.") in below
    places: list[float] = []
    for page in reader.pages:
        page.extract_text(
            visitor_text=lambda text, cm, tm, *_: places.append(cm[4] + tm[4]) if "word" in text else None
        )
    assert places
    assert max(places) < 200.0


def test_columns_of_words_are_as_wide_as_their_texts_need() -> None:
    rows = [
        ["short", "a few words here and there, " * 2, "more words than before, " * 2, f"{'long ' * 30}end{n}."]
        for n in range(4)
    ]
    table = Table(("a", "b", "c", "d"), rows, "llll")
    reader = pypdf.PdfReader(BytesIO(pdf(Document("Words", "Test", [Section("Table", [table])]), strict=True)))
    lines = [line for page in reader.pages for line in page.extract_text().split("\n")]
    assert sum("long" in line for line in lines) < 4 * 4
    judged = Table(table.headings, [[row[0], row[1] * 2, row[2] * 2, Badge("pass")] for row in rows], "llll")
    reader = pypdf.PdfReader(BytesIO(pdf(Document("Words", "Test", [Section("Table", [judged])]), strict=True)))
    places: list[float] = []
    reader.pages[0].extract_text(
        visitor_text=lambda text, cm, tm, *_: places.append(cm[4] + tm[4]) if "pass" in text else None
    )
    assert places
    assert max(places) < 525.0, "a verdict has room"


def test_no_picture_of_a_numbered_document_is_in_a_later_chapter() -> None:
    """However little room is left on the page where its own chapter ends."""
    lines = [[Paragraph("filler") for _ in range(1 + n % 4)] for n in range(13)]
    chapters = [
        Section(f"chapter{n}.", [dataclasses.replace(curve(), caption=f"drawn{n}", width=1.0), *each])
        for n, each in enumerate(lines)
    ]
    whole = Document("Chapters", "Test", chapters, is_numbered=True)
    pages = [page.extract_text() for page in pypdf.PdfReader(BytesIO(pdf(whole, strict=True))).pages]

    def page_of(text: str) -> int:
        return next(number for number, page in enumerate(pages[1:]) if text in page)

    assert all(page_of(f"drawn{n}.") <= page_of(f"chapter{n + 1}.") for n in range(12))


def test_the_same_document_is_the_same_file() -> None:
    assert pdf(document(), strict=True) == pdf(document(), strict=True)


def test_a_letter_that_no_font_has_is_said() -> None:
    """It is a box on the page, which the standard for readable files refuses; a name in a scene may hold anything."""
    import typst

    spoilt = document(Paragraph("\U0001f30b"))

    with pytest.raises(typst.TypstError, match="could not be displayed"):
        pdf(spoilt, strict=True)
    said: list[bool] = []
    assert pdf(spoilt, lacking=lambda: said.append(True)).startswith(b"%PDF")
    private = document(Paragraph("\U0010fffd"))
    assert pdf(private, lacking=lambda: said.append(True)).startswith(b"%PDF")
    assert said[-1:] == [True]


def test_many_remarks_leave_no_page_empty_and_a_picture_keeps_its_introduction() -> None:
    """Remarks at the head begin on the first page; a paragraph before a picture is on the page of the picture."""
    head: list[Block] = [Callout(f"remark{n}. " + "word " * 30, "warning") for n in range(10)]
    facts = Facts([(f"fact{n}", "value") for n in range(6)])
    contents = [Section(f"chapter{n}", [Paragraph("filler")]) for n in range(12)]
    tall = dataclasses.replace(curve(), caption="drawn", width=1.0)
    for lines in range(0, 40, 8):
        filler = [Paragraph("line") for _ in range(lines)]
        part = Section("Curves", [*filler, Paragraph("introduced"), tall])
        first = [Paragraph("first") for _ in range(8)]
        whole = Document("Head", "Test", [*contents, part], "", [*first, *head, facts])
        pages = [page.extract_text() for page in pypdf.PdfReader(BytesIO(pdf(whole, strict=True))).pages]
        assert "remark0." in pages[0] and "remark5." in pages[0]
        (page,) = (page for page in pages if "introduced" in page)
        assert "drawn" in page
