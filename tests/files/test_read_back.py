"""What is written is read back and compared with the tables that it was written of."""

from __future__ import annotations

from pathlib import Path

import pytest

from qsbearing.app import answers
from qsbearing.files import catalogue, template
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.scene_file import document_of
from qsbearing.files.toml import read_back

TEXT = '[bearing]\nname = "B218"\nball_count = 16\n'
TABLES = {"bearing": {"name": "B218", "ball_count": 16}}


def test_tables_come_back() -> None:
    assert read_back(TEXT, TABLES, Path("a.toml")) == TABLES


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (TEXT.replace("16", "15"), "is read as something else in bearing"),
        (TEXT + "[operation]\nspeed_rpm = 1\n", "is read as something else in operation"),
        (TEXT.replace('"B218"', '"B2\n18"'), "its text is not read again"),
    ],
)
def test_another_text_is_refused(text: str, told: str) -> None:
    with pytest.raises(SceneFileError, match=told):
        read_back(text, TABLES, Path("a.toml"))


def test_a_saved_scene_is_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    document = document_of("b218")[0]
    assert answers.saved(document, "b218")["text"]
    monkeypatch.setattr("tomli_w.dumps", lambda tables: '[bearing]\nname = "7210C"\n')
    with pytest.raises(SceneFileError, match="is read as something else"):
        answers.saved(document, "b218")


@pytest.mark.parametrize("by_name", [True, False])
def test_a_template_that_lost_a_number_is_refused(by_name: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    entry = catalogue.entries()[0]
    assert template.scene_template(entry, by_name)
    monkeypatch.setattr(template, "_toml", lambda value: '"lost"')
    with pytest.raises(SceneFileError, match="is read as something else"):
        template.scene_template(entry, by_name)
