"""The pressure of a true contact as numbers of a picture: at the nodes of its mesh, over Hertz's ellipse."""

from __future__ import annotations

import numpy as np

from fem_check.independent.references import ellipse
from fem_check.solids.true_contact import CondensedContact

DIGITS = 4
"""Kept of each number: a picture shows three."""


def pressure_map(contact: CondensedContact, load: float) -> dict[str, object]:
    """The half y >= 0 of the contact: places over Hertz's semi-axes, pressures over his largest.

    x grows with the contact angle, from where the undeformed bodies touch.

    Args:
        contact: the bodies on one mesh.
        load: [N].
    """
    exact = ellipse(contact.contact.groove.problem(load))
    x, y = contact.contact.frame.basis.points
    numbers = {
        "x": -x / exact.semi_major_axis,
        "y": y / exact.semi_minor_axis,
        "p": contact.pressure(load) / exact.max_pressure,
    }
    return {
        "race": contact.contact.groove.race_name,
        "load_N": load,
        "elements": contact.contact.elements,
        **{name: np.round(values, DIGITS).tolist() for name, values in numbers.items()},
    }
