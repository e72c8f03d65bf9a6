"""The previous release's records: in a folder, at a tag, or those that came with the package."""

from __future__ import annotations

import io
import json
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from zipfile import ZipFile

from fem_check.records_store import RecordError
from fem_check.release import manifest

RECORDS = "fem_check/records"
NO_MANIFEST = "there is no manifest of its records: nobody can tell whether a digit was changed"


@dataclass(frozen=True)
class Previous:
    """Records to compare with."""

    folder: Path
    """Laid out as the gate's own."""
    repository: Path | None
    """The source tree that the folder is part of, with further records; None where there is none."""
    label: str
    """What they are, for a sentence."""
    problems: list[str]
    """What was changed, deleted or added since its manifest was written."""

    def read(self, name: str, in_repository: str | None = None) -> dict[str, Any] | None:
        """A record by its path in the folder, or else by that in the repository; None where there is neither.

        Raises:
            RecordError: a file that is no record.
        """
        places = [self.folder / name]
        if in_repository is not None and self.repository is not None:
            places.append(self.repository / in_repository)
        for path in places:
            if path.is_file():
                return read(path)
        return None

    def names(self, pattern: str) -> list[str]:
        """Paths of records in the folder."""
        return sorted(path.relative_to(self.folder).as_posix() for path in self.folder.glob(pattern))


def read(path: Path) -> dict[str, Any]:
    """A record.

    Raises:
        RecordError: a file that is none, or cannot be read.
    """
    try:
        return dict(json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError) as problem:
        raise RecordError(f"{path} is no record ({problem})") from problem


@contextmanager
def opened(root: Path, named: str | None) -> Iterator[Previous]:
    """The records that a name stands for, while they are needed.

    Args:
        root: of the checkout.
        named: a folder that holds a checkout or what an earlier gate kept, a tag or a commit; None for the records in
            the checkout.

    Raises:
        RecordError: it is none of these.
    """
    if named is None:
        yield _of_repository(root, "the records in the repository")
    elif Path(named).is_dir():
        folder = Path(named)
        if (folder / RECORDS).is_dir():
            yield _of_repository(folder, str(folder))
        else:
            kept = manifest.read(folder / manifest.NAME)
            found = [NO_MANIFEST] if kept is None else manifest.problems(kept, manifest.sums(folder, kept))
            yield Previous(folder, None, str(folder), found)
    else:
        with TemporaryDirectory() as place:
            _unpack(root, named, Path(place))
            yield _of_repository(Path(place), f"the records at {named}")


def _of_repository(root: Path, label: str) -> Previous:
    kept = manifest.read(manifest.of_repository(root))
    found = [NO_MANIFEST] if kept is None else manifest.problems(kept, manifest.sums(root, manifest.SHIPPED))
    return Previous(root / RECORDS, root, label, found)


def _unpack(root: Path, tag: str, place: Path) -> None:
    done = subprocess.run(["git", "-C", str(root), "archive", "--format=zip", tag], capture_output=True, check=False)
    if done.returncode:
        said = done.stderr.decode(errors="replace").strip()
        raise RecordError(f"--previous {tag}: neither a folder nor a tag ({said})")
    # Not tar: its extraction warns without a filter, which Python 3.11 has from 3.11.4 on only.
    with ZipFile(io.BytesIO(done.stdout)) as archive:
        archive.extractall(place)
    if not (place / RECORDS).is_dir():
        raise RecordError(f"--previous {tag}: it has no records in {RECORDS}")
