"""Records on disk: one JSON file per check and level, written whole or not at all."""

from __future__ import annotations

import json
import os
import shlex
import sys
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, cast

from fem_check import meshing
from fem_check.product.scenes import RING_OPTIONS
from fem_check.rows.agreement import EXAMPLE, Check, Findings, MeshLevel
from fem_check.rows.record import CheckRecord, entries_of
from qsbearing import __version__
from qsbearing.results import provenance

FOLDER = Path(__file__).parents[1] / "records"
FIELDS = entries_of(CheckRecord)


PACKAGES = ("scikit-fem", "meshio", "rslab", "gmsh")
"""On which the numbers of a check rest, beside those of the solver."""


class RecordError(Exception):
    """Records cannot be read; the message says which and why."""


def versions() -> dict[str, str]:
    """Versions of what the numbers rest on."""
    by_package = {"qsbearing": __version__} | provenance.versions(("numpy", "scipy", *PACKAGES))
    gmsh = meshing.gmsh_version()
    return by_package | ({"gmsh": gmsh} if gmsh else {})


def record(
    check: Check | None,
    name: str,
    level: str,
    findings: Findings,
    seconds: float,
    cpu_seconds: float,
    peak_memory_MB: float,
    scene: str = EXAMPLE,
) -> CheckRecord:
    """A check's findings as they are kept and printed.

    The processor's time stands beside the clock's: on a machine that others use too, only it tells the work done.
    """
    entry: dict[str, Any] = {
        "check": name,
        "level": str(level),
        "scene": scene,
        "verdict": findings.verdict,
        "seconds": round(seconds, 2),
        "cpu_seconds": round(cpu_seconds, 2),
        "peak_memory_MB": round(peak_memory_MB),
        "mesh": findings.mesh,
        "solver": findings.solver,
        "versions": versions(),
        "rows": [row.as_dict() for row in findings.rows],
    }
    if check is not None:
        entry |= {
            "question": check.question,
            "kind": str(check.kind),
            "reference": check.reference,
            "tolerance": check.tolerance,
        }
    command = command_of(name, level, scene) if check else shlex.join(["fem-check", *sys.argv[1:]])
    entry["provenance"] = provenance.of_run(command, str(level), PACKAGES)
    entry["notes"] = findings.notes
    entry["pictures"] = findings.pictures
    return cast(CheckRecord, entry)


def command_of(name: str, level: str, scene: str) -> str:
    """What makes a check's record anew."""
    bearing = [] if scene == EXAMPLE and not any(RING_OPTIONS.get().values()) else ["--scene", scene]
    rings = [
        part
        for dimension, value in RING_OPTIONS.get().items()
        if value is not None
        for part in (f"--{dimension.replace('_', '-')}-mm", f"{1e3 * value:.10g}")
    ]
    return shlex.join(["fem-check", "run", name, "--level", level, *bearing, *rings])


def path_of(name: str, level: str, folder: Path = FOLDER) -> Path:
    """Where a check's record is kept."""
    return folder / str(level) / f"{name}.json"


def write(entry: CheckRecord, folder: Path = FOLDER) -> Path:
    """Keep a record: the file is replaced in one step, so an interrupted run leaves the earlier one whole."""
    path = path_of(entry["check"], entry["level"], folder)
    path.parent.mkdir(parents=True, exist_ok=True)
    replace(path, text(entry))
    return path


def text(entry: Mapping[str, Any]) -> bytes:
    """A record as it stands in its file: rows to read, and the pictures' numbers, which nobody reads, on one line."""
    read = json.dumps({key: value for key, value in entry.items() if key != "pictures"}, indent=1, allow_nan=False)
    if "pictures" in entry:
        read = f'{read[:-2]},\n "pictures": {json.dumps(entry["pictures"], allow_nan=False)}\n}}'
    return f"{read}\n".encode()


def replace(path: Path, content: bytes) -> None:
    """Put a file in place, whole or not at all."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        Path(temporary).chmod(0o644)
        Path(temporary).replace(path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def read_all(folder: Path = FOLDER) -> dict[str, CheckRecord]:
    """The records of each check, the release level's where there is one, else the quick level's."""
    by_check: dict[str, CheckRecord] = {}
    for level in (MeshLevel.QUICK, MeshLevel.RELEASE):
        for path in sorted((folder / level).glob("*.json")):
            entry = cast(CheckRecord, read(path, FIELDS, "no record", "run its check again"))
            by_check[entry["check"]] = entry
    return by_check


def read(path: Path, fields: Iterable[str], unfit: str, remedy: str) -> dict[str, Any]:
    """The record in a file.

    Args:
        fields: which it must have.
        unfit: what to say of a file that cannot be read as a record, such as "no record".
        remedy: what makes it anew.

    Raises:
        RecordError: the file is damaged, or lacks a field.
    """
    try:
        entry: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        missing = [field for field in fields if field not in entry]
    except (ValueError, OSError, TypeError) as problem:
        raise RecordError(f"{path} is {unfit} ({problem}); {remedy}") from problem
    if missing:
        raise RecordError(f"{path} lacks {', '.join(missing)}; {remedy}")
    return entry
