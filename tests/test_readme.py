"""README and guide stay true: code runs, commands are CI's, tables are the records', links and files exist."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import qsbearing as qs
from tests.benchmarks import cost, effects_cost, tables
from tests.reference.generate import load_reference

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
ACCURACY = tables.GUIDE / "accuracy.md"
PAGES = sorted(tables.GUIDE.glob("*.md"))


def blocks(language: str) -> list[str]:
    """The README's code blocks of one language."""
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.DOTALL)


def test_the_readme_stays_short() -> None:
    assert len(README.splitlines()) <= 150


def test_the_python_runs_and_prints_what_it_says(capsys: pytest.CaptureFixture[str]) -> None:
    (code,) = blocks("python")
    exec(compile(code, "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert "converged 49.94" in printed
    assert "(3, 8, 5) (3, 8, 16)" in printed


def test_the_scene_file_solves(tmp_path: Path) -> None:
    (text,) = blocks("toml")
    path = tmp_path / "my.toml"
    path.write_text(text, encoding="utf-8")
    solution = qs.solve(qs.load_scene(path))
    assert solution.converged
    assert solution.gyroscopic_moment is not None


def test_ci_calls_the_test_command_literally() -> None:
    lines = [line for block in blocks("sh") for line in block.splitlines()]
    commands = [line for line in lines if line.endswith(".venv/bin/pytest -n auto")]
    assert len(commands) == 1
    assert commands[0] in (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()


@pytest.mark.parametrize("page", tables.PAGES)
def test_the_tables_are_made_from_the_records(page: str) -> None:
    assert tables.filled(page) == (tables.GUIDE / page).read_text(encoding="utf-8")


def test_the_table_of_time_against_accuracy_is_made_from_its_record() -> None:
    page = ACCURACY.read_text(encoding="utf-8")
    assert cost.filled(page, cost.load()) == page


def test_the_table_of_what_effects_cost_is_made_from_its_record() -> None:
    assert effects_cost.filled(README, effects_cost.load()) == README


def test_every_table_mark_of_the_guide_is_filled_by_a_script() -> None:
    for page in PAGES:
        marks = set(re.findall(r"<!-- end of (.+?) -->", page.read_text(encoding="utf-8")))
        known = set(tables.PAGES.get(page.name, {})) | ({cost.MARK} if page == ACCURACY else set())
        assert marks == known, page.name


def test_the_counts_that_the_readme_states_are_the_records() -> None:
    assert f"{len(load_reference())} scenes against an independent solution" in README
    recorded = [case["case"] for case in tables.read(ROOT / "tests" / "reference" / "table.json")["cases"]]
    assert recorded == [entry["case"]["name"] for entry in load_reference()]
    hard = tables.read(tables.HARD_CASES)["cases"]
    within = sum(case["verdict"] == "within 1e-9" for case in hard)
    assert f"{len(hard)} named hard cases, {within} of which" in " ".join(README.split())
    for path in tables.CAMPAIGNS.glob("*.json"):
        record = json.loads(path.read_text(encoding="utf-8"))
        for number in (record["count"], record["classes"]["converged"]):
            assert f"{number:,}" in README, path.name


@pytest.mark.parametrize("page", [ROOT / "README.md", *PAGES], ids=lambda page: page.name)
def test_every_link_leads_to_a_file(page: Path) -> None:
    links = re.findall(r"\]\(([^)#]+)", page.read_text(encoding="utf-8"))
    for link in links:
        assert link.startswith("https://") or (page.parent / link).exists(), link


@pytest.mark.parametrize("page", [ROOT / "README.md", *PAGES], ids=lambda page: page.name)
def test_every_file_that_is_named_exists(page: Path) -> None:
    """A path in back quotes is one of the repository or of the package."""
    for name in set(re.findall(r"`((?:\w+/)+(?:\w+\.\w+)?|\w+\.py)`", page.read_text(encoding="utf-8"))):
        assert any((folder / name).exists() for folder in (ROOT, ROOT / "qsbearing", ROOT / "fem_check")), name


def test_the_map_names_every_folder_of_the_packages() -> None:
    packages = (ROOT / "qsbearing", ROOT / "fem_check")
    folders = {path.parent.name for package in packages for path in package.glob("*/__init__.py")}
    page = (tables.GUIDE / "code.md").read_text(encoding="utf-8")
    lines = [line.split("|")[1] for line in page.splitlines() if line.startswith("| `")]
    assert folders <= {name for line in lines for name in re.findall(r"`(\w+)/`", line)}


@pytest.mark.parametrize(("name", "panels"), [("gallery/speed.svg", 3), ("b218_life.svg", 2), ("spindle.svg", 2)])
def test_the_pictures_are_light(name: str, panels: int) -> None:
    """Thirty thousand bytes for each panel."""
    assert (tables.GUIDE / name).stat().st_size < 30_000 * panels
