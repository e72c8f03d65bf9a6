"""What of a set's shaft becomes part of a rotor, without ROSS: masses with their inertias, sections, holders."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.systems.rotor_dynamics import ross_rotor
from qsbearing.systems.sets import rotor
from qsbearing.systems.sets.row import Direction

B218 = qs.load_scene("b218").bearing


def test_a_disk_has_its_own_two_inertias(monkeypatch: pytest.MonkeyPatch) -> None:
    given: dict[str, Any] = {}

    def taken(sections: Any, holders: Any, speed: Any, places: Any, disks: Any, longest: float) -> str:
        given.update(sections=sections, holders=holders, speed=speed, places=places, disks=disks, longest=longest)
        return "the rotor"

    monkeypatch.setattr(ross_rotor, "rotor", taken)
    sections = (qs.ShaftSection(0.2, 0.09, 0.03, end_outer_diameter=0.08), qs.ShaftSection(0.1, 0.07))
    shaft = qs.Shaft(
        sections, -0.05, (qs.ShaftLoad(0.21, radial_y=1.0),), (qs.ShaftSupport(0.24, radial_y=3e7),), {"tool": -0.04},
        masses=(qs.ShaftMass(0.22, 4.0, 0.03, 0.017), qs.ShaftMass(0.0, 2.0, 0.005)),
    )  # fmt: skip
    rows = (qs.Row(B218, 0.01), qs.Row(B218, 0.13, Direction.MINUS))
    of = qs.BearingSet(rows, qs.Operation(speed=100.0, axial_load=100.0), shaft=shaft)
    held = np.stack([np.eye(5), 2.0 * np.eye(5)])
    extra = {"position": 0.1, "m": 1.0, "Ip": 0.2, "Id": 0.1}
    assert rotor.rotor(of, held, [extra], 0.4) == "the rotor"
    assert given["disks"] == [
        {"position": 0.22, "m": 4.0, "Ip": 0.03, "Id": 0.017}, {"position": 0.0, "m": 2.0, "Ip": 0.005, "Id": 0.0},
        extra,
    ]  # fmt: skip
    assert [(each.begin, each.end, each.outer_diameters, each.inner_diameters) for each in given["sections"]] == [
        (-0.05, pytest.approx(0.15), (0.09, 0.08), (0.03, 0.03)),
        (pytest.approx(0.15), pytest.approx(0.25), (0.07, 0.07), (0.0, 0.0)),
    ]
    assert [(each.position, each.stiffness[1, 1], each.name) for each in given["holders"]] == [
        (0.01, 1.0, "row 1"), (0.13, 2.0, "row 2"), (0.24, 3e7, "support 1"),
    ]  # fmt: skip
    assert (given["places"], given["longest"], float(given["speed"])) == ([-0.04, 0.21], 0.4, 100.0)
