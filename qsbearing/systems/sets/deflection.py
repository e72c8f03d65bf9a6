"""What a shaft does away from its reference: deflection, inner forces, stiffness of a point, and whose it is.

Forces on the shaft being known, of rows -T^T F, of supports -k u, loads f0, its displacement at a place p is

    u(p) = R(p) q + sum of C(p, a) f(a).

A small load at p, on the tangent of the rows, moves it by the compliance there. Its work is the strain energy of shaft,
rows, housings and supports (Clapeyron), which are their shares of the deflection.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.systems.sets.beam import rigid_motion
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.elastic_shaft import Places, Structure, to_row


@dataclass(frozen=True)
class ShaftPoint:
    """A named point of a solved shaft; arrays lead with the case axes. In the order x, y, z, tilt y, tilt z; SI."""

    position: float
    """[m]"""
    displacement: NDArray
    """Of the shaft there, from its zero; shape (*cases, 5)."""
    compliance: NDArray
    """What a small load there moves there; shape (*cases, 5, 5). Channels of the reference whose displacement is
    prescribed stay where they are."""
    shares: dict[str, NDArray]
    """Of its diagonal: what `shaft`, `row 1`, `housing 1`, `support 1` and the like contribute; shape (*cases, 5)."""
    axial_growth: NDArray | None
    """Of the shaft by heat, from the reference position to there, in +x [m]; not part of `displacement`; shape
    (*cases). None: the set names no temperature of it."""

    @property
    def effective_stiffness(self) -> NDArray:
        """Of each channel, a small load acting in it alone; shape (*cases, 5)."""
        return np.asarray(1.0 / np.diagonal(self.compliance, axis1=-2, axis2=-1))

    @property
    def relative_shares(self) -> dict[str, NDArray]:
        """Of each of `shares` what part of the whole it is, channel by channel; shape (*cases, 5)."""
        whole = np.diagonal(self.compliance, axis1=-2, axis2=-1)
        return {name: share / whole for name, share in self.shares.items()}


class Deflection:
    """The forces on the shaft of a solved set, and what they do along it; arrays lead with the flattened case.

    Args:
        row_loads: of the rows in their own frames; shape (row, case, 5).
        reference_load: shape (case, 5).
    """

    def __init__(
        self, of: BearingSet, shape: tuple[int, ...], structure: Structure, q: NDArray, row_loads: NDArray,
        reference_load: NDArray,
    ) -> None:  # fmt: skip
        self.places, self.structure, self.q = Places(of, shape), structure, q
        self.turned = np.stack([to_row(of, number, self.places.count) for number in range(len(of.rows))])
        self.rows = -np.einsum("rkji,rkj->kri", self.turned, row_loads)
        """Forces of rows; shape (case, row, 5)."""
        moved = np.einsum(
            "skij,kj->ski", structure.supports, q[:, : structure.supports.shape[-1]]
        )  # without any: of none
        self.supports = -np.einsum("sij,skj->ksi", self._springs, moved)
        """Forces of supports; shape (case, support, 5)."""
        self._reference_load = reference_load

    @property
    def _springs(self) -> NDArray:
        return np.array([each.stiffness for each in self.places.supports]).reshape(-1, 5, 5)

    def _acting(self, positions: list) -> tuple[NDArray, NDArray]:
        """(where, what) acts on the shaft, as these positions see it; shape (case or 1, force), (case, force, 5)."""
        loads = self.places.loads_seen_from(positions)
        at = (self.places.masters, self.places.arms([each.position for each in loads]), np.zeros((1, 1)))
        cases = max(each.shape[0] for each in at)
        every = (self.rows, self.supports, self.places.forces_of(loads), self._reference_load[:, None])
        where = [np.broadcast_to(each, (cases, each.shape[1])) for each in at]
        return np.concatenate(where, axis=1), np.concatenate(every, axis=1)

    def along(self, positions: ArrayLike) -> NDArray:
        """Displacement at these positions [m]; shape (case, position, 5)."""
        requested = list(np.atleast_1d(np.asarray(positions, float)))
        arms, (at, forces) = self.places.arms(requested), self._acting(requested)
        bent = np.einsum("kpaij,kaj->kpi", self._cases(self.places.flexibility(arms, at)), forces)
        return np.asarray(bent + np.einsum("kpij,kj->kpi", self._cases(rigid_motion(arms)), self.q[:, :5]))

    def inner_forces(self, positions: ArrayLike) -> NDArray:
        """What the shaft beyond a position, in +x, does to what is before it; shape (case, position, 5) [N, N m]."""
        requested = list(np.atleast_1d(np.asarray(positions, float)))
        arms, (at, forces) = self.places.arms(requested), self._acting(requested)
        lever = at[:, None, :] - arms[..., None]
        carried = rigid_motion(lever).swapaxes(-1, -2) * (lever > 0.0)[..., None, None]
        return np.asarray(np.einsum("kpaij,kaj->kpi", self._cases(carried), forces))

    def _cases(self, array: NDArray) -> NDArray:
        return np.broadcast_to(array, (self.places.count, *array.shape[1:]))

    def compliance(
        self, position: float, tangent: NDArray, free: list[int], rows: NDArray
    ) -> tuple[NDArray, dict[str, NDArray]]:
        """Of a point: (shape (case, 5, 5); shares of its diagonal, shape (case, 5) each).

        Args:
            tangent: of the set over its unknowns, of which these are free.
            rows: stiffness of each; shape (row, case, 5, 5).
        """
        places, structure = self.places, self.structure
        arm = places.arms([position])
        own = self._cases(places.flexibility(arm, arm)[:, 0, 0])
        to_masters = places.flexibility(places.masters, arm)[:, :, 0].swapaxes(0, 1)
        count = len(rows)
        straight = self.turned @ to_masters[:count]
        held = to_masters[count:]
        springs = self._springs[:, None]
        side = np.zeros((places.count, tangent.shape[1], 5))
        side[:, :5] = rigid_motion(arm)[:, 0].swapaxes(1, 2)
        side -= (structure.matrices.swapaxes(2, 3) @ rows @ straight).sum(axis=0)
        side -= (structure.supports.swapaxes(2, 3) @ springs @ held).sum(axis=0)
        moved = np.zeros_like(side)
        moved[:, free] = solve_known(tangent[:, free][..., free], side[:, free])
        pressed = structure.matrices @ moved + straight
        loads = rows @ pressed
        sunk = structure.supports @ moved + held
        forces = np.concatenate([-self.turned.swapaxes(2, 3) @ loads, -springs @ sunk])
        back = places.flexibility(arm, places.masters)[:, 0].swapaxes(0, 1)
        total = rigid_motion(arm)[:, 0] @ moved[:, :5] + (back @ forces).sum(axis=0) + own
        bent = places.flexibility(places.masters, places.masters)
        energy = np.einsum("akic,kabij,bkjc->kc", forces, self._cases(bent), forces)
        energy = energy + 2.0 * np.einsum("kii->ki", (back @ forces).sum(axis=0)) + np.einsum("kii->ki", own)
        parts = [] if places.beam is None else [energy]
        for number, row in enumerate(places.of.rows):
            parts.append((pressed[number] * loads[number]).sum(axis=1))
            if row.housing_stiffness is not None:
                sinks = row.housing_stiffness.compliance @ forces[number]
                parts.append((sinks * forces[number]).sum(axis=1))
        parts += [-(one * forces[count + number]).sum(axis=1) for number, one in enumerate(sunk)]
        return total, dict(zip(parts_of(places.of), parts, strict=True))


def parts_of(of: BearingSet) -> list[str]:
    """What gives way at a point of the shaft, in the order of `Deflection.compliance`."""
    shaft = of.shaft
    names = ["shaft"] if shaft is not None and shaft.sections else []
    for number, row in enumerate(of.rows, 1):
        names += [f"row {number}", *([] if row.housing_stiffness is None else [f"housing {number}"])]
    return [*names, *(f"support {number + 1}" for number in range(0 if shaft is None else len(shaft.supports)))]


def solve_known(matrices: NDArray, right_sides: NDArray) -> NDArray:
    """Of each case; NaN where a matrix is singular or not known."""
    known = np.flatnonzero(np.isfinite(matrices).all(axis=(1, 2)))
    out = np.full(right_sides.shape, np.nan)
    try:
        out[known] = np.linalg.solve(matrices[known], right_sides[known])
    except np.linalg.LinAlgError:
        for k in known:
            with suppress(np.linalg.LinAlgError):
                out[k] = np.linalg.solve(matrices[k], right_sides[k])
    return out
