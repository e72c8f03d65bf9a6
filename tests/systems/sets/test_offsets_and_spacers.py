"""Offsets and spacers beside a preload: what they add, what its share is of, and where the shaft's zero is."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.documents.model import Paragraph, RowGroup
from qsbearing.reports import set_inputs
from qsbearing.results.set_report import set_result
from qsbearing.systems.sets.preload_limits import preload_summary
from tests.documents.tables import rows_of
from tests.systems.sets.arrangements import rows, solved
from tests.systems.sets.test_axial_growth import HOUSING, REAR, STRAIN, UNLOADED, WARM, pressed
from tests.systems.sets.test_elastic_shaft import spindle

LONGER = 5 * qs.um
SPACER = qs.Spacer((1, 2), inner_length=10 * qs.mm, outer_length=10 * qs.mm + LONGER)


@pytest.mark.parametrize("kind", ["rigid", "mounted"])
@pytest.mark.parametrize("arrangement", ["DB", "DF", "TBT"])
def test_an_offset_adds_to_a_preload_that_is_a_force(kind: str, arrangement: str) -> None:
    """As it adds to the displacement that the same force takes."""
    fits = (qs.RingExpansion(50 * qs.mm, 90 * qs.mm, shaft_interference=4 * qs.um),)
    of = qs.BearingSet(rows(arrangement, ring_effects=fits), preload=qs.Preload(**{kind: 720.0}))
    alone = solved(of)
    held = tuple(float(row.displacement[0]) for row in alone.rows)
    by_force = solved(pressed(of, *[LONGER, 0.0, 0.0][: len(held)]))
    by_displacement = solved(pressed(replace(of, preload=None), held[0] + LONGER, *held[1:]))
    np.testing.assert_allclose(by_force.axial_loads, by_displacement.axial_loads, rtol=1e-8)
    assert by_force.axial_loads[-1] > 1.1 * alone.axial_loads[-1]
    np.testing.assert_allclose(by_force.preload_given, alone.preload_at_rest, rtol=1e-9)
    np.testing.assert_allclose(by_force.preload_share, by_force.axial_loads / by_force.preload_given, rtol=1e-8)


def test_an_offset_does_what_a_spacer_as_much_longer_does() -> None:
    """For a pair is free along the shaft."""
    of = qs.BearingSet(rows("DB"), preload=qs.Preload(rigid=720.0))
    by_spacer = solved(replace(of, spacers=(SPACER,)))
    assert by_spacer.axial_loads[0] > 800.0
    for offsets in ((LONGER, 0.0), (0.0, LONGER), (0.4 * LONGER, 0.6 * LONGER)):
        np.testing.assert_allclose(solved(pressed(of, *offsets)).axial_loads, by_spacer.axial_loads, rtol=1e-8)


def test_the_share_is_of_the_preload_that_is_given() -> None:
    of = qs.BearingSet(rows("DB"), preload=qs.Preload(rigid=50.0), spacers=(SPACER,))
    found = solved(of)
    np.testing.assert_allclose(found.preload_given, 50.0, rtol=1e-9)
    np.testing.assert_allclose(found.preload_share, found.preload_at_rest / 50.0, rtol=1e-9)
    assert found.preload_share[0] > 2.0
    assert any(
        "Offsets and spacers change the preload of the rows from 50 N to" in each for each in preload_summary(found)
    )
    longer = replace(SPACER, outer_length=SPACER.inner_length + 4.0 * LONGER)
    much = solved(replace(of, spacers=(longer,)))
    assert list(much.preload_state) == ["excessive", "excessive"]
    assert any("3 times the given preload of 50 N" in each for each in much.warnings())
    # lengths alone: what they make at rest is what is given
    for lengths in (replace(of, preload=None), replace(of, preload=qs.Preload(rigid=0.0))):
        alone = solved(lengths)
        np.testing.assert_allclose(alone.preload_share, 1.0, rtol=1e-9)
    assert "offsets or spacers" in preload_summary(solved(replace(of, preload=None)))[0]


def test_the_reference_position_does_not_shift_the_zero_of_a_set_with_spacers() -> None:
    """Its zero is the row that spacers leave in its place, wherever loads act. (A preload that is a force moves it a
    little: rows are pressed further by what the shaft gives way, which counts from the reference.)"""
    held = qs.Preload(axial_displacement=20 * qs.um)
    of = replace(spindle(UNLOADED, preload=held), spacers=(SPACER,), floating=(REAR,))
    ends = [solved(replace(of, reference_position=at)) for at in (0.0, 0.00999, 0.01, 0.02, 0.1)]
    tools = [each.points["tool"].displacement[0] for each in ends]
    np.testing.assert_allclose(tools, tools[0], rtol=1e-7)
    # Row 1 stays, as if a face of row 2 were ground off.
    ground = solved(pressed(replace(of, spacers=()), 0.0, LONGER, 0.0, 0.0))
    assert tools[0] == pytest.approx(ground.points["tool"].displacement[0], rel=1e-6)


def test_the_zero_is_the_first_row_in_plus_x_that_does_not_float() -> None:
    def datum(of: qs.BearingSet) -> int:
        return of.axial_datum

    of = spindle(UNLOADED)
    assert datum(of) == 0
    assert datum(replace(of, floating=(qs.FloatingGroup((1, 2)),))) == 2
    turned = replace(of, rows=tuple(replace(row, carries="-x") for row in of.rows), preload=None)  # type: ignore[arg-type]
    assert datum(turned) == 0
    assert datum(replace(of, rows=of.rows[::-1], floating=(qs.FloatingGroup((1, 2)),))) == 3


def test_outputs_name_the_row_that_spacers_leave_in_its_place() -> None:
    of = replace(spindle(UNLOADED), floating=(qs.FloatingGroup((1, 2)),))
    for each, said in ((of, False), (replace(of, spacers=(SPACER,)), True)):
        solution = solved(each)
        heading = set_result(solution, [{}, {}, {}, {}])[0]
        assert isinstance(heading, Paragraph)
        assert ("row 3 is the axial datum of spacers" in heading.text) is said
        rows = rows_of(set_inputs.section(each, "").blocks)
        lines = [row for row in rows if not isinstance(row, RowGroup) and row[0] == "axial_datum_row"]
        assert [line[1] for line in lines] == (["3"] if said else [])


def test_growth_of_the_shaft_to_a_point_is_a_result_of_its_own(tmp_path: Any) -> None:
    from qsbearing.results.set_record import set_record
    from qsbearing.studies.results import known_results, read

    of = replace(spindle(replace(UNLOADED, temperature=WARM)), housing=HOUSING, spacers=(SPACER,))
    found = solved(of)
    at = -0.07 - float(of.reference)
    assert found.points["tool"].axial_growth == pytest.approx(STRAIN * at, rel=1e-12)
    many = solved(replace(of, shaft=replace(UNLOADED, temperature=np.array([WARM, WARM + 25.0]))))
    np.testing.assert_allclose(many.points["tool"].axial_growth, [STRAIN * at, 2.0 * STRAIN * at], rtol=1e-12)
    record = set_record(found, [{}, {}, {}, {}])
    json.dumps(record)
    assert record["axial_datum_row"] == 1
    assert record["shaft"]["points"]["tool"]["axial_growth_um"] == pytest.approx(STRAIN * at * 1e6, rel=1e-12)
    line = {each["at"]: each["axial_growth_um"] for each in record["shaft"]["line"]}
    assert line["tool"] == pytest.approx(STRAIN * at * 1e6, rel=1e-12)
    growth = known_results(found)["tool_axial_growth"]
    assert read(found, [growth])["tool_axial_growth"] == pytest.approx(STRAIN * at * 1e6, rel=1e-12)
    cold = solved(spindle(UNLOADED))
    assert cold.points["tool"].axial_growth is None
    record = set_record(cold, [{}, {}, {}, {}])
    assert record["axial_datum_row"] is None
    assert record["shaft"]["points"]["tool"]["axial_growth_um"] is None
    assert "tool_axial_growth" not in known_results(cold)
