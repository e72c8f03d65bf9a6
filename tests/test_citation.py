"""CITATION.cff: the keys that version 1.2 of the format asks for, and the package's own version."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

import qsbearing as qs

yaml = pytest.importorskip("yaml")
ROOT = Path(__file__).parents[1]
CHANGES = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")

ALLOWED = {
    *("abstract", "authors", "cff-version", "commit", "contact", "date-released", "doi", "identifiers", "keywords"),
    *("license", "license-url", "message", "preferred-citation", "references", "repository", "repository-artifact"),
    *("repository-code", "title", "type", "url", "version"),
}
"""Keys at the top of a file of format 1.2."""


@pytest.fixture
def found() -> dict[str, Any]:
    return dict(yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8")))


def test_it_has_what_the_format_asks_for(found):
    assert {"cff-version", "message", "title", "authors"} <= set(found) <= ALLOWED
    assert found["cff-version"] == "1.2.0"
    assert found["type"] in ("software", "dataset")
    for work in [found, *found["references"]]:
        assert work["title"] and work["authors"]
        assert all("name" in who or {"family-names", "given-names"} <= set(who) for who in work["authors"])
    assert all({"type", "title", "authors"} <= set(work) for work in found["references"])


def test_it_is_of_this_version_and_licence(found):
    with (ROOT / "pyproject.toml").open("rb") as file:
        project = tomllib.load(file)["project"]
    assert str(found["version"]) == qs.__version__
    released = re.search(rf"^## {re.escape(qs.__version__)} \((\S+)\)$", CHANGES, flags=re.MULTILINE)
    assert released and str(found["date-released"]) == released[1], "the day is that of the list of changes"
    assert found["license"] == project["license"]
    assert found["title"].startswith(project["name"])
