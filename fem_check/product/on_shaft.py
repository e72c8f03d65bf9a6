"""A set of rows on an elastic shaft: the equations that its solution must obey, from what is given alone.

Everything is counted from the reference position, on a shaft as long and thick as heat makes it. Its sections bend
under the solution's forces as a beam does; where that puts a row, together with what heat, spacers, a seat out of line
and an elastic housing add, its balls must be in equilibrium, and all forces on the shaft must sum up to nothing.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

import qsbearing as qs
from fem_check.independent import shaft_beam
from fem_check.independent.contact_problem import Array
from fem_check.independent.quasi_static import CHANNELS, BalanceProblem, Placed, alone
from fem_check.independent.shaft_beam import BeamSection
from fem_check.product.problems import LOADS, approach_of, as_preloaded, past_the_balls, row_of

NAME = "of the check"
FORCES = ("axial", "radial_y", "radial_z", "moment_y", "moment_z")
PLANES = ((1, 4, 1.0), (2, 3, -1.0))
"""Channels of force and tilt, and the sense in which a tilt is a slope: tilt z is dy/dx, tilt y is -dz/dx."""
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(12)
"""Where a piece of shaft weighs on it, on -1 to 1."""


def moved_along(arm: float) -> Array:
    """What a rigid shaft's displacement is this far along it; (5, 5)."""
    out = np.eye(5)
    out[1, 4], out[2, 3] = arm, -arm
    return out


@dataclass(frozen=True)
class OnShaft:
    """A set of two rows with one spacer between them, the first of which stays where it is, on a shaft of sections in a
    housing, both of which have a temperature; its preload is a force before fitting. One case."""

    of: qs.BearingSet
    is_cold: bool = False

    @property
    def shaft(self) -> qs.Shaft:
        """With its sections."""
        assert self.of.shaft is not None
        return self.of.shaft

    def _warmer(self, given: Any, reference: Any) -> float:
        return 0.0 if self.is_cold else float(given) - float(reference)

    @cached_property
    def strains(self) -> list[float]:
        """alpha dT of each section."""
        warmer = self._warmer(self.shaft.temperature, self.shaft.reference_temperature)
        return [float(each.material.thermal_expansion) * warmer for each in self.shaft.sections]  # type: ignore[arg-type]

    @cached_property
    def ends(self) -> list[float]:
        """Of the sections, as drawn [m]."""
        out = [self.shaft.start]
        for each in self.shaft.sections:
            out.append(out[-1] + each.length)
        return out

    def _section(self, position: float) -> int:
        return next(i for i, end in enumerate(self.ends[1:]) if position < end)

    @property
    def positions(self) -> list[float]:
        """Of the rows, as drawn [m]."""
        return [float(np.asarray(row.position)) for row in self.of.rows]

    def _grown(self, position: float) -> float:
        """By how much heat moves a place of the shaft from the reference position."""
        reference, total = float(np.asarray(self.of.reference_position)), 0.0
        for strain, begin, end in zip(self.strains, self.ends[:-1], self.ends[1:], strict=True):
            total += strain * (min(max(position, begin), end) - min(max(reference, begin), end))
        return total

    @property
    def _housing_strain(self) -> float:
        housing = self.of.housing
        assert housing is not None and housing.material.thermal_expansion is not None
        return float(np.asarray(housing.material.thermal_expansion)) * self._warmer(
            housing.temperature, housing.reference_temperature
        )

    def _spacer(self) -> tuple[float, float]:
        """By how much the spacers part inner and outer rings beyond what shaft and housing do."""
        (spacer,), (first, last) = self.of.spacers, self.positions
        inner, outer = (float(np.asarray(each)) for each in (spacer.inner_length, spacer.outer_length))
        grown = []
        for side, length in (("inner", inner), ("outer", outer)):
            expands = float(getattr(spacer, f"{side}_material").thermal_expansion)
            body = self.shaft if side == "inner" else self.of.housing
            grown.append(
                length * expands * self._warmer(getattr(spacer, f"{side}_temperature"), body.reference_temperature)  # type: ignore[union-attr]
            )
        of_shaft = inner * (self._grown(last) - self._grown(first)) / (last - first)
        return grown[0] - of_shaft + inner - outer, grown[1] - outer * self._housing_strain

    def arm(self, position: float) -> float:
        """From the reference position to a place on the shaft, as warm as it is; from the middle of the spacer on it is
        moved by the spacer."""
        beyond = position >= 0.5 * sum(self.positions)
        reference = float(np.asarray(self.of.reference_position))
        return position - reference + self._grown(position) + (self._spacer()[0] if beyond else 0.0)

    @cached_property
    def beam(self) -> list[BeamSection]:
        """The sections as they are in operation."""
        out = []
        ends = [self.arm(each) for each in self.ends]
        for section, strain, begin, end in zip(self.shaft.sections, self.strains, ends[:-1], ends[1:], strict=True):
            first, last = (
                [size * (1.0 + strain) for size in sizes]
                for sizes in zip(section.outer_diameters, section.inner_diameters, strict=True)
            )
            constants = [float(np.asarray(getattr(section.material, n))) for n in ("elastic_modulus", "poisson_ratio")]
            out.append(BeamSection(begin, end, *first, *constants, *last))
        return out

    def moved(self, at: Array, forces: Array, reference: Array, stations: Array) -> Array:
        """The shaft at `stations` under forces that balance, where its reference position is moved by this; (station,
        5)."""
        every = np.append(stations, 0.0)
        out = np.zeros((len(every), 5))
        out[:, 0] = shaft_beam.stretch(self.beam, at, forces[:, 0], every)
        for channel, tilt, sense in PLANES:
            bent = shaft_beam.shape(self.beam, at, forces[:, channel], sense * forces[:, tilt], every)
            out[:, channel], out[:, tilt] = bent[0], sense * bent[1]
        # From where its beginning stayed to where the reference position is moved by so much.
        rest = reference - out[-1]
        return np.array([each + moved_along(x) @ rest for each, x in zip(out[:-1], stations, strict=True)])

    def weights(self, stops: list[float]) -> tuple[list[float], list[Array]]:
        """Places, as drawn, and weights of the sections between these stops, and of what is fixed to the shaft."""
        gravity = np.array([*self.shaft.gravity, 0.0, 0.0])  # type: ignore[misc]
        at = [each.position for each in self.shaft.masses]
        loads = [gravity * float(np.asarray(each.mass)) for each in self.shaft.masses]
        for section, begin, end in zip(self.shaft.sections, self.ends[:-1], self.ends[1:], strict=True):
            sizes = zip(section.outer_diameters, section.inner_diameters, strict=True)
            (outer, inner), (last_outer, last_inner) = sizes
            drawn = BeamSection(begin, end, outer, inner, 1.0, 0.0, last_outer, last_inner)
            cuts = np.unique([begin, *(each for each in stops if begin < each < end), end])
            for low, high in itertools.pairwise(cuts):
                places = 0.5 * (low + high) + 0.5 * (high - low) * POINTS
                masses = 0.5 * (high - low) * WEIGHTS * drawn.area(places) * float(np.asarray(section.material.density))
                at += [float(each) for each in places]
                loads += [gravity * mass for mass in masses]
        return at, loads

    def acting(self, rows: list[Array], supports: Array, seen: Sequence[float]) -> tuple[Array, Array]:
        """Places from the reference position, and all that acts on the shaft there: loads and weights, and what rows
        and supports do.

        Args:
            seen: where else the shaft's shape is asked for: weights between such places act at single points.
        """
        held = [*self.positions, *(each.position for each in self.shaft.supports)]
        loaded = [each.position for each in self.shaft.loads]
        operation, reference = self.of.operation, float(np.asarray(self.of.reference_position))
        given = np.array([float(np.asarray(getattr(operation, name))) for name in LOADS])
        own = [np.array([float(getattr(each, name)) for name in FORCES]) for each in self.shaft.loads]
        at, weights = self.weights([*held, reference, *seen])
        # What is meant at the reference position stays there, whatever a spacer moves.
        places = [*(self.arm(each) for each in [*held, *loaded]), 0.0, *(self.arm(each) for each in at)]
        return np.array(places), np.array([*rows, *supports, *own, given, *weights])

    def to_row(self, number: int) -> Array:
        """From the shaft's displacement where a row stands to that of its inner ring, in its own frame; (5, 5)."""
        sign = self.of.rows[number].sign
        out = moved_along(sign * past_the_balls(self.row_scene(number), NAME))
        out[[0, 3, 4]] *= sign
        return out

    def row_scene(self, number: int) -> qs.Scene:
        """A row alone, turning, with what its seats take from shaft and housing."""
        row, of = self.of.rows[number], self.of
        place = self.positions[number]
        section = self.shaft.sections[self._section(place)]
        begin, (bore, last) = self.ends[self._section(place)], section.inner_diameters
        seats: dict[str, Any] = {
            "shaft_bore_diameter": bore + (place - begin) / section.length * (last - bore),
            "shaft_material": section.material, "shaft_temperature": self.shaft.temperature,
        }  # fmt: skip
        assert of.housing is not None
        around: dict[str, Any] = {
            "housing_material": of.housing.material, "housing_temperature": of.housing.temperature,
        }  # fmt: skip
        effects: list[Any] = []
        for effect in row.ring_effects or ():
            if isinstance(effect, qs.RingExpansion) and effect.shaft_interference is not None:
                effect = replace(effect, **seats)
            if isinstance(effect, qs.RingExpansion) and effect.housing_interference is not None:
                effect = replace(effect, **around)
            effects.append(effect)
        turning = {name: getattr(of.operation, name) for name in ("speed", "outer_speed", "first_ball_azimuth")}
        choices = ("raceway_control", "hertz_angle", "hertz_form", "tilt_lever", "orbit_radius", "ball_effects")
        return qs.Scene(
            row.bearing, qs.Operation(**turning), ring_effects=tuple(effects),
            **{name: getattr(of, name) for name in choices},
        )  # fmt: skip

    def offset(self, number: int) -> float:
        """By how much a row is pressed together while the shaft is at its zero, in its own direction [m]."""
        row, place = self.of.rows[number], self.positions[number]
        pressed = float(np.asarray(row.offset)) + self._preloaded(number)
        along, beside = self._spacer()
        is_beyond = place >= 0.5 * sum(self.positions)
        inner = self._grown(place) + is_beyond * along
        reference = float(np.asarray(self.of.reference_position))
        outer = self._housing_strain * (place - reference) + is_beyond * beside
        return pressed * (1.0 + self.strains[self._section(place)]) + row.sign * (inner - outer)

    def _preloaded(self, number: int) -> float:
        """By the preload: what its force presses the row alone, and lets shaft and housing draw back; cold."""
        preload, row = self.of.preload, self.of.rows[number]
        assert preload is not None and preload.rigid is not None
        force = float(np.asarray(preload.rigid))
        still = Placed(row_of(as_preloaded(self.row_scene(number), preload), NAME), alone())
        cold = replace(self, is_cold=True)
        arm = cold.arm(self.positions[number])
        pull = np.zeros((2, 5))
        pull[:, 0] = force, -force
        stretched = float(cold.moved(np.array([arm, 0.0]), pull, np.zeros(5), np.array([arm]))[0, 0])
        return approach_of((still,), force) + stretched + force * float(self.compliance(row)[0])

    @staticmethod
    def compliance(row: qs.Row) -> Array:
        """Of a row's housing, by channel."""
        of = row.housing_stiffness
        each = (None,) * 3 if of is None else (of.axial, of.radial, of.tilt)
        axial, radial, tilt = (0.0 if stiffness is None else 1.0 / stiffness for stiffness in each)
        return np.array([axial, radial, radial, tilt, tilt])

    def row_moved(self, number: int, at_row: Array, on_shaft: Array) -> Array:
        """A row's own displacement, where the shaft there is moved by this under this force of the row."""
        row = self.of.rows[number]
        names = ("housing_radial_y", "housing_radial_z", "housing_tilt_y", "housing_tilt_z")
        seat = np.array([0.0, *(float(np.asarray(getattr(row, name) or 0.0)) for name in names)])
        apart = at_row - seat + self.compliance(row) * on_shaft
        return np.asarray(self.to_row(number) @ apart + self.offset(number) * np.eye(5)[0])

    def row_problem(self, number: int, moved: Array) -> BalanceProblem:
        """A row's balls, whose inner ring is displaced by this."""
        shaft = np.append(moved, 0.0)
        placed = (Placed(row_of(self.row_scene(number), NAME), alone()),)
        return BalanceProblem(placed, np.zeros(CHANNELS), np.ones(CHANNELS, bool), shaft)

    def stiffness(self, rows: list[Array]) -> Array:
        """Of the shaft at its reference position, from that of each row (5, 5): what gives way, in series."""
        held = [self.to_row(i).T @ own @ self.to_row(i) for i, own in enumerate(rows)]
        supports = self.shaft.supports
        held += [np.diag([float(getattr(each, name)) for name in _SPRINGS]) for each in supports]
        arms = np.array([self.arm(each) for each in [*self.positions, *(each.position for each in supports)]])
        count = 5 * len(arms)
        springs, flexible = np.zeros((count, count)), np.zeros((count, count))
        for i, (own, arm) in enumerate(zip(held, arms, strict=True)):
            springs[5 * i : 5 * i + 5, 5 * i : 5 * i + 5] = own
            for channel in range(5):
                unit = np.eye(5)[channel]
                forces = np.array([unit, -moved_along(arm).T @ unit])
                bent = self.moved(np.array([arm, 0.0]), forces, np.zeros(5), arms)
                flexible[:, 5 * i + channel] = bent.reshape(-1)
        for i, row in enumerate(self.of.rows):
            at = range(5 * i, 5 * i + 5)
            flexible[at, at] += self.compliance(row)
        rigid = np.concatenate([moved_along(arm) for arm in arms])
        return np.asarray(rigid.T @ np.linalg.solve(np.eye(count) + springs @ flexible, springs @ rigid))


_SPRINGS = ("axial", "radial_y", "radial_z", "tilt_y", "tilt_z")
