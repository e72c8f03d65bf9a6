"""THIRD_PARTY_LICENSES.md: all that a wheel carries of others, each with the text of its licence."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
NAME = "qsbearing/THIRD_PARTY_LICENSES.md"
TEXT = (ROOT / NAME).read_text(encoding="utf-8")
ROWS = re.findall(r"^\| ([\w -]+?)(?:: .*?)? \| \(c\) .*? \| ([\w.-]+) \|$", TEXT, flags=re.MULTILINE)


def packages_of(scripts: Path) -> set[str]:
    """Those that are bundled into the scripts of a folder, by the maps beside them."""
    sources = [each for path in scripts.rglob("*.map") for each in json.loads(path.read_text("utf-8"))["sources"]]
    return {name for each in sources for name in re.findall(r"node_modules/((?:@[^/]+/)?[^/]+)/", each)}


def test_what_the_scripts_of_the_theme_contain_is_listed() -> None:
    theme = Path(pytest.importorskip("material").__file__).parent
    bundled = packages_of(theme / "templates" / "assets" / "javascripts")
    assert len(bundled) >= 5
    assert bundled <= {name for name, _ in ROWS}


def test_every_licence_has_its_text() -> None:
    licences = {licence for _, licence in ROWS}
    texts = dict(re.findall(r"^### (\S+)\n\n```text\n(.*?)^```$", TEXT, flags=re.MULTILINE | re.DOTALL))
    assert licences == set(texts)
    assert all(len(text) > 500 for text in texts.values())


def test_it_goes_where_the_licence_goes() -> None:
    with (ROOT / "pyproject.toml").open("rb") as file:
        settings = tomllib.load(file)
    assert settings["project"]["license-files"] == ["LICENSE", NAME]


def test_the_source_holds_no_script_style_or_font_of_others() -> None:
    """They say whose they are; ours do not."""
    held = [path for package in ("qsbearing", "fem_check") for path in (ROOT / package).rglob("*")]
    own = [path for path in held if "built" not in path.parts]
    assert [path for path in own if path.suffix in (".woff", ".woff2", ".ttf", ".otf")] == []
    written = [path for path in own if path.suffix in (".js", ".css", ".html", ".typ")]
    assert len(written) > 20
    assert [
        path for path in written if re.search(r"copyright|licen[sc]e|@preserve", path.read_text("utf-8"), re.I)
    ] == []
