"""Modes by what moves in them, against a disk whose frequencies have closed forms and against ROSS; critical speeds."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.linalg import eig
from scipy.optimize import brentq

import qsbearing as qs
from qsbearing.pictures.campbell import campbell
from qsbearing.systems.rotor_dynamics.natural_frequencies import NaturalFrequencies, natural_frequencies
from tests.systems.rotor_dynamics.rotor_program import load
from tests.systems.sets.test_elastic_shaft import SHAFT, spindle

MASS, POLAR, DIAMETRAL = 3.0, 0.02, 0.012
SPRINGS = np.array([4e7, 4e7, 6e7, 3e4, 3e4, 7e4])
"""Of the six coordinates of a node of ROSS, the last against torsion."""


class Disk:
    """A rigid disk on springs, in the coordinates of ROSS: its tilts are coupled by its rotation alone."""

    def M(self) -> np.ndarray:
        return np.diag([MASS, MASS, MASS, DIAMETRAL, DIAMETRAL, POLAR])

    def run_modal(self, speed: float, num_modes: int) -> Any:
        """As ROSS: eigenvalues of positive frequency, the lowest first; here all of them."""
        gyroscopic = np.zeros((6, 6))
        gyroscopic[3, 4], gyroscopic[4, 3] = POLAR * speed, -POLAR * speed
        zero, one = np.zeros((6, 6)), np.eye(6)
        inverse = np.linalg.inv(self.M())
        values, vectors = eig(np.block([[zero, one], [-inverse @ np.diag(SPRINGS), -inverse @ gyroscopic]]))
        chosen = [i for i in np.argsort(values.imag) if values[i].imag > 0.0]
        return SimpleNamespace(wd=values.imag[chosen], evectors=vectors[:, chosen])


def test_a_disk_whirls_as_its_closed_form_says() -> None:
    """Tilts: w^2 Id -+ w Ip n - k = 0 of the whirl with and against the rotation."""
    speeds = np.array([200.0, 900.0, 2500.0])
    found = natural_frequencies(Disk(), speeds)
    half = 0.5 * POLAR * speeds / DIAMETRAL
    root = np.hypot(half, np.sqrt(SPRINGS[3] / DIAMETRAL))
    across = np.sqrt(SPRINGS[0] / MASS)
    for kind, tilts in (("forward", half + root), ("backward", root - half)):
        own = getattr(found, kind)
        for number, tilt in enumerate(tilts):
            near = np.abs(own[number] - tilt)
            assert np.nanmin(near) < 1e-6 * tilt
    assert np.allclose(found.axial[:, 0], np.sqrt(SPRINGS[2] / MASS))
    every = np.concatenate([found.forward.ravel(), found.backward.ravel()])
    assert np.sum(np.isclose(every, across)) == 2 * speeds.size, "both directions of a whirl without rotation"


def test_a_critical_speed_is_where_a_forward_whirl_meets_the_speed() -> None:
    speeds = np.linspace(0.0, 1000.0, 11)
    forward = np.stack([500.0 + 0.2 * speeds, 1500.0 + speeds], axis=-1)
    found = NaturalFrequencies(speeds, forward, forward - 300.0, forward[:, :1])
    assert found.critical_speeds == pytest.approx([625.0])
    assert found._replace(forward=forward + 600.0).critical_speeds.size == 0


def test_modes_are_those_of_the_rotor_program() -> None:
    """Where it is sure of a direction it is the same; its frequencies are all there."""
    load()
    speeds = np.linspace(500.0, 20_000.0, 6) * qs.rpm
    of = spindle(SHAFT, speed=12_000 * qs.rpm)
    solution = qs.solve_set(replace(of, operation=replace(of.operation, speed=speeds)))
    rotor = solution.to_ross_rotor(disks=[{"position": -0.08, "m": 30.0, "Id": 0.05, "Ip": 0.03}])
    found = natural_frequencies(rotor, speeds)
    seen = 0
    for number, speed in enumerate(speeds):
        modal = rotor.run_modal(float(speed), num_modes=12)
        for frequency, way in zip(modal.wd, modal.whirl_direction(), strict=True):
            if way in ("Forward", "Backward"):
                own = getattr(found, str(way).lower())[number]
                assert np.nanmin(np.abs(own - frequency)) < 1e-6 * frequency
                seen += 1
    assert seen > 10

    def away(speed: float) -> float:
        return float(natural_frequencies(rotor, np.array([speed])).forward[0, 0]) - speed

    (critical, *_) = found.critical_speeds
    assert critical == pytest.approx(brentq(away, speeds[0], speeds[-1], xtol=0.1), rel=5e-3)


def test_a_campbell_diagram_is_refused_in_a_sentence() -> None:
    still = qs.solve_set(spindle(SHAFT))
    assert float(np.asarray(still.set.operation.speed)) == 0.0
    with pytest.raises(ValueError, match="stands still"):
        campbell(still)
    of = spindle(SHAFT, speed=12_000 * qs.rpm)
    several = qs.solve_set(replace(of, operation=replace(of.operation, speed=np.array([800.0, 900.0]))))
    with pytest.raises(ValueError, match="single case"):
        campbell(several)
