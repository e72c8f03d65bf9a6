"""What ball and ring add to half-spaces, by a series and a Fourier series: limits and sums known otherwise."""

from dataclasses import replace
from math import radians, sin

import numpy as np
import pytest

from fem_check.independent import finite_bodies, references
from fem_check.independent.ring_sections import RingProfile, RingSections
from fem_check.product.scenes import drawing_at_rest, groove_contact, load_scene

GROOVE = groove_contact("b218", "inner")
PROFILE = RingProfile(0.045, 0.030)


@pytest.fixture
def coarse(monkeypatch):
    """A ring's section with fewer elements, 0.1 % of the approach off."""
    for name, value in (("ALONG", 6), ("GROWTH", 1.8), ("SHORTEST", 5.0)):
        monkeypatch.setattr(finite_bodies, name, value)


def test_the_sphere_s_kernel_is_the_series_of_the_equator():
    # One pair of forces a right angle away, where the series alternates and is summed in another way.
    forces, cosines = np.full(201, 1.0 / 201), np.linspace(-0.05, 0.05, 201)
    sphere = -references.pressed_sphere(cosines, forces, 1.0, GROOVE.ball)
    half = np.sin(0.5 * np.arccos(cosines))
    unit = (1.0 - 0.3**2) / (np.pi * GROOVE.ball.elastic_modulus)
    assert unit * finite_bodies._sphere(half, 0.3).mean() == pytest.approx(sphere, rel=2e-3, abs=0.0)


@pytest.mark.parametrize("excess", [finite_bodies.ball_excess, None])
def test_under_a_small_load_every_body_is_a_half_space(excess, coarse):
    def part(load):
        compliance = excess(GROOVE, load) if excess else finite_bodies.ring_excess(GROOVE, 16, PROFILE, load)
        return load * compliance / references.ellipse(GROOVE.problem(load)).approach

    # As the ellipse's size over the body's, but for a logarithm; with the ring it is the mesh of its section that is
    # seen.
    assert abs(part(1.0)) < 0.003


def test_a_ring_on_a_nearer_seat_is_stiffer(coarse):
    usual = finite_bodies.ring_excess(GROOVE, 16, PROFILE, 2000.0)
    nearer = replace(PROFILE, back_radius=0.048)
    change = usual - finite_bodies.ring_excess(GROOVE, 16, nearer, 2000.0)
    assert change > 0.0
    # Harmonics that reach no seat are left out of the difference.
    assert finite_bodies.ring_doubt(GROOVE, 16, PROFILE, [[nearer]], 2000.0) == pytest.approx(2000.0 * change, rel=0.02)


def test_assumed_dimensions_of_a_ring_may_lie_at_both_ends_of_their_range():
    scene = load_scene("b218")
    drawing, contact = drawing_at_rest(scene, "b218"), (radians(40.0), radians(15.0))
    every = {"bore_diameter": 0.09, "outside_diameter": 0.16, "width": 0.03}
    every |= {
        f"inner_{side}_diameter": 2.0 * (drawing.inner_groove_centre_radius - 0.005) for side in ("shoulder", "open")
    }
    assert RingSections(every).alternatives(drawing, "inner", contact) == []
    of_bore = RingSections({k: v for k, v in every.items() if k != "bore_diameter"}).alternatives(
        drawing, "inner", contact
    )
    assert [[round(each.back_radius, 5) for each in some] for some in of_bore] == [[0.04514, 0.03463]]
    shoulders = RingSections({"bore_diameter": 0.09, "width": 0.03}).alternatives(drawing, "inner", contact)
    # No contact reaches over a shoulder that is assumed.
    assert all(each.high_shoulder >= sum(contact) for each in shoulders[0])
    assert sin(shoulders[0][1].high_shoulder) > sin(shoulders[0][0].high_shoulder)
