"""The elastic-plastic half-space: Hertz below yield, yield where theory has it, what stays."""

from dataclasses import replace

import numpy as np
import pytest

from fem_check.checks import permanent_dent
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.mechanics.elastic_plastic import VOLUME, Indentation
from fem_check.product.scenes import SceneProblemError

COARSE = Indentation(ElasticConstants(208e9, 0.3), 2e9, 0.1, 4.2e9, 4)


def pressed(**changes):
    of = replace(COARSE, **changes)
    return of, of.loaded()


@pytest.mark.parametrize("is_line", [False, True])
def test_elastic_it_is_hertzs_contact_and_springs_back(is_line):
    of, state = pressed(yield_stress=np.inf, is_line=is_line)
    assert of.contact_radius(state) == pytest.approx(of.radius, rel=0.02)
    assert float(state.forces.sum()) == pytest.approx(of.load, rel=1e-5)
    assert abs(of.dent(state)) < 1e-12 * of.radius**2
    # A line's axis is that of plane strain, a ball's has equal stresses across.
    exact = permanent_dent.line_mises(0.3) if is_line else 0.62
    assert of.largest_mises(state) / 4.2e9 == pytest.approx(exact, rel=0.04)


def test_line_mises_is_the_known_yield_of_a_cylinder():
    # Johnson 1985, section 6.1: von Mises, nu = 0.3, p0 = 1.79 Y.
    assert 1.0 / permanent_dent.line_mises(0.3) == pytest.approx(1.79, abs=0.005)


def test_nothing_stays_below_first_yield_and_something_above():
    # A circle yields at p0 = 1.61 Y; elements of a quarter radius see the maximum a few per cent too low.
    below, above = (pressed(max_pressure=ratio * 2e9) for ratio in (1.55, 1.85))
    assert below[1].hardening.max() == 0.0 and abs(below[0].dent(below[1])) < 1e-12
    assert above[1].hardening.max() > 0.0 and above[0].dent(above[1]) > 1e-8


def test_stresses_lie_on_the_hardened_yield_surface_and_dents_fall_with_it():
    of, state = pressed()
    part = state.stress - (state.stress @ VOLUME / 3.0)[..., None] * VOLUME
    mises = np.sqrt(1.5 * ((part[..., :3] ** 2).sum(axis=-1) + 2.0 * part[..., 3] ** 2))
    limit = 2e9 * (1.0 + 208e9 * state.hardening / 2e9) ** 0.1
    flowing = state.hardening > 0.0
    np.testing.assert_allclose(mises[flowing], limit[flowing], rtol=1e-8)
    assert (mises[~flowing] < 2e9 * (1.0 + 1e-9)).all()
    # Plastic flow keeps the volume.
    np.testing.assert_allclose(state.plastic @ VOLUME, 0.0, atol=1e-12)
    dent = of.dent(state)
    softer, harder = (pressed(yield_stress=each) for each in (1.8e9, 2.2e9))
    assert softer[0].dent(softer[1]) > 1.3 * dent > 1.69 * harder[0].dent(harder[1])
    # Both bodies of a ball on a flat: ISO 76's ten-thousandth, within what the yield stress leaves open.
    assert 0.5e-4 < 2.0 * dent < 1.1e-4


def test_unlike_materials_are_refused():
    with pytest.raises(SceneProblemError, match="unlike materials"):
        permanent_dent.run(permanent_dent.MeshLevel.QUICK, lambda stage, part: None, "7210c_hybrid")
