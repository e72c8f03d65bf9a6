"""Every example, wherever it stands: nothing in it is wrong, files load, and each output that is shown is compared with
a run or has its reason why not."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

pytest.importorskip("xarray")
pytest.importorskip("matplotlib")

import qsbearing as qs
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.studies.scenes import base_scene
from qsbearing.studies.study import Study
from tests.guide.example_rules import wrong
from tests.guide.examples import INLINE, Example, every_page, everywhere, named
from tests.guide.pages import GUIDE, PAGES, REFUSED, blocks, commands, files_of

ON_PURPOSE = {
    "adding_a_reading.md": {
        "qsbearing.": "the page is about the code itself",
    },
    "adding_an_effect.md": {
        "qsbearing.model.": "the page is about the code itself",
        "[effects.groove_wear]": "the effect that it adds",
    },
    "how_to.md": {"ball_diameter_in": "refused, to show the line to write in its place"},
}
"""What is wrong and stays, by page and beginning of what is said of it, with the reason."""
NOT_COMPARED = {
    ("adding_an_effect.md", "text"): "a line of a list, which tests/model/effects/test_adding_an_effect.py adds",
    ("force_tables.md", "matlab"): "no MATLAB runs here; the page says so",
}
"""Blocks that nothing runs and nothing prints, by page and language, with the reason."""


@cache
def examples() -> dict[str, list[Example]]:
    return everywhere()


def faults(found: list[Example]) -> list[str]:
    """Of the examples of one file."""
    beside = frozenset(re.findall(r"[A-Za-z]\w*", " ".join(each.text for each in found if each.language != INLINE)))
    return [f"{each.where}: {problem}" for each in found for problem in wrong(each, beside)]


@pytest.mark.parametrize("name", [named(path) for path in [*every_page(), *sorted(GUIDE.glob("*.ipynb"))]])
def test_nothing_is_wrong_with_the_examples_of_a_page(name: str) -> None:
    reasons = ON_PURPOSE.get(Path(name).name, {})
    found = [each.partition(": ")[2] for each in faults(examples().get(name, []))]
    assert [each for each in found if not each.startswith(tuple(reasons))] == []
    assert [each for each in reasons if not any(one.startswith(each) for one in found)] == [], "no longer wrong"


def test_nothing_is_wrong_with_the_examples_of_docstrings_help_and_messages() -> None:
    found = {name: each for name, each in examples().items() if name.endswith((".py", ".yml"))}
    assert sum(map(len, found.values())) > 1000
    assert [problem for each in found.values() for problem in faults(each)] == []


PLANTED = {
    "option": ("sh", "qsbearing run b218 --plots my.png", "No such option"),
    "command": ("sh", "cd a && .venv/bin/qsbearing solve b218", "has no command 'solve'"),
    "argument": ("sh", "qsbearing stiffness b218 7210C", "nothing takes"),
    "choice": ("sh", "qsbearing stiffness b218 --format nastrn", "--format nastrn"),
    "set key": ("sh", "qsbearing run b218 --set operation.speed=100", "operation.speed is no key"),
    "vary key": ("sh", "qsbearing sweep b218 --vary axial_load_kN=1:2:3", "axial_load_kN is no key"),
    "result": ("sh", "qsbearing find b218 --limit 'inner.max_presure_MPa<=1500'", "is no result"),
    "extra": ("sh", "pip install 'qsbearing[plots]'", "no extra 'plots'"),
    "program": ("sh", "qsbaering run b218", "no program of this project"),
    "module": ("sh", "python -m fem_check.releases", "no module"),
    "mark": ("sh", ".venv/bin/pytest -m quickly", "'quickly'"),
    "test file": ("sh", "pytest tests/fem_checks", "there is no tests/fem_checks"),
    "quotes": ("sh", "qsbearing run b218 --set 'a=1", "No closing quotation"),
    "not TOML": ("toml", "[bearing\nball_count = 3", "cannot be read"),
    "old key": ("toml", "[bearing]\ncontact_angle_deg = 25", "contact_angle_deg is no key"),
    "old key in a row": ("toml", "rows = [{ place_mm = 0 }]", "place_mm is no key"),
    "unit": ("toml", "[operation]\naxial_load_N = 8  # in kN", "in kN"),
    "unit of a length": ("toml", "[bearing]\nball_diameter_mm = 0.0127  # m", "in m"),
    "not Python": ("python", "qs.solve(", "cannot be read"),
    "private import": ("python", "from qsbearing.model.solution.solver import solve", "solver.solve is not public"),
    "private name": ("python", "import qsbearing as qs\nqs.model.units", "qs.model is no public name"),
    "old name": ("python", "import qsbearing as qs\nqs.solve_scene('b218')", "qs.solve_scene is no public name"),
    "unit in Python": ("python", "qs.Operation(\n    speed=12_000 * qs.rpm,  # rad/s\n)", "rad/s"),
    "not JSON": ("json", '{"a": 1,}', "cannot be read"),
    "server": ("json", '{"command": "qsbearing", "args": ["mcp", "--dir", "."]}', "No such option"),
    "language": ("console", "$ ls", "no rule"),
    "command in a sentence": (INLINE, "qsbearing run SCENE --requires", "No such option"),
    "option in a sentence": (INLINE, "--tolerances 0.01", "no command has --tolerances"),
    "table in a sentence": (INLINE, "[readings.lives]", "no table"),
    "line in a sentence": (INLINE, "preloads = 300", "preloads is no key"),
    "key in a sentence": (INLINE, "shaft_interference_mm", "nothing is called"),
    "Python in a sentence": (INLINE, "qs.solve_pair(pair)", "no public name"),
}
"""Mistakes, with what is said of them."""


@pytest.mark.parametrize("name", PLANTED)
def test_a_planted_mistake_is_found(name: str) -> None:
    language, text, said = PLANTED[name]
    found = wrong(Example("page.md:1", language, text))
    assert any(said in each for each in found), found


def load(document: dict[str, object]) -> object:
    """As the program does."""
    return base_scene(Study.of(document)) if "vary" in document else scene_or_set_of(document, "file", may_infer=True)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_file_of_a_page_loads(page: Path, tmp_path: Path) -> None:
    for name, document in files_of(page, tmp_path):
        if isinstance(document.get("spectrum"), dict):
            continue  # from a table that the page's program writes
        if name in REFUSED:
            with pytest.raises(qs.SceneFileError):
                load(document)
        else:
            load(document)


def test_a_file_that_does_not_load_is_found(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("```toml\n[bearing]\nname = 'b218'\n[operation]\nspeed_rpm = -3\n```\n", encoding="utf-8")
    ((_, document),) = files_of(page, tmp_path)
    with pytest.raises(qs.SceneFileError):
        load(document)


def uncompared(page: Path) -> set[str]:
    """Languages of blocks that no run is compared with: those that nothing runs, and texts behind no command."""
    found, before = set(), ""
    for block in blocks(page):
        if block.language == "text" and before != "sh":
            found.add("text")
        elif block.language not in ("sh", "python", "toml", "xml", "json", "text"):
            found.add(block.language)
        before = block.language
    return found


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_each_output_is_compared_or_has_its_reason(page: Path) -> None:
    assert {(page.name, each) for each in uncompared(page)} == {each for each in NOT_COMPARED if each[0] == page.name}


_FILE = re.compile(r"[a-z0-9][\w.]*\.(?:toml|json|nc|csv|xlsx|parquet|rexs)")
WRITES = {">", "--out", "--csv", "--plot"}
"""What stands before a file that a command writes."""


def unmade(found: list[Example]) -> list[str]:
    """Files that commands read and nothing before them has made: no block, no program, no other command."""
    made, lacking = {"my.toml"}, []
    for each in found:
        if each.language in ("toml", "xml", "python"):
            made |= set(_FILE.findall(each.text))
        elif each.language == "sh" or re.match(r"(?:qsbearing|fem-check) ", each.text):
            for words in commands(each.text):
                pairs = list(zip(["", *words], words, strict=False))
                reads = {word for before, word in pairs if before not in WRITES and _FILE.fullmatch(word)}
                lacking += [f"{each.where}: {word}" for word in sorted(reads - made)]
                made |= {word for before, word in pairs if before in WRITES}
    return lacking


@pytest.mark.parametrize("name", [named(path) for path in every_page()])
def test_files_that_commands_read_are_made_before(name: str) -> None:
    assert unmade(examples().get(name, [])) == []


def test_a_file_that_nothing_made_is_found() -> None:
    made = [Example("page.md:1", "sh", "qsbearing init > one.toml\nqsbearing run one.toml --csv balls.csv")]
    assert unmade(made) == []
    assert unmade([*made, Example("page.md:5", "sh", "qsbearing run two.toml")]) == ["page.md:5: two.toml"]
