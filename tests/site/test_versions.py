"""Sites of several versions in one folder, without making one."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from qsbearing.cli import cli
from qsbearing.model.version import __version__
from qsbearing.site import __main__ as site
from qsbearing.site.__main__ import set_close
from qsbearing.site.versions import list_versions


def folder_of(folder: Path, *names: str) -> Path:
    """One with these sites."""
    for name in names:
        (folder / name).mkdir()
        (folder / name / "index.html").write_text("", encoding="utf-8")
    return folder


def test_the_newest_is_first_and_the_folder_leads_there(tmp_path: Path) -> None:
    list_versions(folder_of(tmp_path, "0.9.0", "0.10.0", "0.2.1", "notes"))
    listed = json.loads((tmp_path / "versions.json").read_text(encoding="utf-8"))
    assert [each["version"] for each in listed] == ["0.10.0", "0.9.0", "0.2.1"]
    assert [each["aliases"] for each in listed] == [["latest"], [], []]
    assert "url=0.10.0/index.html" in (tmp_path / "index.html").read_text(encoding="utf-8")


def test_a_version_that_is_made_again_stands_once(tmp_path: Path) -> None:
    folder = folder_of(tmp_path, "0.2.0")
    for _ in range(2):
        list_versions(folder)
    assert len(json.loads((folder / "versions.json").read_text(encoding="utf-8"))) == 1


@pytest.fixture
def no_engine(monkeypatch: pytest.MonkeyPatch) -> None:
    """In its place what it leaves: a first page where the configuration says, with the title of the site."""

    def run(command: list[str], **_: Any) -> subprocess.CompletedProcess[str]:
        if "mkdocs" not in command:  # the command makes it in a process of its own
            site.main.main(command[command.index("qsbearing.site") + 1 :], standalone_mode=False)
            return subprocess.CompletedProcess(command, 0)
        given = json.loads(Path(command[-1]).read_text(encoding="utf-8"))
        page = Path(given["site_dir"]) / "index.html"
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(given.get("site_name", "one of several"), encoding="utf-8")
        return subprocess.CompletedProcess(command, 0)

    monkeypatch.setattr(subprocess, "run", run)
    monkeypatch.setattr(site, "write_pages", lambda folder: [])


def test_it_is_made_in_a_folder_of_its_version(tmp_path: Path, no_engine: None) -> None:
    folder_of(tmp_path, "0.1.9")
    assert CliRunner().invoke(site.main, [str(tmp_path)]).exit_code == 0
    assert (tmp_path / __version__ / "index.html").read_text(encoding="utf-8") == "one of several"
    listed = json.loads((tmp_path / "versions.json").read_text(encoding="utf-8"))
    assert [each["version"] for each in listed] == [__version__, "0.1.9"]


def test_the_command_makes_one_that_stands_alone(
    tmp_path: Path, no_engine: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("mkdocs")
    monkeypatch.setattr(sys.modules["qsbearing.cli.guide"], "_carried", lambda: None)
    ended = CliRunner().invoke(cli, ["guide", "--html", str(tmp_path / "made")])
    assert ended.exit_code == 0, ended.output
    assert [path.name for path in (tmp_path / "made").iterdir()] == ["index.html"]
    assert (tmp_path / "made" / "index.html").read_text(encoding="utf-8") == f"qsbearing {__version__}"


def test_code_keeps_its_lines_where_a_page_is_set_close() -> None:
    code = '<pre><code><span class="k">def</span> {}():\n\n    return 1\n</code></pre>'
    marked, plain = code.format('<span class="n">f</span>'), code.format("f")
    page = f"<ul>\n\n    <li>\n  one\n  </li>\n</ul>\n  {marked}\n\n  <p>two\n  lines</p>"
    assert set_close(page) == f"<ul>\n<li>\none\n</li>\n</ul>\n{plain}\n<p>two\nlines</p>"
