"""A spindle of ours as a rotor of ROSS: statically the same shaft on the same rows, and a rotor that whirls."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from tests.systems.rotor_dynamics.rotor_program import load
from tests.systems.sets.test_elastic_shaft import SHAFT, bare, spindle

ross = load()
ORDER = [2, 0, 1, 3, 4]
"""Of our channels among ROSS's x, y, z, alpha, beta."""


def node(rotor: object, position: float) -> int:
    """Of a position of ours."""
    return int(np.abs(np.asarray(rotor.nodes_pos) + SHAFT.start - position).argmin())  # type: ignore[attr-defined]


def static(rotor: object, loads: dict[int, np.ndarray]) -> np.ndarray:
    """Displacements of all nodes in our order under loads of nodes in our order, torsion held; by ROSS's matrices."""
    stiffness = np.asarray(rotor.K(0.0))  # type: ignore[attr-defined]
    free = [i for i in range(stiffness.shape[0]) if i % 6 != 5]
    force = np.zeros(stiffness.shape[0])
    for at, load_there in loads.items():
        force[[6 * at + k for k in ORDER]] = load_there
    moved = np.zeros_like(force)
    moved[free] = np.linalg.solve(stiffness[np.ix_(free, free)], force[free])
    return moved.reshape(-1, 6)[:, ORDER]


def test_a_shaft_on_linear_springs_bends_as_in_ross() -> None:
    springs = {"axial": 1e8, "radial_y": 1e8, "radial_z": 6e7}
    supports = (qs.ShaftSupport(0.0, **springs), qs.ShaftSupport(0.15, **springs, tilt_z=1e5))
    tool = qs.ShaftLoad(-0.07, axial=-2.0, radial_y=4.0, radial_z=-1.5, moment_y=0.03, moment_z=0.05)
    found = bare(replace(SHAFT, supports=supports, loads=(tool,)))
    rotor = found.to_ross_rotor()
    moved = static(rotor, {node(rotor, -0.07): np.array(tool.values, float)})
    at = np.asarray(rotor.nodes_pos) + SHAFT.start
    own = found.deflection(at)
    sizes = np.abs(own).max(axis=0)
    assert np.abs((moved - own) / sizes).max() < 1e-6


def test_a_cone_and_a_mass_are_those_of_ross() -> None:
    springs = {"axial": 1e8, "radial_y": 1e8, "radial_z": 6e7}
    supports = (qs.ShaftSupport(0.0, **springs), qs.ShaftSupport(0.15, **springs))
    first, *others = SHAFT.sections
    tool, mass = qs.ShaftLoad(-0.07, axial=-2.0, radial_y=4.0), qs.ShaftMass(0.1, 2.0, 0.002, 0.001)
    sections = (replace(first, outer_diameter=0.03, end_outer_diameter=0.06, end_inner_diameter=0.03), *others)
    found = bare(replace(SHAFT, sections=sections, supports=supports, loads=(tool,), masses=(mass,)))
    away = []
    for longest in (0.4, 0.2):
        rotor = found.to_ross_rotor(longest=longest)
        moved = static(rotor, {node(rotor, -0.07): np.array(tool.values, float)})[0, :2]
        away.append(np.abs(moved / found.deflection(SHAFT.start)[0, :2] - 1.0).max())
    assert away[1] < 1e-3 and away[1] < 0.5 * away[0]
    without = bare(replace(SHAFT, sections=sections, supports=supports)).to_ross_rotor()
    assert rotor.m - without.m == pytest.approx(2.0, rel=1e-3)  # ROSS's mass of a cone depends on its elements
    assert [(disk.m, disk.Ip, disk.Id) for disk in rotor.disk_elements] == [(2.0, 0.002, 0.001)]


def test_the_compliance_at_the_tool_is_that_of_the_rotor() -> None:
    """Rows on their tangents, in elastic housings, at speed."""
    housing = qs.HousingStiffness(axial=4e8, radial=6e8, tilt=5e5)
    found = qs.solve_set(spindle(SHAFT, housing=housing, speed=12_000 * qs.rpm))
    rotor = found.to_ross_rotor()
    tool = node(rotor, -0.07)
    compliance = np.stack([static(rotor, {tool: unit})[tool] for unit in np.eye(5)], axis=1)
    own = found.points["tool"].compliance
    sizes = np.sqrt(np.outer(*2 * [np.abs(np.diagonal(own))]))
    assert np.abs((compliance - own) / sizes).max() < 1e-6


def test_a_spindle_over_the_speed_whirls() -> None:
    speeds = np.linspace(0.0, 20_000.0, 5) * qs.rpm
    of = spindle(SHAFT, speed=12_000 * qs.rpm)
    found = qs.solve_set(replace(of, operation=replace(of.operation, speed=speeds)))
    rotor = found.to_ross_rotor(disks=[{"position": -0.08, "m": 1.0, "Id": 0.0004, "Ip": 0.0007}])
    modal = rotor.run_modal(speeds[2], num_modes=12)
    heavier = found.to_ross_rotor(disks=[{"position": -0.08, "m": 4.0, "Id": 0.0004, "Ip": 0.0007}])
    assert 0.0 < heavier.run_modal(speeds[2], num_modes=12).wn[0] < modal.wn[0]


def test_what_makes_no_rotor_is_refused() -> None:
    with pytest.raises(qs.SceneError, match="sections"):
        qs.solve_set(spindle(None)).to_ross_rotor()
    with pytest.raises(qs.SceneError, match="not on the shaft"):
        qs.solve_set(spindle(SHAFT)).to_ross_rotor(disks=[{"position": 3.0, "m": 1.0, "Id": 0.1, "Ip": 0.1}])
