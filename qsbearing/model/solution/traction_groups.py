"""Results of the balance of friction: each once, in groups of what has them. Nothing by a hypothesis."""

from __future__ import annotations

from typing import Any

from qsbearing.model.solution.result_keys import BALL, Group, Result

TRACTION = "traction"
"""What their names begin with, and their table."""
SIDES = "inner", "outer"
OPPOSITE = "opposite"
"""Of a four-point bearing, the table of those arcs that carry angles below zero."""
BALANCE = "balance of friction on each ball, derived here"


def _aliases(name: str, unit: str = "") -> tuple[str, ...]:
    return (name, f"{name}_{unit}") if unit else (name,)


OF_BEARING = (
    Result("cage_speed", "rpm", "speed of a cage that balls carry along", r"\omega_c", is_signed=True,
           aliases=_aliases("cage_speed", "rpm")),
    Result("heat", "W", "heat of friction in all contacts", r"P", path="told_heat"),
    Result("torque", "N mm", "torque of the balls on the inner ring", "M", is_signed=True),
    Result("gyroscopic_margin", words="friction over what outer control asks for",
           path="least_gyroscopic_margin", aliases=_aliases("gyroscopic_margin")),
    Result("skid_margin", words="drag at which balls skid over their drag",
           path="least_skid_margin", aliases=_aliases("skid_margin")),
)  # fmt: skip
OF_BALL = (
    Result("attitude_angle", "deg", "attitude of the ball's axis, in its plane", r"\beta", is_signed=True,
           heading="attitude"),
    Result("yaw_angle", "deg", "yaw of the ball's axis, out of its plane", r"\beta'", is_signed=True, heading="yaw"),
    Result("drag", "N", "drag against the ball's orbit", "F_d", is_signed=True),
)  # fmt: skip
OF_CONTACT = (
    Result("slip_across", "m/s", "slip of the ball at the centre, across the groove", "v_t", is_signed=True),
    Result("slip_along", "m/s", "slip of the ball at the centre, against the orbit", "v_y", is_signed=True),
    Result("spin_speed", "rpm", "spin of the ball on the raceway", r"\omega_s", is_signed=True),
    Result("across", "N", "friction on the ball across the groove", "T", path="traction", is_signed=True),
    Result("along", "N", "friction on the ball against its orbit", "Y", path="sideways", is_signed=True),
    Result("friction_use", words="friction force over mu Q"),
    Result("spin_moment", "N mm", "moment of friction about the normal", "M_n", is_signed=True, is_usual=False),
    Result("roll_moment", "N mm", "moment of friction about the tangent across", "M_t", is_signed=True, is_usual=False),
    Result("turn_moment", "N mm", "moment of friction about the tangent along", "M_y", is_signed=True, is_usual=False),
    Result("heat", "W", "heat of friction in the contact", path="told_heat", of_rows=("max",)),
)


_WHOLE = Group(OF_BEARING, prefix=TRACTION, holder="balance", table=(TRACTION,), source=BALANCE, by_words=True)
_BALLS = _WHOLE._replace(results=OF_BALL, axis=BALL, table=(TRACTION, "balls"))


def is_arched(scene: Any) -> bool:
    """Whether it has a four-point bearing: of a set no row is one."""
    return bool(getattr(getattr(scene, "bearing", None), "is_arched", False))


TRACTION_GROUPS = (
    _WHOLE,
    *(
        _BALLS._replace(results=OF_CONTACT, raceway=side, holder=f"balance.{side}", table=(TRACTION, "balls", side))
        for side in SIDES
    ),
    *(
        _BALLS._replace(
            results=OF_CONTACT,
            raceway=side,
            prefix=f"{OPPOSITE}_{TRACTION}",
            holder=f"balance.opposite.{side}",
            table=(TRACTION, "balls", OPPOSITE, side),
            is_requested=is_arched,
        )
        for side in SIDES
    ),
    _BALLS,
)
