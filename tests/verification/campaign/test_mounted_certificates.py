"""Certificates of bearings that a preload presses, whose rings have grown and whose balls are unequal."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from tests.qsbearing.scenes import B218
from tests.verification.campaign import certificates
from tests.verification.campaign.certificates import NOT_PROVED, free_load, unsupported_direction
from tests.verification.campaign.chunk import judge
from tests.verification.campaign.envelope import chunk_groups

compiled_only = pytest.mark.skipif(not has_fast_code(), reason="a thousand iterations take minutes in plain Python")
LIFTED = {"radial_load_y": 0.0, "radial_load_z": 0.0, "moment_y": -300.0, "moment_z": 0.0}
"""A moment that tips the ring about its own rim where the thrust is small."""


def preloaded(**preload: float) -> qs.Scene:
    return qs.Scene(B218, qs.Operation(**LIFTED), preload=qs.Preload(**preload))


def test_a_spring_is_a_load_and_a_rigid_preload_holds_the_ring() -> None:
    free, load = free_load(preloaded(spring=700.0))
    assert free == [0, 1, 2, 3, 4] and load[0] == 700.0
    free, _ = free_load(preloaded(rigid=700.0))
    assert free == [1, 2, 3, 4]


def test_a_moment_above_what_the_spring_bears_is_proved_to_tip_the_ring() -> None:
    assert unsupported_direction(preloaded(spring=700.0)) is not None
    assert unsupported_direction(preloaded(spring=70_000.0)) is None
    grown = qs.RingExpansion(90e-3, 160e-3, shaft_interference=20e-6)
    balls = qs.BallDiameterDeviations(1e-6 * np.linspace(-1.0, 1.0, 16))
    mounted = replace(preloaded(spring=700.0), ring_effects=(grown, balls))
    assert unsupported_direction(mounted) is not None
    assert str(qs.solve(mounted).status) == "no_equilibrium"


@compiled_only
def test_refusals_of_mounted_scenes_are_sought_a_certificate() -> None:
    """Most have one; what has none is not proved, and no failure."""
    kinds = [
        certificate.kind
        for group in chunk_groups(1, 0, envelope="mounted")[:24]
        if group.more
        for certificate in judge(group)[2].values()
    ]
    assert len(kinds) > 5
    assert sum(kind == NOT_PROVED for kind in kinds) < 0.2 * len(kinds)


@pytest.mark.parametrize(("preload", "kind"), [("spring_N", "unique equilibrium"), ("rigid_N", "an equilibrium")])
def test_where_a_rigid_preload_holds_the_ring_nothing_is_called_unique(
    preload: str, kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The displacement at which it is held is the solver's word, which a proof may not take."""
    broken = {name: np.array([name == "open_side"]) for name in certificates.RESTRICTIONS}
    monkeypatch.setattr(certificates, "restrictions_broken", lambda group, solution: broken)
    monkeypatch.setattr(certificates, "directional", lambda scene: certificates.Certificate(certificates.NONE))
    monkeypatch.setattr(certificates, "is_at_rest", lambda group, index: True)
    drawn = (group for chunk in range(4) for group in chunk_groups(1, chunk, envelope="mounted"))
    group = next(
        group
        for group in drawn
        if preload in group.more.get("preload", {}) and group.hertz_angle is not qs.HertzAngle.ACTUAL
    ).part([0])
    (certificate,) = certificates.certify(group, qs.solve(group.scene()), np.array([0]))
    assert certificate.kind == f"open side, {kind}"
