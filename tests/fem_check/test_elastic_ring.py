"""The ring of finite elements obeys what any ring does, judges the model, and sees errors planted in the model."""

import numpy as np
import pytest

from fem_check.checks import elastic_ring, solution_parts
from fem_check.elements.plane_ring import Ring, RingGrid, harmonics
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.rows.agreement import MeshLevel
from qsbearing.model.effects import elastic_rings, ring_compliance

STEEL = ElasticConstants(208e9, 0.3)
GRID = (48, 2)


def failing(rows) -> set[str]:
    """The cases out of tolerance."""
    return {row.case for row in rows if row.verdict == "fail"}


def moved(ring: Ring, n: int, rim: str = "bore_radius") -> np.ndarray:
    """Harmonics of the ring's movement by a pressure cos(n t)."""
    radius = getattr(ring.ring, rim)
    return harmonics(ring.moved(radius, ring.ring.pressed(radius, lambda angle: np.cos(n * angle))))


@pytest.mark.parametrize("n", [0, 2, 5])
def test_a_wave_of_pressure_makes_that_wave_alone(n):
    waves = moved(Ring(RingGrid(0.07, 0.08, STEEL, *GRID)), n)
    waves[1] = 0.0  # the ring's place is arbitrary
    assert np.abs(np.delete(waves, n)).max() < 1e-3 * abs(waves[n])


def test_uniform_growth_is_that_of_a_thick_cylinder():
    a, b = 0.06, 0.08
    exact = a / STEEL.elastic_modulus * ((a**2 + b**2) / (b**2 - a**2) + STEEL.poisson_ratio)
    assert moved(Ring(RingGrid(a, b, STEEL, *GRID)), 0)[0] == pytest.approx(
        exact, rel=5e-5, abs=0.0
    )  # two elements through it


def test_a_seat_that_slides_stiffens_and_that_of_next_to_nothing_does_not():
    one, soft = RingGrid(0.07, 0.08, STEEL, *GRID), ElasticConstants(1.0, 0.3)
    free, with_seat, with_soft = (
        Ring(one, seat) for seat in (None, RingGrid(0.08, 0.09, STEEL, *GRID), RingGrid(0.08, 0.09, soft, *GRID))
    )
    for n in (0, 2, 4):
        assert 0.0 < moved(with_seat, n)[n] < 0.9 * moved(free, n)[n]
        assert moved(with_soft, n)[n] == pytest.approx(moved(free, n)[n], rel=1e-8, abs=0.0)


def test_the_balls_influence_is_symmetric_and_moves_no_ring_as_a_body():
    one = RingGrid(0.0739, 0.08, STEEL, *GRID)
    matrix = elastic_ring.influence(GRID, 16, one)
    np.testing.assert_allclose(matrix, matrix.T, rtol=1e-12)
    angle = 2.0 * np.pi * np.arange(16) / 16
    # Waves n = 15 and 17 are a shift for 16 balls.
    part = np.cos(angle) @ matrix @ np.cos(angle) / (np.cos(2.0 * angle) @ matrix @ np.cos(2.0 * angle))
    assert 0.0 < part < 1e-3


@pytest.mark.heavy
def test_one_pitch_in_three_dimensions_sees_the_shoulders(monkeypatch):
    """In bending; with the rectangle that the groove's bottom leaves, the model would deflect four times as far."""
    assert failing(elastic_ring.pitch_rows(MeshLevel.QUICK)) == set()
    monkeypatch.setattr(elastic_rings, "bending_height", lambda thickness, *shape: np.asarray(thickness))
    elastic_rings._known_compliances.cache_clear()
    rows = elastic_ring.pitch_rows(MeshLevel.QUICK)
    elastic_rings._known_compliances.cache_clear()
    assert {row.case for row in rows if row.verdict == "fail"} == {row.case for row in rows if row.case[-1] == "3"}
    assert min(row.reference / row.found for row in rows if row.case[-1] == "3") > 3.0


def test_bending_that_is_off_by_half_a_per_cent_is_seen(monkeypatch):
    right = ring_compliance._michell
    monkeypatch.setattr(ring_compliance, "_michell", lambda body: 1.005 * right(body))
    seen = failing(elastic_ring.compliance_rows(MeshLevel.QUICK))
    assert {case for case in seen if case.endswith("n = 0, 2 to 8")} >= {
        f"{name}, n = 0, 2 to 8" for name in elastic_ring.rings(GRID)
    }


def test_a_seat_of_the_wrong_sign_is_seen(monkeypatch):
    right = ring_compliance._ratio
    monkeypatch.setattr(ring_compliance, "_ratio", lambda moved, held: -right(moved, held))
    seen = failing(elastic_ring.compliance_rows(MeshLevel.QUICK))
    assert {case for case in seen if "sliding" in case} and not {case for case in seen if "free" in case}


@pytest.mark.parametrize(
    "wrong",
    [
        lambda by_load, of_section: (lambda known, radius, width: by_load(known, radius, 1.05 * width), of_section),
        lambda by_load, of_section: (by_load, lambda compliance, radius, modulus: compliance),
        lambda by_load, of_section: (by_load, lambda *known: -of_section(*known)),
    ],
    ids=["width", "local compression left in", "sign of the deflection"],
)
def test_an_error_between_ring_and_balls_is_seen(wrong, monkeypatch):
    by_load, of_section = wrong(elastic_rings.by_load, elastic_rings.of_section)
    monkeypatch.setattr(elastic_rings, "by_load", by_load)
    monkeypatch.setattr(elastic_rings, "of_section", of_section)
    elastic_rings._known_compliances.cache_clear()
    try:
        assert failing(elastic_ring.load_rows(MeshLevel.QUICK))
    finally:
        elastic_rings._known_compliances.cache_clear()


@pytest.mark.parametrize("rounding", [0.0, 1e-15, -1e-14])
def test_a_ring_on_a_shaft_is_judged_whatever_rounding_leaves_of_a_start(rounding, monkeypatch):
    """Under thrust the radial displacements are 0 but for that."""
    start = elastic_ring.at_rest

    def rounded(problem):
        shaft, positions = start(problem)
        return np.where(np.abs(shaft) < 1e-12, rounding, shaft), positions

    monkeypatch.setattr(elastic_ring, "at_rest", rounded)
    rows = list(solution_parts.ring_rows())
    assert rows and not failing(rows)
