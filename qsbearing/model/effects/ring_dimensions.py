"""Dimensions of a bearing's rings where a scene does not state them: the bearing's own, else of usual proportions.

Source        printed tables of boundary dimensions: 85 spindle bearings of series 719 and 72 have 0.29 to 0.55 of the
              ball diameter below each groove (median 0.35), 200 deep-groove bearings 0.33 in the mean, B218 0.28; all
              are 4.5 to 4.9 of that wide in the mean; shoulders are 0.16 to 0.2 of the ball diameter high, B218's 0.34
              and on its open side 0.03
When not      bearings with small balls in thick rings (high-speed series): their rings are two to three times as stiff
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

THICKNESS = 0.35
"""Below a groove, over the ball diameter."""
WIDTH = 4.7
"""Over the thickness of the outer ring below its groove."""
SHOULDER, OPEN_SHOULDER = 0.18, 0.03
"""Heights above the groove's bottom over the ball diameter: the lowest that a ball presses against; the other one of
an angular-contact bearing."""
BEYOND_CONTACT = np.radians(30.0)
"""So far beyond the free contact angle the groove goes on."""

USUAL, OWN = "usual proportions", "the bearing's own dimensions"
OWN_DIAMETERS = "the bearing's own diameters and usual width"
"""Where dimensions come from, in words that follow "rings of"."""


class RingDimensions(NamedTuple):
    """Diameters and width [m]."""

    bore: Any
    outside: Any
    width: Any
    shoulder: Any
    """Of the outer ring, on the side that contact angles above zero lean to."""
    open_shoulder: Any
    """Its other one."""
    origin: str
    """`USUAL`, `OWN_DIAMETERS` or `OWN`."""


def ring_dimensions(bearing: Any, ring_effects: Iterable[Any] = ()) -> RingDimensions:
    """Of the rings of a bearing: those that its ring effects or its outline state, else of usual proportions."""
    ball, radius = np.asarray(bearing.ball_diameter, float), np.asarray(bearing.outer_groove_radius, float)
    inner_bottom = bearing.inner_groove_centre_radius - np.asarray(bearing.inner_groove_radius, float)
    outer_bottom = bearing.outer_groove_centre_radius + radius
    edge = np.asarray(bearing.free_contact_angle, float) + BEYOND_CONTACT
    height = np.maximum(SHOULDER * ball, radius * (1.0 - np.cos(np.minimum(edge, 0.5 * np.pi))))
    stated = [*ring_effects, bearing.outline]

    def known(*names: str) -> Any:
        values = (getattr(each, name, None) for name in names for each in stated)
        return next((each for each in values if each is not None), None)

    def own(value: Any, usual: Any) -> Any:
        return (usual if value is None else np.asarray(value, float))[()]  # a number of a single case

    outside, width = known("outside_diameter"), known("outer_width", "width")
    outer = own(outside, 2.0 * (outer_bottom + THICKNESS * ball))
    shoulder = own(known("outer_shoulder_diameter"), 2.0 * (outer_bottom - height))
    is_symmetric = bearing.kind == "deep_groove"
    return RingDimensions(
        own(known("bore_diameter"), 2.0 * (inner_bottom - THICKNESS * ball)),
        outer,
        own(width, WIDTH * (0.5 * outer - outer_bottom)),
        shoulder,
        shoulder if is_symmetric else 2.0 * (outer_bottom - OPEN_SHOULDER * ball),
        USUAL if outside is None else OWN_DIAMETERS if width is None else OWN,
    )
