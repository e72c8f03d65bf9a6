"""Numbers in words: no power of ten, no range between two equal ends, no per cent of rounding."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from string import Formatter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qsbearing.documents.numbers import duration, plain
from qsbearing.model.effects import QUANTITIES
from qsbearing.model.solution.judgement import ATOM, NOTHING, changed, estimated, percent, unit_of
from qsbearing.readings.rating_life import LIFE_OF_CERAMIC
from qsbearing.readings.shoulder_overrun import ELLIPSE_CUT
from qsbearing.remarks.missing_effects import EFFECT_DATA_MISSING
from qsbearing.remarks.remark import Cases, Of, Remark, some_balls
from qsbearing.remarks.wording import Span
from qsbearing.reports.guide_lists import every_kind
from qsbearing.studies.chooser.explain import Assessment
from tests.qsbearing.source_text import PACKAGES, trees

TIMES = st.floats(-6.0, 8.0).map(lambda power: 10.0**power)
PARTS = st.floats(-16.0, 3.0).map(lambda power: 10.0**power)
"""Relative changes."""
UNITS = {"h": 3600.0, "min": 60.0, "s": 1.0, "ms": 1e-3, "µs": 1e-6}
POWER = re.compile(r"\de[-+]?\d")


@given(TIMES)
def test_a_time_keeps_two_digits_in_a_unit_that_suits_it(seconds: float) -> None:
    number, unit = duration(seconds).split()
    assert "e" not in number
    assert float(number) * UNITS[unit] == pytest.approx(seconds, rel=0.05)
    assert unit == "h" or float(number) < 100.0 * (1.0 + 1e-9)


@given(
    st.floats(-7.0, 8.9).map(lambda power: 10.0**power),
    st.sampled_from((".1g", ".2g", "+.3g", ",.4g", ".5g")),
    st.booleans(),
)
def test_plain_keeps_the_digits_without_a_power(size: float, spec: str, is_negative: bool) -> None:
    number = -size if is_negative else size
    text = plain(number, spec)
    assert "e" not in text
    assert float(text.replace(",", "")) == float(format(number, spec).replace(",", ""))
    assert text.startswith("+") == ("+" in spec and number > 0.0)


@given(PARTS)
def test_rounding_is_no_per_cent(part: float) -> None:
    for said in (percent(part), changed(part), estimated(part)):
        assert not POWER.search(said), said
        assert (said == "0 %") == (part < NOTHING)
        assert changed(part) == "> 100 %" or part <= 1.0


def row(first: float, last: float, quantity: str, is_assumed: bool) -> Assessment:
    of = lambda part: {"actual": dict.fromkeys(QUANTITIES, 0.0) | {quantity: part}, "displacement_um": 20.0 * part}  # noqa: E731
    assumed = [of(first), of(last)] if is_assumed else []
    own = {"actual": None, "displacement_um": None} if is_assumed else of(first)
    return Assessment(
        effect="elastic_rings", what="", in_scene=False, indicator=None, predicted=None, actual=own["actual"],
        time_with_over_without=None, verdict="", why="", add=[], assumed=assumed, alternatives=[], range={},
        displacement_um=own["displacement_um"],
    )  # fmt: skip


def ends(text: str) -> list[str]:
    """What a range reaches from and to."""
    return [re.sub(r" \([a-z ]+\)", "", each).removeprefix("≈ ").strip() for each in re.split(r"\s*\bto\b\s*", text)]


@given(PARTS, PARTS, st.sampled_from(QUANTITIES), st.booleans())
def test_a_change_that_explain_shows_is_a_number_or_a_range(
    first: float, last: float, quantity: str, is_assumed: bool
) -> None:
    text = row(first, last, quantity, is_assumed).change(quantity)
    assert not POWER.search(text), text
    assert len(set(ends(text))) == len(ends(text)) <= 2, text
    largest = max(first, last if is_assumed else 0.0)
    assert (text == "0") == (20.0 * largest < ATOM if quantity == "displacement" else largest < NOTHING)
    assert row(first, last, quantity, is_assumed).change_in(quantity).endswith(f" {unit_of(quantity)}")


@given(PARTS, PARTS, PARTS, st.sampled_from(QUANTITIES), st.booleans())
def test_a_sentence_on_what_is_missing_has_no_range_of_equal_ends(
    first: float, middle: float, last: float, quantity: str, is_estimated: bool
) -> None:
    """Of several rows or points a number is a span itself."""
    parts = Span((first, middle)), Span((last, last))
    by = {"displacements_um": tuple(Span(20.0 * each for each in part) for part in parts)}
    values = {"quantity": quantity, "under": ("steel housing", "free"), "is_estimated": is_estimated}
    values |= {"effect": "elastic_rings", "changes": parts} | (by if quantity == "displacement" else {})
    found = re.search(
        r"would change the [a-z ]+? by (.*?)\. To include", Remark(EFFECT_DATA_MISSING, Of(), values).text
    )
    assert found
    said = found[1]
    assert not POWER.search(said), said
    assert (
        "about 0 " not in said
        and "about >" not in said
        and "about ≈" not in said
        and "about more" not in said
        and ">" not in said
    )
    whole = re.split(r"(?<=\)) to ", said)
    assert len({re.sub(r" \(.*", "", each.removeprefix("about ")) for each in whole}) == len(whole), said
    for each in whole:
        assert len(set(ends(each))) == len(ends(each)), said


@given(TIMES)
def test_no_remark_has_a_power_of_ten(number: float) -> None:
    """Every kind whose sentence is a format string, its numbers all alike."""
    count = 0
    for kind in every_kind().values():
        if kind.say is None:
            fields = {name: spec for _, name, spec, _ in Formatter().parse(kind.sentence + kind.more) if name}
            values = {name: number if spec else "a word" for name, spec in fields.items()}
            text = Remark(kind, Of(raceways=("inner",), balls=some_balls([True, False])), values).text
            assert not POWER.search(text), text
            count += bool(kind.values)
    assert count > 20
    for name in ("beyond_percent", "load_loss_percent", "turn_deg"):
        cut = {"beyond_percent": 5.0, "load_loss_percent": 5.0, "turn_deg": 5.0} | {name: number}
        assert not POWER.search(Remark(ELLIPSE_CUT, Of(raceways=("inner",)), cut).text), name


@pytest.mark.parametrize(
    ("cases", "said"),
    [
        (Cases(3, 3, (0,)), "For all 3 cases: "),
        (Cases(2, 3, (1,)), "2 of 3 cases, the first 1: "),
        (Cases(1, 1, (0,)), "1 of 1 cases, the first 0: "),
        (Cases(3, 3, (0, 0), "bearings of the list"), "For all 3 bearings of the list: "),
        (Cases(2, 3, (0, 0), "bearings of the list"), "For 2 of 3 bearings of the list: "),
    ],
)
def test_cases_of_a_remark(cases: Cases, said: str) -> None:
    assert Remark(LIFE_OF_CERAMIC, Of(cases=cases)).text.startswith(said)


# The programs ---------------------------------------------------------------------------------------------------------


SHORT = r"\.[1-4]g"


def short_numbers(tree: ast.Module) -> Iterator[str]:
    """F-strings in which a number of few digits, which turns into a power of ten soon, has a per cent sign or a unit of
    time behind it."""
    for node in ast.walk(tree):
        for number, after in zip(node.values, node.values[1:], strict=False) if isinstance(node, ast.JoinedStr) else ():
            if isinstance(number, ast.FormattedValue) and isinstance(after, ast.Constant):
                spec = ast.unparse(number.format_spec) if number.format_spec else ""
                if re.search(SHORT + "'$", spec) and re.match(r" ?(%|µs|ms|s|min|h)(?![a-z])", str(after.value)):
                    yield ast.unparse(node)


def test_times_and_per_cents_go_through_one_place() -> None:
    seen = dict(trees(SHORT, *PACKAGES))
    found = {str(path): each for path, tree in seen.items() for each in short_numbers(tree)}
    assert len(seen) > 20 and found == {}


@pytest.mark.parametrize("code", ["f'{x:.2g} s'", "f'took {1e3 * x:.3g} ms, or'", "f'{100 * x:.2g} % of it'"])
def test_a_short_number_is_seen(code: str) -> None:
    assert re.search(SHORT, code) and list(short_numbers(ast.parse(code)))
    assert not list(short_numbers(ast.parse(code.replace(":.2g", ":.0f").replace(":.3g", ":.0f"))))
