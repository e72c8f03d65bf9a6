"""A ball in its groove with its true surfaces, on several meshes at several loads, and Hertz's contact beside it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import degrees
from typing import Any

import qsbearing
from fem_check.independent import finite_bodies
from fem_check.independent.groove import RACES, BallInGroove
from fem_check.independent.references import hertz
from fem_check.independent.ring_sections import DIMENSIONS
from fem_check.product.scenes import ball_count, drawing_at_rest, groove_contact, load_scene, ring_sections
from fem_check.rows import convergence
from fem_check.rows.agreement import Progress
from fem_check.solids.mesh_room import room
from fem_check.solids.true_contact import CondensedContact, TrueContact, loaded_angle

WHY_FOUND = (
    "a finding: its scatter over two meshes of one load tells nothing; judged over six loads at the release level"
)


@dataclass(frozen=True)
class TrueContactStudy:
    """One contact at one load on each mesh, coarse to fine: every quantity over Hertz's."""

    groove: BallInGroove
    load: float
    parabola: list[dict[str, float]]
    """True bodies, Hertz's gap, pressure along the contact's axis."""
    exact_gap: list[dict[str, float]]
    """Exact gap."""
    surface: list[dict[str, float]]
    """Exact gap, pressure along the normal of the surfaces: the true contact."""
    bulges: list[tuple[float, float]]
    """See `CondensedContact.bulges`."""
    added: list[tuple[float, float]]
    """See `CondensedContact.added_compliances`."""
    dofs: int
    solver: str
    alike: tuple[TrueContactStudy, ...] = ()
    """All contacts of the run, over which scatter is pooled; none: this alone."""
    finest: CondensedContact | None = None
    """The bodies on the finest mesh, where asked for."""
    ring_doubt: float = 0.0
    """Of the approach over Hertz's, where dimensions of the ring are assumed."""

    @property
    def case(self) -> str:
        """Contact, load and angle."""
        angle = degrees(self.groove.contact_angle)
        return f"{self.groove.name} {self.groove.race_name}, Q = {self.load:.0f} N at {angle:.2f}°"

    def estimate(self, values: list[float]) -> tuple[float, float]:
        """The finest mesh's value, and its uncertainty."""
        return values[-1], convergence.largest_change(values)

    def ratio(self, above: str, below: str, name: str) -> tuple[float, float]:
        """Of two results of the same mesh, whose errors largely cancel; with its uncertainty.

        Of approaches the difference over Hertz's, and 1: what the bodies' size adds is the same in both, -2 % of
        Hertz's at 5 kN, and in a ratio would be taken for 2 % more of the gap's effect.

        On meshes of 5 to 8 elements what is left of approach and semi-axes scatters in no order, by 0.5 to 2 % of the
        effect at every load: a at 5 kN inside by -1.81, -1.78, -1.75, -1.80 % of Hertz's. Three meshes of one load tell
        that badly. For the approach at 2 kN outside, chance has them within 0.04 % of it, all loads together say 0.5.
        The pressure is read at one place and errs alike under all loads, on 5 elements by 6 % of the effect: there the
        largest change says more.
        """
        if name == "max_pressure" or (name != "approach" and len(self.alike) < 2):
            return self.estimate(self.ratios(above, below, name))
        doubt = convergence.scatter([each.effects(above, below, name) for each in self.alike or (self,)])
        own = self.effects(above, below, name)[-1]
        return 1.0 + own, abs(own) * doubt

    def tolerance_of(self, name: str, tolerance: float, why: str) -> tuple[float | None, str]:
        """Tolerance of a ratio, and why that; of an approach on two meshes none, since two values know next to nothing
        of the scatter that is its uncertainty."""
        return (None, WHY_FOUND) if name == "approach" and len(self.surface) < 3 else (tolerance, why)

    def effects(self, above: str, below: str, name: str) -> list[float]:
        """What one result has more than the other, over it, on each mesh; of approaches over Hertz's."""
        if name == "approach":
            return [one[name] - other[name] for one, other in self._pairs(above, below)]
        return [ratio - 1.0 for ratio in self.ratios(above, below, name)]

    def ratios(self, above: str, below: str, name: str) -> list[float]:
        """Of two results on each mesh, coarse to fine; not of approaches."""
        return [one[name] / other[name] * _beside(name, one, other) for one, other in self._pairs(above, below)]

    def _pairs(self, above: str, below: str) -> Iterator[tuple[dict[str, float], dict[str, float]]]:
        return zip(getattr(self, above), getattr(self, below), strict=True)

    def bulge(self) -> tuple[float, float]:
        """The ball's equator over an elastic sphere's, each mesh's pressure on both; with its uncertainty.

        One ball under all loads, and far from all contacts: what its meshes do there is the same scatter at every load.
        """
        every = [[ball / sphere for ball, sphere in each.bulges] for each in self.alike or (self,)]
        ball, sphere = self.bulges[-1]
        return ball / sphere, convergence.scatter(every)


def _beside(name: str, one: dict[str, float], other: dict[str, float]) -> float:
    """The largest pressure over that at the pressure's centre, by what slants one result and not the other.

    On one mesh the slant's errors are alike: at 5 kN it is 0.012, 0.015 and 0.016 on B218's three, 0.0140 in all when
    the parabola's is taken off. The largest of sqrt(1 - x^2) (1 + s x + c x^2) is 1 + s^2/(2 - 4 c).
    """
    if name != "max_pressure":
        return 1.0
    return 1.0 + (one.get("slant", 0.0) - other.get("slant", 0.0)) ** 2 / (2.0 - 4.0 * one.get("bend", 0.0))


def contacts(scene: str, race: str, load: float, elements: tuple[int, ...]) -> list[TrueContact]:
    """A raceway's contact at its loaded angle, meshed more and more finely for a load."""
    grooves = {name: groove_contact(scene, name) for name in RACES}
    angle = loaded_angle(grooves["inner"], grooves["outer"], load)
    return meshed(load_scene(scene), scene, replace(grooves[race], contact_angle=angle), load, elements)


def meshed(
    bearing: qsbearing.Scene, source: str, groove: BallInGroove, load: float, elements: tuple[int, ...]
) -> list[TrueContact]:
    """A contact of a bearing, meshed more and more finely for a load.

    Args:
        bearing: with its rings' sections.
        source: where it was read from.
        groove: ball and raceway at the contact angle.
        load: [N].
        elements: per semi-axis, coarse to fine.
    """
    profile = ring_sections(bearing, source).profile(
        drawing_at_rest(bearing, source), groove.race_name, room(groove, load)
    )
    balls = ball_count(bearing)
    return [TrueContact(groove, balls, load, count, profile) for count in elements]


def assumed_shoulders(bearing: qsbearing.Scene, source: str, groove: BallInGroove, load: float) -> str:
    """Which of the groove's edges beside a contact are assumed, and what gives them; a sentence's end, or empty."""
    sections, drawing = ring_sections(bearing, source), drawing_at_rest(bearing, source)
    profile = sections.profile(drawing, groove.race_name, room(groove, load))
    told = [
        f"{DIMENSIONS[name]} {1e3 * diameter:.4g} mm, {degrees(angle):.0f}° round the groove (give "
        f"--{name.replace('_', '-')}-mm)"
        for name, (diameter, angle) in sections.assumed_shoulders(drawing, groove.race_name, profile).items()
    ]
    return f". The groove's edges are assumed: {'; '.join(told)}" if told else ""


def ring_doubt(bearing: qsbearing.Scene, source: str, groove: BallInGroove, load: float) -> float:
    """Of the approach over Hertz's, how far it may be off where dimensions of the ring are assumed."""
    sections, drawing, needs = ring_sections(bearing, source), drawing_at_rest(bearing, source), room(groove, load)
    balls = ball_count(bearing)
    usual = sections.profile(drawing, groove.race_name, needs)
    others = sections.alternatives(drawing, groove.race_name, needs)
    return finite_bodies.ring_doubt(groove, balls, usual, others, load) / hertz(groove.problem(load)).approach


def solve(made: list[TrueContact], loads: tuple[float, ...], progress: Progress) -> list[TrueContactStudy]:
    """A contact on a sequence of meshes, made for one load and solved at loads near it."""
    per_mesh = []
    for done, contact in enumerate(made):
        stage = f"{contact.groove.race_name}, {contact.elements} elements per semi-axis"
        progress(stage, done / len(made))
        finest = contact.condensed()
        per_mesh.append([_read(finest, load) for load in loads])  # where it fills its patch, the coarsest mesh tells
    solved = []
    for load, own in zip(loads, zip(*per_mesh, strict=True), strict=True):
        parabola, exact_gap, surface, bulges, added = (list(each) for each in zip(*own, strict=True))
        solved.append(
            TrueContactStudy(
                contact.groove, load, parabola, exact_gap, surface, bulges, added, finest.dofs, finest.solver,
                finest=finest,
            )
        )  # fmt: skip
    return solved


def _read(condensed: CondensedContact, load: float) -> tuple[Any, ...]:
    """What `TrueContactStudy` has of each mesh."""
    return (
        condensed.over_hertz(load, follows_surface=False, parabola=True),
        condensed.over_hertz(load, follows_surface=False),
        condensed.over_hertz(load, follows_surface=True),
        condensed.bulges(load),
        condensed.added_compliances(load),
    )
