"""What of `qsbearing sweep`'s options cannot be, known before anything is solved: sentences, all at once."""

from __future__ import annotations

import importlib.util
import os
from typing import Any

from qsbearing.cli.picture_file import PICTURES

TABLES = (".csv", ".parquet")


def ending(name: str) -> str:
    """Of a file's name, in small letters."""
    return os.path.splitext(name)[1].lower()  # noqa: PTH122 - pathlib costs --help its time


def place_problems(out: str | None, overwrite: bool, resume: bool) -> list[str]:
    """Of --out, --overwrite and --resume."""
    found = []
    form = ending(out or "")
    if out is not None and form not in (".nc", *TABLES):
        found.append(f"--out {out}: the name must end in one of .nc, {', '.join(TABLES)}")
    elif out is not None and os.path.isfile(out) and not overwrite and not (resume and _is_unfinished(out)):  # noqa: PTH113
        found.append(f"--out {out}: is there already; --overwrite replaces it")
    if form == ".parquet" and importlib.util.find_spec("pyarrow") is None:
        found.append("--out *.parquet needs pyarrow: pip install pyarrow")
    if resume and form != ".nc":
        found.append("--resume needs --out FILE.nc: only there finished chunks are kept")
    return found


def _is_unfinished(out: str) -> bool:
    """Whether there is a run to go on with, which was allowed to write there."""
    from qsbearing.studies.store import folder_of

    return folder_of(out).is_dir()


def picture_problems(picture: str | None) -> list[str]:
    """Of --plot."""
    if picture is None:
        return []
    if importlib.util.find_spec("matplotlib") is None:
        return ["--plot needs matplotlib: pip install 'qsbearing[studies]'"]
    if ending(picture) not in PICTURES:
        return [f"--plot {picture}: the name must end in one of {', '.join(PICTURES)}"]
    if not os.path.isdir(os.path.dirname(picture) or "."):  # noqa: PTH112, PTH120
        return [f"--plot {picture}: there is no such folder"]
    return []


def sobol_problems(count: int, given: dict[str, Any]) -> list[str]:
    """Of --sobol, and of options that do not go with it."""
    from qsbearing.studies.sobol import count_problem

    found = [f"--sobol {count}: {count_problem(count)}"] if count_problem(count) else []
    for name in ("samples", "sampling", "scheduler", "resume"):
        if given[name] not in (None, False):
            found.append(f"--{name} does not go with --sobol, which draws and solves its own points")
    return found
