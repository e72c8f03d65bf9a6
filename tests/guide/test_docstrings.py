"""Docstrings of public names: examples that run and print what they say, and what the reference needs of each."""

from __future__ import annotations

import dataclasses
import doctest
import inspect
import io
import re
from collections.abc import Iterator
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.solution.groups import GROUPS
from qsbearing.model.solution.result_keys import BALL
from tests.guide.interface import HOLDERS, classes, kept, words_of

pytest.importorskip("xarray")
pytest.importorskip("matplotlib")
WITHOUT_EXAMPLE = {"ross_element", "to_ross"}
"""These need ROSS, which the environment of the tests has not; their page of the guide runs where it is."""


def functions() -> Iterator[tuple[str, Any]]:
    for prefix, holder in HOLDERS.items():
        for name in holder.__all__:
            if inspect.isfunction(value := getattr(holder, name)):
                yield f"{prefix}.{name}", value


FUNCTIONS = dict(functions())
METHODS = {
    f"{of}.{name}": method
    for of, each in classes().items()
    for name, method in inspect.getmembers(each, lambda one: inspect.isfunction(one) or inspect.ismethod(one))
    if not name.startswith("_") and method.__module__.startswith("qsbearing.")
}


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if name.rpartition(".")[2] not in WITHOUT_EXAMPLE])
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_an_example_prints_what_it_says(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names = {"qs": qs, "np": np, "dataclasses": dataclasses}
    test = doctest.DocTestParser().get_doctest(inspect.getdoc(FUNCTIONS[name]) or "", names, name, None, None)
    assert any(each.want for each in test.examples), "an example that prints something"
    said = io.StringIO()
    with redirect_stdout(said):
        result = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test)
    assert result.failed == 0, said.getvalue()


@pytest.mark.parametrize("name", FUNCTIONS)
def test_what_is_given_back_is_told(name: str) -> None:
    assert "Returns:" in (inspect.getdoc(FUNCTIONS[name]) or "")


@pytest.mark.parametrize("name", [*FUNCTIONS, *METHODS])
def test_documented_arguments_are_there(name: str) -> None:
    function = {**FUNCTIONS, **METHODS}[name]
    section = re.search(r"^Args:\n((?:[ ]{4}.*\n|\n)+)", (inspect.getdoc(function) or "") + "\n", re.MULTILINE)
    told = re.findall(r"^ {4}(\w[\w, ]*):", section[1], re.MULTILINE) if section else []
    named = {each.strip() for line in told for each in line.split(",")}
    assert named <= set(inspect.signature(function).parameters)


NO_NUMBERS = {
    "Belt.assumed", "Gear.assumed", "ErrorDetail.allowed", "ErrorDetail.where",
    "FileErrorDetail.allowed", "FileErrorDetail.where", "InferredBearing.set_number", "InferredBearing.practice",
    "Operation.turning", "Row.sign", "Row.out_of_line", "SetSolution.line", "ElasticRings.housing_touches",
    "ElasticRings.shaft_touches", "ElasticRings.inner_compliance", "RingExpansion.shaft_touches",
    "RingExpansion.housing_touches", "Solution.slips", "Solution.raceway_control",
    "Life.is_at_limit",
    *(f"{of}.{name}" for of in ("Solution", "SetSolution") for name in ("codes", "free_channels")),
}  # fmt: skip
"""Of what may be arrays: words, switches, counts, and what stands in the unit of something else."""
IN_SI = re.compile(r"\[[^\]]+\]|\bSI\b")


Words = dict[str, tuple[str, str]]


@pytest.fixture(scope="module")
def described() -> dict[str, Words]:
    """By public class and attribute: its type and its words, as the reference has them."""
    griffe = pytest.importorskip("griffe")
    package = griffe.load(
        "qsbearing", resolve_aliases=False, extensions=griffe.load_extensions("qsbearing.site.lazy_docs")
    )
    found: dict[str, Words] = {}
    for name, of in classes().items():
        own = found.setdefault(name, {})
        for each in (each for each in of.__mro__ if each.__module__.startswith("qsbearing.")):
            members = package[f"{each.__module__.removeprefix('qsbearing.')}.{each.__qualname__}"].members
            for member in (one for one in members.values() if not one.is_alias and one.name not in own):
                is_read = not member.is_function or "property" in member.labels
                kind = str(member.returns if member.is_function else member.annotation) if is_read else "a method"
                own[member.name] = kind, member.docstring.value if member.docstring else ""
    return found


def public(described: dict[str, Words]) -> Iterator[tuple[str, str, str]]:
    """(class and attribute, type, words) of every public one."""
    for of, words in described.items():
        for name, (kind, text) in words.items():
            if not name.startswith("_"):
                yield f"{of}.{name}", kind, text


def test_every_public_name_has_words_and_stays(described: dict[str, Words]) -> None:
    """So that the reference shows what may be relied on, and nothing else; the site's own test looks at its pages."""
    assert [name for name, _, text in public(described) if not text] == []
    for of, words in described.items():
        shown = (name for name in words if not name.startswith("_"))
        assert words_of(classes()[of], shown) == set(kept()["python"][of]), of


def test_every_number_names_its_unit(described: dict[str, Words]) -> None:
    """In square brackets, [-] for a ratio; or says that it is in SI, where the unit differs from entry to entry."""
    numbers = [each for each in public(described) if re.search("float|ArrayLike|NDArray", each[1])]
    assert len(numbers) > 200
    silent = {name.removeprefix("qs.").removeprefix("readings.") for name, _, text in numbers if not IN_SI.search(text)}
    assert silent - NO_NUMBERS == set()


OF_CASES = re.compile(
    r"\(\*cases|\(case|\bshape\b|spans? (the )?cases|may be (an array|arrays)|case axes|over the cases|which cases",
    re.I,
)


def test_every_array_names_its_shape(described: dict[str, Words]) -> None:
    """By the words of cases and axes, its own or those of its class."""
    silent = set()
    for name, kind, text in public(described):
        of = classes()[name.rpartition(".")[0]]
        if re.search("ArrayLike|NDArray", kind) and not OF_CASES.search(text + (inspect.getdoc(of) or "")):
            silent.add(name.removeprefix("qs.").removeprefix("readings."))
    assert silent == set()


AXES = re.compile(r"\(\*cases((?:, \w+)*)\)")
OF_OTHERS = {"codes", "free_channels"}
"""Arrays without the axes of cases: of flattened cases, and of channels."""


def solved() -> dict[str, tuple[Any, dict[str, int]]]:
    """By public class: an object that has many arrays, and the lengths of its axes by name."""
    given = qs.load_scene("7210c")
    point = dataclasses.replace(given.operation, axial_load=np.array([[500.0], [700.0]]), speed=np.full(3, 500.0))
    ring = {"bore_diameter": 0.05, "outside_diameter": 0.09, "shaft_interference": 5e-6}
    scene = dataclasses.replace(
        given,
        operation=point,
        ball_effects=(qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=0.06)),
        raceway_control="outer",
        ring_effects=(qs.BallDiameterDeviations(np.zeros(15)), qs.RingExpansion(**ring)),
    )
    solution = qs.solve(scene)
    rows = qs.Row(given.bearing, 0.0, "+x"), qs.Row(given.bearing, 0.02, "-x")
    shaft = qs.Shaft(
        sections=(qs.ShaftSection(0.1, 0.05),), start=-0.03, supports=(qs.ShaftSupport(0.05, 1e6, 1e6, 1e6),)
    )
    loaded = qs.Operation(speed=500.0, radial_load_y=np.array([[500.0], [600.0]]) + np.zeros(3), moment_z=0.0)
    found = qs.solve_set(qs.BearingSet(rows, loaded, qs.Preload(rigid=720.0), shaft=shaft))
    balls, of_set = {"ball": 15}, {"row": 2, "support": 1}
    return {
        "qs.Solution": (solution, balls),
        "qs.RacewayContacts": (solution.inner, balls),
        "qs.SetSolution": (found, of_set),
    }


def test_arrays_of_solutions_have_the_shapes_that_are_told(described: dict[str, Words]) -> None:
    compared = 0
    for of, (holder, lengths) in solved().items():
        for name, (_, text) in described[of].items():
            value = None if name.startswith("_") or name in OF_OTHERS else getattr(holder, name, None)
            if not isinstance(value, np.ndarray):
                continue
            told = [
                each.split(", ")[1:] for each in AXES.findall(text) or AXES.findall(inspect.getdoc(type(holder)) or "")
            ]
            tails = [tuple(str(lengths.get(axis, axis)) for axis in axes) for axes in told]
            assert value.shape[:2] == (2, 3), f"{of}.{name}: {value.shape}"
            assert tuple(map(str, value.shape[2:])) in tails, f"{of}.{name}: {value.shape}, told {told}"
            compared += 1
    assert compared > 55


def test_words_of_each_ball_agree_with_the_description_of_results(described: dict[str, Words]) -> None:
    """What tables and studies take for a number of each ball, and what for one of the case."""
    compared = 0
    for group in GROUPS:
        of = {"": "qs.Solution", "inner": "qs.RacewayContacts", "outer": "qs.RacewayContacts"}.get(str(group.holder))
        for result in group.results if of else ():
            name = str(result.name if result.path is None else result.path)
            _, text = described[of or ""].get(name, ("", ""))
            if AXES.search(text):
                assert ("ball" in AXES.findall(text)[0]) == (group.axis == BALL), (of, name)
                compared += 1
    assert compared > 8
