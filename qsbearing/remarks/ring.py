"""Remarks about the place of the ring: undetermined, out of contact, tilted far."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from qsbearing.model.bearing import BearingKind
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.ring_stiffness import SOFTEST, scaled_tangents
from qsbearing.model.solution.solved_cases import solved_of
from qsbearing.model.units import mrad, um
from qsbearing.remarks.case_range import CaseRange, Subject
from qsbearing.remarks.kinds import CHECK, SEE_STATUSES, WRONG, Kind
from qsbearing.remarks.remark import Holding, Remark, remark

RING = Subject()

SMALL_TILT = 0.02
"""Tilts are taken as small rotations; at this size [rad] the neglected square is 2 % of the tilt itself."""

SEPARATED = 0.01
"""Loaded contact angles of less than this part of the free one carry no axial load worth the name (chosen: a bearing
made for axial load works at its free angle; 1 % of it is 1 % of the axial load that its balls could carry)."""

RING_UNLOADED = Kind(
    "ring_unloaded", CHECK, SEE_STATUSES,
    "No load acts on the ring: its position is undetermined, and one of many is reported.",
)  # fmt: skip


@RING.tells
def _unloaded(of: CaseRange) -> Iterator[Holding]:
    yield of.cases(of.solution.ring_is_unloaded, bool), remark(RING_UNLOADED)


RING_FREE = Kind(
    "ring_free", CHECK, SEE_STATUSES,
    "Nothing resists a displacement of the ring in {channels}: the value reported for it is arbitrary.",
)  # fmt: skip


@RING.tells
def _soft_directions(of: CaseRange) -> Iterator[Holding]:
    solution, part = of.solution, of.part
    if solution.friction is not None or solution.opposite is not None:
        return
    free = solution.free_channels
    solved = solved_of(solution)
    stiffness, _ = scaled_tangents(solved, part, solved.maker.make(part.start, part.stop))
    stiffness = np.nan_to_num(stiffness, nan=0.0)
    values, vectors = np.linalg.eigh(0.5 * (stiffness + stiffness.swapaxes(-1, -2)))
    soft = np.abs(values) <= SOFTEST * np.abs(values).max(axis=-1, keepdims=True, initial=np.finfo(float).tiny)

    def undetermined(i: int) -> Remark:
        share = np.abs(vectors[i][:, soft[i]]).max(axis=1)
        return remark(RING_FREE, channels=", ".join(CHANNELS[channel].label for channel in free[share > 0.1]))

    yield ~of.cases(solution.ring_is_unloaded, bool) & soft.any(axis=-1), undetermined


RACEWAYS_SEPARATED = Kind(
    "raceways_separated", CHECK, "how_to#preload-of-one-bearing",
    "No axial load keeps the raceways together: the ring has moved axially by {axial_displacement_um:.4g} µm, "
    "until the contact angles are zero.",
)  # fmt: skip


@RING.tells
def _separated(of: CaseRange) -> Iterator[Holding]:
    solution = of.solution
    loaded = of.rows(solution.inner.load) > 0.0
    steepest = np.abs(np.where(loaded, of.rows(solution.inner.angle), 0.0)).max(axis=-1)
    free_angle = of.cases(solution.scene.operating_bearing.free_contact_angle)
    can_separate = solution.scene.bearing.kind is BearingKind.ANGULAR_CONTACT and 0 in solution.free_channels
    axial = of.rows(solution.displacement)[:, 0] / um
    yield (
        can_separate & loaded.any(axis=-1) & (steepest < SEPARATED * free_angle),
        lambda i: remark(RACEWAYS_SEPARATED, axial_displacement_um=axial[i]),
    )


TILT_LARGE = Kind(
    "tilt_large", WRONG, "limits",
    "The ring tilts by {tilt_mrad:.0f} mrad: beyond the small rotations that the model assumes.",
)  # fmt: skip


@RING.tells
def _tilted(of: CaseRange) -> Iterator[Holding]:
    tilt = np.abs(of.rows(of.solution.displacement)[:, 3:]).max(axis=-1)
    yield tilt > SMALL_TILT, lambda i: remark(TILT_LARGE, tilt_mrad=tilt[i] / mrad)
