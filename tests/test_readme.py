"""README and guide stay true: code runs, commands are CI's, tables are the records', links and files exist."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from tests.verification.benchmarks import guide_pictures, tables
from tests.verification.reference.generate import load_reference

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = sorted(tables.GUIDE.glob("*.md"))


def blocks(language: str) -> list[str]:
    """The README's code blocks of one language."""
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.DOTALL)


def test_the_readme_stays_short() -> None:
    assert len(README.splitlines()) <= 120
    assert [line for line in README.splitlines() if len(line) > 88] == []


def test_one_line_installs_and_runs_and_one_tests() -> None:
    alone = [block for block in blocks("sh") if "venv" in block.partition("\n")[0].split()]
    assert [block.count("\n") for block in alone] == [1, 1]
    assert ["qsbearing run" in block for block in alone] == [True, False]


def test_the_python_runs_and_prints_what_it_says(capsys: pytest.CaptureFixture[str]) -> None:
    (code,) = blocks("python")
    exec(compile(code, "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert "converged 49.94" in printed


def test_the_scene_file_solves(tmp_path: Path) -> None:
    one, pair = blocks("toml")
    for name, text in {"my": one, "pair": pair}.items():
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    solution = qs.solve(qs.load_scene(tmp_path / "my.toml"))
    assert solution.converged
    assert solution.gyroscopic_moment is not None
    assert qs.solve_set(qs.load_set(tmp_path / "pair.toml")).converged


def test_ci_runs_the_test_commands_literally() -> None:
    """Within parentheses: bash goes on where an inner part of `a && b` fails, and stops where a subshell does."""
    (block,) = [block for block in blocks("sh") if block.endswith(".venv/bin/pytest -n auto\n")]
    assert f"\n(\n{block})\n" in (ROOT / ".ci" / "run").read_text(encoding="utf-8")


def test_the_output_shown_is_what_the_command_prints() -> None:
    (shown,) = blocks("text")
    printed = CliRunner().invoke(cli, ["run", "b218"]).output
    assert shown in printed


def test_the_picture_of_the_section_is_that_of_the_program(drawn: None) -> None:
    """Another: `python -m tests.verification.benchmarks.guide_pictures`. Lines and letters; other versions of
    matplotlib may write the same with other names, and round otherwise."""
    made = guide_pictures.svg(guide_pictures.overview(qs.solve(qs.load_scene("b218"))))
    shipped = (tables.GUIDE / "section.svg").read_text(encoding="utf-8")
    now, then = (re.findall(r' (?:d|x|y|transform)="([^"]*)"', text) for text in (made, shipped))
    assert [re.sub(r"[-\d.]+", "0", each) for each in now] == [re.sub(r"[-\d.]+", "0", each) for each in then]
    numbers = ([float(each) for text in found for each in re.findall(r"-?\d+\.?\d*", text)] for found in (now, then))
    assert next(numbers) == pytest.approx(next(numbers), abs=0.02)


@pytest.mark.parametrize("page", tables.PAGES)
def test_the_tables_are_made_from_the_records(page: str) -> None:
    assert tables.filled(page) == tables.path_of(page).read_text(encoding="utf-8")


def test_every_table_mark_of_the_guide_is_filled_by_a_script() -> None:
    for page in (ROOT / "README.md", *PAGES):
        marks = set(re.findall(r"<!-- end of (.+?) -->", page.read_text(encoding="utf-8")))
        elsewhere = (
            {"agreement"} if page.name == "agreement.md" else set()
        )  # tests/guide/agreement.py, which tables calls
        assert marks == set(tables.PAGES.get(page.name, {})) | elsewhere, page.name


def test_the_records_that_the_readme_counts_are_whole_and_without_a_wrong_result() -> None:
    """What it states of them: tests/guide/test_claims.py."""
    recorded = [
        case["case"] for case in tables.read(ROOT / "tests" / "verification" / "reference" / "table.json")["cases"]
    ]
    assert recorded == [entry["case"]["name"] for entry in load_reference()]
    campaigns = [json.loads(path.read_text(encoding="utf-8")) for path in tables.CAMPAIGNS.glob("*/summary.json")]
    assert sum("envelope" in record for record in campaigns) == 3
    assert f"wrong in {len(campaigns)} campaigns: 0" in README
    assert not any(record.get("wrong") or record.get("failures") for record in campaigns)


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


@pytest.mark.parametrize(
    ("name", "panels"), [("section.svg", 2), ("b218_life.svg", 2), ("spindle.svg", 2), ("span.svg", 1)]
)
def test_the_pictures_are_light(name: str, panels: int) -> None:
    """Thirty thousand bytes for each panel."""
    assert (tables.GUIDE / name).stat().st_size < 30_000 * panels
