"""What judges a solution: derived from the drawing alone, right on B218, and red for every wrong input.

The finite-element half costs minutes and runs with the check itself (`fem-check run`); its verdict is in
`test_planted_errors.py`.
"""

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from fem_check import equilibrium, scenes
from fem_check.checks import solution_contacts
from fem_check.equilibrium import Contacts
from fem_check.scenes import SceneProblemError, Solved

POINTS = scenes.solved("b218")
DRAWING = scenes.drawing_of(POINTS[0].solution.scene, "b218")


def failing(drawing=DRAWING, points=POINTS) -> set[str]:
    """The quantities out of tolerance, closed forms and mechanics together."""
    rows = [row for point in points for row in solution_contacts.mechanics_rows(drawing, point)]
    for race in ("inner", "outer"):
        contacts = solution_contacts.loaded_contacts(drawing, race, points)
        rows += solution_contacts.closed_form_rows(contacts, contacts[:1])
    return {row.quantity for row in rows if row.verdict == "fail"}


def test_b218_is_right_at_every_operating_point():
    assert len(POINTS) == 8
    assert failing() == set()


CONTACT = {"approach", "semi_major_axis", "semi_minor_axis", "max_pressure"}
CLOSURE = {"loop closure, over the approach"}
INERTIA = {"centrifugal force", "gyroscopic moment"}


@pytest.mark.parametrize(
    ("wrong", "caught"),
    [
        ({"ball_diameter": 22.226e-3}, CONTACT | CLOSURE | INERTIA),
        ({"pitch_diameter": 125.3e-3}, CONTACT | {"orbital speed, over the ring's", "rotation speed, over the ring's"}),
        ({"inner_groove_radius": 1.1 * 11.6281e-3}, CONTACT | CLOSURE),
        ({"free_contact_angle": 40.01 * qs.deg}, CONTACT | CLOSURE),
        ({"ball_density": 7801.0}, INERTIA | {"force left on a ball, over the largest load"}),
    ],
    ids=lambda value: "-".join(value) if isinstance(value, dict) else "",
)  # fmt: skip
def test_another_bearing_is_seen(wrong, caught):
    assert caught <= failing(replace(DRAWING, **wrong))


def test_wrong_material_is_seen():
    soft = replace(DRAWING.ball, elastic_modulus=1.001 * DRAWING.ball.elastic_modulus)
    assert failing(replace(DRAWING, ball=soft)) >= CONTACT


@pytest.mark.parametrize("control", ["outer", "inner", "per_ball"])
@pytest.mark.parametrize("shares", list(qs.MomentShares))
@pytest.mark.parametrize("angle", ["free", "actual", "zero"])
def test_every_choice_of_the_model_is_followed(control, shares, angle):
    scene = replace(
        POINTS[-1].solution.scene,
        raceway_control=control,
        ball_effects=(qs.CentrifugalForce(), qs.GyroscopicMoment(shares)),
        hertz_angle=angle,
        operation=qs.Operation(
            speed=3000.0 * qs.rpm, outer_speed=-1000.0 * qs.rpm, axial_load=20e3, radial_load_z=3e3, moment_y=0.0
        ),
    )
    assert failing(points=(Solved("choice", scenes.solve("b218", "choice", scene)),)) == set()


def test_rolling_is_the_textbooks():
    # Harris & Kotzalas: omega_m/omega = (1 - g cos ai)/(1 + cos(ai - ao)) under outer raceway control.
    angles = np.radians([[49.9379, 31.3354], [20.0, 20.0]])
    one = np.ones(2)
    inner, outer = Contacts(one, angles[:, 0], one), Contacts(one, angles[:, 1], one)
    orbit, rotation = equilibrium.rolling(DRAWING, inner, outer, 1.0, 0.0, np.array(["outer"] * 2))
    g = DRAWING.ball_diameter / DRAWING.pitch_diameter
    expected = (1.0 - g * np.cos(angles[:, 0])) / (1.0 + np.cos(angles[:, 0] - angles[:, 1]))
    np.testing.assert_allclose(orbit, expected, rtol=1e-14)  # a 3 x 3 solve against a closed form: rounding
    attitude = np.sin(angles[:, 1]) / (np.cos(angles[:, 1]) + g)
    np.testing.assert_allclose(-rotation[:, 1] / rotation[:, 0], attitude, rtol=1e-14)


# --- scenes that cannot be judged -------------------------------------------------------------------------------------

SCENE = """
[bearing]
name = "B218"
[operation]
axial_load_N = {load}
"""


@pytest.mark.parametrize(
    ("load", "said"),
    [(-1000.0, "No equilibrium"), (6e5, "permanent dents exceed"), ("1", "")],
    ids=["reversed", "dents", "light"],
)
def test_a_scene_beyond_elastic_contact_is_refused(load, said, tmp_path):
    path = tmp_path / "my.toml"
    path.write_text(SCENE.format(load=load))
    if not said:
        assert len(scenes.solved(str(path))) == 1
        return
    with pytest.raises(SceneProblemError, match=said):
        scenes.solved(str(path))


def test_a_bearing_that_has_grown_is_refused(tmp_path):
    path = tmp_path / "hot.toml"
    path.write_text(SCENE.format(load=5000) + "[effects.ball_expansion]\nball_temperature_C = 80\n")
    with pytest.raises(SceneProblemError, match="ball_expansion; contacts are judged from the drawing"):
        scenes.solved(str(path))


def test_a_contact_over_the_groove_is_refused(tmp_path):
    # Soft rings: the ellipse grows past the groove long before the pressure is high.
    path = tmp_path / "soft.toml"
    path.write_text(
        SCENE.format(load=20000).replace(
            "[operation]",
            "ring_material = {elastic_modulus_GPa = 1.0, poisson_ratio = 0.4, density_kg_m3 = 1000}\n[operation]",
        )
    )
    with pytest.raises(SceneProblemError, match="leaves its groove"):
        scenes.solved(str(path))
