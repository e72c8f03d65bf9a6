"""[rows.bearing]: a bearing of the row's own, or single keys in which it differs from [bearing]."""

from __future__ import annotations

from typing import Any

from qsbearing.files.keys import CLEARANCE, COEFFICIENTS, DIAMETERS, FREE_ANGLE, MATERIALS, RACEWAYS, named

_RACEWAYS = {*named(RACEWAYS)}
_CLEARANCE = {FREE_ANGLE.name, CLEARANCE.name, "clearance_class"}
_BOTH = "groove_radius_coefficient"
_ALONE = ({"name"}, {"kind"}, {*named(DIAMETERS)}, {"ball_count", "ball_diameter_mm", *MATERIALS})
"""With all keys of one of these a table describes a bearing by itself."""


def whole_bearing(row: dict[str, Any], common: Any) -> Any:
    """The table of a row's bearing: that of all rows, with what the row's own changes; its own alone where that has a
    name, a kind, bore and outside diameter, or balls and materials. None: neither is given."""
    own = row.get("bearing")
    if own is None or not isinstance(own, dict) or not isinstance(common, dict):
        return common if own is None else own
    if any(each <= own.keys() for each in _ALONE):
        return own
    displaced = {"preload"}.union(*map(_displaced, own))  # a class is that of all rows
    return {key: each for key, each in common.items() if key not in displaced} | own


def _displaced(key: str) -> set[str]:
    """What says the same in another way, and so goes out with a key."""
    if key in _CLEARANCE:
        return (_CLEARANCE | _RACEWAYS) - {key}
    if key in _RACEWAYS:
        return {*_CLEARANCE, "pitch_diameter_mm"}
    if key == "pitch_diameter_mm":
        return _RACEWAYS
    if key == _BOTH:
        return {*COEFFICIENTS, *COEFFICIENTS[_BOTH]} - {key}
    of_groove = {name: radii[0] for name, radii in COEFFICIENTS.items() if name != _BOTH}
    return {of_groove[key]} if key in of_groove else {name for name, radius in of_groove.items() if radius == key}
