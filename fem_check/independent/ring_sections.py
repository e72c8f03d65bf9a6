"""A bearing's ring sections: bore, outside diameter, width and shoulders; each given, or assumed and told to be so."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import acos, cos, degrees, radians

from fem_check.independent.drawing import BearingDrawing

# Bore, outside diameter and width of the 218 series (90, 160, 30 mm), radii in ball diameters from the pitch circle of
# B218: what a bearing gets whose ring sections are not known.
BORE_BELOW_PITCH, OUTSIDE_ABOVE_PITCH, WIDTH = 17.63 / 22.225, 17.37 / 22.225, 30.0 / 22.225
HIGH_SHOULDER, LOW_SHOULDER = radians(70.0), radians(20.0)
"""The groove's arc ends here, on the loaded and on the other side of the radial plane."""
SYMMETRIC_SHOULDER = radians(50.0)
"""On both sides of a deep groove: a depth of 0.19 ball diameters, as catalogues' shoulder diameters have it."""
BESIDE = radians(4.0)
"""Groove left beside a contact's elements where the shoulder is assumed."""
HIGHEST = radians(80.0)
"""No assumed shoulder ends farther round the groove: at 85° the land beside it and the block of elements below the
contact enclose a wedge that gmsh cannot mesh; the contact's patch then ends at the groove's edge."""

BACK_SPREAD, WIDTH_SPREAD = (0.787, 1.26), (1.5, 2.52)
"""Distance of bore or outside diameter from the pitch circle, and width, of the catalogue's 145 spindle bearings, in
ball diameters: where an assumed one may lie (of the outside diameter and the width, 19 in 20)."""
SHOULDER_SPREAD = radians(10.0)
"""Either way, of an assumed shoulder, as far as the contact leaves room."""

DIMENSIONS = {
    "bore_diameter": "bore",
    "outside_diameter": "outside diameter",
    "width": "width",
    "inner_shoulder_diameter": "inner shoulder",
    "outer_shoulder_diameter": "outer shoulder",
    "inner_open_diameter": "inner open side",
    "outer_open_diameter": "outer open side",
}
"""What a section consists of, and what readers call it; the open side is the one that contact angles lean away from."""


class SectionError(Exception):
    """Dimensions make no ring; the message has every fault."""


@dataclass(frozen=True)
class RingProfile:
    """What a ring's cross-section has beside its groove; SI units, radians."""

    back_radius: float
    """Of the bore (inner ring) or the outside diameter (outer ring)."""
    width: float
    high_shoulder: float = HIGH_SHOULDER
    """Angle round the groove from its bottom to the shoulder on the side that contact angles lean to."""
    low_shoulder: float = LOW_SHOULDER
    """To the other one."""


@dataclass(frozen=True)
class RingSections:
    """The dimensions of both rings that are known [m], and who gave each."""

    known: Mapping[str, float] = field(default_factory=dict)
    """By the names of `DIMENSIONS`."""
    sources: Mapping[str, str] = field(default_factory=dict)
    """Of each: option, scene or catalogue."""
    is_symmetric: bool = False
    """Both shoulders of a ring are alike, as in a deep-groove bearing."""

    @classmethod
    def of(cls, *given: tuple[str, Mapping[str, float | None]], is_symmetric: bool = False) -> RingSections:
        """What several sources give; the first that has a dimension counts."""
        known, sources = {}, {}
        for source, values in reversed(given):
            for name, value in values.items():
                if value is not None:
                    known[name], sources[name] = value, source
        return cls(known, sources, is_symmetric)

    def checked(self, drawing: BearingDrawing) -> RingSections:
        """These, where they make rings of a drawing.

        Raises:
            SectionError: they do not; all faults at once.
        """
        faults = []
        for name, (low, high, why) in _limits(drawing).items():
            value = self.known.get(name)
            if value is not None and not low < value < high:
                between = f"above {1e3 * low:.4g}" + (f" and below {1e3 * high:.4g}" if high < float("inf") else "")
                faults.append(f"{DIMENSIONS[name]} {1e3 * value:.6g} mm ({self.sources[name]}): {between} mm, {why}")
        if faults:
            raise SectionError(f"{drawing.name}: " + "; ".join(faults))
        return self

    def profile(self, drawing: BearingDrawing, race: str, contact: tuple[float, float] | None = None) -> RingProfile:
        """A ring's section.

        Args:
            drawing: the bearing.
            race: inner or outer.
            contact: its angle and what its elements need to either side [rad], for which an assumed shoulder is high
                enough.
        """
        is_inner = race == "inner"
        offset = -BORE_BELOW_PITCH if is_inner else OUTSIDE_ABOVE_PITCH
        back = self.known.get("bore_diameter" if is_inner else "outside_diameter")
        return RingProfile(
            0.5 * drawing.pitch_diameter + offset * drawing.ball_diameter if back is None else 0.5 * back,
            self.known.get("width", WIDTH * drawing.ball_diameter),
            self._shoulder(drawing, race, "shoulder", contact),
            self._shoulder(drawing, race, "open", contact),
        )

    def alternatives(self, drawing: BearingDrawing, race: str, contact: tuple[float, float]) -> list[list[RingProfile]]:
        """Beside `profile`, what a ring may look like: of each assumed dimension, both ends of its usual range."""
        usual = self.profile(drawing, race, contact)
        side, ball = (-1.0 if race == "inner" else 1.0), drawing.ball_diameter
        profiles = []
        if ("bore_diameter" if race == "inner" else "outside_diameter") not in self.known:
            backs = (0.5 * drawing.pitch_diameter + side * offset * ball for offset in BACK_SPREAD)
            profiles.append([replace(usual, back_radius=back) for back in backs if back > 0.0])
        if "width" not in self.known:
            profiles.append([replace(usual, width=width * ball) for width in WIDTH_SPREAD])
        angle, reach = contact
        for which, name, needed in (
            ("shoulder", "high_shoulder", angle + reach),
            ("open", "low_shoulder", reach - angle),
        ):
            if self._given_shoulder(race, which) is None:
                ends = (getattr(usual, name) + step for step in (-SHOULDER_SPREAD, SHOULDER_SPREAD))
                profiles.append([replace(usual, **{name: min(max(end, needed), HIGHEST)}) for end in ends])
        return profiles

    def _given_shoulder(self, race: str, side: str) -> float | None:
        """A shoulder's diameter; of a symmetric ring, the other one's will do."""
        other = {"shoulder": "open", "open": "shoulder"}[side]
        names = (f"{race}_{side}_diameter", *([f"{race}_{other}_diameter"] if self.is_symmetric else []))
        return next((self.known[name] for name in names if name in self.known), None)

    def _shoulder(self, drawing: BearingDrawing, race: str, side: str, contact: tuple[float, float] | None) -> float:
        given = self._given_shoulder(race, side)
        if given is not None:
            centre, radius, sign = _groove(drawing, race)
            return acos(sign * (0.5 * given - centre) / radius)
        usual = SYMMETRIC_SHOULDER if self.is_symmetric else HIGH_SHOULDER if side == "shoulder" else LOW_SHOULDER
        if contact is None:
            return usual
        angle, reach = contact
        needed = (angle if side == "shoulder" else -angle) + reach + BESIDE
        return max(usual, min(needed, HIGHEST))

    def assumed_shoulders(
        self, drawing: BearingDrawing, race: str, profile: RingProfile
    ) -> dict[str, tuple[float, float]]:
        """Of a ring's shoulders, by the names of `DIMENSIONS`, those that nobody gave: diameter [m], angle [rad]."""
        centre, radius, sign = _groove(drawing, race)
        return {
            f"{race}_{side}_diameter": (2.0 * (centre + sign * radius * cos(angle)), angle)
            for side, angle in (("shoulder", profile.high_shoulder), ("open", profile.low_shoulder))
            if self._given_shoulder(race, side) is None
        }

    def told(self, drawing: BearingDrawing, profiles: Mapping[str, RingProfile]) -> str:
        """Every dimension with where it comes from: one sentence for a table's note."""
        by_source: dict[str, list[str]] = {}
        for name, value in self.known.items():
            by_source.setdefault(f"from the {self.sources[name]}", []).append(f"{DIMENSIONS[name]} {1e3 * value:.4g}")
        assumed = [
            f"{DIMENSIONS[name]} {1e3 * value:.4g}"
            for name, value in (
                ("bore_diameter", 2.0 * profiles["inner"].back_radius),
                ("outside_diameter", 2.0 * profiles["outer"].back_radius),
                ("width", profiles["inner"].width),
            )
            if name not in self.known
        ]
        for race, profile in profiles.items():
            for name, (diameter, angle) in self.assumed_shoulders(drawing, race, profile).items():
                assumed.append(f"{DIMENSIONS[name]} {1e3 * diameter:.4g} ({degrees(angle):.0f}°)")
        parts = [f"{', '.join(values)} mm {source}" for source, values in by_source.items()]
        if assumed:
            parts.append(
                f"assumed: {', '.join(assumed)} mm (proportions of the 218 series; the true bodies' "
                "uncertainty holds the range of these dimensions among spindle bearings)"
            )
        return "Rings: " + "; ".join(parts) + "."


def _groove(drawing: BearingDrawing, race: str) -> tuple[float, float, float]:
    """Radius of the circle of groove centres, groove radius, and the side of the raceway seen from there."""
    if race == "inner":
        return drawing.inner_groove_centre_radius, drawing.inner_groove_radius, -1.0
    return drawing.outer_groove_centre_radius, drawing.outer_groove_radius, 1.0


def _limits(drawing: BearingDrawing) -> dict[str, tuple[float, float, str]]:
    """Between what each dimension lies, and why."""
    limits = {}
    for race in ("inner", "outer"):
        centre, radius, sign = _groove(drawing, race)
        bottom = 2.0 * (centre + sign * radius)
        if race == "inner":
            limits["bore_diameter"] = (0.0, bottom, "the bottom of the inner groove")
        else:
            limits["outside_diameter"] = (bottom, float("inf"), "the bottom of the outer groove")
        for side in ("shoulder", "open"):
            low, high = sorted((bottom, 2.0 * centre))
            limits[f"{race}_{side}_diameter"] = low, high, "the groove's bottom and the circle of its centres"
    limits["width"] = (0.5 * drawing.ball_diameter, float("inf"), "half a ball")
    return limits
