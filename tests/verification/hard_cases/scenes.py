"""A hard case as the package's scene, and as the reference must see it to solve the very same numbers."""

from __future__ import annotations

from decimal import Decimal
from typing import Any

from mpmath import mp

import qsbearing as qs
from tests.verification.hard_cases.cases import CASES
from tests.verification.reference import as_scene
from tests.verification.reference.as_scene import bearing_numbers, material, operation_numbers
from tests.verification.reference.scenes import Case

BY_NAME = {case["name"]: case for case in CASES}


def scene_of(name: str, *, stacked: int = 0) -> qs.Scene:
    """The scene; with `stacked`, so many equal cases in one scene of arrays."""
    return as_scene.scene_of(*[BY_NAME[name]] * max(stacked, 1), stacked=stacked > 0)


def exact_case(case: Case) -> Case:
    """The case with every number replaced by exactly the float that the package computes with.

    So the difference between the two solutions is the package's own, not the rounding of what it was given.
    """
    numbers, operation = bearing_numbers(case), operation_numbers(case)
    with mp.workdps(120):
        found = dict(case)
        for key in ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius"):
            found[key] = _exact(numbers[key])
        found["free_contact_angle_deg"] = _exact(numbers["free_contact_angle"], 180 / mp.pi)
        for key, name in (("inner_speed_rpm", "speed"), ("outer_speed_rpm", "outer_speed")):
            found[key] = _exact(operation[name], 30 / mp.pi)
        for side in ("ball_material", "ring_material"):
            found[side] = {name: _exact(value) for name, value in material(case, side).items()}
        found["channels"] = {name: [kind, _exact(float(value))] for name, (kind, value) in case["channels"].items()}
    return found


def _exact(value: float, size: Any = None) -> str:
    """A float in decimal, exactly; over the size of the unit in which the reference reads it, to 100 digits."""
    return str(Decimal(value)) if size is None else mp.nstr(mp.mpf(value) * size, 100)
