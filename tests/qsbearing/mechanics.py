"""Mechanics in three dimensions, written from vectors: what solved balls must satisfy, with nothing of the kernel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from tests.qsbearing.scenes import lever, moment_shares

AXIS = np.array([1.0, 0.0, 0.0])


@dataclass(frozen=True)
class Vectors:
    """One case's contacts as vectors; every array has shape (ball, 3)."""

    radial: NDArray
    """Unit vector from the axis to the ball."""
    tangent: NDArray
    """Unit vector of the ball's travel, axis x radial."""
    inner_normal: NDArray
    """From the inner contact to the ball's centre."""
    outer_normal: NDArray
    """From the ball's centre to the outer contact."""
    inner_pull: NDArray
    """Force on the ball at the inner contact, friction included."""
    outer_pull: NDArray
    """Force on the ball at the outer contact, friction included."""


def ball_diameters(solution: qs.Solution, operating: bool = True) -> NDArray:
    """Each ball's own diameter (ball), in operation or cold: balls that deviate cold do so in proportion when grown."""
    bearing = solution.scene.operating_bearing if operating else solution.scene.bearing
    deviation = solution.ball_diameter_deviation
    relative = (
        np.zeros_like(solution.azimuth) if deviation is None else deviation / solution.scene.bearing.ball_diameter
    )
    return float(np.asarray(bearing.ball_diameter)) * (1.0 + relative)


def lobe(solution: qs.Solution) -> NDArray:
    """By how much seats out of round bring the grooves nearer at each ball (ball), by complex numbers."""
    seats, total = solution.scene.seats_out_of_round, np.zeros(len(solution.azimuth), complex)
    if seats is not None:
        for ring, sense in (("inner", 1.0), ("outer", -1.0)):
            for number, word in ((2, "two"), (3, "three")):
                size, phase = (getattr(seats, f"{ring}_{word}_lobe_{what}") for what in ("amplitude", "phase"))
                total = total + sense * (size or 0.0) * np.exp(1j * number * (solution.azimuth - (phase or 0.0)))
    return total.real


def vectors(solution: qs.Solution) -> Vectors:
    """The contacts of a single case: normals from the angles, forces from the loads, friction from the moments."""
    psi = solution.azimuth
    zero = np.zeros_like(psi)
    radial = np.stack([zero, np.cos(psi), np.sin(psi)], axis=-1)
    normals, pulls = {}, {}
    if solution.gyroscopic_moment is None:
        friction = {"inner": zero, "outer": zero}
    else:
        force = solution.gyroscopic_moment / ball_diameters(solution)
        share_i, share_o = moment_shares(solution.scene, solution.raceway_control)
        friction = {"inner": share_i * force, "outer": share_o * force}
    for race, sense in (("inner", 1.0), ("outer", -1.0)):
        contacts = getattr(solution, race)
        angle = np.where(contacts.load > 0.0, contacts.angle, 0.0)
        normal = np.sin(angle)[:, None] * AXIS + np.cos(angle)[:, None] * radial
        across = np.cos(angle)[:, None] * AXIS - np.sin(angle)[:, None] * radial
        normals[race] = normal
        pulls[race] = sense * (contacts.load[:, None] * normal - friction[race][:, None] * across)
    return Vectors(radial, np.cross(AXIS, radial), normals["inner"], normals["outer"], pulls["inner"], pulls["outer"])


def ring_load(solution: qs.Solution) -> NDArray:
    """The load that holds the inner ring against its balls: forces at the contact points, moments about the centre.

    The inner groove's centre stands at the tilt lever from the axis; the contact lies a groove radius from it.
    """
    v = vectors(solution)
    groove_radius = float(np.asarray(solution.scene.operating_bearing.inner_groove_radius))
    contact = lever(solution.scene) * v.radial - groove_radius * v.inner_normal
    moment = np.cross(contact, v.inner_pull).sum(axis=0)
    return np.array([*v.inner_pull.sum(axis=0), moment[1], moment[2]])


def contact_stiffness(solution: qs.Solution, race: str) -> NDArray:
    """Q/delta^1.5 of every contact of a race, by the public Hertz contact at the angle that the scene asks for."""
    bearing, scene = solution.scene.operating_bearing, solution.scene
    side = -1.0 if race == "inner" else 1.0
    pitch = float(np.asarray(bearing.pitch_diameter))
    groove = float(np.asarray(getattr(bearing, f"{race}_groove_radius")))
    angles = getattr(solution, race).angle
    if scene.hertz_angle is qs.HertzAngle.FREE:
        angles = np.full_like(angles, float(np.asarray(bearing.free_contact_angle)))
    elif scene.hertz_angle is qs.HertzAngle.ZERO:
        angles = np.zeros_like(angles)
    values = []
    for angle, diameter in zip(np.nan_to_num(angles), ball_diameters(solution), strict=True):
        rolling = 2.0 / (diameter * (1.0 + side * diameter / pitch * np.cos(angle)))
        across = 2.0 / diameter - 1.0 / groove
        modulus = float(bearing.effective_modulus)
        values.append(qs.point_contact(1.0, rolling, across, modulus, scene.hertz_form).stiffness_constant)
    return np.array(values)


def stored_energy(solution: qs.Solution) -> float:
    """Elastic energy of all contacts, the integral 2/5 K delta^2.5 of Q over delta [J]."""
    total = 0.0
    for race in ("inner", "outer"):
        approach = np.maximum(np.nan_to_num(getattr(solution, race).approach), 0.0)
        total += float((0.4 * contact_stiffness(solution, race) * approach**2.5).sum())
    return total
