"""What judges a solution: derived from the drawing alone, right on all that `solve` offers, red for every wrong input.

The finite-element half costs minutes and runs with the check itself (`fem-check run`); its verdict is in
`test_planted_errors.py`.
"""

from dataclasses import replace
from functools import cache, partial
from types import SimpleNamespace

import numpy as np
import pytest

import qsbearing as qs
from fem_check.checks import product_scenes
from fem_check.checks.solution_contacts import (
    catalogue_rows,
    clearance_rows,
    closed_form_rows,
    equilibrium_rows,
    loaded_contacts,
    mechanics_rows,
    set_rows,
)
from fem_check.independent import catalogue_sources, equilibrium, quasi_static, references, ring_growth
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.independent.drawing import BearingDrawing
from fem_check.product import problems, scenes, solution_equilibrium
from fem_check.product.scenes import SceneProblemError, SolvedPoint

POINTS = scenes.solved("b218")
DRAWING = scenes.drawing_of(POINTS[0].solution.scene, "b218")
LOADED = POINTS[-1:]


def judged(points=POINTS):
    """The rows of one bearing, without finite elements."""
    rows = list(mechanics_rows(points, "x"))
    for race in ("inner", "outer"):
        contacts = loaded_contacts(race, points, "x")
        rows += closed_form_rows(contacts, contacts[:1])
    return rows


def failing(rows) -> set[str]:
    """The quantities out of tolerance."""
    return {row.quantity for row in rows if row.verdict == "fail"}


def passing(rows) -> set[str]:
    """The judged quantities within it."""
    return {row.quantity for row in rows if row.verdict == "pass"}


def test_b218_is_right_at_every_operating_point():
    assert len(POINTS) == 8
    assert failing(judged()) == set()


CONTACT = {"approach", "semi_major_axis", "semi_minor_axis", "max_pressure"}
BALANCE = {"contact load", "contact angle", "approach and gap", "displacement, tilts at the groove centres"}
MOTION = {"orbital speed", "rotation, its axis", "rotation speed"}
INERTIA = {"centrifugal force", "gyroscopic moment"}


@pytest.mark.parametrize(
    ("wrong", "caught"),
    [
        ({"ball_diameter": 22.226e-3}, CONTACT | BALANCE | MOTION | INERTIA),
        ({"pitch_diameter": 125.3e-3}, CONTACT | BALANCE | MOTION | INERTIA),
        ({"inner_groove_radius": 1.1 * 11.6281e-3}, CONTACT | BALANCE),
        ({"free_contact_angle": 40.01 * qs.deg}, CONTACT | BALANCE),
        ({"ball_density": 7801.0}, BALANCE | INERTIA),
        ({"ball": ElasticConstants(1.001 * 208e9, 0.3)}, CONTACT | BALANCE),
    ],
    ids=lambda value: "-".join(value) if isinstance(value, dict) else "",
)  # fmt: skip
def test_another_bearing_is_seen(wrong, caught, monkeypatch):
    monkeypatch.setattr(problems, "drawing_at_rest", lambda scene, name: replace(DRAWING, **wrong))
    monkeypatch.setattr(problems, "drawing_of", lambda scene, name: replace(DRAWING, **wrong))
    assert caught <= failing(judged(LOADED))


# --- all that solve offers --------------------------------------------------------------------------------------------


@cache
def rows_of(label):
    """Of one of the product's scenes, judged once."""
    return judged((SolvedPoint(label, scenes.solve("", label, product_scenes.scenes()[label])),))


@pytest.mark.heavy  # the release gate judges these rows at each level
@pytest.mark.parametrize("label", product_scenes.scenes())
def test_every_effect_and_choice_is_judged_and_right(label):
    rows = rows_of(label)
    assert failing(rows) == set()
    assert passing(rows) >= CONTACT | BALANCE | {"load, moments over the lever", "stiffness, tilts at the lever"}
    if product_scenes.scenes()[label].ball_effects:
        assert passing(rows) >= MOTION | INERTIA


@pytest.mark.heavy
@pytest.mark.parametrize("label", product_scenes.sets())
def test_sets_are_judged_and_right(label):
    rows = list(set_rows(label, scenes.solve_set(label, product_scenes.sets()[label]), label))
    assert failing(rows) == set()
    assert passing(rows) >= BALANCE | {"load of each row", "stiffness, tilts at the lever"}


TEMPERATURES = ("shaft_temperature", "inner_ring_temperature", "outer_ring_temperature", "housing_temperature")


@pytest.mark.parametrize("body", TEMPERATURES)
def test_every_temperature_of_the_warm_scenes_counts(body):
    """Judged by a scene in which one body is a hundredth of a kelvin warmer, each is red."""
    warm = {
        label: scene
        for label, scene in product_scenes.scenes().items()
        if scene.ring_expansion is not None and scene.ring_expansion.is_warm
    }
    assert len(warm) == 2
    for label, scene in warm.items():
        solution = scenes.solve("", label, scene)
        rings = replace(scene.ring_expansion, **{body: getattr(scene.ring_expansion, body) + 0.01})
        others = tuple(each for each in scene.ring_effects if not isinstance(each, qs.RingExpansion))
        other = replace(scene, ring_effects=(rings, *others))
        rows = equilibrium_rows(
            label, partial(problems.of_scene, other, label), [solution], solution, solution.displacement
        )
        assert "contact load" in failing(rows)


CONTROLS, ANGLES = ("outer", "inner", "per_ball", "minimum_dissipation"), ("free", "actual", "zero")


@pytest.mark.parametrize(("i", "j"), [(i, j) for i in range(len(CONTROLS)) for j in range(len(ANGLES))])
def test_every_choice_of_the_model_is_followed(i, j):
    """Every pair of two choices at least once."""
    control, angle, shares = CONTROLS[i], ANGLES[j], list(qs.MomentShares)[(i + j) % len(qs.MomentShares)]
    scene = replace(
        POINTS[-1].solution.scene,
        raceway_control=control,
        ball_effects=(qs.CentrifugalForce(), qs.GyroscopicMoment(shares)),
        hertz_angle=angle,
        operation=qs.Operation(
            speed=3000.0 * qs.rpm, outer_speed=-1000.0 * qs.rpm, axial_load=20e3, radial_load_z=3e3, moment_y=0.0
        ),
    )
    assert failing(judged((SolvedPoint("choice", scenes.solve("b218", "choice", scene)),))) == set()


def test_catalogue_and_clearance_stand():
    deep = product_scenes.scenes()["deep groove with 10 µm of clearance, at rest"]
    rows = [*catalogue_rows(), *clearance_rows(DRAWING), *clearance_rows(scenes.drawing_at_rest(deep, "x"))]
    assert failing(rows) == set()


@pytest.mark.parametrize(
    ("material", "field", "digit"), [("SILICON_NITRIDE", "poisson_ratio", 0.27), ("STEEL", "thermal_expansion", 11e-6)]
)
def test_a_digit_of_a_material_is_seen(material, field, digit, monkeypatch):
    monkeypatch.setattr(qs, material, replace(getattr(qs, material), **{field: digit}))
    scene = qs.load_scene("7210c_hybrid")
    wrong = replace(scene, bearing=replace(scene.bearing, ball_material=getattr(qs, material)))
    monkeypatch.setattr(qs, "load_scene", lambda name: wrong if name == "7210c_hybrid" else scene)
    assert {field, f"ball's {field}"} & failing(catalogue_rows())


def test_what_is_in_no_equilibrium_fails(monkeypatch):
    def nowhere(*given):
        raise quasi_static.NoReferenceError("found none")

    monkeypatch.setattr(quasi_static, "solve", nowhere)
    assert failing(mechanics_rows(LOADED, "x")) == {"equilibria found"}


# --- no row is judged by a quantity made from itself ------------------------------------------------------------------


class Doubled:
    """An object all of whose numbers are twice as large."""

    def __init__(self, of) -> None:
        self._of = of

    def __getattr__(self, name):
        return doubled(getattr(self._of, name))


def doubled(value):
    if isinstance(value, float) or (isinstance(value, np.ndarray) and value.dtype.kind == "f"):
        return 2.0 * value
    if isinstance(value, qs.RacewayContacts | qs.Solution):
        return Doubled(value)
    return tuple(map(doubled, value)) if isinstance(value, tuple) else value


# Counted, not measured: nothing of it doubles.
COUNTED = {"balls that follow Jones's criterion"}


EVERY_QUANTITY = (
    "loads turned by 217 degrees, free to tilt, at rest",
    "inner raceway control, 6000 rpm",
    "control by ball, near where it changes, 6000 rpm",
    "deep groove with 10 µm of clearance, at rest",
)
"""Scenes at rest and at speed whose rows together are of every quantity that is judged."""


def test_a_few_scenes_have_rows_of_every_quantity():
    """The other scenes add no kind of row: what doubling does to one it does to all."""
    quantities = {row.quantity for label in EVERY_QUANTITY for row in rows_of(label)}
    others = ("unequal balls, 6000 rpm", "displaced orbit, 10000 rpm", "stiffness of each contact's angle, 8000 rpm")
    assert {row.quantity for label in others for row in rows_of(label)} <= quantities


@pytest.mark.parametrize("label", [*EVERY_QUANTITY, next(iter(product_scenes.sets()))])
def test_every_row_hangs_on_the_solution(label):
    """Twice what `solve` reports, the reference as it is: every judged row is red."""
    if label in product_scenes.scenes():
        solution = scenes.solve("", label, product_scenes.scenes()[label])
        rows = judged((SolvedPoint(label, FoundDoubled(solution)),))
    else:
        solution = scenes.solve_set(label, product_scenes.sets()[label])
        rows = list(
            equilibrium_rows(
                label, lambda: problems.of_set(solution.set, label), [FoundDoubled(row) for row in solution.rows],
                Doubled(solution), 2.0 * np.append(solution.displacement, solution.slide or []),
            )
        )  # fmt: skip
    assert passing(rows) - COUNTED == set()
    assert failing(rows) >= BALANCE


class FoundDoubled(Doubled):
    """A solution's numbers doubled, and what was asked for as it is."""

    @property
    def scene(self):
        return self._of.scene


@pytest.mark.parametrize("label", EVERY_QUANTITY)
def test_every_row_hangs_on_the_reference(label, monkeypatch):
    """The reference doubled where it is computed, the solution as it is: every judged row is red."""
    point = SolvedPoint(label, scenes.solve("", label, product_scenes.scenes()[label]))
    ellipse, hertz, stiffness = references.ellipse, references.hertz, quasi_static.stiffness
    near = solution_equilibrium.reference_near

    def equilibrium_doubled(*given):
        equilibrium = near(*given)
        states = [twice(each) for each in equilibrium.states]
        return SimpleNamespace(
            problem=equilibrium.problem, shaft=2.0 * equilibrium.shaft, load=2.0 * equilibrium.load, states=states,
            of=equilibrium, controls=equilibrium.controls,
        )  # fmt: skip

    monkeypatch.setattr(solution_equilibrium, "reference_near", equilibrium_doubled)
    monkeypatch.setattr(quasi_static, "stiffness", lambda equilibrium: 2.0 * stiffness(equilibrium.of))
    monkeypatch.setattr(references, "ellipse", lambda *given: replace(twice(ellipse(*given))))
    monkeypatch.setattr(references, "hertz", lambda *given: replace(twice(hertz(*given))))
    rows = list(mechanics_rows((point,), "x"))
    assert passing(rows) - COUNTED == set()
    assert failing(rows) >= BALANCE
    contacts = [each for race in ("inner", "outer") for each in loaded_contacts(race, (point,), "x")]
    assert passing(closed_form_rows(contacts, contacts[:1])) == set()


def twice(state):
    """A copy with twice its numbers: of a ball its loads, angles, gaps, speeds and forces."""
    copy = object.__new__(type(state))
    copy.__dict__.update({name: 2.0 * value if not isinstance(value, dict) else {
        race: 2.0 * each for race, each in value.items()} for name, value in vars(state).items()})  # fmt: skip
    return copy


def test_every_row_of_the_catalogue_hangs_on_both(monkeypatch):
    monkeypatch.setattr(
        catalogue_sources,
        "BEARINGS",
        {name: {key: 2.0 * value for key, value in each.items()} for name, each in catalogue_sources.BEARINGS.items()},
    )
    monkeypatch.setattr(catalogue_sources, "EXPANSION", dict.fromkeys(catalogue_sources.EXPANSION, 1.0))
    vanishing = {"free_contact_angle"}  # the deep groove's, 0 degrees
    assert passing(catalogue_rows()) <= vanishing


# --- the reference itself ---------------------------------------------------------------------------------------------


def test_rolling_is_the_textbooks():
    # Harris & Kotzalas: omega_m/omega = (1 - g cos ai)/(1 + cos(ai - ao)) under outer raceway control.
    angles = np.radians([[49.9379, 31.3354], [20.0, 20.0]])
    inner, outer = (np.stack([np.sin(each), np.cos(each)], axis=1) for each in angles.T)
    radius, pitch, one = (np.full(2, 0.5 * each) for each in (DRAWING.ball_diameter, DRAWING.pitch_diameter, 2.0))
    orbit, rotation = equilibrium.rolling(radius, pitch, inner, outer, 1.0, 0.0, 0.0 * one, one)
    g = DRAWING.ball_diameter / DRAWING.pitch_diameter
    expected = (1.0 - g * np.cos(angles[:, 0])) / (1.0 + np.cos(angles[:, 0] - angles[:, 1]))
    np.testing.assert_allclose(orbit, expected, rtol=1e-14)  # a 3 x 3 solve against a closed form: rounding
    attitude = np.sin(angles[:, 1]) / (np.cos(angles[:, 1]) + g)
    np.testing.assert_allclose(-rotation[:, 1] / rotation[:, 0], attitude, rtol=1e-14)


@pytest.mark.parametrize("form", ["exact", "brewe_hamrock_1977", "hamrock_brewe_1983"])
def test_hertz_stiffness_of_b218_is_the_books(form):
    # theory: Ki = 4.1097262e10 N/m^1.5; the fits are known to be 0.3 to 0.7 % off in approach, 1 % in stiffness.
    stiffness = references.ellipse(DRAWING.groove("inner").problem(1.0), form).approach ** -1.5
    assert stiffness == pytest.approx(4.1097262e10, rel=1e-7 if form == "exact" else 1.2e-2)


def test_a_solid_disk_grows_as_the_books_say():
    # Timoshenko & Goodier: u(b) = (1 - nu) rho w^2 b^3/(4 E) of a solid disk at its rim.
    disk = ring_growth.LameRing(0.0, 0.1, 208e9, 0.3, 7800.0, 1000.0, 0.0)
    expected = 0.7 * 7800.0 * 1e6 * 1e-3 / (4.0 * 208e9)
    assert ring_growth.elastic_growth(disk, 0.1) == pytest.approx(expected, rel=1e-12)


def test_a_shrink_fit_is_lames():
    # A hub 50/100 mm on a solid shaft of the same steel: p = E s (b^2 - a^2)/(4 a b^2), s the diametral interference.
    shaft = ring_growth.LameRing(0.0, 0.05, 208e9, 0.3, 7800.0, 0.0, 0.0)
    hub = ring_growth.LameRing(0.05, 0.1, 208e9, 0.3, 7800.0, 0.0, 0.0)
    pressure = 208e9 * 20e-6 * (0.1**2 - 0.05**2) / (4.0 * 0.05 * 0.1**2)
    expected = 2.0 * pressure * 0.05**2 * 0.1 / (208e9 * (0.1**2 - 0.05**2))
    assert ring_growth.elastic_growth(hub, 0.1, shaft, 20e-6) == pytest.approx(expected, rel=1e-12)
    assert ring_growth.elastic_growth(hub, 0.1, shaft, -20e-6) == 0.0


def test_clearance_is_the_books():
    # Harris & Kotzalas's 218 bearing: Pd = 0.4826 mm, 40 degrees; its groove radii in Wang et al. make 40.004.
    drawn = BearingDrawing(
        "218", 22.225e-3, 125.26e-3, 11.6281e-3, 11.6281e-3, 40.004 * qs.deg, DRAWING.ball, DRAWING.ring, 1.0
    )
    assert drawn.diametral_clearance == pytest.approx(0.4826e-3, rel=1e-4)


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


GROWN = """
[effects.ring_expansion]
bore_diameter_mm = 90
outside_diameter_mm = 160
shaft_interference_um = 15
[effects.ball_expansion]
ball_temperature_C = 80
"""


def test_a_bearing_that_has_grown_is_judged_as_grown(tmp_path):
    path = tmp_path / "hot.toml"
    path.write_text(SCENE.format(load=5000) + GROWN)
    points = scenes.solved(str(path))
    grown, cold = (make(points[0].solution.scene, "x") for make in (scenes.drawing_of, scenes.drawing_at_rest))
    # 60 K at 12e-6 per kelvin.
    assert grown.ball_diameter == pytest.approx(cold.ball_diameter * (1.0 + 7.2e-4), rel=1e-12)
    assert grown.free_contact_angle < cold.free_contact_angle - 1.0 * qs.deg
    assert failing(judged(points)) == set()


SET = """
[bearing]
name = "B218"
[[rows]]
position_mm = 0
carries = "+x"
[[rows]]
position_mm = 60
carries = "-x"
[operation]
radial_load_z_N = 2000
moment_y_Nm = 0
[preload]
rigid_N = 3000
"""


def test_a_set_is_read_and_judged(tmp_path):
    path = tmp_path / "pair.toml"
    path.write_text(SET)
    points = scenes.solved(str(path))
    assert [point.label for point in points] == ["row 1", "row 2"]
    solution = scenes.solve_set(str(path), scenes.load(str(path)))
    assert failing(set_rows("pair", solution, str(path))) == set()
    # The rows' contacts are those of the set's equilibrium.
    assert points[1].solution.inner.load == pytest.approx(solution.rows[1].inner.load)
    assert scenes.operating_loads(str(path), "inner")[-1] == pytest.approx(solution.rows[1].inner.load.max(), rel=0.5)


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


LOCATED = """
rows = [{position_mm = 0}, {position_mm = 90, offset_um = 12}]
operation = {axial_load_N = -700, radial_load_y_N = 1500, radial_load_z_N = -400, moment_y_Nm = 8, moment_z_Nm = -5}
[bearing]
kind = "deep_groove"
ball_count = 9
ball_diameter_mm = 11.90625
pitch_diameter_mm = 60
groove_radius_coefficient = 0.52
diametral_clearance_mm = 0.02
ball_material = "steel"
ring_material = "steel"
"""


def test_located_rows_are_judged_by_their_middle_planes(tmp_path, monkeypatch):
    """Pushed to either side; and a lever of tilts that is not theirs is seen."""
    path = tmp_path / "located.toml"
    path.write_text(LOCATED)
    rows = list(set_rows("located", scenes.solve_set(str(path), scenes.load(str(path))), str(path)))
    assert failing(rows) == set()
    assert passing(rows) >= BALANCE | {"load of each row", "stiffness, tilts at the lever"}
    monkeypatch.setattr("qsbearing.systems.sets.rigid_shaft.own_lever", lambda of, row: 1e-4)
    assert failing(set_rows("located", scenes.solve_set(str(path), scenes.load(str(path))), str(path)))


def test_rings_that_slide_by_themselves_are_refused(tmp_path):
    path = tmp_path / "floating.toml"
    path.write_text(LOCATED.replace("offset_um = 12", 'carries = "none"'))
    with pytest.raises(scenes.SceneProblemError, match="the outer ring of row 2 slides"):
        list(set_rows("floating", scenes.solve_set(str(path), scenes.load(str(path))), str(path)))
