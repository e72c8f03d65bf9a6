"""The results of a solution: each once, in groups of what has them, in the order of tables and datasets."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.operating_point import Solved
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.result_keys import (
    BALL,
    DISPLACEMENT,
    LOAD,
    NODES,
    RING,
    SIZE,
    STIFFNESS,
    Group,
    Result,
)
from qsbearing.model.solution.traction_groups import OPPOSITE, TRACTION_GROUPS, is_arched


class SolvedScene(Solved, Protocol):
    """What is read here and in `columns` of a solution, which lies above: its methods call what is here."""

    scene: Scene
    thermal: Any

    @property
    def balance(self) -> Any: ...
    @property
    def opposite(self) -> Any: ...
    @property
    def inner_load(self) -> NDArray: ...
    @property
    def stiffness(self) -> NDArray: ...
    @property
    def gyroscopic_moment(self) -> NDArray | None: ...
    @property
    def slips(self) -> NDArray | None: ...
    @property
    def status(self) -> Any: ...
    @property
    def reason(self) -> Any: ...
    @property
    def iterations(self) -> Any: ...
    @property
    def residual(self) -> Any: ...
    @property
    def load(self) -> NDArray: ...


BALANCE, HERTZ, NO_SLIP = "Jones 1960; Harris & Kotzalas 2006", "Hertz 1881; Johnson 1985", "Jones 1960"
"""Sources."""

SIDES = "inner", "outer"
ANGLES = "min", "max", SIZE

CONTACT_LOAD = Result("load", "N", "contact load", "Q", BALANCE, of_rows=("max",), heading="load")
ANGLE = Result("angle", "deg", "contact angle", r"\alpha", BALANCE, is_signed=True, of_rows=ANGLES, heading="angle")
MAX_PRESSURE = Result("max_pressure", "MPa", "maximum contact pressure", "p_0", HERTZ, of_rows=("max",))
FRICTION = Result("required_friction", words="friction coefficient that Mg requires", symbol=r"\mu", source=BALANCE)
CONTACT = (
    CONTACT_LOAD,
    ANGLE,
    Result("approach", "um", "elastic approach (negative: a gap)", r"\delta", HERTZ),
    Result("semi_major_axis", "mm", "semi-axis of the contact ellipse, across rolling", "a", HERTZ),
    Result("semi_minor_axis", "mm", "semi-axis of the contact ellipse, along rolling", "b", HERTZ),
    MAX_PRESSURE,
    FRICTION,
)
SPEEDS = (
    Result("orbital_speed", "rpm", "orbital speed of the ball's centre round x", r"\omega_m", NO_SLIP, is_signed=True,
           heading="orbit"),
    Result("rotation_speed", "rpm", "rotation speed of the ball about its axis", r"\omega_R", NO_SLIP, is_signed=True,
           heading="rotation"),
)  # fmt: skip
DEVIATION = Result("ball_diameter_deviation", "um", is_signed=True, heading="D - D0")
ELSEWHERE = (DEVIATION, Result("groove_deflection", "um", is_signed=True))
"""Of balls, but not of their motion."""
OF_BALL = (
    Result("centrifugal_force", "N", "centrifugal force on the ball", "F_c", BALANCE),
    Result("gyroscopic_moment", "N mm", "gyroscopic moment on the ball", "M_g", BALANCE, is_signed=True),
    *SPEEDS,
    *ELSEWHERE,
)
"""Arrays of a solution (*cases, ball), those of contacts for either raceway."""

GEOMETRY = (
    Result("ball_diameter", "mm"),
    Result("pitch_diameter", "mm"),
    Result("inner_groove_radius", "mm"),
    Result("outer_groove_radius", "mm"),
    Result("free_contact_angle", "deg"),
    Result("diametral_clearance", "um"),
)
"""Of the bearing that ring effects have changed."""
RING_STATE = (
    Result("groove_growth", "um", "radial growth of groove"),
    Result("seat_pressure", "MPa"),
    Result("seat_gap", "um"),
    Result("bore_hoop_stress", "MPa", "hoop stress at bore"),
    Result("equivalent_stress", "MPa", "largest Tresca stress"),
)
"""Of a `RingState`."""
RING_SHAPE = (
    Result("growth", "um"),
    Result("bending", "um"),
    Result("seat_pressure", "MPa"),
    Result("least_seat_pressure", "MPa", heading="least"),
    Result("largest_seat_pressure", "MPa", heading="largest"),
)
"""Of a `RingShape`."""


APEX = (
    Result("apex_margin", "mm", "from the end of the ellipse to the groove's apex", is_usual=False,
           heading="apex"),
)  # fmt: skip
"""Of a contact of a four-point bearing, along its groove; negative where the ellipse would pass the apex."""


def _reshaped(solution: SolvedScene) -> Any:
    return solution.scene.operating_bearing if solution.scene.is_reshaped else None


def _unloaded(solution: SolvedScene) -> NDArray:
    """Balls that have lost the inner raceway; NaN where not solved."""
    lost = (solution.inner_load == 0.0).sum(axis=-1)
    return np.where(solution.converged, lost, np.nan)


LEVEL = 1e-6
"""Relative difference of two balls' approaches below which neither is the less loaded one (chosen: far above what the
solver leaves, far below what matters)."""


def _least_loaded(solution: SolvedScene) -> NDArray:
    """Azimuth of the ball that is first to leave the inner raceway, or farthest from it [rad]; of several the first.

    NaN where no ball is less loaded than the others, where not solved, and at rest where a ball touches no raceway.
    """
    approach = solution.inner.approach
    if solution.opposite is not None and solution.opposite.inner is not None:
        approach = np.fmax(approach, solution.opposite.inner.approach)
    present = ~np.isnan(solution.azimuth)
    known = (np.isfinite(approach) | ~present).all(axis=-1)
    least = np.where(present & known[..., None], approach, np.inf).min(axis=-1)
    most = np.where(present & known[..., None], approach, -np.inf).max(axis=-1)
    margin = LEVEL * np.maximum(np.abs(least), np.abs(most))
    ball = (approach <= (least + margin)[..., None]).argmax(axis=-1)
    azimuth = np.take_along_axis(solution.azimuth, ball[..., None], -1)[..., 0]
    return np.where(known & (most - least > margin), azimuth, np.nan)


def _steady_friction(solution: SolvedScene) -> NDArray | None:
    return None if solution.thermal is None else np.asarray(sum(solution.thermal.powers.values()))


def _has_preload(scene: Any) -> bool:
    return scene.preload is not None


def _has_elastic_rings(scene: Any) -> bool:
    return scene.elastic_rings is not None


def _control(solution: SolvedScene) -> NDArray | None:
    if solution.raceway_control is None:
        return None
    return np.where(np.isnan(solution.inner.load), np.nan, solution.raceway_control == "inner")


def unasked(results: Iterable[Result], **changes: Any) -> tuple[Result, ...]:
    """The same, kept by a study only where they are asked for."""
    return tuple(each._replace(is_usual=False, **changes) for each in results)


WITH_LOADS = "axial load in operation, external loads included"
PRELOAD = unasked(
    (
        Result("at_rest", "N", "preload as given", path="preload_at_rest"),
        Result("unmounted", "N", "preload before fitting", path="preload_unmounted"),
        Result("mounted", "N", "preload mounted, at rest", path="preload_mounted"),
    )
) + unasked(
    (
        Result("in_operation", "N", WITH_LOADS, path="load.0"),
        Result("alone", "N", "preload in operation, without external loads", path="preload_in_operation"),
        Result("carried", "N", WITH_LOADS, path="load.0"),
        Result("share", words="part of the given preload, without external loads", path="preload_share"),
        Result("axial_displacement", "um", "axial displacement under preload", path="displacement.0"),
    ),
    is_column=False,
)
"""Of a bearing. `in_operation` is what is carried with external loads; of a row of a set it is without them."""
DERIVED = (
    Result("balls_off_inner", "balls", "balls off the inner raceway", path=_unloaded, is_column=False),
    Result(
        "least_loaded_azimuth",
        "deg",
        "azimuth of the least loaded ball",
        path=_least_loaded,
        is_azimuth=True,
        is_column=False,
    ),
)
MIDDLE = (
    Result("axial_from_middle", "um", "axial displacement from the middle of both grooves", is_signed=True,
           is_usual=False),
)  # fmt: skip
"""Of a deep-groove or four-point bearing."""
SHARE = (
    Result(
        "share_of_axial_displacement",
        words="part of the rings' deflection in the axial displacement",
        path="elastic_share",
        is_usual=False,
        is_column=False,
    ),
)
CONTROLS = (Result("inner_raceway_controls", path=_control, is_column=False),)
AZIMUTH = (Result("azimuth", "deg", is_azimuth=True, is_column=False),)
TEMPERATURE = (Result("temperature", "C", path="value", is_usual=False, is_column=False),)
BODIES = "inner_ring", "outer_ring", "shaft", "housing", "balls"
"""With a temperature of their own."""


def channels(before: str) -> tuple[Group, ...]:
    """The five channels of the ring, or of a set's shaft: how it moves, what loads it, and how stiff it is."""
    kinds = ("displacement", DISPLACEMENT), ("load", LOAD), ("locked_stiffness", STIFFNESS)
    every = (*kinds, ("effective_stiffness", STIFFNESS))
    return tuple(Group(each, before, prefix=kind, holder=kind, table=(kind,)) for kind, each in every)


def _of_sides(results: tuple[Result, ...], prefix: str, holder: str, table: str, axis: str = "") -> tuple[Group, ...]:
    return tuple(Group(results, "", side, prefix, f"{side}{holder}", axis, (table, side)) for side in SIDES)


CONTACTS = _of_sides(CONTACT, "", "", "balls", BALL)
ARCS = (
    *(Group(APEX, "", side, holder=side, axis=BALL, table=("balls", side), is_requested=is_arched) for side in SIDES),
    *(
        Group((*CONTACT, *APEX), "", side, OPPOSITE, f"{OPPOSITE}.{side}", BALL, ("balls", OPPOSITE, side),
              is_requested=is_arched)
        for side in SIDES
    ),
)  # fmt: skip
"""Of a four-point bearing: the arcs that carry angles below zero, and what the others have besides."""
BALLS = Group(OF_BALL, axis=BALL, table=("balls",))
RINGS = tuple(Group(RING_STATE, prefix=f"{side}_ring", holder=f"{side}_ring", table=("rings", side)) for side in SIDES)
SHAPES = _of_sides(RING_SHAPE, "elastic", "_shape", "elastic_rings")
TEMPERATURES = tuple(
    Group(TEMPERATURE, prefix=body, holder=f"scene.temperatures.{body}", table=("temperatures", body))
    for body in BODIES
)
OPERATING = Group(GEOMETRY, prefix="operating", holder=_reshaped, table=("operating_geometry",))
OF_PRELOAD = Group(PRELOAD, prefix="preload", table=("preload",), is_requested=_has_preload, by_words=True)
STEADY = Group(
    tuple(Result(f"{node}_temperature", "C", path=node, entry=node) for node in NODES),
    prefix="steady", holder="thermal.temperatures", table=("thermal", "temperatures_C"),
)  # fmt: skip
OF_MIDDLE = Group(MIDDLE, table=(), by_words=True)
OF_AZIMUTH = Group(AZIMUTH, axis=BALL, table=("balls",))
GROUPS = (
    *CONTACTS,
    *ARCS,
    BALLS,
    Group(CONTROLS, axis=BALL),
    *channels(RING),
    OF_PRELOAD,
    OPERATING,
    *RINGS,
    *SHAPES,
    STEADY,
    Group((Result("friction", "W", path=_steady_friction),), prefix="steady"),
    Group(DERIVED),
    OF_AZIMUTH,
    *TEMPERATURES,
    OF_MIDDLE,
    Group(SHARE, table=("elastic_rings",), is_requested=_has_elastic_rings, by_words=True),
    *TRACTION_GROUPS,
)
"""Of every solution of a bearing; a group that its scene does not call for has no numbers."""
