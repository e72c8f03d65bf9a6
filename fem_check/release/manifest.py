"""The digits of the repository's records, kept as sha256 sums, so that a changed, lost or added record is seen.

`python -m fem_check.release.manifest` writes them; they belong into the commit that changes the records.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from fem_check.running import records_store
from fem_check.running.kept_files import MANIFEST, RECORDS

MISSING = "there is no manifest of its records: nobody can tell whether a digit was changed"


def of_repository(root: Path) -> Path:
    """Where the sums of a repository's records are kept."""
    return root / MANIFEST


def sums(root: Path) -> dict[str, str]:
    """sha256 of each record of a repository, by its path."""
    files = {path for pattern in RECORDS for path in root.glob(pattern)} - {of_repository(root)}
    return {path.relative_to(root).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(files)}


def write(root: Path) -> Path:
    """Keep the sums as they are now; returns their file."""
    path = of_repository(root)
    records_store.replace(path, (json.dumps(sums(root), indent=1, sort_keys=True) + "\n").encode())
    return path


def problems(root: Path) -> list[str]:
    """What was changed, deleted or added since the sums were kept; empty for nothing.

    Raises:
        RecordError: their file holds something else.
    """
    path, actual = of_repository(root), sums(root)
    if not path.is_file():
        return [MISSING]
    try:
        kept = dict(json.loads(path.read_text(encoding="utf-8")))
    except (ValueError, TypeError) as problem:
        raise records_store.RecordError(f"{path} is not a manifest ({problem})") from problem
    changed = [f"{name} was changed" for name in kept if name in actual and actual[name] != kept[name]]
    deleted = [f"{name} was deleted" for name in kept if name not in actual]
    return changed + deleted + [f"{name} is not in the manifest" for name in actual if name not in kept]


if __name__ == "__main__":
    print(f"wrote {write(Path(__file__).parents[2])}")
