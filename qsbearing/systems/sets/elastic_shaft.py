"""The elastic shaft and elastic housings: what rows and supports move in addition to the rigid motion of the reference.

The shaft is clamped at the reference position and moves with it by q. Forces f of rows and supports, and loads f0 of
the shaft, its weight among them, move their places by

    u = R q + C f + C0 f0 - h,

C from the beam, and for a row from its housing too; h is how far a row's housing is out of line. C = A A^T makes
C f = A n of unknowns n that obey n = A^T f,
at the minimum of the energy of rows, supports and n. In the units of lengths these equations stay well conditioned
however stiff the shaft is, and without elasticity none of them is there.

    rows:      sum of G^T F(G q + offset) + S q = load,      G = T [R, slide, A, C0 f0 - h]

with T from a place on the shaft to the row's own frame, S of n and of the supports, and 1 in q for the
loads and what is out of line. A rigid shaft has no C.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from qsbearing.systems.sets.beam import Beam, flexibility, rigid_motion
from qsbearing.systems.sets.bearing_set import BearingSet, numbers_around
from qsbearing.systems.sets.rigid_shaft import UNKNOWNS, arms_along, own_lever, row_matrices
from qsbearing.systems.sets.shaft import Shaft, ShaftLoad
from qsbearing.systems.sets.weight import weight

PLANES = ((0,), (1, 4), (2, 3))
"""Channels that a round shaft in housings without couplings keeps apart: along, in xy, in xz."""
TOGETHER = ((0, 1, 2, 3, 4),)
NEGLIGIBLE = 1e-14
"""Of the softest direction: what is stiffer than that in comparison does not move. Rounding of the eigenvalues."""
START_DEFLECTION = 1e-3
"""Of the ball diameter: rows' stiffness there makes a first guess of how loads of the shaft bend it."""


@dataclass
class Structure:
    """Shaft, housings and supports around the rows of a set, over its flattened cases; unknowns as in `Stretch`."""

    matrices: NDArray
    """G of each row; shape (row, case, 5, unknown)."""
    elasticity: NDArray
    """S; shape (case, unknown, unknown), or of no case where all is rigid."""
    load: NDArray
    """Of the shaft's own loads; shape (case, unknown)."""
    planes: tuple[tuple[int, slice], ...]
    """(number of the plane in `PLANES`, or -1: all together; its elastic unknowns)."""
    rigid: int
    """Up to this unknown they are those of rigid bodies: the shaft, rings and sleeves that slide."""
    given: int
    """From this unknown on they are held at 1: the column of the shaft's loads and of what is out of line."""
    supports: NDArray = field(default_factory=lambda: np.zeros((0, 1, 5, UNKNOWNS)))
    """What displaces each support; shape (support, case, 5, unknown)."""

    @property
    def bends_askew(self) -> bool:
        """Whether some housing moves in one plane under what acts in another."""
        return any(plane == -1 for plane, _ in self.planes)

    def bends_in(self, plane: int) -> NDArray:
        """Where loads of the shaft act in a plane; shape (case,)."""
        channels = list(PLANES[plane])
        moved = (self.matrices[..., self.given :] != 0.0).any(axis=(0, -1))
        return np.asarray((self.load[:, channels] != 0.0).any(axis=1) | moved[:, channels].any(axis=1))

    def unknowns_in(self, plane: int) -> list[int]:
        """Elastic ones that move nothing out of a plane."""
        return [i for own, unknowns in self.planes if own == plane for i in range(unknowns.start, unknowns.stop)]


def structure_of(of: BearingSet, shape: tuple[int, ...], length: NDArray) -> Structure:
    """That of a set.

    Args:
        length: makes tilts lengths; shape (case,) [m].
    """
    rigid = row_matrices(of, shape)
    springs = np.zeros((rigid.shape[1], rigid.shape[-1]))
    for number, group in enumerate(of.floating, UNKNOWNS):
        springs[:, number] = np.broadcast_to(np.asarray(group.spring, float), shape).reshape(-1)
    if of.shaft is None and all(row.housing_stiffness is None and not row.is_out_of_line for row in of.rows):
        none = np.zeros((0, rigid.shape[-1], rigid.shape[-1]))
        return Structure(rigid, none, springs, (), rigid.shape[-1], rigid.shape[-1])
    structure = _elastic(of, shape, rigid, length)
    structure.load[:, : springs.shape[1]] += springs
    return structure


class Places:
    """Rows and supports on the shaft, its loads, and the beam; arrays lead with the case, one where all are alike."""

    def __init__(self, of: BearingSet, shape: tuple[int, ...]) -> None:
        self.of, self.shaft = of, of.shaft
        self.shape, self.count = shape, int(np.prod(shape))
        self.supports = () if self.shaft is None else self.shaft.supports
        masters = [row.position for row in of.rows] + [each.position for each in self.supports]
        self.masters, self._cuts = self.arms(masters), [*masters, of.reference]
        self.loads = self.loads_seen_from([])
        self.loaded = self.arms([each.position for each in self.loads])
        self.beam = _warm_beam(of, self.shaft, self) if self.shaft is not None and self.shaft.sections else None

    def loads_seen_from(self, positions: list) -> tuple[ShaftLoad, ...]:
        """Of the shaft and its weight, as rows, supports and these positions see them exactly."""
        return () if self.shaft is None else (*self.of.shaft_loads, *weight(self.shaft, [*self._cuts, *positions]))

    def arms(self, positions: list) -> NDArray:
        """From the reference, warm; shape (case or 1, position)."""
        return arms_along(self.of, positions, self.shape) if positions else np.zeros((1, 0))

    def flexibility(self, at: NDArray, loaded: NDArray) -> NDArray:
        """The beam's; shape (case or 1, at, loaded, 5, 5); nothing of a rigid shaft."""
        if self.beam is None:
            return np.zeros((1, at.shape[-1], loaded.shape[-1], 5, 5))
        cases = np.broadcast_shapes(at.shape[:1], loaded.shape[:1], self.beam.begin.shape[:1])[0]
        at, loaded = (np.broadcast_to(each, (cases, each.shape[-1])) for each in (at, loaded))
        return flexibility(self.beam, np.zeros(cases), at, loaded)

    def own_flexibility(self) -> NDArray:
        """Of rows and supports, housings included; shape (case or 1, place, place, 5, 5)."""
        out = self.flexibility(self.masters, self.masters)
        for number, row in enumerate(self.of.rows):
            if row.housing_stiffness is not None:
                out[:, number, number] += row.housing_stiffness.compliance
        return out

    def forces_of(self, loads: tuple[ShaftLoad, ...]) -> NDArray:
        """Shape (case, load, 5)."""
        flat = [[np.broadcast_to(v, self.shape).reshape(-1) for v in load.values] for load in loads]
        return np.array(flat, float).reshape(len(loads), 5, self.count).transpose(2, 0, 1)

    def out_of_line(self) -> NDArray:
        """How far housings of rows are; shape (case, place, 5)."""
        out = np.zeros((self.count, self.masters.shape[1], 5))
        for number, row in enumerate(self.of.rows):
            for channel, value in enumerate(row.out_of_line, 1):
                out[:, number, channel] = np.broadcast_to(value, self.shape).reshape(-1)
        return out


def _warm_beam(of: BearingSet, shaft: Shaft, places: Places) -> Beam:
    """About the reference position, as long and thick as heat makes it."""
    ends = places.arms(list(shaft.ends))
    strains = shaft.strains
    if strains.ndim > 1:
        strains = np.broadcast_to(strains, (*places.shape, strains.shape[-1])).reshape(-1, strains.shape[-1])
    grown = 1.0 + np.atleast_2d(strains)
    grown, begin, end = np.broadcast_arrays(grown, ends[:, :-1], ends[:, 1:])
    sections = shaft.sections
    outer, inner = (
        np.array([(first, last - first) for first, last in ends]).T
        for ends in ([each.outer_diameters for each in sections], [each.inner_diameters for each in sections])
    )
    modulus, ratio = (
        np.array([float(np.asarray(getattr(each.material, name))) for each in sections])
        for name in ("elastic_modulus", "poisson_ratio")
    )
    outer, inner = (np.stack([each * grown for each in side]) for side in (outer, inner))
    return Beam(begin, end, outer, inner, modulus, ratio)


def to_row(of: BearingSet, number: int, cases: int) -> NDArray:
    """T, from the displacement of a row's place on the shaft to the row's own frame; shape (case, 5, 5)."""
    row = of.rows[number]
    out = rigid_motion(np.broadcast_to(np.asarray(own_lever(of, row), float).reshape(-1), (cases,)))
    out[:, (0, 3, 4)] *= row.sign
    return out


def _elastic(of: BearingSet, shape: tuple[int, ...], rigid: NDArray, length: NDArray) -> Structure:
    places = Places(of, shape)
    count, first = places.count, rigid.shape[-1]
    flexible = places.own_flexibility()
    coupled = any(row.housing_stiffness is not None and _couples(row.housing_stiffness.compliance) for row in of.rows)
    columns, stiffness, planes = [], [], []
    for number, channels in enumerate(TOGETHER if coupled else PLANES):
        some, resists = _modes(flexible, channels, length)
        planes.append((-1 if coupled else number, slice(first, first + resists.shape[-1])))
        first += resists.shape[-1]
        columns.append(some)
        stiffness.append(resists)
    forces = places.forces_of(places.loads)
    if places.loads or any(row.is_out_of_line for row in of.rows):
        moved = np.einsum("kmlij,klj->kmi", places.flexibility(places.masters, places.loaded), forces)
        columns.append((moved - places.out_of_line())[..., None])
        stiffness.append(np.zeros((1, 1)))
    cases = np.broadcast_shapes(*(each.shape[:1] for each in columns))[0]
    elastic = np.concatenate([np.broadcast_to(each, (cases, *each.shape[1:])) for each in columns], axis=-1)
    resists = np.concatenate([np.broadcast_to(each, (cases, each.shape[-1])) for each in stiffness], axis=-1)
    total = rigid.shape[-1] + elastic.shape[-1]
    rows = len(of.rows)
    matrices = np.zeros((rows, count, 5, total))
    matrices[..., : rigid.shape[-1]] = rigid
    for number in range(rows):
        matrices[number, ..., rigid.shape[-1] :] = to_row(of, number, count) @ elastic[:, number]
    elasticity = np.zeros((count, total, total))
    diagonal = np.arange(rigid.shape[-1], total)
    elasticity[:, diagonal, diagonal] = resists
    supports = np.zeros((len(places.supports), count, 5, total))
    for number, (support, own) in enumerate(zip(places.supports, supports, strict=True), rows):
        own[..., :5] = rigid_motion(places.masters[:, number])
        own[..., rigid.shape[-1] :] = elastic[:, number]
        elasticity += own.swapaxes(1, 2) @ support.stiffness @ own
    load = np.zeros((count, total))
    if places.loads:
        load[:, :5] = np.einsum("klji,klj->ki", rigid_motion(places.loaded), forces)
    return Structure(matrices, elasticity, load, tuple(planes), rigid.shape[-1], first, supports)


def _couples(compliance: NDArray) -> bool:
    """Whether a housing moves in one plane under what acts in another."""
    apart = np.ones((5, 5), bool)
    for channels in PLANES:
        apart[np.ix_(channels, channels)] = False
    return bool((compliance[apart] != 0.0).any())


def _modes(own: NDArray, channels: tuple[int, ...], length: NDArray) -> tuple[NDArray, NDArray]:
    """Directions in which places move without their reference, each of the length 1 at its largest, and what resists
    them.

    Returns:
        Of shape (case, place, 5, mode) and (case, mode).
    """
    cases, places = own.shape[:2]
    lengths = [length[:cases, None] if channel >= 3 else np.ones((cases, 1)) for channel in channels]
    scale = np.tile(np.concatenate(lengths, axis=1), places)
    block = own[..., np.array(channels)[:, None], np.array(channels)].swapaxes(2, 3).reshape(cases, scale.shape[1], -1)
    values, vectors = np.linalg.eigh(block * scale[:, :, None] * scale[:, None, :])
    moves = values > NEGLIGIBLE * np.maximum(values[:, -1:], 0.0)
    kept = moves.any(axis=0)
    values, vectors, moves = values[:, kept], vectors[:, :, kept], moves[:, kept]
    with np.errstate(divide="ignore", invalid="ignore"):
        largest = np.abs(vectors).max(axis=1)
        resists = np.where(moves, 1.0 / (values * largest**2), 1.0)
        columns = np.where(moves[:, None], vectors / largest[:, None], 0.0) / scale[:, :, None]
    out = np.zeros((cases, places, 5, resists.shape[-1]))
    out[:, :, np.array(channels)] = columns.reshape(cases, places, len(channels), -1)
    return out, resists


def axial_deflection(of: BearingSet, loads: list[NDArray]) -> list[NDArray]:
    """How far shaft and housings let each row draw back in the direction that it carries, under rows' axial loads in
    theirs [m]; of a set at rest and cold, its shaft unloaded."""
    given = (of.reference, *(row.position for row in of.rows), *numbers_around(of), *loads)
    shape = np.broadcast_shapes(*(np.shape(each) for each in given if each is not None))
    places, signs = Places(of, shape), np.array([row.sign for row in of.rows])
    rows = len(of.rows)
    axial = places.own_flexibility()[:, :rows, :rows, 0, 0] * signs[:, None] * signs
    pressed = np.stack([np.broadcast_to(load, shape).reshape(-1) for load in loads], axis=-1)
    deflection = np.einsum("kij,kj->ki", np.broadcast_to(axial, (places.count, rows, rows)), pressed)
    return [deflection[:, number].reshape(shape)[()] for number in range(rows)]
