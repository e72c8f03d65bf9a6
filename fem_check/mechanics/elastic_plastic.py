"""Indentation of an elastic-plastic half-space by a rigid paraboloid or cylinder, and what stays after unloading.

Two like bodies of small strains deform alike on both sides of the plane between them: each is a half-space that a rigid
body indents whose radius is twice the relative one, R' = 2R, here the unit of length. Von Mises yield with isotropic
hardening Y (1 + E p/Y)^n, p the equivalent plastic strain; radial return and its consistent tangent (Simo & Hughes,
Computational Inelasticity, 1998, boxes 3.1 and 3.2). Bilinear quadrangles, axisymmetric or in plane strain, with the
element's mean volume change (B-bar, Hughes 1980): plastic flow would lock them otherwise. Contact without friction at
the surface's nodes: Newton's method on displacements and on the set of nodes in contact together.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from fem_check.elements.linear_solver import factorise
from fem_check.independent.contact_problem import Array, ElasticConstants
from fem_check.mechanics.contact import ContactError

VOLUME = np.array([1.0, 1.0, 1.0, 0.0])
DEVIATOR = np.diag([1.0, 1.0, 1.0, 0.5]) - np.outer(VOLUME, VOLUME) / 3.0
"""Strains are (rr, zz, tt, 2 rz), stresses (rr, zz, tt, rz)."""
SIZE, GROWTH = 400.0, 1.3
"""Of the meshed quarter, clamped, in contact radii (a line's stresses, which fall like 1/r, are 5 % off at 15 of them);
and of each element over the one before, outside 1.5 contact radii."""
INCREMENTS, HALVINGS = 15, 5
"""Of the indentation; of one that does not converge."""


class PlasticState(NamedTuple):
    """Displacements; at the Gauss points plastic strain, its equivalent, stress; nodes in contact, and their forces."""

    moved: Array
    plastic: Array
    hardening: Array
    stress: Array
    touching: Array
    forces: Array


@dataclass(frozen=True)
class Indentation:
    """A half-space, pressed to Hertz's load of a largest pressure [Pa]; yield stress [Pa], infinite: elastic."""

    material: ElasticConstants
    yield_stress: float
    exponent: float
    max_pressure: float
    elements: int
    """Per contact radius."""
    is_line: bool = False
    """A cylinder in plane strain, else a paraboloid."""

    @property
    def radius(self) -> float:
        """Hertz's a = pi p0 R'/(2 E'), of a line 2 p0 R'/E' (Johnson 1985, eqs 4.22 to 4.24 and 4.43)."""
        return (2.0 if self.is_line else 0.5 * pi) * self.max_pressure * self.material.compliance

    @property
    def load(self) -> float:
        """2/3 pi a^2 p0; of a line, of which half is meshed, pi a p0/4 for each length."""
        return pi * self.radius * self.max_pressure * (0.25 if self.is_line else 2.0 / 3.0 * self.radius)

    @cached_property
    def lines(self) -> Array:
        """Mesh lines in r, and in depth."""
        step = self.radius / self.elements
        lines = list(step * np.arange(round(1.5 * self.elements) + 1))
        while lines[-1] < SIZE * self.radius:
            step *= GROWTH
            lines.append(lines[-1] + step)
        return np.array(lines)

    @cached_property
    def _mesh(self) -> tuple[Array, Array, Array, Array]:
        """Node numbers, each element's unknowns, strains of these (element, point, 4, 8), and the points' volumes."""
        n = np.arange(len(self.lines) ** 2).reshape(len(self.lines), -1)
        corners = np.stack([n[:-1, 1:], n[1:, 1:], n[1:, :-1], n[:-1, :-1]], axis=-1).reshape(-1, 4)
        r, z = (each.ravel()[corners] for each in np.meshgrid(self.lines, -self.lines, indexing="ij"))
        strains, volume = np.zeros((len(corners), 4, 4, 8)), np.zeros((len(corners), 4))
        for point, (x, y) in enumerate(np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) / np.sqrt(3.0)):
            shapes = 0.25 * np.array([(1 - x) * (1 - y), (1 + x) * (1 - y), (1 + x) * (1 + y), (1 - x) * (1 + y)])
            slopes = 0.25 * np.array([[y - 1, 1 - y, 1 + y, -1 - y], [x - 1, -1 - x, 1 + x, 1 - x]])
            jacobian = np.einsum("ak,ekc->eac", slopes, np.stack([r, z], axis=-1))
            along, radius = np.einsum("eca,ak->eck", np.linalg.inv(jacobian), slopes), r @ shapes
            strains[:, point, 0, 0::2] = strains[:, point, 3, 1::2] = along[:, 0]
            strains[:, point, 1, 1::2] = strains[:, point, 3, 0::2] = along[:, 1]
            strains[:, point, 2, 0::2] = 0.0 if self.is_line else shapes / radius[:, None]
            volume[:, point] = (1.0 if self.is_line else 2.0 * pi * radius) * np.linalg.det(jacobian)
        own = np.einsum("i,egij->egj", VOLUME, strains)
        mean = np.einsum("eg,egj->ej", volume, own) / volume.sum(axis=1)[:, None]
        strains += VOLUME[:, None] / 3.0 * (mean[:, None] - own)[:, :, None]
        return n, np.stack([2 * corners, 2 * corners + 1], axis=-1).reshape(-1, 8), strains, volume

    def _returned(self, moved: Array, before: PlasticState) -> tuple[Array, Array, Array, Array]:
        """Stresses, tangents, plastic strains and hardening at displacements, from the state before."""
        e, nu = self.material.elastic_modulus, self.material.poisson_ratio
        bulk, shear = e / (3.0 - 6.0 * nu), e / (2.0 + 2.0 * nu)
        _, unknowns, strains, _ = self._mesh
        strain = np.einsum("egij,ej->egi", strains, moved[unknowns]) - before.plastic
        trial = 2.0 * shear * strain @ DEVIATOR
        norm = np.sqrt((trial[..., :3] ** 2).sum(axis=-1) + 2.0 * trial[..., 3] ** 2)
        mises = np.sqrt(1.5) * norm
        step, slope = np.zeros_like(mises), np.zeros_like(mises)
        if np.isfinite(self.yield_stress):
            y, n = self.yield_stress, self.exponent
            flows = mises > y * (1.0 + e * before.hardening / y) ** n * (1.0 + 1e-12)
            for _ in range(20):
                at = 1.0 + e * (before.hardening + step) / y
                slope = n * e * at ** (n - 1.0)
                step = flows * np.maximum(step + (mises - 3.0 * shear * step - y * at**n) / (3.0 * shear + slope), 0.0)
        kept = (1.0 - 3.0 * shear * step / np.maximum(mises, 1e-300))[..., None]
        normal = trial / np.maximum(norm, 1e-300)[..., None]
        lost = np.where(step > 0.0, 1.0 / (1.0 + slope / (3.0 * shear)) - 1.0 + kept[..., 0], 0.0)[..., None, None]
        flow_tangent = kept[..., None] * DEVIATOR - lost * normal[..., :, None] * normal[..., None, :]
        tangent = bulk * np.outer(VOLUME, VOLUME) + 2.0 * shear * flow_tangent
        flow = np.sqrt(1.5) * step[..., None] * normal * np.array([1.0, 1.0, 1.0, 2.0])
        stress = kept * trial + bulk * (strain @ VOLUME)[..., None] * VOLUME
        return stress, tangent, before.plastic + flow, before.hardening + step

    def pressed(self, depth: float | None, before: PlasticState) -> PlasticState:
        """The state at an indentation, or (None) without the indenter; ContactError where it does not converge."""
        numbers, unknowns, strains, volume = self._mesh
        size, surface = 2 * numbers.size, 2 * numbers[:, 0] + 1
        held = np.zeros(size, dtype=bool)
        for fixed in (2 * numbers[0], *(2 * edge + k for edge in (numbers[-1], numbers[:, -1]) for k in (0, 1))):
            held[fixed] = True
        indenter = np.full(len(self.lines), np.inf) if depth is None else 0.5 * self.lines**2 - depth
        pairs = [np.repeat(unknowns, 8, axis=1).ravel(), np.tile(unknowns, 8).ravel()]
        moved, touching = before.moved, before.touching & (depth is not None)
        for iteration in range(40):
            stress, tangent, plastic, hardening = self._returned(moved, before)
            forces = np.einsum("eg,egij,egi->ej", volume, strains, stress)
            forces = np.bincount(unknowns.ravel(), forces.ravel(), size)
            if not np.isfinite(forces).all():
                break
            over = moved[surface] - indenter
            now = np.where(touching, (forces[surface] < 0.0) | (iteration == 0), over > 0.0)
            free = ~held
            free[surface[now]] = False
            left = float(np.abs(forces[free]).max()) / max(float(np.abs(forces).max()), 1e-300)
            fits = not now.any() or float(np.abs(over[now]).max()) < 1e-9 * self.radius**2
            # Without the indenter all forces vanish together, and one step of Newton's method takes them away.
            if iteration and fits and (now == touching).all() and left < (1e-6 if now.any() else np.inf):
                return PlasticState(moved, plastic, hardening, stress, touching, -forces[surface] * touching)
            touching, change = now, np.zeros(size)
            change[surface[now]] = -over[now]
            blocks = np.einsum("eg,egki,egkl,eglj->eij", volume, strains, tangent, strains, optimize=True)
            matrix = sp.csr_matrix((blocks.ravel(), pairs), (size, size))
            change[free] = factorise(sp.csc_matrix(matrix[free][:, free])).solve((-forces - matrix @ change)[free])
            moved = moved + change
        raise ContactError(f"the indentation of {self.elements} elements did not converge")

    def _deeper(self, depth: float, by: float, before: PlasticState, halvings: int = HALVINGS) -> PlasticState:
        try:
            with np.errstate(over="ignore", invalid="ignore"):
                return self.pressed(depth + by, before)
        except (ContactError, RuntimeError, ValueError):
            if not halvings:
                raise
        half = self._deeper(depth, 0.5 * by, before, halvings - 1)
        return self._deeper(depth + 0.5 * by, 0.5 * by, half, halvings - 1)

    def loaded(self) -> PlasticState:
        """At the load."""
        numbers, _, strains, volume = self._mesh
        points, nodes, zero = np.zeros(volume.shape), np.zeros(len(numbers)), np.zeros_like(strains[..., 0])
        state = PlasticState(np.zeros(2 * numbers.size), zero, points, zero, np.arange(len(nodes)) == 0, nodes)
        step, depth, load = self.radius**2 * (2.0 if self.is_line else 1.0) / INCREMENTS, 0.0, 0.0
        for _ in range(10 * INCREMENTS):
            further = self._deeper(depth, step, state)
            total = float(further.forces.sum())
            if abs(total / self.load - 1.0) < 1e-5:
                return further
            if total < self.load:
                depth, state, load = depth + step, further, total
            else:
                step *= (self.load - load) / (total - load)
        raise ContactError("the load was not reached")

    def dent(self, loaded: PlasticState) -> float:
        """Depth at the centre once unloaded, over R'."""
        return -float(self.pressed(None, loaded).moved[2 * self._mesh[0][0, 0] + 1])

    def contact_radius(self, loaded: PlasticState) -> float:
        """From the forces' second moment: 2 a^2/5, of a line a^2/4."""
        second = float(loaded.forces @ self.lines**2 / loaded.forces.sum())
        return float(np.sqrt((4.0 if self.is_line else 2.5) * second))

    def largest_mises(self, loaded: PlasticState) -> float:
        """Of any element, the mean of its points [Pa]."""
        part = loaded.stress - (loaded.stress @ VOLUME / 3.0)[..., None] * VOLUME
        squares = (part[..., :3] ** 2).sum(axis=-1) + 2.0 * part[..., 3] ** 2
        return float(np.sqrt(1.5 * squares).mean(axis=1).max())
