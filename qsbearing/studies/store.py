"""A study's results on the disk: each finished chunk as a file of its own, then one netCDF file, written whole."""

from __future__ import annotations

import json
import os
import shutil
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.io.file_errors import FileErrorDetail, SceneFileError
from qsbearing.studies import dataset
from qsbearing.studies.chunk import Chunk, Plan
from qsbearing.studies.netcdf import write_netcdf
from qsbearing.studies.points import Points

if TYPE_CHECKING:
    import xarray

PLAN = "plan.json"


def _refused(file: Path, problem: str, cause: str = "") -> SceneFileError:
    return SceneFileError(str(file), [FileErrorDetail("", problem, cause=cause)])


class Store:
    """Finished chunks in a folder beside the file that they will be joined to."""

    def __init__(self, out: str | os.PathLike[str], plan: Plan, points: Points, *, resume: bool) -> None:
        """Claim the place.

        Raises:
            SceneFileError: it cannot be written, there is too little room, or it holds another study.
        """
        self.out = Path(out)
        self.plan = plan
        self.points = points
        self.folder = self.out.with_name(f"{self.out.name}.parts")
        if self.out.is_dir():
            raise _refused(self.out, "is a folder")
        if not self.out.parent.is_dir():
            raise _refused(self.out, f"there is no folder {self.out.parent}")
        self._check_room()
        kept = self.folder / PLAN
        identity = {"fingerprint": plan.study.fingerprint, "results": plan.results}
        if kept.exists():
            if not resume:
                problem = f"an unfinished run has {len(self.finished())} of {points.chunk_count} chunks done"
                raise _refused(self.folder, problem, "--resume goes on with it; or delete that folder")
            if _json_of(kept) != json.loads(json.dumps(identity)):
                problem = "holds chunks of another study, or of another version of qsbearing"
                raise _refused(self.folder, problem, "Delete that folder, or choose another --out")
            self._drop_damaged()
            return
        try:
            self.folder.mkdir(exist_ok=True)
            _write(kept, json.dumps(identity).encode())
        except OSError as error:
            raise _refused(self.out, f"cannot be written: {error.strerror}") from None

    def _check_room(self) -> None:
        per_point = 16.0
        per_point += sum(8.0 * (self.plan.ball_axis if each.is_per_ball else 1) for each in self.plan.results)
        needed = 2.0 * per_point * self.points.count  # the chunks, and the file that they are joined to
        free = shutil.disk_usage(self.out.parent or Path()).free
        if needed > free:
            problem = f"needs {needed / 1e9:.3g} GB, and the disk has {free / 1e9:.3g} GB left"
            raise _refused(self.out, problem, "Name fewer quantities, or fewer points")

    def _drop_damaged(self) -> None:
        """Remove chunks that a crash of the whole machine has left incomplete, and what was being written."""
        for file in self.folder.glob("*.part"):
            file.unlink()
        for number in self.finished():
            try:
                self.get(number)
            except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
                (self.folder / f"{number}.npz").unlink()

    def finished(self) -> set[int]:
        """Numbers of the chunks that are there."""
        return {int(file.stem) for file in self.folder.glob("*.npz") if file.stem.isdecimal()}

    def put(self, number: int, chunk: Chunk) -> None:
        """Keep a finished chunk.

        Raises:
            SceneFileError: it cannot be written, as where the disk is full.
        """
        fields: dict[str, Any] = chunk._asdict() | {"reasons": np.array(chunk.reasons)}
        fields |= {f"result_{name}": values for name, values in fields.pop("results").items()}
        temporary = self.folder / f"{number}.part"
        try:
            with temporary.open("wb") as file:
                np.savez(file, **fields)
            temporary.replace(self.folder / f"{number}.npz")
        except OSError as error:
            raise self._unwritten(error) from None
        finally:
            temporary.unlink(missing_ok=True)

    def _unwritten(self, error: Exception) -> SceneFileError:
        why = error.strerror if isinstance(error, OSError) else ""
        cause = f"Finished points are kept in {self.folder}: make room, then --resume goes on"
        return _refused(self.out, f"cannot be written: {why or error}", cause)

    def get(self, number: int) -> Chunk:
        """A chunk that was kept."""
        # Opened here: numpy leaves a damaged file open.
        with (self.folder / f"{number}.npz").open("rb") as opened, np.load(opened) as file:
            fields = {name: file[name] for name in Chunk._fields if name not in ("results", "reasons")}
            results = {each.name: file[f"result_{each.name}"] for each in self.plan.results}
            return Chunk(**fields, reasons=tuple(map(str, file["reasons"])), results=results)

    def join(self) -> None:
        """Write the file from all chunks, in one step as its reader sees it, and remove them.

        Raises:
            SceneFileError: it cannot be written, as where the disk is full; the chunks are kept.
        """
        temporary = self.out.with_name(f".{self.out.name}.part")
        try:
            write_netcdf(temporary, self.plan, self.points, self._chunks)
            temporary.replace(self.out)
        except (OSError, RuntimeError) as error:  # HDF5 has errors of both kinds
            raise self._unwritten(error) from None
        finally:
            temporary.unlink(missing_ok=True)
        shutil.rmtree(self.folder)

    def _chunks(self) -> Iterator[tuple[int, Chunk]]:
        for number in range(self.points.chunk_count):
            yield number, self.get(number)


def open_results(file: str | os.PathLike[str]) -> xarray.Dataset:
    """The results of a sweep, read from the disk as they are used, and as often; `.load()` keeps them in memory.

    Raises:
        SceneFileError: no file, or none that this version reads.
    """
    import xarray

    place = Path(file)
    if not place.is_file():
        raise _refused(place, "no such file")
    try:
        found = xarray.open_dataset(place, engine="h5netcdf", cache=False)
    except (OSError, ValueError, KeyError) as error:
        raise _refused(place, f"is not a results file, or damaged: {error}") from None
    version = found.attrs.get("qsbearing_format")
    if version != dataset.FORMAT:
        found.close()
        made = found.attrs.get("qsbearing_version", "another program")
        raise _refused(place, f"is no results file of this version (made by {made})", "Run the sweep again")
    return found


def _json_of(place: Path) -> Any:
    """What a file holds; None where that cannot be read."""
    try:
        return json.loads(place.read_text("utf-8"))
    except ValueError:
        return None


def _write(place: Path, data: bytes) -> None:
    temporary = place.with_suffix(".part")
    temporary.write_bytes(data)
    temporary.replace(place)
