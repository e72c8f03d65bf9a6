"""The digits of a folder's records, kept as sha256 sums, so that a changed, lost or added record is seen.

`python -m fem_check.release.manifest` writes that of the records in the repository; it belongs into the commit that
changes them.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path

from fem_check import records_store

NAME = "manifest.json"

SHIPPED = (
    "fem_check/records/**/*.json",
    "qsbearing/studies/cost/records/*.json",
    "tests/benchmarks/*.json",
    "tests/campaign/records/*.json",
    "tests/hard_cases/*.json",
    "tests/reference/*.json",
    "tests/*.json",
)
"""Records in the repository."""


def sums(base: Path, patterns: Iterable[str]) -> dict[str, str]:
    """sha256 of each file, by its path below the base; without manifests themselves."""
    files = {path for pattern in patterns for path in base.glob(pattern) if path.name != NAME}
    return {path.relative_to(base).as_posix(): of_file(path) for path in sorted(files)}


def of_file(path: Path) -> str:
    """sha256 of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def write(path: Path, found: dict[str, str]) -> None:
    """Keep the sums, whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    records_store.replace(path, (json.dumps(found, indent=1, sort_keys=True) + "\n").encode())


def read(path: Path) -> dict[str, str] | None:
    """The kept sums; None where there are none.

    Raises:
        RecordError: a file that is no manifest.
    """
    if not path.is_file():
        return None
    try:
        return dict(json.loads(path.read_text(encoding="utf-8")))
    except (ValueError, TypeError) as problem:
        raise records_store.RecordError(f"{path} is no manifest ({problem})") from problem


def problems(kept: dict[str, str], found: dict[str, str]) -> list[str]:
    """What was changed, deleted or added since the sums were kept; empty for nothing."""
    changed = [f"{name} was changed" for name in kept if name in found and found[name] != kept[name]]
    deleted = [f"{name} was deleted" for name in kept if name not in found]
    added = [f"{name} is not in the manifest" for name in found if name not in kept]
    return changed + deleted + added


def of_repository(root: Path) -> Path:
    """Where the manifest of the records in a repository is kept."""
    return root / "fem_check" / "records" / NAME


if __name__ == "__main__":
    folder = Path(__file__).parents[2]
    write(of_repository(folder), sums(folder, SHIPPED))
    print(f"wrote {of_repository(folder)}")
