"""Where the shaft of a set is likely to be, so that no row starts far from its equilibrium.

Loads of an elastic shaft bend it, on rows as stiff as balls are at a small deflection. And without a load along it, a
row under a load across moves until its contact angles are zero, where its grooves leave the balls half of the diametral
clearance: nothing resists in this gap, and no imbalance says how far it reaches.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.systems.sets.elastic_shaft import START_DEFLECTION, Structure
from qsbearing.systems.sets.rigid_shaft import SLIDE, UNKNOWNS

SOFTER = 1e-3
"""Of their stiffness against tilt: as gaps close, rows follow the shaft."""


def begin(
    structure: Structure, part: slice, cases: NDArray, offsets: NDArray, load: NDArray, held: NDArray, place: NDArray,
    lever: NDArray, play: NDArray,
) -> tuple[NDArray, NDArray]:  # fmt: skip
    """Values of what is held, and a start of the rest, (case, unknown); and which cases have gaps to be closed.

    Args:
        part: of the structure's cases, those that the other arrays have.
        cases, offsets: (row, case), offsets counting from where a row touches in operation [m].
        load, held, place: of the unknowns, (case, unknown); places of those that are not held are zero.
        lever: makes forces of moments [m].
        play: from where to where rows let the shaft go, (case, 2); not a number where none has two sides [m].
    """
    rests, place = _in_play(load, held, place, play)
    matrices, is_bent = structure.matrices[:, part], structure.given < place.shape[1]
    stays = held.copy()
    stays[:, 0] |= rests
    moved, gaps = _along(structure.rigid, cases, matrices, offsets, load, stays, place)
    place = np.where(rests[:, None], moved, place)  # rings that slide, amid theirs
    across = (load[:, 1:5] != 0.0).any(axis=1)
    gapped = across & (gaps > 0.0).any(axis=0)
    loose = gapped | (across & ~cases["one_sided"].all(axis=0))
    if not is_bent and not gapped.any():
        return place, loose
    place = np.where(gapped[:, None], moved, place)
    held = held.copy()
    held[:, [0, *range(SLIDE, structure.rigid), *structure.unknowns_in(0)]] = True
    contact = cases["series_stiffness"] * cases["force"] / cases["length"]
    stiffness = 0.5 * cases["ball_count"] * contact * START_DEFLECTION**0.5
    springs = np.zeros((*cases.shape, 5))
    springs[..., 1:3] = stiffness[..., None]
    springs[..., 3:] = (stiffness * lever**2)[..., None]

    def moved_by(force: NDArray, rest: NDArray) -> NDArray:
        """On such rows, by these forces beside those where the shaft rests."""
        matrix = np.einsum("rkia,rki,rkib->kab", matrices, springs, matrices)
        matrix = matrix + structure.elasticity[part] if structure.elasticity.size else matrix
        force = np.where(held, 0.0, force - np.einsum("kij,kj->ki", matrix, rest))
        matrix[held[:, :, None] | held[:, None, :]] = 0.0
        matrix[:, range(held.shape[1]), range(held.shape[1])] += np.where(held, 1.0, 0.0)
        return np.asarray(np.linalg.solve(matrix, force[..., None])[..., 0])

    bent = moved_by(load, place)
    if gapped.any():
        way = np.einsum("rkij,kj->rki", matrices, bent)[..., 1:3]
        closed = _closing(cases, way, springs[..., 1:3] * way, gaps)
        springs[..., 3:] *= SOFTER
        pushed = np.einsum("rkia,rki->ka", matrices[:, :, 1:3], springs[..., 1:3] * closed)
        bent = np.where(gapped[:, None], bent * is_bent + moved_by(pushed, np.zeros_like(place)), bent)
    return np.where((gapped | is_bent)[:, None], place + bent, place), loose


def _in_play(load: NDArray, held: NDArray, place: NDArray, play: NDArray) -> tuple[NDArray, NDArray]:
    """Which shafts are without any load; and those amid their play, or as near their zero as rows on one side allow."""
    low, high = play.T
    with np.errstate(invalid="ignore"):
        amid = np.where(np.isfinite(low + high), 0.5 * (low + high), np.clip(0.0, low, high))
        rests = ~held[:, 0] & (load[:, :SLIDE] == 0.0).all(axis=1) & (low <= high)
    place = place.copy()
    place[:, 0] += np.where(rests, amid, 0.0)
    return rests, place


def _closing(cases: NDArray, way: NDArray, load: NDArray, gaps: NDArray) -> NDArray:
    """How rows with a gap move across the shaft, y and z, until balls carry the load; shape (row, case, 2) [m]."""
    size = np.linalg.norm(way, axis=-1)
    between = 2.0 * np.pi / cases["ball_count"]
    ahead = np.arctan2(way[..., 1], way[..., 0]) - cases["first_azimuth"]
    nearest = np.abs(ahead - between * np.round(ahead / between))
    # Stribeck's largest ball load, 4.37 Fr/Z, as for one bearing.
    contact = cases["ball_count"] * cases["series_stiffness"] * cases["force"]
    pressed = cases["length"] * (4.37 * np.linalg.norm(load, axis=-1) / contact) ** (2.0 / 3.0)
    far = np.where(gaps > 0.0, gaps / np.cos(nearest) + pressed, 0.0)
    return np.divide(way, size[..., None], out=np.zeros_like(way), where=size[..., None] > 0.0) * far[..., None]


def _along(
    rigid: int, cases: NDArray, matrices: NDArray, offsets: NDArray, load: NDArray, held: NDArray, place: NDArray
) -> tuple[NDArray, NDArray]:
    """The shaft, and each sleeve without a spring, as near as may be to where contact angles are zero, without pressing
    a row axially; and the radial gap there of rows that no load along the shaft centres, shape (row, case) [m]."""
    along = matrices[..., 0, :]
    span = cases["length"] * (cases["inner_coefficient"] + cases["outer_coefficient"] - 1.0)
    touching = span * cases["sin_free"]
    place, loose = place.copy(), np.zeros(offsets.shape, bool)
    for column in (0, *range(UNKNOWNS, rigid)):
        way = along[..., column]
        after = np.s_[max(column + 1, SLIDE) : rigid]
        later = ((along[..., after] != 0.0) & ~held[:, after]).any(axis=-1)
        own = (way != 0.0) & ~later
        free = ~held[:, column] & (load[:, column] == 0.0)
        base = offsets + np.einsum("rkj,kj->rk", along, place)
        back = np.where(cases["one_sided"], np.inf, base + 2.0 * touching)  # to the other side of both grooves
        most = np.where(own, np.where(way > 0.0, -base, back), np.inf).min(axis=0)
        least = np.where(own, np.where(way < 0.0, base, -back), -np.inf).max(axis=0)
        count = np.maximum(own.sum(axis=0), 1)
        middle = -(np.where(own, way * (base + touching), 0.0)).sum(axis=0) / count
        place[:, column] += np.where(free & (least <= most), np.clip(middle, least, np.maximum(least, most)), 0.0)
        loose |= own & (free | held[:, column])
    axial = touching + offsets + np.einsum("rkj,kj->rk", along, place)
    room = np.sqrt(np.maximum(span**2 - axial**2, 0.0)) - span * cases["cos_free"]
    return place, np.where(loose, np.maximum(room - cases["length"] * cases["interference"], 0.0), 0.0)
