"""Motion of the balls and stresses below contacts, as `solution_parts` judges them: by vectors and by integrals."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

import qsbearing as qs
from fem_check.checks.product_scenes import B218, BOTH
from fem_check.independent import orthogonal_shear, references
from fem_check.rows.agreement import AgreementRow
from fem_check.rows.compared import compared
from qsbearing.readings import kinematics, stress

SPEED = 8000.0 * qs.rpm
LOADS = qs.Operation(speed=SPEED, axial_load=12e3, radial_load_y=1.5e3, radial_load_z=-1e3, moment_y=0.0, moment_z=0.0)
INTERPOLATED = 1e-5
"""Of the largest shear, and of its depth: read from a table of ellipses."""


def motion_of(case: str, solution: qs.Solution) -> Iterator[AgreementRow]:
    """The balls' axis and spin, by vectors from the reported rotation."""
    motion, source = kinematics(solution), "vectors, from the reported rotation"
    operation = solution.scene.operation
    along, outward, size, orbit = (
        np.asarray(getattr(solution, name), float)
        for name in ("axial_rotation", "radial_rotation", "rotation_speed", "orbital_speed")
    )
    rotation = np.stack([along, -outward])
    axis = np.arctan2(-rotation[1] / size, rotation[0] / size)
    yield compared(case, "attitude angle", "rad", solution.attitude_angle, axis, source)
    turning = float(np.asarray(operation.speed)), float(np.asarray(operation.outer_speed or 0.0))
    for race, contacts, ring in (("inner", solution.inner, turning[0]), ("outer", solution.outer, turning[1])):
        normal = np.stack([np.sin(contacts.angle), np.cos(contacts.angle)])
        spin = (rotation * normal).sum(axis=0) - (ring - orbit) * normal[0]
        scale = np.abs(rotation).max()  # the controlling raceway has none
        told = np.append(getattr(motion, race).spin_speed, scale)
        yield compared(case, f"{race} spin and the largest rotation", "rad/s", told, np.append(spin, scale), source)


def motion_rows() -> Iterator[AgreementRow]:
    """Of B218; slip from what is asked and what is allowed."""
    yield from motion_of("B218, 8000 rpm, combined loads", qs.solve(qs.Scene(B218, LOADS, **BOTH)))
    friction = 0.03
    effects = (qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=friction))
    bound = qs.solve(qs.Scene(B218, replace(LOADS, speed=6000.0 * qs.rpm), **BOTH | {"ball_effects": effects}))
    required = np.max([np.asarray(each.required_friction, float) for each in (bound.inner, bound.outer)], axis=0)
    slipping = np.asarray(bound.slips, bool)
    yield compared(
        "B218, mu = 0.03", "balls that slip, and all", "1", [np.sum(slipping), len(required)],
        [np.sum(required > friction * (1.0 + 1e-9)), len(required)], "friction asked for above the coefficient",
    )  # fmt: skip


def stress_of(case: str, solution: qs.Solution) -> Iterator[AgreementRow]:
    """Shear below the most heavily loaded contacts: the orthogonal one, and the largest in the ring."""
    told, poisson = stress(solution), float(np.asarray(solution.scene.bearing.ring_material.poisson_ratio))
    for race in ("inner", "outer"):
        contacts, of = getattr(solution, race), getattr(told, race)
        ball = int(np.argmax(contacts.load))
        a, b, p0 = (
            float(getattr(contacts, name)[ball]) for name in ("semi_major_axis", "semi_minor_axis", "max_pressure")
        )
        over_p0, depth = orthogonal_shear.amplitude(a / b)
        at, source = f"{case} {race}", "Boussinesq's stresses integrated"
        yield compared(at, "orthogonal shear stress", "Pa", of.orthogonal_shear[ball], over_p0 * p0, source)
        # At a maximum the place is known to the square root of the value's precision.
        yield compared(at, "its depth", "m", of.orthogonal_shear_depth[ball], depth * b, source, tolerance=1e-6)
        largest, below = references.largest_shear(a / b, poisson)
        for quantity, unit, computed, expected in (
            ("largest shear stress", "Pa", of.max_shear[ball], largest * p0),
            ("depth of the largest shear stress", "m", of.max_shear_depth[ball], below * b),
        ):
            row = compared(at, quantity, unit, computed, expected, source, INTERPOLATED)
            yield replace(row, why_tolerance="interpolated between ellipses, to 1e-5")


def stress_rows() -> Iterator[AgreementRow]:
    """Of B218."""
    yield from stress_of("B218", qs.solve(qs.Scene(B218, LOADS, **BOTH)))
