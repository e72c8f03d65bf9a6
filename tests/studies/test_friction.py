"""Balls that friction moves, through the doors of studies: sweep, find, explain, heat."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.model.effects.raceway_control import HYPOTHESES
from qsbearing.studies.chooser.explain import explain
from tests.files.test_traction import tables

pytest.importorskip("xarray")


def of_control(rows: Any) -> Any:
    return next(each for each in rows if each.effect == "raceway_control")


def test_a_sweep_from_rest_over_the_coefficient(tmp_path: Path) -> None:
    vary = {"operation.speed_rpm": [0.0, 10_000.0], "effects.traction.friction_coefficient": [0.03, 0.07, 0.1]}
    names = ["cage_speed_rpm", "traction_heat", "inner_traction_heat_max", "ring_displacement_axial", "skid_margin"]
    study = qs.Study.of(tables({"friction_coefficient": 0.05}), vary, quantities=names)
    data = qs.sweep(study, out=tmp_path / "a.nc")
    assert (data["status"] == 0).all()
    one = qs.solve(scene_of(tables({"friction_coefficient": 0.1}), "a file"))
    assert one.friction is not None
    last = data.isel(speed_rpm=1, traction_friction_coefficient=2)
    assert float(last["traction_cage_speed"]) == pytest.approx(float(one.friction.cage_speed / qs.rpm))
    assert float(last["traction_heat"]) == pytest.approx(float(one.friction.heat))
    assert float(last["ring_displacement_axial"]) == pytest.approx(one.displacement[0] / qs.um)
    every = qs.sweep(replace(study, quantities=()), out=tmp_path / "every.nc")
    assert {"traction_heat", "inner_traction_friction_use", "traction_attitude_angle"} <= set(every)
    many = qs.solve(scene_of(tables({"friction_coefficient": 0.07}), "a file"))
    assert float(many.to_xarray()["traction_friction_coefficient"]) == 0.07
    still = data.isel(speed_rpm=0)
    assert np.isnan(still["traction_cage_speed"]).all()
    assert np.ptp(still["ring_displacement_axial"].values) == 0.0


def test_explain_says_what_friction_gives_beside_the_hypotheses() -> None:
    row = of_control(explain(qs.load_scene("b218"), 0.01)[1])
    span = row.by_friction
    assert span["friction_range"] == [0.03, 0.1] and 'raceway_control = "friction"' in row.why
    ends = [
        qs.solve(scene_of(tables({"friction_coefficient": mu}), "a file")).displacement[0] / qs.um for mu in (0.1, 0.03)
    ]
    assert span["displacement"]["axial_um"] == pytest.approx(ends, rel=1e-9)
    hypotheses = {str(each["under"]).split('"')[1] for each in row.alternatives}
    assert hypotheses <= set(map(str, HYPOTHESES)), "friction is none of them"
    moved = of_control(explain(scene_of(tables({"friction_range": [0.05, 0.07]}), "a file"), 0.01)[1])
    assert moved.by_friction["friction_range"] == [0.05, 0.07]
    assert "friction is solved for" in moved.why and "hypothesis" not in moved.why
    assert {str(each["under"]).split('"')[1] for each in moved.alternatives} == set(map(str, HYPOTHESES))
    of_moved = explain(scene_of(tables({}), "a file"), 0.01)[1]
    (slip,) = (each for each in of_moved if each.effect == "gyroscopic_slip")
    assert slip.why == "does not apply here" and not slip.needs, "its key is refused beside friction"
    actual = replace(qs.load_scene("b218"), hertz_angle="actual")
    assert "not told by friction: hertz_angle" in of_control(explain(actual, 0.01)[1]).why


def test_a_limit_on_a_margin_is_met() -> None:
    wanted = {
        "vary": {"speed_rpm": "1000:12000"},
        "limits": ["gyroscopic_margin>=2"],
        "maximise": "traction_cage_speed",
    }
    answer = qs.find(tables({"friction_coefficient": 0.07}), points=64, **wanted)
    assert answer.is_feasible
    (speed,) = answer.values.values()
    margins = []
    for each in (0.98, 1.02):
        document = tables({"friction_coefficient": 0.07}, speed=speed * each)
        one = qs.solve(scene_of(document, "a file"))
        assert one.friction is not None
        margins.append(float(one.friction.least_gyroscopic_margin))
    assert margins[0] > 2.0 > margins[1]


def test_heat_of_a_bearing_is_that_of_the_balance() -> None:
    thermal = {
        "friction": "contacts", "fixed": {"ambient_C": 20.0},
        "conductances": [{"between": [ring, "ambient"], "W_per_K": 100.0} for ring in ("inner_ring", "outer_ring")],
    }  # fmt: skip
    readings = {"friction": {"friction_coefficient": 0.07}}
    document = tables({"friction_coefficient": 0.07}) | {"thermal": thermal, "readings": readings}
    solution = qs.solve(scene_of(document, "a file"))
    assert solution.friction is not None and solution.thermal is not None
    inner, outer = solution.friction.inner.heat.sum(), solution.friction.outer.heat.sum()
    found = solution.thermal.temperatures
    assert found["inner_ring"] - 293.15 == pytest.approx(inner / 100.0, rel=1e-9)
    assert found["outer_ring"] - 293.15 == pytest.approx(outer / 100.0, rel=1e-9)
