"""The validation book: every case passes, sees an error of its physics, and is printed from its record alone."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from fem_check.book import UnknownCaseError, picture, records, run_book
from fem_check.book.case import Case, CaseResult, plain
from fem_check.book.cases import ALL
from fem_check.book.not_yet import NOT_YET
from fem_check.cli import cli
from fem_check.elements.pressure_basis import PressureBasis
from fem_check.report.files import write_book
from fem_check.report.rows import as_read
from fem_check.running import records_store
from qsbearing.model import bearing as scene_bearing
from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.model.effects import ring_compliance, ring_expansion
from qsbearing.model.solution import flatten
from qsbearing.readings import bearing_numbers, dynamic_rating, pass_frequencies, rating_life
from qsbearing.studies.design import optimum
from qsbearing.systems.sets import gears, problem
from tests.documents.page import Page

pytestmark = pytest.mark.skipif(not has_fast_code(), reason="thousands of cases")


LONG = ("bearing_design", "code_aster_spheres")
"""Ten seconds each: run by the release gate, at each level, and their planted errors by the heavy tests."""
NAMES = [name for name in ALL if name not in LONG]
Book = tuple[Callable[[str], records.BookRecord], Path]


@pytest.fixture(scope="module")
def book(tmp_path_factory: pytest.TempPathFactory) -> Book:
    """A case's record by its name, each run once, and the folder that holds them."""
    out = tmp_path_factory.mktemp("results")
    return cache(lambda name: run_book([name], out)[0]), out


@pytest.mark.parametrize("name", NAMES)
def test_the_case_passes_and_says_all_that_a_page_needs(name: str, book: Book) -> None:
    entry = book[0](name)
    assert entry["verdict"] == "pass", [row for row in entry["rows"] if row["verdict"] == "fail"]
    assert set(entry) - {"counter_example"} == set(records.FIELDS)
    assert entry["kind"] in "MCB"
    for text in ("title", "question", "summary", "sources", "inputs", "missing", "does_not_show"):
        assert entry[text]
    assert any(row["tolerance_percent"] is not None for row in entry["rows"])
    assert all(row["why_tolerance"] and row["reference_source"] for row in entry["rows"])
    assert records.read_all(book[1])[name] == json.loads(records.text(entry)) == entry


@pytest.mark.parametrize("name", NAMES)
def test_shipped_records_are_what_a_run_finds(name: str, book: Book) -> None:
    shipped = records.read_all(records_store.FOLDER)[name]
    assert shipped["provenance"]["dirty"] is False
    assert list(differences(comparable(shipped), comparable(book[0](name)))) == []


def comparable(entry: records.BookRecord) -> records.BookRecord:
    """A record without what every run changes: date, commit, machine, seconds."""
    return {key: value for key, value in entry.items() if key not in records.RUN}


def differences(one: Any, other: Any, at: str = "") -> Iterator[str]:
    """Where two records differ by more than processors do in their last digits."""
    if isinstance(one, dict) and isinstance(other, dict) and one.keys() == other.keys():
        for key in one.keys() - {"deviation_percent"}:  # follows from the others, and may be all rounding
            yield from differences(one[key], other[key], f"{at}.{key}")
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for i, (left, right) in enumerate(zip(one, other, strict=True)):
            yield from differences(left, right, f"{at}[{i}]")
    elif isinstance(one, float) and isinstance(other, float):
        if one != pytest.approx(other, rel=1e-6, abs=1e-9):
            yield f"{at}: {one} and {other}"
    elif one != other:
        yield f"{at}: {one} and {other}"


def test_a_second_run_finds_the_same_numbers_and_draws_the_same_picture(book: Book, drawn: None) -> None:
    name = "gmn_rigidities"
    first, again = book[0](name), run_book([name])[0]
    assert records.text(comparable(first)) == records.text(comparable(again))
    assert picture.svg(first) == picture.svg(again)


# ------------------------------------------------------------------------------------------------------ planted errors


def softer(monkeypatch: pytest.MonkeyPatch) -> None:
    """E' 2 % too high, wherever a bearing tells it."""
    for module in (flatten, scene_bearing):
        right = module.effective_modulus
        monkeypatch.setattr(module, "effective_modulus", lambda *numbers, right=right: 1.02 * right(*numbers))


def groove_distance(monkeypatch: pytest.MonkeyPatch) -> None:
    """The distance of the groove centres 0.01 D too long: contact angles change too little under load."""
    right = flatten.CaseMaker.make

    def longer(*arguments: Any) -> Any:
        cases = right(*arguments)
        cases["outer_coefficient"] += 0.01
        return cases

    monkeypatch.setattr(flatten.CaseMaker, "make", longer)


def size_exponent(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ratings as D^1.7."""
    monkeypatch.setattr(dynamic_rating, "size_factor", lambda D: (np.asarray(D) * 1e3) ** 1.7)


def zero_angle(monkeypatch: pytest.MonkeyPatch) -> None:
    """Frequencies from the nominal angle in place of the solved one."""
    right = pass_frequencies.frequencies

    def blind(solution: Any) -> Any:
        frequencies = right(solution)
        return type(frequencies)(frequencies.nominal, frequencies.nominal, frequencies.orbit_spread)

    monkeypatch.setattr("qsbearing.readings.frequencies", blind)


def free_angle(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every free contact angle a degree more."""
    right = flatten.CaseMaker.make

    def steeper(*arguments: Any) -> Any:
        cases = right(*arguments)
        angle = np.arctan2(cases["sin_free"], cases["cos_free"]) + np.radians(1.0)
        cases["sin_free"], cases["cos_free"] = np.sin(angle), np.cos(angle)
        return cases

    monkeypatch.setattr(flatten.CaseMaker, "make", steeper)


def ball_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """E' from the ball's constants alone."""
    right = scene_bearing.effective_modulus
    monkeypatch.setattr(scene_bearing, "effective_modulus", lambda E, nu, *ring: right(E, nu, E, nu))


def groove_exponent(monkeypatch: pytest.MonkeyPatch) -> None:
    """The groove's part of a dynamic rating with 0.3 in place of 0.41."""
    right = dynamic_rating.groove_factor
    monkeypatch.setattr(dynamic_rating, "groove_factor", lambda f: right(f) ** (0.3 / 0.41))


def inner_share(monkeypatch: pytest.MonkeyPatch) -> None:
    """Lundberg and Palmgren's ratio of the raceways with gamma to the power 1.6 in place of 1.72."""
    right = dynamic_rating.rating_ratio
    monkeypatch.setattr(dynamic_rating, "rating_ratio", lambda g, *rest: right(g, *rest) * ((1 + g) / (1 - g)) ** 0.12)


def slow_cage(monkeypatch: pytest.MonkeyPatch) -> None:
    """Balls that pass the inner raceway 0.01 % more often, as if the cage slipped."""
    right = pass_frequencies.frequencies

    def slipping(solution: Any) -> Any:
        frequencies = right(solution)
        return replace(
            frequencies, solved=replace(frequencies.solved, ball_pass_inner=1.0001 * frequencies.solved.ball_pass_inner)
        )

    monkeypatch.setattr("qsbearing.readings.frequencies", slipping)


def fitted_ellipse(monkeypatch: pytest.MonkeyPatch) -> None:
    """A published fit in place of the exact ellipse."""
    right = qs.point_contact
    form = qs.HertzForm.BREWE_HAMROCK_1977
    monkeypatch.setattr(qs, "point_contact", lambda *numbers: right(*numbers, form=form))


def equivalent_load(monkeypatch: pytest.MonkeyPatch) -> None:
    """Equivalent loads 0.5 % too high."""
    right = rating_life.equivalent_load
    monkeypatch.setattr(rating_life, "equivalent_load", lambda *given: 1.005 * right(*given))


def half_modulus(monkeypatch: pytest.MonkeyPatch) -> None:
    """Films with half of E', as contact mechanics often defines it."""
    right = bearing_numbers.BearingNumbers.__getattr__
    halved = {"effective_modulus": 0.5}
    monkeypatch.setattr(
        bearing_numbers.BearingNumbers, "__getattr__", lambda self, name: halved.get(name, 1.0) * right(self, name)
    )


def wider_gap(monkeypatch: pytest.MonkeyPatch) -> None:
    """The undeformed gap 1 % too wide in the finite elements."""
    right = PressureBasis.weighted
    monkeypatch.setattr(PressureBasis, "weighted", lambda self, function: 1.01 * right(self, function))


def softer_rings(monkeypatch: pytest.MonkeyPatch) -> None:
    """Bending 1 % further."""
    right = ring_compliance._michell
    monkeypatch.setattr(ring_compliance, "_michell", lambda body: 1.01 * right(body))


def lost_offset(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first row of a set as if its faces were not ground."""
    right = problem.offset_in_operation

    def lost(of: Any, number: int, offset: Any) -> Any:
        return right(of, number, 0.0 * offset if number == 0 else offset)

    monkeypatch.setattr(problem, "offset_in_operation", lost)


def heavier_rings(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stresses by rotation 5 % too high."""
    right = ring_expansion.stress_by_rotation

    def heavier(*arguments: Any) -> Any:
        return type(masses := right(*arguments))(*(1.05 * each for each in masses))

    monkeypatch.setattr(ring_expansion, "stress_by_rotation", heavier)


def lenient_limits(monkeypatch: pytest.MonkeyPatch) -> None:
    """A search that takes limits for met within a thousandth of their spread: its design is better than possible."""
    monkeypatch.setattr(optimum, "MET", 1e-3)


def lost_lever(monkeypatch: pytest.MonkeyPatch) -> None:
    """Axial forces of gears as if they acted on the axis."""
    right = gears.carried_to_axis
    monkeypatch.setattr(gears, "carried_to_axis", lambda *parts: right(*parts[:-1], 0.0))


PLANTED: list[tuple[str, Callable[[pytest.MonkeyPatch], None]]] = [
    ("bearing_design", lenient_limits),
    ("gmn_rigidities", softer),
    ("gmn_rigidities", groove_distance),
    ("iso_76_factors", softer),
    ("endurance_1956", size_exponent),
    ("motor_bearings", zero_angle),
    ("gmn_dynamic_ratings", groove_exponent),
    ("gmn_hybrid_ratings", ball_alone),
    ("iso_281_ratings", inner_share),
    ("mfpt_rig", slow_cage),
    ("b218_textbook", groove_distance),
    ("half_loaded_ring", free_angle),
    ("boresi_contacts", fitted_ellipse),
    ("code_aster_spheres", wider_gap),
    ("skf_examples", equivalent_load),
    ("iso_16281_seven_balls", softer),
    ("hamrock_209_film", half_modulus),
    ("loaded_rings", softer_rings),
    ("ntn_rigidities", softer),
    ("tpi_7014c", groove_distance),
    ("radial_over_axial", free_angle),
    ("unloading_loads", free_angle),
    ("multiple_sets", lost_offset),
    ("snfa_veb_rigidities", softer),
    ("triple_set_factor", lost_offset),
    ("nsk_6208", equivalent_load),
    ("pinion_on_motor", lost_lever),
    ("axisforge_tilts", softer),
    ("rings_with_fits", heavier_rings),
    ("contacts_of_programs", softer),
]


def test_every_case_has_an_error_planted() -> None:
    assert {name for name, _ in PLANTED} == set(ALL)


@pytest.mark.parametrize(
    ("name", "plant"),
    [pytest.param(*each, marks=[pytest.mark.heavy] if each[0] in LONG else []) for each in PLANTED],
    ids=lambda value: getattr(value, "__name__", value),
)
def test_a_planted_error_is_seen(
    name: str, plant: Callable[[pytest.MonkeyPatch], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    plant(monkeypatch)
    assert ALL[name].run().verdict == "fail"


# Errors in the source, compiled: file, line as it stands, line as it is made, and the cases that must fail.
COMPILED_ERRORS = {
    "load exponent 1.49": (
        "qsbearing/model/kernel/contact_line.py",
        "return stiffness * approach * root, 1.5 * stiffness * root",
        "return stiffness * approach**1.49, 1.49 * stiffness * approach**0.49",
        {"gmn_rigidities", "b218_textbook", "half_loaded_ring", "iso_16281_seven_balls", "hamrock_209_film"},
    ),
    "raceway curvature sign swapped": (
        "qsbearing/model/contact/hertz.py",
        "(1.0 + side * ball_diameter / pitch_diameter * cos_angle))",
        "(1.0 - side * ball_diameter / pitch_diameter * cos_angle))",
        {"iso_16281_seven_balls"},
    ),
    "E' from the ball's modulus alone": (
        "qsbearing/model/contact/hertz.py",
        "(1.0 - poisson_ratio_2**2) / elastic_modulus_2)",
        "(1.0 - poisson_ratio_1**2) / elastic_modulus_1)",
        {"gmn_hybrid_ratings"},
    ),
    "a film with the central one's exponent of speed": (
        "qsbearing/readings/film_thickness.py",
        "return 3.63 * exp(0.68 * ln_U",
        "return 3.63 * exp(0.67 * ln_U",
        {"hamrock_209_film"},
    ),
    "the orbital speed counted from the inner ring": (
        "qsbearing/readings/ball_motion.py",
        "return float(orbit[k, j])",
        "return float(inner_speed[k] - orbit[k, j])",
        {"motor_bearings"},
    ),
    "stiffness +1 %": (
        "qsbearing/model/contact/hertz.py",
        "return pi * k * effective_modulus * sqrt(E / (4.5 * curvature_sum * (K * K * K)))",
        "return 1.01 * pi * k * effective_modulus * sqrt(E / (4.5 * curvature_sum * (K * K * K)))",
        {"iso_16281_seven_balls", "hamrock_209_film", "boresi_contacts"},
    ),
}


@pytest.mark.heavy
@pytest.mark.parametrize("name", COMPILED_ERRORS)
def test_an_error_in_the_compiled_source_is_seen(name: str, tmp_path: Path) -> None:
    path, old, new, failing = COMPILED_ERRORS[name]
    root = Path(__file__).parents[2]
    for package in ("qsbearing", "fem_check"):
        ignored = shutil.ignore_patterns("records", "__pycache__")
        shutil.copytree(root / package, tmp_path / package, ignore=ignored)
    source = (tmp_path / path).read_text()
    assert source.count(old) == 1, f"{path} no longer holds one {old!r}: plant the error where the formula is now"
    (tmp_path / path).write_text(source.replace(old, new))
    environment = os.environ | {"PYTHONPATH": str(tmp_path), "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    command = [sys.executable, "-m", "fem_check", "book", "--out", str(tmp_path / "out")]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 1, done.stderr
    failed = {each for each, entry in records.read_all(tmp_path / "out").items() if entry["verdict"] == "fail"}
    assert failed >= failing, failed


# --------------------------------------------------------------------------------------------------- pages and command


def test_the_page_says_what_the_records_hold(book: Book) -> None:
    """And what documents are wanted."""
    entries = [book[0](name) for name in ALL if name not in LONG]
    text = Page.of(write_book(book[1]).read_text(encoding="utf-8")).text
    for entry in entries:
        for item in [entry["title"], entry["summary"], *entry["missing"], *entry["does_not_show"]]:
            assert as_read(item) in text
        assert all(row["why_tolerance"].removeprefix("a finding").removeprefix(": ") in text for row in entry["rows"])
        assert entry["provenance"]["date"][:10] in text
    assert all(each["document"] in text for each in NOT_YET)


def test_unknown_names_are_refused_before_anything_is_run(tmp_path: Path) -> None:
    with pytest.raises(UnknownCaseError, match="no case named iso_67"):
        run_book(["iso_76_factors", "iso_67"], tmp_path)
    assert list(tmp_path.iterdir()) == []
    result = CliRunner().invoke(cli, ["book", "iso_67", "--out", str(tmp_path)])
    assert result.exit_code == 2
    assert "iso_76_factors" in result.stderr


def test_the_command_prints_records_and_fails_with_a_case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    arguments = ["book", "iso_76_factors", "--out", str(tmp_path)]
    result = CliRunner().invoke(cli, [*arguments, "--json"])
    assert result.exit_code == 0
    assert json.loads(result.stdout) == records.read_all(tmp_path)["iso_76_factors"]
    assert all(name in CliRunner().invoke(cli, ["list"]).output for name in ALL)
    assert "pass" in CliRunner().invoke(cli, arguments).output
    softer(monkeypatch)
    assert CliRunner().invoke(cli, arguments).exit_code == 1
    assert records.read_all(tmp_path)["iso_76_factors"]["verdict"] == "fail"


def test_a_damaged_record_is_named(tmp_path: Path) -> None:
    folder = records.folder_of(tmp_path)
    folder.mkdir()
    (folder / "iso_76_factors.json").write_text('{"case": "iso_76_factors"}')
    with pytest.raises(records_store.RecordError, match=r"lacks .*title"):
        records.read_all(tmp_path)
    (folder / "iso_76_factors.json").write_text("{")
    with pytest.raises(records_store.RecordError, match="no record of the book"):
        records.read_all(tmp_path)


def test_numbers_that_are_none_stay_none() -> None:
    assert plain({"a": np.array([1.0, np.nan]), "b": (np.int64(3), np.bool_(True), 1 / 3)}) == {
        "a": [1.0, None],
        "b": [3, True, 0.3333333333],
    }


def test_a_case_without_texts_is_an_error() -> None:
    with pytest.raises(FileNotFoundError):
        Case("nothing", lambda: CaseResult("", [], [])).texts  # noqa: B018
