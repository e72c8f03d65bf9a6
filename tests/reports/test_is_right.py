"""Page 1's answer whether the model is right: its colours go by the size of what is missing, whatever the reason."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qsbearing.documents.model import Badge, Table
from qsbearing.model.effects import EFFECTS, QUANTITIES
from qsbearing.reports.effects import is_right
from qsbearing.studies.chooser.explain import DATA_MISSING, NEEDED, Assessment

LACKING = [entry.name for entry in EFFECTS if entry.needs]


def row(effect: str, size: float, verdict: str, quantity: str) -> Assessment:
    """Of an effect that is missing, which changes one quantity."""
    of = {"actual": dict.fromkeys(QUANTITIES, 0.0) | {quantity: size}, "displacement_um": 20.0 * size}
    is_assumed = verdict == DATA_MISSING
    return Assessment(
        effect=effect, what=effect, in_scene=False, indicator=None, predicted=None,
        actual=None if is_assumed else of["actual"], time_with_over_without=None, verdict=verdict, why="",
        add=["x = 1"], assumed=[of | {"under": "", "what": ""}] if is_assumed else [], alternatives=[], range={},
        displacement_um=None if is_assumed else of["displacement_um"],
    )  # fmt: skip


@given(
    st.lists(
        st.tuples(st.floats(0.011, 2.0), st.sampled_from((NEEDED, DATA_MISSING)), st.sampled_from(QUANTITIES)),
        min_size=1, max_size=len(LACKING),
    )
)  # fmt: skip
def test_colours_go_by_size_and_the_largest_comes_first(found: list[tuple[float, str, str]]) -> None:
    rows = [row(effect, *each) for effect, each in zip(LACKING, found, strict=False)]
    table, _ = is_right(rows, 0.01)
    assert isinstance(table, Table)
    sizes = {each.effect: size for each, (size, *_) in zip(rows, found, strict=True)}
    shown = [sizes[str(line[0])] for line in table.rows]
    assert shown == sorted(shown, reverse=True)
    for line, size in zip(table.rows, shown, strict=True):
        assert isinstance(line[1], Badge) and line[1].kind == ("fail" if size > 0.05 else "finding")


@pytest.mark.parametrize("verdict", [NEEDED, DATA_MISSING])
def test_a_displacement_is_told_in_its_unit(verdict: str) -> None:
    table, _ = is_right([row(LACKING[0], 0.3, verdict, "displacement")], 0.01)
    assert table.rows[0][2].removeprefix("≈ ") == "6 µm of the displacement"
    table, _ = is_right([row(LACKING[0], 0.3, verdict, "load")], 0.01)
    assert table.rows[0][2].removeprefix("≈ ") == "30 % of the contact loads"
