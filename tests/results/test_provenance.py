"""Where records come from: stated in full, read from git, never guessed."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

import qsbearing as qs
from qsbearing.results import provenance

KEYS = {"qsbearing", "commit", "dirty", "date", "machine", "packages", "command", "level"}


@pytest.fixture
def tree(tmp_path, monkeypatch):
    """A repository with one commit, as if it were the package's own."""
    (tmp_path / "kept").write_text("1")
    for command in (["init", "-q"], ["add", "kept"], [*_author(), "commit", "-qm", "first"]):
        provenance.git(*command, folder=tmp_path)
    monkeypatch.setattr(provenance, "FOLDER", tmp_path)
    provenance._source.cache_clear()
    yield tmp_path
    provenance._source.cache_clear()


def _author() -> list[str]:
    return ["-c", "user.name=a", "-c", "user.email=a@b.c"]


def test_a_run_states_everything():
    found = provenance.of_run("make it", "quick", ("click", "no-such-package"))
    assert set(found) == KEYS
    assert found["qsbearing"] == qs.__version__
    assert (found["command"], found["level"]) == ("make it", "quick")
    assert found["packages"] == {name: metadata.version(name) for name in ("numpy", "numba", "scipy", "click")}
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", found["date"])
    assert found["machine"]["python"] == ".".join(map(str, sys.version_info[:3]))
    assert found["machine"]["cores"] >= 1 and found["machine"]["memory_GB"] > 0.1
    assert json.loads(json.dumps(found)) == found


def test_commit_and_changes_are_those_of_git(tree):
    head = subprocess.run(["git", "-C", tree, "rev-parse", "HEAD"], capture_output=True, text=True).stdout.strip()
    assert len(head) == 40
    assert (provenance.commit(), provenance.is_dirty()) == (head, False)
    (tree / "new").write_text("not committed")
    assert provenance.is_dirty() is False, "what this process writes did not make its numbers"
    provenance._source.cache_clear()
    assert provenance.is_dirty() is True
    assert provenance.of_run("x")["dirty"] is True


def test_an_installed_package_has_no_commit(tmp_path, monkeypatch):
    """Even where its folder lies inside somebody's repository."""
    provenance.git("init", "-q", folder=tmp_path)
    (tmp_path / "site-packages").mkdir()
    monkeypatch.setattr(provenance, "FOLDER", tmp_path / "site-packages")
    provenance._source.cache_clear()
    assert (provenance.commit(), provenance.is_dirty()) == (None, None)
    assert provenance.of_run("x")["commit"] is None
    provenance._source.cache_clear()


def test_importing_it_costs_next_to_nothing():
    heavy = "{'numba', 'scipy', 'numpy.random'}"
    code = f"import sys, qsbearing.results.provenance; sys.exit(bool({heavy} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], cwd=Path(qs.__file__).parents[1]).returncode == 0
