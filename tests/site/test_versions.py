"""Sites of several versions in one folder, without making one."""

from __future__ import annotations

import json
from pathlib import Path

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


def test_code_keeps_its_lines_where_a_page_is_set_close() -> None:
    code = "<pre><code>def f():\n\n    return 1\n</code></pre>"
    page = f"<ul>\n\n    <li>\n  one\n  </li>\n</ul>\n  {code}\n\n  <p>two\n  lines</p>"
    assert set_close(page) == f"<ul>\n<li>\none\n</li>\n</ul>\n{code}\n<p>two\nlines</p>"
