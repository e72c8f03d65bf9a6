"""Balls between arched rings, moved by friction: random four-point bearings, recomputed as in `friction`, over the
contacts of all arcs.

    python -m tests.verification.campaign.arched COUNT [SEED] [--out FILE]

Nothing of the kernel is used. Besides force, moment and energy, the contact lines of the arcs of each sign must reach
from one groove centre to the other, whose places follow from the shims by geometry alone.

| quantity | range |
|---|---|
| bearing, speeds, friction, orbits, drag | those of `friction` |
| free contact angle | 15 to 45 degrees |
| arcs | two in each ring (60 %), in the inner one (20 %) or the outer one alone |
| axial clearance | 2 to 60 % of 2 BD sin(alpha0), in a tenth of the cases as much interference; with one arched ring, as little as leaves its resting angle below the free one |
| axial load | of either sign |
"""  # noqa: E501 - a row of a table

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution.friction_balance import ContactFriction, FrictionMotion
from qsbearing.model.solution.friction_motion import friction_motion
from tests.qsbearing.scenes import BOTH
from tests.verification.campaign import friction
from tests.verification.campaign.batches import Batch, per_row, run
from tests.verification.campaign.checks import Contacts, hertz_error
from tests.verification.campaign.friction import UNEXPLAINED, AtContacts, Recomputed, of_both, recomputed

BATCH, RADIAL = 104, 4
"""Bearings of a batch, and how many of them are under radial load."""
FREED = "balls without load at rest"
"""Why a case has no solution: balls that only their weight in motion presses are lost at times, under radial load."""


def draw(rng: np.random.Generator, is_radial: bool, n: int) -> tuple[qs.Scene, Traction]:
    """So many bearings that one call can solve, and the law of their friction."""
    scene, traction = friction.draw(rng, is_radial, n)
    given, kind = scene.bearing, rng.random()
    angle = rng.uniform(15.0, 45.0, n) * qs.deg
    fields: dict[str, Any] = {name: getattr(given, name) for name in (
        "ball_count", "ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius", "ball_material",
        "ring_material",
    )}  # fmt: skip
    ball = np.asarray(given.ball_diameter)
    distance = np.asarray(given.inner_groove_radius) + np.asarray(given.outer_groove_radius) - ball
    if kind < 0.6:
        play = rng.uniform(0.02, 0.6, n) * 2.0 * distance * np.sin(angle)
        tight = (rng.random(n) < 0.1) & ~is_radial
        play = np.where(tight, -np.minimum(0.1 * play, 0.002 * ball), play)
        bearing = qs.BallBearing.from_axial_clearance(axial_clearance=play, free_contact_angle=angle, **fields)
    else:
        side = "inner" if kind < 0.8 else "outer"
        length = np.asarray(getattr(given, f"{side}_groove_radius")) - 0.5 * ball
        shim = rng.uniform(0.4, 0.98, n) * 2.0 * length * np.sin(angle)
        shims: dict[str, Any] = {f"{side}_shim": shim}
        bearing = qs.BallBearing(free_contact_angle=angle, kind=qs.BearingKind.FOUR_POINT, **fields, **shims)
    load = np.asarray(scene.operation.axial_load) * np.where(rng.random(n) < 0.3, -1.0, 1.0)
    operation = replace(scene.operation, axial_load=load)
    moved = replace(
        scene, bearing=bearing, operation=operation, ball_effects=BOTH, raceway_control="friction", traction=traction
    )
    return moved, traction


class RecomputedArches(Recomputed):
    """The same, over the contacts of all arcs."""

    def others(self, side: str) -> ContactFriction | None:
        """Contacts of a ring's other arc, if there is one."""
        assert self.found.opposite is not None
        other: ContactFriction | None = getattr(self.found.opposite, side)
        return other

    def contact(self, side: str) -> AtContacts:
        """Of both arcs together; they have no one normal. Balls that nothing touches at rest have no place, and no
        contact does anything there."""
        first, other = super().contact(side), self.others(side)
        own = [(first, getattr(self.found, side)), *([] if other is None else [(self.at(side, other), other)])]
        sums = []
        for name in ("force", "moment", "heat", "torque"):
            parts = [getattr(at, name) for at, _ in own]
            idle = [
                (of.load == 0.0)[(...,) + (None,) * (part.ndim - 2)] for part, (_, of) in zip(parts, own, strict=True)
            ]
            sums.append(sum(np.where(none, 0.0, part) for part, none in zip(parts, idle, strict=True)))
        return AtContacts(first.normal, *sums)

    @cached_property
    def largest(self) -> NDArray:
        """Load of a contact, (case,)."""
        largest = np.max([np.nan_to_num(each.load).max(axis=1) for each in self.found.sides], axis=0)
        return np.where(largest > 0.0, largest, 1.0)

    def closure(self) -> NDArray:
        """The largest gap between contact lines and groove centres, those of the arcs for angles below zero too."""
        gap, found, bearing = super().closure(), self.found, self.scene.bearing
        inner = found.inner if self.others("inner") is None else self.others("inner")
        outer = found.outer if self.others("outer") is None else self.others("outer")
        assert inner is not None and outer is not None
        shims = sum(
            np.zeros(()) if each is None else np.asarray(each, float)
            for each in (bearing.inner_shim, bearing.outer_shim)
        )
        lines = self.line("inner", inner.approach), self.line("outer", outer.approach)
        distance, free = self.of_bearing("groove_centre_distance"), self.of_bearing("free_contact_angle")
        x, y, z = (found.displacement[:, k, None] for k in range(3))
        axial = lines[0] * np.sin(inner.angle) + lines[1] * np.sin(outer.angle) - distance * np.sin(free) - x
        axial = axial + self.column(shims)
        radial = lines[0] * np.cos(inner.angle) + lines[1] * np.cos(outer.angle) - distance * np.cos(free)
        radial = radial - y * np.cos(self.azimuth) - z * np.sin(self.azimuth)
        other = np.maximum(np.abs(axial), np.abs(radial)) / np.maximum(distance, np.maximum(*lines))
        placed = self.there & np.isfinite(self.found.outer.angle)  # but balls that nothing touches at rest
        return np.fmax(np.nan_to_num(gap), np.where(placed, other, 0.0).max(axis=1))

    def hertz(self) -> NDArray:
        """Largest relative error of an ellipse or a load."""
        worst = super().hertz()
        for side in ("inner", "outer"):
            if self.others(side) is not None:
                of_sides: Any = SimpleNamespace(**{side: self.others(side)}, ball_diameter_deviation=None)
                contacts = Contacts(self.scene, of_sides, side)
                worst = np.maximum(worst, hertz_error(self.scene, contacts, self.of_bearing("ball_diameter")))
        return worst


def ends(scene: qs.Scene, traction: Traction, found: FrictionMotion) -> list[str]:
    """How each case ended, in words."""
    is_dragged = traction.cage_drag > 0.0 or traction.drag_coefficient is not None
    is_radial = scene.operation.radial_load_y is not None
    why = ": drag" if is_dragged else f": {FREED}" if is_radial else ""
    words = []
    for status, reason in zip(found.status, found.reason, strict=True):
        if status == "not_converged":
            words.append(UNEXPLAINED + why)
        else:
            words.append(f"{status}: {reason}".removesuffix(": "))
    return words


def batch(rng: np.random.Generator, thrust: int = BATCH - RADIAL, radial: int = RADIAL) -> Batch:
    """How the bearings of a batch ended, those under thrust first."""
    return of_both(draw, solved, rng, thrust, radial)


def solved(scene: qs.Scene, traction: Traction) -> Batch:
    """How the bearings of a call ended."""
    found = friction_motion(scene, traction)
    return recomputed(RecomputedArches(scene, traction, found), ends(scene, traction, found))


def contacts(found: FrictionMotion) -> Counter[int]:
    """How many balls have how many loaded contacts, over converged cases."""
    loaded = sum((np.nan_to_num(each.load) > 0.0).astype(int) for each in found.sides)
    return Counter(np.asarray(loaded)[np.isfinite(found.inner.load)].tolist())


if __name__ == "__main__":
    run("arched", batch, BATCH, per_row(), __doc__)
