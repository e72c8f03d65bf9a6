"""A table is built once: the terminal shows what the HTML page shows."""

from __future__ import annotations

import html
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qsbearing.documents.html import part
from qsbearing.documents.model import Badge, Block, Bullets, Callout, Paragraph, RowGroup, Table
from qsbearing.documents.numbers import with_minus
from qsbearing.documents.terminal import text_of
from tests.documents.names import broken

BLOCKS: list[Block] = [
    Paragraph("B218 [old]  16 balls", lead="B218 [old]"),
    Callout("Check your data: `preload` is large", "warning", "Check your data:", "yellow"),
    Table(
        ("name", "load\nN", ""),
        [("7210C [red]", "1234.5", Badge("pass")), ("a name that is long enough to be folded", "-0.25", Badge("fail"))],
        "lrl", "Loads [of rows]", notes=[("*", "inferred")],
    ),
    Paragraph("Below it", is_apart=True),
]  # fmt: skip


@pytest.mark.parametrize("width", [34, 100])
def test_a_terminal_shows_every_word_of_the_page(width: int) -> None:
    page = html.unescape(re.sub(r"<[^>]*>", " ", part(BLOCKS))).replace("\N{MINUS SIGN}", "-")
    shown = text_of(BLOCKS, width).replace("\N{MINUS SIGN}", "-")
    assert sorted(page.split()) == sorted(word for word in shown.split() if "─" not in word)
    assert max(map(len, shown.splitlines())) <= width


WIDE = Table(
    ("effect", "angles\n%", "loads of\nballs %", "verdict", "time"),
    [("hertz_angle", "0.00026", "≈ 0.5 to 20", "likely needed, data missing", "x0.55"),
     ("a name of a user that is longer than others", "31", "> 100", "needed", "x1.3")],
    "lrrlr", "Effects",
)  # fmt: skip


@pytest.mark.parametrize("width", range(34, 100, 6))
def test_no_number_is_cut_and_no_word(width: int) -> None:
    """What does not fit follows below, beside the first column."""
    lines = text_of([WIDE], width).splitlines()
    assert max(map(len, lines)) <= width
    for cell in ("0.00026", "≈ 0.5 to 20", "> 100", "x0.55", "x1.3"):
        assert any(cell in line for line in lines), cell
    words = {word for line in lines for word in line.split()}
    assert {"likely", "needed,", "missing", "verdict", "hertz_angle"} <= words


@pytest.mark.parametrize("width", range(40, 100, 6))
def test_a_group_s_long_text_cuts_no_number(width: int) -> None:
    text = "outer, Q = 800 N at 20.18°: exact gap over parabola, true bodies of both rings"
    rows = [RowGroup(text), ("approach", "1.00482", "-0.004 ± 0.030", Badge("pass"))]
    lines = text_of([Table(("", "found", "deviation", ""), rows, "lrrl")], width).splitlines()
    assert max(map(len, lines)) <= width
    assert lines[-1].split() == ["approach", "1.00482", "−0.004", "±", "0.030", "pass"]
    assert " ".join(line.strip() for line in lines[2:-1]) == text


NAMES = st.integers(1, 50).map(lambda letters: ("ring_effective_stiffness_radial_" * 2)[:letters])
NUMBERS = st.floats(-1e9, 1e9).map("{:.5g}".format)


@st.composite
def tables(draw: st.DrawFn) -> Table:
    """Of names as long as any key, numbers, and columns that may be left out."""
    names = draw(st.lists(NAMES, min_size=1, max_size=4))
    align = "l" + draw(st.text("lr", min_size=1, max_size=7))
    rows = [(name, *(draw(NAMES if side == "l" else NUMBERS) for side in align[1:])) for name in names]
    headings = ("", *(draw(st.text("abcdef", min_size=1, max_size=9)) for _ in align[1:]))
    return Table(headings, rows, align, spare=draw(st.permutations(range(1, len(align))))[: len(align) // 2])


@given(tables(), st.integers(60, 120))
def test_no_name_is_broken(table: Table, width: int) -> None:
    """From 60 columns on; what does not fit beside it stands below it."""
    assert broken(table, width) == set()


@given(st.one_of(tables(), st.just(WIDE)), st.integers(60, 119))
def test_what_fits_is_laid_out_alike(table: Table, width: int) -> None:
    """In a narrower terminal as in a wider one."""
    wide = text_of([table], 120)
    if max(map(len, wide.splitlines())) <= width:
        assert text_of([table], width) == wide


@given(tables(), st.integers(60, 120))
def test_columns_are_left_out_by_their_order_and_said_to_be(table: Table, width: int) -> None:
    text = text_of([table], width)
    *_, last = text.splitlines()
    left = last.removeprefix("Too narrow for: ").removesuffix(".").split(", ") if last.startswith("Too narrow") else []
    assert sorted(left) == sorted(table.headings[number] for number in table.spare[: len(left)])
    assert sum("─" in line for line in text.splitlines()) == 1 or len(left) == len(table.spare)
    numbers = [n for n, side in enumerate(table.alignment) if side == "r" and n not in table.spare[: len(left)]]
    assert {with_minus(str(row[number])) for row in table.rows for number in numbers} <= set(text.split())


def test_tables_and_what_is_apart_follow_an_empty_line() -> None:
    lines = text_of(BLOCKS, 100).splitlines()
    assert [lines[number + 1].split()[0] for number, line in enumerate(lines) if not line] == ["Loads", "*", "Below"]


def test_a_piece_that_a_terminal_cannot_show_is_refused() -> None:
    with pytest.raises(TypeError, match="Bullets"):
        text_of([Bullets(["one"])])


@pytest.mark.parametrize(
    ("typed", "printed"),
    [
        ("-5.2 µm", "−5.2 µm"), ("(-3)", "(−3)"), ("= -17", "= −17"), ("1.1e-17", "1.1e−17"), ("-.5", "−.5"),
        ("2026-11-28", "2026-11-28"), ("7210-C", "7210-C"), ("ISO 16281-1", "ISO 16281-1"), ("-y", "-y"), ("-", "-"),
        ("3-5", "3-5"), ("-4 to -2 °C", "−4 to −2 °C"), ("name-1", "name-1"), ("--5", "--5"), ("-∞", "−∞"),
    ],
)  # fmt: skip
def test_numbers_have_the_sign_of_minus(typed: str, printed: str) -> None:
    assert with_minus(typed) == printed
    block = [Paragraph(typed), Table(("", "a"), [("b", typed)])]
    words = [word for word in text_of(block, 100).split() if "─" not in word]
    assert words == [*printed.split(), "a", "b", *printed.split()]
    page = html.unescape(re.sub(r"<[^>]*>", " ", part(block))).replace("\N{NO-BREAK SPACE}", " ")
    assert page.count(printed) == 2
