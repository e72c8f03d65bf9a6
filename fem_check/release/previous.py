"""The previous release's records: in a folder, at a tag, or those that are in the repository."""

from __future__ import annotations

import io
import json
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

from fem_check.release import manifest
from fem_check.rows.record import Record
from fem_check.running.kept_files import place_of
from fem_check.running.records_store import RecordError

RECORDS = "fem_check/records"


@dataclass(frozen=True)
class Previous:
    """Records to compare with."""

    folder: Path
    """Laid out as the gate's own."""
    label: str
    """What they are, for a sentence."""
    repository: Path | None = None
    """The source tree that the folder is part of, with further records; None where there is none."""
    problems: list[str] = field(default_factory=list)
    """What was changed, deleted or added since the repository's manifest was written."""

    def read(self, name: str) -> Record | None:
        """A record by its path in the folder that a gate makes; None where there is none."""
        path = place_of(name, self.repository, self.folder) if self.repository else self.folder / name
        return read(path) if path.is_file() else None

    def names(self, pattern: str) -> list[str]:
        """Paths of records in the folder."""
        return sorted(path.relative_to(self.folder).as_posix() for path in self.folder.glob(pattern))


def read(path: Path) -> Record:
    """A record.

    Raises:
        RecordError: a file that is none, or cannot be read.
    """
    try:
        return dict(json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError) as problem:
        raise RecordError(f"{path} is not a record ({problem})") from problem


@contextmanager
def opened(root: Path, named: str | None) -> Iterator[Previous]:
    """The records that a name stands for, while they are needed.

    Args:
        root: of the checkout.
        named: a folder that holds a checkout or what an earlier gate made, a tag or a commit; None for the records in
            the checkout.

    Raises:
        RecordError: it is none of these.
    """
    if named is not None and not Path(named).is_dir():
        with TemporaryDirectory() as place:
            _unpack(root, named, Path(place))
            yield _of(Path(place), f"the records at {named}")
    else:
        yield _of(root, "the records in the repository") if named is None else _of(Path(named), named)


def _of(folder: Path, label: str) -> Previous:
    if (folder / RECORDS).is_dir():
        return Previous(folder / RECORDS, label, folder, manifest.problems(folder))
    return Previous(folder, label)


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
