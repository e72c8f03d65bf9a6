"""The files of a cost record: written when all is measured, each put in place in one step."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

from fem_check.cost import tables
from fem_check.records_store import replace, text


def try_folder(folder: Path) -> None:
    """Make the folder and see that it takes files, before the work begins.

    Raises:
        OSError: it does not.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryFile(dir=folder):
        pass


def keep(record: dict[str, Any], folder: Path) -> list[Path]:
    """Keep a record where advice and report look for it, in the file of its level."""
    return _put({f"{record['level']}.json": text(record)}, folder)


def write(record: dict[str, Any], folder: Path) -> list[Path]:
    """Write a record, its tables as CSV and its figures; the names let `qsbearing cost` share the folder."""
    from fem_check.cost import figures

    contents = {"fem_cost.json": text(record)}
    contents |= {f"fem_{part}.csv": tables.text_csv(record[part]).encode() for part in tables.CSV_PARTS}
    contents |= {f"fem_{name}.png": figures.png(draw(record)) for name, (draw, _) in figures.FIGURES.items()}
    return _put(contents, folder)


def _put(contents: dict[str, bytes], folder: Path) -> list[Path]:
    for name, content in contents.items():
        replace(folder / name, content)
    return [folder / name for name in contents]
