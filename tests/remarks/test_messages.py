"""What a solution says in sentences: one case, many cases, and when each warning is due."""

from __future__ import annotations

import dataclasses
import json
import pickle
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.documents.guide import topics
from qsbearing.documents.model import anchor_of
from qsbearing.files import catalogue
from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.contact.hertz import STATIC_PRESSURE, first_yield_pressure, subsurface_shear
from qsbearing.model.solution.limit import Standing
from qsbearing.readings.ball_motion import CONTROL_ASSUMED
from qsbearing.readings.rating_life import LIFE_FACTOR_CAPPED
from qsbearing.readings.shoulder_overrun import ELLIPSE_CUT
from qsbearing.remarks.kinds import Severity
from qsbearing.remarks.preload import PRELOAD_LOST
from qsbearing.remarks.remark import Remark, Warned, in_order, remark, some_balls
from qsbearing.reports.guide_lists import every_kind
from qsbearing.results.built_in_limits import built_in_answers
from tests.qsbearing.scenes import B218, BOTH, CENTRIFUGAL, DEEP_GROOVE, INNER, OUTER, SPINDLE, resting, solved, turning
from tests.remarks.test_data import typed

SEPARATED = "No axial load keeps the raceways together"


def warnings_of(bearing: qs.BallBearing, effects: tuple[Any, ...] = (), **operation: Any) -> str:
    scene = qs.Scene(bearing, qs.Operation(**operation), effects, OUTER if effects else None)
    solution = qs.solve(scene)
    assert solution.converged
    return " ".join(qs.warnings(solution))


@pytest.mark.parametrize(
    ("operation", "said"),
    [
        ({"axial_load": 50.0, "tilt_y": 0.0, "tilt_z": 0.03}, "the prescribed tilt z is too large"),
        ({"axial_load": 50.0, "tilt_y": 0.03, "tilt_z": 0.0}, "the prescribed tilt y is too large"),
        ({"axial_load": 50.0, "moment_z": 300.0, "tilt_y": 0.0}, "the load in channel tilt z is too large"),
        ({"axial_load": 50.0, "radial_load_y": 400.0, "tilt_y": 0.0, "tilt_z": 0.03},
         "the load in channel radial y or the prescribed tilt z is too large"),
    ],
)  # fmt: skip
def test_what_is_too_large_is_called_by_what_it_is(operation: dict[str, float], said: str) -> None:
    """A displacement that is given is no load."""
    bearing = qs.load_scene("7210C").bearing
    solution = qs.solve(qs.Scene(bearing, qs.Operation(**operation)))
    assert said in qs.message(solution)


# Many cases -----------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def many() -> qs.Solution:
    """Speeds against thrusts: fast ones slip, heavy ones yield, the last row is pulled apart."""
    speed = np.array([1e3, 10e3]) * qs.rpm
    thrust = np.array([[2e3], [20e3], [600e3], [-10.0]])
    return qs.solve(qs.Scene(B218, qs.Operation(speed=speed, axial_load=thrust), BOTH, OUTER))


def test_the_message_of_many_counts_them(many: qs.Solution) -> None:
    assert qs.message(many) == "8 cases: 6 converged, 2 no_equilibrium (the first: (3, 0))."


def test_the_warnings_of_many_say_how_many_and_which_is_the_first(many: qs.Solution) -> None:
    each = {place: qs.warnings(many, place) for place in np.ndindex(many.shape)}
    found = qs.warnings(many)
    assert len(found) == 6
    for kind in (
        "the slip of contacts that cannot carry the gyroscopic moment",
        "aceway control is a hypothesis",
        "requires a friction coefficient",
        "the expansion of the rings is not included",
        "rings and their seats are taken as rigid",
        "contact pressure reaches",
    ):
        (sentence,) = [sentence for sentence in found if kind in sentence]
        have = [place for place, sentences in each.items() if any(kind in one for one in sentences)]
        assert 0 < len(have) < 8
        assert sentence.startswith(f"{len(have)} of 8 cases, the first {have[0]}: ")
        assert sentence.partition(": ")[2] in each[have[0]]


def test_balls_are_counted_in_singular_and_plural() -> None:
    for which, said in (
        ([True, False, False], "1 ball (no. 0) carries"), ([False, True, True], "2 balls (no. 1 to 2) carry"),
        ([True, True], "All 2 balls carry"), ([True, True, False, True], "3 balls (no. 0 to 1, 3) carry"),
    ):  # fmt: skip
        assert f"{some_balls(which):carries/carry}" == said


@pytest.mark.parametrize("index", [0, (0,), (4, 0), (0, -3), (0, 0, 0)])
def test_an_index_that_names_no_case_says_what_would(many: qs.Solution, index: Any) -> None:
    for ask in (qs.message, qs.warnings):
        with pytest.raises(ValueError, match=r"this solution has \(4, 2\) cases; give index, such as \(3, 1\)"):
            ask(many, index)


def test_an_index_from_the_end(many: qs.Solution) -> None:
    assert qs.message(many, (-1, -2)) == qs.message(many, (3, 0))
    alone = qs.solve(qs.Scene(B218, qs.Operation(axial_load=1e3)))
    assert qs.message(alone, ()) == qs.message(alone)
    with pytest.raises(ValueError, match="a single case; leave index out"):
        qs.message(alone, 0)


def test_balls_without_support_where_every_displacement_is_prescribed() -> None:
    """A ring held two ball diameters aside of the one ball, which is thrown off."""
    held = dict.fromkeys(["axial_displacement", "radial_displacement_y", "tilt_y", "tilt_z"], 0.0)
    operation = qs.Operation(speed=50_000 * qs.rpm, radial_displacement_z=0.05, **held)
    bearing = dataclasses.replace(B218, ball_count=1)
    solution = qs.solve(qs.Scene(bearing, operation, CENTRIFUGAL, OUTER))
    assert solution.status == "no_equilibrium"
    assert "at the prescribed displacements" in qs.message(solution)


# Pressure -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("ratio", [1.0, 1.5, 2.5, 5.0, 10.0, 50.0])
def test_first_yield_is_where_the_largest_shear_meets_tresca(ratio: float) -> None:
    """2742 MPa for 1700 MPa, within 5 % for every ellipse."""
    pressure = first_yield_pressure(1700e6)
    assert pressure == pytest.approx(2742e6, rel=1e-3)
    assert subsurface_shear(ratio).stress * pressure == pytest.approx(0.5 * 1700e6, rel=0.05)


def test_dents_and_first_yield_are_two_limits() -> None:
    for load, rings, words in (
        (150e3, (), None),
        (150e3, (qs.RingExpansion(90 * qs.mm, 160 * qs.mm),), "below ISO 76's static limit"),
        (150e3, (qs.RingExpansion(90 * qs.mm, 160 * qs.mm, yield_strength=2200e6),), None),
        (600e3, (), "above ISO 76's static limit of 4200 MPa: expect permanent dents"),
        (600e3, (qs.RingExpansion(90 * qs.mm, 160 * qs.mm),), "permanent dents"),
    ):
        solution = qs.solve(qs.Scene(B218, qs.Operation(axial_load=load), ring_effects=rings))
        said = " ".join(line for line in qs.warnings(solution) if line.startswith("The contact pressure"))
        assert (words is None) == (said == "")
        assert words is None or words in said
        assert ("begins to yield below the surface near 2700 MPa" in said) == (words is not None and rings != ())


# Balls far apart ------------------------------------------------------------------------------------------------------


def test_balls_that_fill_too_little_of_the_pitch_circle_are_a_warning() -> None:
    """A decimal slip of the pitch diameter, which is solved without a word else."""
    bearing = dataclasses.replace(qs.load_scene("7210c").bearing, pitch_diameter=np.array([70.0, 700.0]) * qs.mm)
    solution = qs.solve(qs.Scene(bearing, qs.Operation(axial_load=500.0)))
    assert not any("pitch circle" in line for line in qs.warnings(solution, 0))
    assert any("The balls fill 8.7 % of the pitch circle" in line for line in qs.warnings(solution, 1))


@pytest.mark.parametrize("name", [entry.stem for entry in Path(catalogue.__file__).parent.glob("*.toml")])
def test_the_catalogue_is_as_full_as_the_warning_says(name: str) -> None:
    bearing = qs.load_scene(name).bearing
    assert 0.589 <= bearing.ball_count * bearing.ball_diameter / (np.pi * bearing.pitch_diameter) <= 0.904


# Names that there are not ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("pressure", "Did you mean max_pressure[?]"),
        ("loads", "Did you mean load[?]"),
        ("axis", "semi_major_axis or semi_minor_axis"),
        ("foo", "There are angle, apex_margin, approach"),
    ],
)
def test_a_misspelt_result_names_the_nearest(many: qs.Solution, name: str, words: str) -> None:
    with pytest.raises(AttributeError, match=words):
        getattr(many.inner, name)
    assert not hasattr(many.inner, name)


# Raceways that separate -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("bearing", [B218, SPINDLE], ids=["B218", "spindle"])
@pytest.mark.parametrize("speed", [0.0, 5000 * qs.rpm])
@pytest.mark.parametrize("axial", [{}, {"axial_load": 0.0}, {"axial_load": 1.0}], ids=str)
def test_without_axial_load_a_radially_loaded_bearing_separates(
    bearing: qs.BallBearing, speed: float, axial: dict[str, float]
) -> None:
    found = warnings_of(bearing, BOTH if speed else (), speed=speed, radial_load_y=4e3, tilt_z=0.0, **axial)
    assert SEPARATED in found
    moved = float(found.partition("moved axially by ")[2].partition(" µm")[0]) * qs.um
    reach = -bearing.groove_centre_distance * np.sin(bearing.free_contact_angle)
    assert moved == pytest.approx(reach, rel=0.02), "as far as the free contact angle lets it go"


@pytest.mark.parametrize(
    "operation",
    [
        {"axial_load": 4e3, "radial_load_y": 4e3, "tilt_z": 0.0},
        {"axial_load": 400.0, "radial_load_y": 4e3, "tilt_z": 0.0},
        {"axial_load": 4e3},
        {"axial_displacement": 1e-6, "radial_load_y": 4e3, "tilt_z": 0.0},
        {"axial_displacement": 0.0, "radial_load_y": 4e3, "moment_z": 0.0},
        {},
    ],
    ids=str,
)
def test_loaded_preloaded_and_idle_bearings_do_not_separate(operation: dict[str, float]) -> None:
    assert SEPARATED not in warnings_of(B218, **operation)


def test_a_deep_groove_bearing_does_not_separate() -> None:
    """Shoulders on both sides: at angle zero under a radial load, as it is made for; and so with some clearance."""
    for bearing in (DEEP_GROOVE, dataclasses.replace(DEEP_GROOVE, free_contact_angle=8 * qs.deg)):
        assert SEPARATED not in warnings_of(bearing, radial_load_y=1e3, tilt_z=0.0)


# What a warning is ----------------------------------------------------------------------------------------------------


def test_warnings_are_strings_with_a_rank_what_matters_most_first(many: qs.Solution) -> None:
    found = [qs.warnings(many), *(qs.warnings(many, place) for place in np.ndindex(many.shape))]
    assert len({each.rank for each in found[0]}) == 3, "or there is no order to see"
    for said in found:
        assert all(isinstance(each, Warned) for each in said)
        assert [each.rank for each in said] == sorted(each.rank for each in said)
    assert json.loads(json.dumps(found[0])) == found[0]
    assert [each.rank for each in pickle.loads(pickle.dumps(found[0]))] == [each.rank for each in found[0]]


def test_a_line_has_severity_sentence_and_page_what_matters_most_first() -> None:
    said = in_order(
        [remark(CONTROL_ASSUMED), remark(LIFE_FACTOR_CAPPED, limit=50.0), lost(), remark(ELLIPSE_CUT, "outer")]
    )
    assert [each.said().line for each in said] == [
        "Wrong model: The ellipse of an outer contact runs over the groove's edge: pressure there exceeds Hertz's (see "
        "qsbearing guide limits).",
        "Check your data: Preload lost: the bearing carries 0.5 N in operation; its preload is 50 N mounted (see "
        "qsbearing guide sets#preload).",
        "Good to know: No raceway control is named: all spin is put on the inner raceway (see qsbearing guide "
        "readings#choices-that-change-the-numbers).",
        "Good to know: aISO is at the upper limit of ISO 281, 50: the modified life is not a prediction (see qsbearing "
        "guide readings#choices-that-change-the-numbers).",
    ]  # fmt: skip


def lost() -> Remark:
    return remark(PRELOAD_LOST, carried_N=0.5, given_N=50.0, state="mounted")


def test_sentences_are_short(many: qs.Solution) -> None:
    """Two lines of a terminal; three where it says what to add to the model."""
    for place in np.ndindex(many.shape):
        for each in qs.warnings(many, place):
            assert len(each.line) <= (300 if each.rank is Severity.INCOMPLETE_MODEL else 200), each.line


def test_every_remark_says_where_the_guide_has_more() -> None:
    pages = topics()
    for kind in every_kind().values():
        page, _, section = kind.see.partition("#")
        assert page in pages, kind
        headings = re.findall(r"^#+ (.*)$", pages[page].text, flags=re.MULTILINE)
        assert section in ("", *map(anchor_of, headings)), kind


def test_a_run_shows_the_rank_of_each_warning(tmp_path: Path) -> None:
    scene = tmp_path / "fast.toml"
    text = '[bearing]\nname = "B218"\n[operation]\nspeed_rpm = 8000\naxial_load_N = 5000\n'
    scene.write_text(text + "radial_load_y_N = 40000\ntilt_z_mrad = 0\n")
    solution = qs.solve(qs.load_scene(scene))
    shown = CliRunner().invoke(cli, ["run", str(scene)], env={"COLUMNS": "100"}).stdout
    words = " ".join(shown.split())
    said = [each.remark.said(IN_FILE) for each in qs.warnings(solution)]
    places = [words.index(typed(each.line, each.remark.paste(IN_FILE))) for each in said]
    assert len({each.rank for each in qs.warnings(solution)}) > 1
    assert places == sorted(places)


def test_friction_above_the_load_is_said_to_carry_it() -> None:
    """A required coefficient above 1 is an answer of the hypothesis, and said as what it is."""
    loads = {"effects": (qs.GyroscopicMoment(),), "control": INNER, "axial_load": 200.0}
    beyond, slipping = ([str(each) for each in qs.warnings(solved(turning(rpm, **loads)))] for rpm in (6000, 3000))
    said = "friction, not the contact, carries the load there"
    assert any(said in each and "1.22 at the inner raceway" in each for each in beyond)
    assert not any(said in each for each in slipping)
    assert any("expect slip" in each for each in slipping)


def test_only_a_loaded_outer_raceway_carries_load() -> None:
    """A load that rounding leaves is none."""
    solution = solved(turning(8000, axial_load=2e3, radial_load_y=4e3, tilt_y=0.0, tilt_z=0.0))
    assert (solution.inner.load[7:9] == 0.0).all()
    solution.outer.load[7] = 1e-13 * solution.outer.load.max()
    said = " ".join(qs.warnings(solution))
    assert "1 ball (no. 7) carries no load." in said
    assert "8 balls (no. 4 to 6, 8 to 12) have left the inner raceway" in said


def test_a_ball_without_orbit_refuses_the_case_in_words() -> None:
    """Loads a millionth of inertia, centrifugal force alone, inner control."""
    loads = {"axial_load": 0.01, "radial_load_y": 0.03, "radial_load_z": 0.012, "moment_y": 0.0, "moment_z": 0.0}
    solution = qs.solve(turning(20e3, effects=CENTRIFUGAL, control=INNER, **loads))
    assert (solution.status, solution.reason) == (qs.Status.NO_EQUILIBRIUM, qs.Reason.NO_ORBIT)
    assert "would leave the ball standing" in qs.message(solution)


def test_dents_are_said_where_the_limit_of_reports_is_not_met() -> None:
    """At the limit, and just beyond by no more than a search leaves, it is met, and nothing is said of dents."""
    least, most = 20e3, 600e3
    for _ in range(60):
        middle = 0.5 * (least + most)
        largest = qs.solve(resting(axial_load=middle)).inner.max_pressure.max()
        least, most = (middle, most) if largest < STATIC_PRESSURE * (1.0 + 3e-7) else (least, middle)
    loads = np.array([0.99 * most, most, 1.01 * most])
    solution = qs.solve(resting(axial_load=loads))
    assert solution.inner.max_pressure[1].max() > STATIC_PRESSURE
    for place, load in enumerate(loads):
        alone = qs.solve(resting(axial_load=float(load)))
        (answer,) = (each for each in built_in_answers(alone, {}) if each.limit.name == "contact pressure")
        said = {each.remark.code for each in qs.warnings(solution, place)}
        assert ("pressure_dents" in said) == (answer.state is Standing.NOT_MET) == (place == 2)
