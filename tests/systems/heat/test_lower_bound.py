"""Verdicts that rest on the friction of the contacts alone, and the same with the friction of the whole bearing."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import qsbearing as qs
from qsbearing.cli.heat import _show
from qsbearing.files.scene_tables import input_tables
from qsbearing.readings import static_load_rating
from qsbearing.results.thermal_report import whole_bearing_record
from qsbearing.systems.heat.state import NetworkPart, WholeBearing
from qsbearing.systems.heat.whole_bearing import with_whole_friction
from tests.systems.heat.spindle import BEARING, EFFECTS, pair, scene, tables
from tests.systems.heat.test_heating_up import run

BOUND = 'with the friction model "contacts", a lower bound of the heat'
WARM = tables()["thermal"] | {"limit_temperature_C": 60.0}
"""A low limit: curves end early."""


def by_palmgren(of: qs.Scene, **estimate: Any) -> qs.Scene:
    """Written out by hand."""
    own = {"bore_diameter": 35 * qs.mm, "outside_diameter": 62 * qs.mm, "lubrication_factor": 2.0} | estimate
    own.setdefault("static_load_rating", float(static_load_rating(of.bearing)))
    readings = {"friction_estimate": own, "lubricant": {"iso_viscosity_grade": 32}}
    thermal = replace(of.thermal, friction="palmgren", viscosity_at="outer_ring")  # type: ignore[type-var]
    return replace(of, readings=readings, thermal=thermal)


def test_a_verdict_from_a_lower_bound_says_so_in_its_sentence() -> None:
    of = scene(thermal=WARM, operation={"speed_rpm": 4000})
    for each, said in ((of, True), (by_palmgren(of), False)):
        state = qs.solve(each).thermal
        assert state is not None and (BOUND in state.message().split(". ")[0]) is said


def test_heat_shows_both(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With what the file gives; what is assumed for the rest is said. Beyond the limit of either, so that both follow
    their curves."""
    of = scene(thermal=WARM, operation={"speed_rpm": 14_000})
    state = qs.solve(by_palmgren(of)).thermal
    assert state is not None and state.speeds.at_limit is not None
    text = run(tmp_path, input_tables(of), "--json").stdout
    shown = json.loads(text, object_pairs_hook=lambda pairs: {NetworkPart(key): value for key, value in pairs})
    assert BOUND in shown["message"] and BOUND in shown["speeds"]["message"]
    found = shown["whole_bearing"]
    assert found["at_limit"]["speed_rpm"] == pytest.approx(state.speeds.at_limit.factor * 14_000, rel=1e-9)
    assert found["at_limit"]["speed_rpm"] < 0.8 * shown["speeds"]["at_limit"]["speed_rpm"]
    assert found["message"].startswith(
        "With Palmgren's friction of the whole bearing (assumed: f0 = 2 (oil bath), C0 = "
    )
    assert found["message"].endswith("before any runaway.")
    _show(shown)
    said = capsys.readouterr().out
    assert "Likewise, with Palmgren's friction of the whole bearing" in said and "assumed: f0 = 2" in said


def test_what_the_file_gives_is_not_assumed() -> None:
    of = scene()
    estimate = {"friction_estimate": {"static_load_rating": 9000.0, "lubrication_factor": 4.0}}
    given = {"lubricant": {"iso_viscosity_grade": 68}} | estimate
    whole, assumed = with_whole_friction(replace(of, readings={**of.readings, **given}))
    assert assumed == ["viscosity at the temperature of the outer ring"]
    assert whole.readings["friction_estimate"]["lubrication_factor"] == 4.0
    assert whole.readings["lubricant"] == given["lubricant"]


def test_where_nothing_is_assumed_nothing_is_said_of_it() -> None:
    state = qs.solve(scene()).thermal
    assert state is not None
    own = replace(state, with_whole_friction=lambda: WholeBearing(state, [], ()))
    found = whole_bearing_record(own)
    assert found is not None and found["message"].startswith("With Palmgren's friction of the whole bearing: ")


def test_what_the_whole_bearing_lacks_is_said() -> None:
    bare = {key: value for key, value in BEARING.items() if key not in ("bore_diameter_mm", "outside_diameter_mm")}
    effects = {key: value for key, value in EFFECTS.items() if key != "ring_expansion"}
    state = qs.solve(scene(bearing=bare, effects=effects)).thermal
    assert state is not None
    found = whole_bearing_record(state)
    assert found is not None
    assert found["states"] == []
    assert "not computed" in found["message"] and "bore_diameter_mm" in found["message"]


def test_each_row_of_a_set_has_its_own_numbers() -> None:
    own = pair()
    contacts = {"friction": {"friction_coefficient": 0.06}}
    rows = (own.rows[0], replace(own.rows[1], readings={**contacts, "lubricant": {"iso_viscosity_grade": 100}}))
    thermal = replace(own.thermal, friction="contacts")  # type: ignore[type-var]
    whole, assumed = with_whole_friction(replace(own, rows=rows, readings=contacts, thermal=thermal))
    grades = [row.readings["lubricant"]["iso_viscosity_grade"] for row in whole.rows]
    assert grades == [32, 100] and "ISO VG 32" in assumed
    assert whole.thermal.friction == "palmgren"
