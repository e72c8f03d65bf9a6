"""What the balance of friction says of a case, as plain data and as tables for people."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.model.effects.traction import ANGLES, FRICTION_COEFFICIENT, RADII, Traction, TractionLaw
from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.friction_band import Band, friction_band
from qsbearing.model.solution.judgement import percent
from qsbearing.model.solution.point_errors import errors_of_points
from qsbearing.model.solution.result_keys import DISPLACEMENT, STIFFNESS, Place, Result, printed_unit
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.traction_groups import OPPOSITE, TRACTION, TRACTION_GROUPS
from qsbearing.results.contact_table import per_contact
from qsbearing.results.readings_record import number, within
from qsbearing.results.record_type import Record
from qsbearing.results.tables import digits_of


def of_balance(solution: Solution, index: CasePlace = ()) -> Record | None:
    """One case's numbers: the bearing's, its balls', how they were found, and the band; None where not solved."""
    if not np.asarray(solution.converged)[index]:
        return None
    law = solution.scene.traction or Traction()
    exists = np.flatnonzero(np.isfinite(solution.azimuth[index]))
    whole: Record = {}
    balls: list[Record] = [{} for _ in exists]
    for group in TRACTION_GROUPS:
        if group.is_requested is not None and not group.is_requested(solution.scene):
            continue
        for each in group.results:
            values = Place(group, each).of(solution)
            if not group.axis:
                whole[each.key] = None if values is None else number(values[index])
                continue
            for row, ball in zip(balls, exists, strict=True):
                holder = within(row, group, "balls")
                holder[each.key] = None if values is None else number(values[index][ball])
    mu = (
        solution.balance.friction_coefficient
        if solution.balance is not None
        else np.broadcast_to(np.nan, solution.shape)
    )
    how = {
        "law": str(law.law),
        "friction_coefficient": number(mu[index]),
        "friction_coefficient_is_assumed": law.is_assumed,
        "contact_points": _points(law, whole["gyroscopic_margin"]),
    }
    return {**whole, **how, "band": band_record(friction_band(solution), index), "balls": balls}


def _points(law: Traction, margin: float | None) -> Record:
    """Of each contact; and the relative errors that they leave in random thrust cases, where they are known: for
    displacements those in 95 of 100 and the largest, then all."""
    points: Record = {"along_radius": law.radial_points, "around": law.points_around}
    if (law.radial_points, law.points_around) != (RADII, ANGLES) or law.law is TractionLaw.LINEAR:
        return points | {"relative_error": None, "largest_relative_error": None, "random_cases": None}
    of = errors_of_points(np.nan if margin is None else margin)
    usual = of.errors["displacement"]
    errors = {name.replace(" ", "_"): each._asdict() for name, each in of.errors.items()}
    random_cases = {"balls": of.balls, "cases": of.cases, "relative_errors": errors}
    told = {"relative_error": usual.in_95_of_100, "largest_relative_error": usual.largest}
    return points | told | {"random_cases": random_cases}


def band_record(band: Band | None, index: CasePlace = ()) -> Record | None:
    """Least and largest displacement and locked stiffness over the range of the friction coefficient."""
    if band is None:
        return None
    kinds = ("displacement", DISPLACEMENT, band.displacement), ("locked_stiffness", STIFFNESS, band.stiffness)
    ends = {name: {each.key: _ends(each, span, index) for each in results} for name, results, span in kinds}
    return {"friction_range": list(band.over), "solves": band.solves, **ends}


def _ends(of: Result, span: tuple[NDArray, NDArray], index: CasePlace) -> list[float | None]:
    return [number(values[index]) for end in span if (values := of.of(end)) is not None]


def tables_of_balance(solution: Solution, record: Record) -> list[Block]:
    """Of a single case: numbers of the bearing, of its contacts the smallest and the largest, the band, and how all was
    found; nothing where friction has not moved the balls."""
    balance = record.get(TRACTION)
    if balance is None:
        return []
    placed = [(Place(group, each), values) for group in TRACTION_GROUPS for each, values in group.values(solution)]
    rows = [
        (place.result.plain_name, digits_of(values), printed_unit(place.unit))
        for place, values in placed
        if not place.is_per_ball and values is not None and np.isfinite(values)
    ]
    opposite = [each for each in placed if OPPOSITE in (each[0].group.table or ())]
    others = [each for each in placed if OPPOSITE not in (each[0].group.table or ())]
    tables = [
        Table(("quantity", "value", "unit"), rows, "lrl", "Friction moves the balls"),
        per_contact("Friction moves the balls: contacts and axes", others),
        per_contact("Friction moves the balls: contacts of the opposite arcs", opposite),
        _band_table(balance["band"]),
    ]
    return [*filter(None, tables), Paragraph(_how(balance))]


def _band_table(band: Record | None) -> Table | None:
    if band is None:
        return None
    rows = []
    for kind, results in (("displacement", DISPLACEMENT), ("locked_stiffness", STIFFNESS)):
        for each in results:
            least, most = band[kind][each.key]
            if least is not None and most != 0.0:
                name = f"{kind.replace('_', ' ')}, {each.plain_name}"
                rows.append((name, f"{least:.6g}", f"{most:.6g}", printed_unit(each.unit)))
    least, most = band["friction_range"]
    return Table(("", "least", "largest", ""), rows, "lrrl", f"Band for friction coefficients of {least:g} to {most:g}")


def _how(balance: Record) -> str:
    points, law = balance["contact_points"], {"coulomb": "Coulomb's law", "linear": "The linear law"}[balance["law"]]
    said = f"{law}, friction summed over {points['along_radius']} x {points['around']} points of each contact"
    if points["random_cases"] is not None:
        said += f". {_errors_said(points['random_cases'])}"
    if balance["friction_coefficient_is_assumed"]:
        said += f". The friction coefficient of {FRICTION_COEFFICIENT:g} is assumed"
    return f"{said}."


def _errors_said(of: dict[str, Any]) -> str:
    """What the points err by in random cases alike."""
    said = [
        f"{name.replace('_', ' ')} {percent(each['in_95_of_100'])} ({percent(each['largest'])})"
        for name, each in of["relative_errors"].items()
    ]
    return (
        f"In 95 of 100 (in all) of {of['cases']:,} random thrust cases whose balls {of['balls']}, as here, these "
        f"points err by less than: {', '.join(said)}"
    )
