"""PDF: what it says, its fonts, its pages; read by a reader that shares nothing with what wrote it."""

from __future__ import annotations

import re
from io import BytesIO
from typing import Any

import pytest

from qsbearing.documents.model import Group, Paragraph, Table
from qsbearing.documents.pdf import pdf
from tests.documents.example import NASTY, document

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
    for said in ("One of everything", "Plain, leaning, heavy, typed_code", "αi = 41.49°", "-2.5", NASTY):
        assert re.sub(r"\s", "", said) in squeezed, said
    assert reader.metadata.title == "One of everything"
    assert [entry.title for entry in reader.outline if not isinstance(entry, list)] == ["Words", "Numbers", "Pictures"]
    assert f"{len(reader.pages)}of{len(reader.pages)}" in squeezed
    assert "/StructTreeRoot" in reader.trailer["/Root"]  # tagged, for those who listen


def test_no_row_of_a_table_is_alone_on_a_page() -> None:
    """At whatever height of a page its tables begin."""
    long = "a cell of more than one line " * 5
    tables = []
    for n in range(200):
        rows = [[f"row{n}.{k}.", long] for k in range(8)]
        tables.append(Table(("", "text"), [*rows[:4], Group("across"), *rows[4:]]))
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


def test_the_same_document_is_the_same_file() -> None:
    assert pdf(document(), strict=True) == pdf(document(), strict=True)


def test_a_letter_that_no_font_has_is_said() -> None:
    """It is a box on the page, which the standard for readable files refuses; a name in a scene may hold anything."""
    import typst

    spoilt = document(Paragraph("\U0001f30b"))

    with pytest.raises(typst.TypstError, match="could not be displayed"):
        pdf(spoilt, strict=True)
    assert pdf(spoilt).startswith(b"%PDF")
