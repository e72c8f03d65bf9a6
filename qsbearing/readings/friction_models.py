"""What each model of friction contains, in which range it holds, and what it is for: stated once, shown everywhere."""

from __future__ import annotations

from typing import NamedTuple


class FrictionModel(NamedTuple):
    """Sentences on a model, as text, report and JSON show them."""

    name: str
    """In words."""
    contains: str
    """What it counts."""
    lacks: str
    """What it leaves out."""
    range: str
    """For which bearings and conditions it holds."""
    heat: str
    """What of the heat to use it for."""


CONTACTS = FrictionModel(
    "Contacts",
    "sliding of every contact by spin and across its ellipse; hysteresis and the balls' drag if their coefficients are "
    "given",
    "viscous, cage and seal friction and the slip of a gyroscopic moment",
    "no limit of n dm of its own; the motion is that of raceway control",
    "the division of the heat of sliding among the contacts; for the whole bearing it is a lower bound",
)
MOVED = CONTACTS._replace(
    contains="sliding of every contact, by the balance of friction that moves the balls, the slip of the gyroscopic "
    "moment included; hysteresis and the balls' drag if their coefficients are given",
    lacks="viscous, cage and seal friction",
    range="the motion is that of the balance",
)
SKF = FrictionModel(
    "SKF",
    "rolling (oil sheared in the inlets, reduced by its heat and by starvation) and sliding of the whole bearing",
    "seals and the drag of an oil bath",
    "constant speed, below the bearing's speed rating; no range of n dm is published",
    "the whole bearing, below its speed rating; above it the part that grows with the centrifugal force is "
    "extrapolated and may dominate",
)
PALMGREN = FrictionModel(
    "Palmgren",
    "a load-dependent and a viscous part of the whole bearing; churning as far as f0 of the lubrication includes it",
    "seals",
    "no range of n dm is published; below nu n = 2000 mm²/s rpm the viscous torque is constant",
    "the whole bearing, with f0 of its lubrication",
)
