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
