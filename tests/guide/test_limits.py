"""What the page of limits says of inner control, beside the solves that it states."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.effects import MomentShares
from qsbearing.model.effects.raceway_control import HYPOTHESES, RacewayControl
from tests.guide.pages import GUIDE

SPEEDS = np.arange(1000.0, 15_001.0, 1000.0) * qs.rpm
THRUSTS = np.array([1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 17.8, 25.0]) * qs.kN
ROW = re.compile(r"^\| ([\d.]+) \| (\d+) % \| (\d+) % \| (\d+) % \|$", flags=re.MULTILINE)
ROWS = [tuple(map(float, found)) for found in ROW.findall((GUIDE / "limits.md").read_text(encoding="utf-8"))]
OTHERS = [control for control in HYPOTHESES if control is not RacewayControl.INNER]


def refused(ratio: float, control: RacewayControl, shares: MomentShares) -> float:
    """The part of the page's grid that has no solution, in whole per cent."""
    side = {"radial_load_y": ratio * THRUSTS, "moment_y": 0.0, "moment_z": 0.0} if ratio else {}
    operation = qs.Operation(speed=SPEEDS[:, None], axial_load=THRUSTS, **side)
    effects = (qs.CentrifugalForce(), qs.GyroscopicMoment(shares))
    scene = replace(qs.load_scene("b218"), operation=operation, ball_effects=effects, raceway_control=control)
    return float(np.round(100.0 * np.mean(~np.asarray(qs.solve(scene).converged))))


@pytest.mark.parametrize("row", ROWS, ids=[str(row[0]) for row in ROWS])
def test_how_often_inner_control_has_no_solution(row: tuple[float, ...]) -> None:
    """Up to one case of 120."""
    ratio, all_inner, half, others = row
    assert SPEEDS.size * THRUSTS.size == 120
    assert refused(ratio, RacewayControl.INNER, MomentShares.CONTROLLING) == pytest.approx(all_inner, abs=1.0)
    assert refused(ratio, RacewayControl.INNER, MomentShares.HARRIS) == pytest.approx(half, abs=1.0)
    found = max(refused(ratio, *each) for each in product(OTHERS, MomentShares))
    assert found == pytest.approx(others, abs=1.0)


def test_the_page_has_the_table() -> None:
    assert [row[0] for row in ROWS] == [0.0, 0.3, 0.5, 1.0]


OUTER_RING = re.compile(r"^\| ([\d,]+) \| ([\d,]+) \| ([\d,]+) \| ([\d,]+) \|$", flags=re.MULTILINE)


def test_what_the_outer_ring_takes_and_how_far_balls_run_ahead() -> None:
    page = (GUIDE / "limits.md").read_text(encoding="utf-8")
    rows = np.array([[float(cell.replace(",", "")) for cell in row] for row in OUTER_RING.findall(page)])
    speed, axial, radial, expected = rows.T
    assert speed.size == 5
    operation = qs.Operation(speed=speed * qs.rpm, axial_load=axial, radial_load_y=radial, tilt_y=0.0, tilt_z=0.0)
    found = qs.readings.ball_advance(qs.solve(replace(qs.load_scene("b218"), operation=operation)))
    assert found.outer_radial_load == pytest.approx(expected, abs=1.0)
    excursions = re.search(r"rows have ([\d.]+), ([\d.]+) and ([\d.]+) mm here", page)
    assert excursions is not None
    assert found.excursion[2:] / qs.mm == pytest.approx([float(each) for each in excursions.groups()], abs=0.05)
