"""Notebooks: what objects show there, and the tutorial, cell by cell and as a reader runs it."""

from __future__ import annotations

import ast
import contextlib
import dataclasses
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("jinja2")
pytest.importorskip("matplotlib")
pytest.importorskip("xarray")

import qsbearing as qs
from qsbearing.documents.terminal import text_of
from qsbearing.results.readings_record import taken
from qsbearing.results.report import result
from tests.guide.mentions import printed, unmentioned
from tests.guide.pages import GUIDE

TUTORIAL = GUIDE / "tutorial.ipynb"


@pytest.fixture(scope="module")
def scene() -> qs.Scene:
    return qs.load_scene("7210C_hybrid")


def words(html: str | None) -> set[str]:
    assert html is not None
    return set(re.sub(r"<[^>]*>", " ", html).split())


def test_a_solution_shows_the_numbers_that_run_prints(scene: qs.Scene) -> None:
    loaded = dataclasses.replace(scene.operation, radial_load_y=300.0, tilt_z=0.0)
    solution = qs.solve(dataclasses.replace(scene, operation=loaded))
    said = text_of(result(solution, taken(solution))).split()
    # What files say is of files, and what is pasted is of commands.
    printed = {word for word in said if re.search(r"\d", word) and '"' not in word and not word.startswith("effects.")}
    assert len(printed) > 60
    assert printed - words(solution._repr_html_()) == set()


def test_each_object_shows_what_it_holds(scene: qs.Scene, tmp_path: Path) -> None:
    many = dataclasses.replace(scene, operation=dataclasses.replace(scene.operation, speed=np.array([500.0, 1000.0])))
    rows = (qs.Row(scene.bearing, -0.02, "+x"), qs.Row(scene.bearing, 0.02, "-x"))
    pair = qs.BearingSet(rows, qs.Operation(speed=800.0), preload=qs.Preload(rigid=300.0))
    solved = qs.solve_set(pair)
    study = qs.Study.of("b218", {"speed_rpm": "0:9000:10", "axial_load_N": "normal(8000,50)"}, samples=32)
    assert {"ball_diameter_mm", "12.7", "pitch_diameter_mm", "70"} <= words(scene._repr_html_())
    assert {"rigid_N", "300"} <= words(pair._repr_html_())
    assert {"axial", f"{solved.axial_loads[0]:.6g}"} <= words(solved._repr_html_())
    assert {"speed_rpm", "320", "normal(8000,"} <= words(study._repr_html_())
    speeds = words(qs.solve(many)._repr_html_())
    assert {"4774.6", "9549.3", "converged"} <= speeds
    assert many._repr_html_() is None  # its table has one number to a key: the text is shown


def test_pictures_by_name(scene: qs.Scene) -> None:
    solution = qs.solve(
        dataclasses.replace(scene, operation=dataclasses.replace(scene.operation, speed=np.arange(3.0)))
    )
    assert len(solution.plot("contact_angles", 2).axes) == 1
    assert len(solution.plot(index=0).axes) > 1
    assert len(qs.plot(solution, "contact_angles", 2).axes) == 1
    with pytest.raises(ValueError, match="section"):
        solution.plot("sektion")
    figure = qs.Study.of("b218", {"speed_rpm": "1000:9000:3"}).plot(y=["ring_displacement_axial"])
    assert len(figure.axes) == 1 and len(figure.axes[0].lines) >= 1


def test_only_public_names_are_listed() -> None:
    assert sorted(dir(qs)) == sorted([*qs.__all__, "__version__"])
    assert all(getattr(qs, name) is not None for name in qs.__all__)


def test_quantities_with_units_are_refused_not_stripped() -> None:
    pint = pytest.importorskip("pint")
    units = pint.UnitRegistry()
    for given in (10.0 * units.kN, np.array([1.0, 2.0]) * units.kN):
        with pytest.raises(qs.SceneError, match="is a quantity with a unit") as caught:
            qs.Operation(axial_load=given)
        assert "10 * qs.kN" in str(caught.value)
        qs.Operation(axial_load=given.to_base_units().magnitude)


def cells() -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(TUTORIAL.read_text(encoding="utf-8"))["cells"]
    return found


def shown(value: Any) -> dict[str, str]:
    """What a notebook shows of it, but for pictures."""
    html = getattr(value, "_repr_html_", lambda: None)()
    return {"text/html": html} if html is not None else {"text/plain": repr(value)}


def numbers_and_words(text: str) -> tuple[list[float], list[str]]:
    """Numbers apart, which may differ in the last of sixteen digits from one processor to another; no time that a run
    took."""
    plain = re.sub(r"<style>.*?</style>|<[^>]*>|\S+\s[mµ]?s\b", " ", text, flags=re.DOTALL)
    number = r"(?<![\w.])[-+\N{MINUS SIGN}]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
    found = [float(each.replace("\N{MINUS SIGN}", "-")) for each in re.findall(number, plain)]
    return found, re.sub(number, " ", plain).split()


def assert_same(now: str, then: str) -> int:
    """What a cell gives and what the notebook shows of it; how many numbers there are."""
    found, shown = numbers_and_words(now), numbers_and_words(then)
    assert found[0] == pytest.approx(shown[0], rel=1e-9, abs=1e-9)
    assert found[1] == shown[1]
    return len(found[0])


def test_the_tutorial_shows_what_its_cells_give(tmp_path: Path) -> None:
    """Outputs no longer those of the program: `python -m tests.verification.benchmarks.guide_notebook`."""
    names: dict[str, Any] = {}
    count, remarked, told = 0, 0, ""
    with contextlib.chdir(tmp_path):
        for cell in cells():
            if cell["cell_type"] != "code":
                told = "".join(cell["source"])
                continue
            *body, last = ast.parse("".join(line for line in cell["source"] if not line.startswith("%"))).body
            exec(compile(ast.Module(body, []), "cell", "exec"), names)
            assert isinstance(last, ast.Expr)
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
            (output,) = cell["outputs"]
            with printed() as said:
                shown(value)
            assert unmentioned(told, said) == set(), "the text above the cell does not mention its remarks"
            remarked += bool(said)
            if "image/png" in output["data"]:
                assert value.__class__.__name__ == "Figure"
                continue
            for form, text in shown(value).items():
                count += assert_same(text, "".join(output["data"][form]))
    assert count > 200 and remarked >= 2
    assert names["found"].is_feasible
    assert names["solution"].converged


@pytest.mark.heavy
def test_run_again_as_a_notebook_it_shows_the_same() -> None:
    """As `python -m tests.verification.benchmarks.guide_notebook` runs it; pictures are there."""
    pytest.importorskip("nbclient")
    from tests.verification.benchmarks import guide_notebook

    forms = set()
    for then, now in zip(cells(), guide_notebook.executed().cells, strict=True):
        assert "".join(then["source"]) == now.source
        for shown, found in zip(then.get("outputs", ()), now.get("outputs", ()), strict=True):
            assert set(shown["data"]) == set(found.data)
            for form, text in found.data.items():
                forms.add(form)
                if form != "image/png":
                    assert_same(text, "".join(shown["data"][form]))
    assert forms == {"text/html", "text/plain", "image/png"}
