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

pytest.importorskip("xarray")
pytest.importorskip("matplotlib")
WITHOUT_EXAMPLE = {"ross_element", "to_ross"}
"""These need ROSS, which the environment of the tests has not; their page of the guide runs where it is."""


def functions() -> Iterator[tuple[str, Any]]:
    for prefix, holder in (("qs", qs), ("qs.readings", qs.readings)):
        for name in holder.__all__:
            if inspect.isfunction(value := getattr(holder, name)):
                yield f"{prefix}.{name}", value


FUNCTIONS = dict(functions())


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


@pytest.mark.parametrize("name", FUNCTIONS)
def test_documented_arguments_are_there(name: str) -> None:
    section = re.search(r"^Args:\n((?:[ ]{4}.*\n|\n)+)", (inspect.getdoc(FUNCTIONS[name]) or "") + "\n", re.MULTILINE)
    told = re.findall(r"^ {4}(\w[\w, ]*):", section[1], re.MULTILINE) if section else []
    named = {each.strip() for line in told for each in line.split(",")}
    assert named <= set(inspect.signature(FUNCTIONS[name]).parameters)


NO_NUMBERS = {
    "BearingSet.numbers_around", "Belt.assumed", "Gear.assumed", "ErrorDetail.allowed", "ErrorDetail.where",
    "FileErrorDetail.allowed", "FileErrorDetail.where", "InferredBearing.set_number", "InferredBearing.practice",
    "Operation.turning", "Row.sign", "Row.out_of_line", "SetSolution.line", "ElasticRings.housing_touches",
    "ElasticRings.shaft_touches", "ElasticRings.inner_compliance", "RingExpansion.shaft_touches",
    "RingExpansion.housing_touches", "SolutionOfCases.seconds", "Solution.slips", "Solution.raceway_control",
    "Life.is_at_limit",
    *(f"{of}.{name}" for of in ("Solution", "SetSolution", "SolutionOfCases") for name in ("codes", "free_channels")),
}  # fmt: skip
"""Of what may be arrays: words, switches, counts, and what stands in the unit of something else."""
IN_SI = re.compile(r"\[[^\]]+\]|\bSI\b")


def test_every_number_names_its_unit() -> None:
    """In square brackets, [-] for a ratio; or says that it is in SI, where the unit differs from entry to entry."""
    griffe = pytest.importorskip("griffe")
    package = griffe.load(
        "qsbearing", resolve_aliases=False, extensions=griffe.load_extensions("qsbearing.site.lazy_docs")
    )
    public = [getattr(holder, name) for holder in (qs, qs.readings) for name in holder.__all__]
    silent, numbers = set(), 0
    for of in {each for one in public if inspect.isclass(one) for each in one.__mro__}:
        if not of.__module__.startswith("qsbearing."):
            continue
        for name, member in package[f"{of.__module__.removeprefix('qsbearing.')}.{of.__qualname__}"].members.items():
            if name.startswith("_") or member.is_alias or member.is_class or member.is_module:
                continue
            if member.is_function and "property" not in member.labels:
                continue
            kind = str(member.returns if member.is_function else member.annotation)
            if re.search("float|ArrayLike|NDArray", kind):
                numbers += 1
                kind_of = package["model.solution.solution.Solution"] if of.__name__ == "SolutionOfCases" else None
                told = kind_of.members.get(name, member) if kind_of else member
                text = told.docstring.value if told.docstring else ""
                silent |= set() if IN_SI.search(text) else {f"{of.__name__}.{name}"}
    assert numbers > 200
    assert silent - NO_NUMBERS == set()
