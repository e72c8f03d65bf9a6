"""What is known of chosen contacts beside their rows: bearing, materials, shapes, meshes; the numbers of pictures."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees
from typing import Any, NotRequired, TypedDict, cast

import numpy as np

from fem_check.contacts import half_spaces, true_bodies
from fem_check.contacts.chosen import ANGLES, Chosen
from fem_check.contacts.half_spaces import Shape, ellipticity
from fem_check.contacts.true_bodies import TrueBodies
from fem_check.elements.pressure_basis import PressureBasis
from fem_check.independent.contact_problem import Array, ElasticConstants
from fem_check.independent.groove import RACES
from fem_check.independent.references import ellipse
from fem_check.product.scenes import ball_count
from fem_check.rows.record import CheckRecord


class MaterialRecord(TypedDict):
    """Of balls or rings."""

    name: str
    elastic_modulus_GPa: float
    poisson_ratio: float


class BearingRecord(TypedDict):
    """What the contacts are of."""

    name: str
    ball_count: int
    ball_diameter_mm: float
    pitch_diameter_mm: float
    inner_groove_radius_mm: float
    outer_groove_radius_mm: float
    free_contact_angle_deg: float
    ball_material: MaterialRecord
    ring_material: MaterialRecord


class ContactRecord(TypedDict):
    """One contact."""

    label: str
    race: str
    load_N: float
    contact_angle_deg: float
    free_angle_deg: float
    loaded_angle_deg: float
    angle: str
    angle_is: str
    balls: str
    curvature_sum_across_per_mm: float
    curvature_sum_along_per_mm: float
    ellipticity: float
    case: NotRequired[str]
    """Of its rows."""
    similar_to_load_N: NotRequired[float]
    """Of half-spaces: the load that was solved for its shape."""
    mesh: NotRequired[dict[str, Any]]
    """Of true bodies: its own."""
    true_case: NotRequired[str]
    """Of its rows as true bodies, where it was solved as half-spaces too."""
    on_each_mesh: NotRequired[list[dict[str, float]]]
    """Elements per semi-axis, and the quantities with them, coarse to fine; SI units."""
    true_on_each_mesh: NotRequired[list[dict[str, float]]]
    """The same of the true bodies, where it was solved as half-spaces too."""


class Known(TypedDict):
    """What is known of chosen contacts beside their rows."""

    bearing: BearingRecord
    elements: list[int]
    true_elements: NotRequired[list[int]]
    """Of the true bodies' meshes, beside half-spaces."""
    contacts: list[ContactRecord]
    undecided: NotRequired[list[str]]
    """Of true bodies: rows that the meshes are too coarse to judge."""


class ContactsRecord(CheckRecord, Known):
    """Findings of chosen contacts."""

    accuracy: NotRequired[dict[str, Any]]
    """Asked for and reached, where meshes were chosen by it."""


def of_half_spaces(contacts: Sequence[Chosen], shapes: Sequence[Shape], sequence: Sequence[int]) -> Known:
    """Entries of the record, and the pressure of each contact for its picture."""
    entries = []
    for each in contacts:
        shape = next(shape for shape in shapes if each in shape.alike)
        entry = _contact(each)
        entry["case"] = half_spaces.case_of(each)
        entry["on_each_mesh"] = _with_elements(sequence, half_spaces.on_each_mesh(shape, each))
        if len(shape.alike) > 1:
            entry["similar_to_load_N"] = shape.study.problem.load
        entries.append(entry)
    return {"bearing": _bearing(contacts[0]), "elements": list(sequence), "contacts": entries}


def of_true_bodies(contacts: Sequence[TrueBodies], sequence: Sequence[int]) -> Known:
    """The same of true bodies; and which rows the meshes are too coarse to judge."""
    entries = [_contact(each.chosen) for each in contacts]
    for entry, each in zip(entries, contacts, strict=True):
        entry |= {"case": each.case, "mesh": true_bodies.mesh_of(each)}
        entry["on_each_mesh"] = _with_elements(sequence, true_bodies.on_each_mesh(each))
    undecided = [case for each in contacts for case in each.undecided]
    bearing = _bearing(contacts[0].chosen)
    return {"bearing": bearing, "elements": list(sequence), "contacts": entries, "undecided": undecided}


def of_both(half: Known, true: Known) -> Known:
    """The same contacts as half-spaces and as true bodies."""
    for own, other in zip(half["contacts"], true["contacts"], strict=True):
        own["true_case"], own["mesh"] = other["case"], other["mesh"]
        own["true_on_each_mesh"] = other["on_each_mesh"]
    return {**half, "true_elements": true["elements"], "undecided": true["undecided"]}


def _with_elements(sequence: Sequence[int], values: Sequence[dict[str, float]]) -> list[dict[str, float]]:
    return [{"elements": count, **each} for count, each in zip(sequence, values, strict=True)]


def _bearing(contact: Chosen) -> BearingRecord:
    bearing = contact.bearing.bearing
    lengths = ("ball_diameter", "pitch_diameter", *(f"{race}_groove_radius" for race in RACES))
    made = {
        "name": contact.groove.name,
        "ball_count": ball_count(contact.bearing),
        **{f"{name}_mm": 1e3 * float(np.ravel(getattr(bearing, name))[0]) for name in lengths},
        "free_contact_angle_deg": degrees(float(np.ravel(bearing.free_contact_angle)[0])),
        "ball_material": _material(bearing.ball_material.name, contact.groove.ball),
        "ring_material": _material(bearing.ring_material.name, contact.groove.race),
    }
    return cast(BearingRecord, made)


def _material(name: str, constants: ElasticConstants) -> MaterialRecord:
    return {
        "name": name,
        "elastic_modulus_GPa": 1e-9 * constants.elastic_modulus,
        "poisson_ratio": constants.poisson_ratio,
    }


def _contact(contact: Chosen) -> ContactRecord:
    problem = contact.problem
    return {
        "label": contact.label,
        "race": contact.groove.race_name,
        "load_N": contact.load,
        "contact_angle_deg": degrees(contact.groove.contact_angle),
        "free_angle_deg": degrees(contact.free_angle),
        "loaded_angle_deg": degrees(contact.loaded_angle),
        "angle": contact.angle,
        "angle_is": ANGLES[contact.angle],
        "balls": contact.balls,
        "curvature_sum_across_per_mm": 1e-3 * problem.curvature_x,
        "curvature_sum_along_per_mm": 1e-3 * problem.curvature_y,
        "ellipticity": ellipticity(problem),
    }


def pressures_of_half_spaces(shapes: Sequence[Shape]) -> list[dict[str, Any]]:
    """The numbers of a map of each shape's pressure, at its heaviest load."""
    maps = []
    for shape in shapes:
        solution = shape.study.solution
        middle = len(solution.unit_lengths) // 2
        length, pressure = float(solution.unit_lengths[middle]), solution.pressures[:, middle]
        heaviest = max(shape.alike, key=lambda each: each.load)
        maps.append(map_of(heaviest, solution.basis, length, pressure))
    return maps


def pressures_of_true_bodies(contacts: Sequence[TrueBodies]) -> list[dict[str, Any]]:
    """The numbers of a map of each contact's pressure."""
    maps = []
    for each in contacts:
        finest = each.solved.finest
        assert finest is not None
        maps.append(map_of(each.chosen, finest.contact.frame.basis, 1.0, finest.pressure(each.chosen.load)))
    return maps


def map_of(contact: Chosen, basis: PressureBasis, length: float, pressure: Array) -> dict[str, Any]:
    """A pressure within its cells, over Hertz's: between the nodes, of which a coarse mesh has few, it is linear."""
    exact = ellipse(contact.problem)
    a, b, p0 = exact.semi_major_axis, exact.semi_minor_axis, exact.max_pressure
    (x, y), _ = basis.samples
    numbers = {"x": length * x / a, "y": length * y / b, "p": basis.values(x, y) @ pressure / p0}
    return {
        "contact": {
            "label": f"at {degrees(contact.groove.contact_angle):.2f}°",
            "name": contact.problem.name,
            "load_N": contact.load,
            "a_mm": 1e3 * a,
            "b_mm": 1e3 * b,
            "p0_MPa": 1e-6 * p0,
            "ellipse": {name: values.tolist() for name, values in numbers.items()},
        }
    }
