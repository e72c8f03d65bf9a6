"""What the limits of fits by name do to preload and stiffness; the results themselves are at the mean."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from qsbearing.documents.model import Block, Paragraph
from qsbearing.model.effects import RingExpansion
from qsbearing.model.effects.ring_expansion_errors import Fit
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solver import solve
from qsbearing.model.units import N, mm, um
from qsbearing.results.readings_record import number
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution

LIMITS = ("least_um", "mean_um", "largest_um")


def fits_record(solution: Solution | SetSolution) -> dict[str, Any]:
    """The key "fits" of `run --json`; nothing where no fit has a name.

    "at_limits" has what is found with the least and with the largest interference of all named fits together, at the
    temperatures of the results; None where it is not solved, or for several operating points.
    """
    of = requested(solution)
    rows = _effects(of)
    seats = [
        _seat(row, seat, fit, effect)
        for row, effect in rows.items()
        for seat, fit in effect.fits.items()
        if np.ndim(fit.least) == 0
    ]
    return {"fits": {"seats": seats, "at_limits": _at_limits(of, solution)}} if seats else {}


def _seat(row: int | None, seat: str, fit: Fit, effect: RingExpansion) -> dict[str, Any]:
    diameter = effect.bore_diameter if seat == "shaft" else effect.outside_diameter
    limits = (round(float(each) / um, 9) for each in (fit.least, fit.mean, fit.most))
    names = {"fit": fit.name, "tolerance_class": fit.tolerance_class}
    return {
        "row": row,
        "seat": seat,
        "diameter_mm": number(np.asarray(diameter, float) / mm),
        **names,
        **dict(zip(LIMITS, limits, strict=True)),
    }


def fits_blocks(solution: Solution | SetSolution) -> list[Block]:
    """The same in a few lines; nothing where no fit has a name."""
    fits = fits_record(solution).get("fits")
    if fits is None:
        return []
    parts = []
    for each in fits["seats"]:
        row = "" if each["row"] is None else f"row {each['row']}, "
        limits = " ... ".join(f"{each[key]:+.3g}" for key in LIMITS)
        bearing = f"bearing of class {each['tolerance_class']}"
        seat = f"{each['seat']} {each['diameter_mm']:.6g} {each['fit']}"
        parts.append(f"{row}{seat}, {bearing}: interference {limits} µm")
    said = f"Fits, least ... mean ... largest: {'; '.join(parts)}. The results are at the mean."
    at = fits["at_limits"]
    if at is not None:
        names = {"preload_in_operation_N": "preload in operation", "axial_N_per_um": "axial stiffness (locked)"}
        names["radial_y_N_per_um"] = "radial stiffness y (locked)"
        texts = [
            f"{names[key]} {' and '.join(f'{low:.4g} ... {high:.4g}' for low, high in _pairs(values))} {_unit(key)}"
            for key, values in at.items()
            if values is not None
        ]
        said += f" With the least and with the largest interference, which are rare: {', '.join(texts)}."
    return [Paragraph(said, is_apart=True)]


def _pairs(values: list[Any]) -> list[list[float]]:
    """Of each row, or of the one bearing."""
    return values if isinstance(values[0], list) else [values]


def _unit(key: str) -> str:
    return "N" if key.endswith("_N") else "N/µm"


def _effects(of: Scene | BearingSet) -> dict[int | None, RingExpansion]:
    """The ring expansion of a bearing, or of each row with its number; once where rows share it."""
    by_row: dict[int | None, Any] = {None: of.ring_effects}
    if isinstance(of, BearingSet) and any(row.ring_effects is not None for row in of.rows):
        own = [of.ring_effects if row.ring_effects is None else row.ring_effects for row in of.rows]
        by_row = dict(enumerate(own, 1))
    return {n: each for n, effects in by_row.items() for each in effects if isinstance(each, RingExpansion)}


def _limited(effects: Any) -> Any:
    if effects is None:
        return None
    return tuple(each.at_limits if isinstance(each, RingExpansion) and each.fits else each for each in effects)


def _at_limits(of: Scene | BearingSet, solution: Solution | SetSolution) -> dict[str, Any] | None:
    if solution.shape or not solution.converged.all():
        return None
    at: Solution | SetSolution
    if isinstance(of, Scene):
        at = solve(replace(of, ring_effects=_limited(of.ring_effects), readings={}, thermal=None))
    else:
        from qsbearing.systems.sets.solve import solve_set

        rows = tuple(replace(row, ring_effects=_limited(row.ring_effects), readings=None) for row in of.rows)
        at = solve_set(replace(of, rows=rows, ring_effects=_limited(of.ring_effects), readings={}, thermal=None))
    if not at.converged.all():
        return None
    stiffness, preload = at.locked_stiffness / (N / um), at.preload_in_operation
    return {
        "preload_in_operation_N": None if preload is None else _numbers(np.asarray(preload).T),
        "axial_N_per_um": _numbers(stiffness[:, 0]),
        "radial_y_N_per_um": _numbers(stiffness[:, 1]),
    }


def _numbers(values: Any) -> Any:
    return [number(each) if np.ndim(each) == 0 else _numbers(each) for each in values]
