"""A study's results on the disk: each finished chunk as a file of its own, then one netCDF file, written whole."""

from __future__ import annotations

import json
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from qsbearing.files.file_errors import SceneFileError, refused
from qsbearing.files.json_text import parsed
from qsbearing.files.limits import LARGEST_RESULT
from qsbearing.files.netcdf import damage_told, json_of
from qsbearing.files.output_file import is_locked, path_of_output, put_in_place
from qsbearing.files.raw import check_regular, read_bytes
from qsbearing.studies import dataset
from qsbearing.studies.chunk import Chunk, Plan, empty_chunk, solve_chunk
from qsbearing.studies.netcdf import write_netcdf
from qsbearing.studies.points import Points
from qsbearing.studies.remarked import of_results

if TYPE_CHECKING:
    import xarray

PLAN, LOCK = "plan.json", "lock"


class Here(NamedTuple):
    """A store as processes on other machines find it, if they do."""

    folder: str
    run: str
    """What its lock holds during this run: a folder of the same name may stand on their own disk."""


def solve_into(here: Here, plan: Plan, number: int) -> Chunk | int:
    """Solve a chunk and keep it: how many points it has; or the chunk, where this process cannot write there."""
    chunk = solve_chunk(plan, number)
    try:
        if (Path(here.folder) / LOCK).read_text(encoding="ascii") != here.run:
            return chunk
        write_chunk(Path(here.folder), number, chunk)
    except (OSError, ValueError):
        return chunk
    return int(chunk.status.size)


def write_chunk(folder: Path, number: int, chunk: Chunk) -> None:
    """A finished chunk as a file, whole or not at all; two processes may have been given the same one.

    Raises:
        OSError: it cannot be written.
    """
    fields: dict[str, Any] = chunk._asdict() | {
        "reasons": np.array(chunk.reasons),
        "remarks": np.array([json.dumps(chunk.remarks)]),
    }
    fields |= {f"result_{name}": values for name, values in fields.pop("results").items()}
    temporary = folder / f"{number}-{secrets.token_hex(4)}.part"
    try:
        with temporary.open("wb") as file:
            np.savez(file, **fields)
        temporary.replace(folder / f"{number}.npz")
    finally:
        temporary.unlink(missing_ok=True)


def folder_of(out: str | os.PathLike[str]) -> Path:
    """Where the finished chunks of a results file are kept: beside it, or beside what a link to it points at."""
    place = Path(os.path.realpath(out)) if Path(out).is_symlink() else Path(out)
    return place.with_name(f"{place.name}.parts")


@contextmanager
def store_at(out: str | os.PathLike[str], plan: Plan, points: Points, *, resume: bool) -> Iterator[Store]:
    """The store of a results file, for this run alone.

    Raises:
        SceneFileError: the file cannot be written, there is too little room, another run is at work on it, or the
            folder holds another study, or what no run has put there.
    """
    store = Store(out, plan, points)
    with _alone(store.folder) as run:
        store.claim(resume)
        store.here = Here(str(store.folder.resolve()), run) if run else None
        yield store


@contextmanager
def _alone(folder: Path) -> Iterator[str]:
    """Keep other runs away; not on Windows, which has no locks that a kill lifts. Gives this run's name, there none.

    Raises:
        SceneFileError: another run is there, or the folder cannot be written.
    """
    if os.name == "nt":
        yield ""
        return
    place = folder / LOCK
    try:
        file = place.open("wb")
    except OSError as error:
        raise refused(folder, f"cannot be written: {error.strerror}") from None
    with file:
        try:
            lock = is_locked(file)
            # Not what a run before has removed.
            is_free = lock is None or (lock and os.path.samestat(os.fstat(file.fileno()), place.stat()))
        except FileNotFoundError:
            is_free = False
        if not is_free:
            raise refused(folder, "another run is using it", "Wait until it has ended, or choose another --out")
        try:
            run = secrets.token_hex(16)
            file.write(run.encode())
            file.flush()
            yield run
        finally:
            place.unlink(missing_ok=True)


class Store:
    """Finished chunks in a folder beside the file that they will be joined to."""

    def __init__(self, out: str | os.PathLike[str], plan: Plan, points: Points) -> None:
        """Try the place, and make the folder.

        Raises:
            SceneFileError: it cannot be written, or there is too little room.
        """
        self.out = Path(out)
        self.here: Here | None = None
        self.plan = plan
        self.points = points
        try:
            self.place = path_of_output(os.fspath(out))
            if self.place.exists() and not self.place.is_file():
                raise refused(self.out, "is not a file, and cannot be replaced")
            self.folder = folder_of(out)
            self._check_room()
            self.folder.mkdir(exist_ok=True)
        except OSError as error:
            raise refused(self.out, f"cannot be written: {error.strerror}" if error.strerror else str(error)) from None

    def claim(self, resume: bool) -> None:
        """See that the folder is this study's, and holds whole chunks and nothing else.

        Raises:
            SceneFileError: it holds another study, an unfinished run that is not to be resumed, or what no run has put
                there.
        """
        kept = self.folder / PLAN
        identity = {"fingerprint": self.plan.study.fingerprint, "results": [each.column for each in self.plan.results]}
        is_new = not kept.exists()
        if not is_new and _json_of(kept) != json.loads(json.dumps(identity)):
            problem = "holds chunks of another study, or of another version of qsbearing"
            raise refused(self.folder, problem, "Delete that folder, or choose another --out")
        if not is_new and not resume:
            problem = f"an unfinished run has {len(self.finished())} of {self.points.chunk_count} chunks done"
            raise refused(self.folder, problem, "Continue it with --resume, or delete that folder")
        self._check_files(0 if is_new else self.points.chunk_count)
        try:
            _write(kept, json.dumps(identity).encode())
        except OSError as error:
            raise refused(self.folder, f"cannot be written: {error.strerror}") from None

    def _check_room(self) -> None:
        per_point = 16.0
        per_point += sum(8.0 * (self.plan.ball_axis if each.is_per_ball else 1) for each in self.plan.results)
        needed = 2.0 * per_point * self.points.count  # the chunks, and the file that they are joined to
        free = shutil.disk_usage(self.place.parent).free
        if needed > free:
            problem = f"needs {needed / 1e9:.3g} GB, and the disk has {free / 1e9:.3g} GB left"
            raise refused(self.out, problem, "Name fewer quantities, or fewer points")

    def _check_files(self, chunks: int) -> None:
        """Remove what a crash of the whole machine has left incomplete, and what was being written.

        Raises:
            SceneFileError: there is what is none of so many chunks of this study.
        """
        known = {PLAN, LOCK, *(f"{number}.npz" for number in range(chunks))}
        others = []
        for file in sorted(self.folder.iterdir()):
            if not file.is_file():
                others.append(file.name)
            elif file.suffix == ".part":
                file.unlink()
            elif file.name not in known:
                others.append(file.name)
            elif file.suffix == ".npz":
                try:
                    suits = self._suits(int(file.stem))
                except Exception:  # of damaged bytes zipfile and numpy raise almost anything
                    file.unlink()
                else:
                    others += [] if suits else [file.name]
        if others:
            problem = f"holds files that do not belong to this study: {', '.join(others[:5])}"
            raise refused(self.folder, problem, "Move it away; points that are then missing are solved again")

    def _suits(self, number: int) -> bool:
        """Whether the arrays of a chunk that was kept are those of its points."""
        kept, expected = (
            [(each.shape, each.dtype) for each in dataset.arrays_of(chunk, chunk.reasons).values()]
            for chunk in (self.get(number), empty_chunk(self.plan, self.points.size(number), ("",)))
        )
        return kept == expected

    def finished(self) -> set[int]:
        """Numbers of the chunks that are there."""
        return {n for n in range(self.points.chunk_count) if (self.folder / f"{n}.npz").exists()}

    def put(self, number: int, chunk: Chunk) -> None:
        """Keep a finished chunk.

        Raises:
            SceneFileError: it cannot be written, as where the disk is full.
        """
        try:
            write_chunk(self.folder, number, chunk)
        except OSError as error:
            raise self._unwritten(error) from None

    def _unwritten(self, error: Exception) -> SceneFileError:
        why = error.strerror if isinstance(error, OSError) else ""
        cause = f"Finished points are kept in {self.folder}: free some disk space, then continue with --resume"
        return refused(self.out, f"cannot be written: {why or error}", cause)

    def get(self, number: int) -> Chunk:
        """A chunk that was kept."""
        # Opened here: numpy leaves a damaged file open.
        with (self.folder / f"{number}.npz").open("rb") as opened, np.load(opened) as file:
            fields = {name: file[name] for name in Chunk._fields if name not in ("results", "reasons", "remarks")}
            results = {each.name: file[f"result_{each.name}"] for each in self.plan.results}
            reasons, remarks = tuple(map(str, file["reasons"])), json.loads(str(file["remarks"][0]))
            return Chunk(**fields, reasons=reasons, remarks=remarks, results=results)

    def join(self) -> None:
        """Write the file from all chunks, in one step as its reader sees it, and remove them.

        Raises:
            SceneFileError: it cannot be written, as where the disk is full; the chunks are kept.
        """
        temporary = self.folder / "whole.part"  # there, as a run that goes on after a kill removes it
        try:
            write_netcdf(temporary, self.plan, self.points, self._chunks)
            put_in_place(temporary, self.place)
        except (OSError, RuntimeError) as error:  # HDF5 has errors of both kinds
            raise self._unwritten(error) from None
        finally:
            temporary.unlink(missing_ok=True)
        shutil.rmtree(self.folder)

    def _chunks(self) -> Iterator[tuple[int, Chunk]]:
        for number in range(self.points.chunk_count):
            yield number, self.get(number)


def open_results(file: str | os.PathLike[str]) -> xarray.Dataset:
    """The results of a sweep, read from the disk each time they are used; `.load()` keeps them in memory.

    Returns:
        The dataset, read as it is used: close it, or use `with`.

    Raises:
        SceneFileError: no file, or none that this version reads.

    Examples:
        >>> results = qs.sweep(qs.Study.of("b218", {"speed_rpm": [0, 10_000]}), out="speeds.nc")
        >>> results.close()
        >>> with qs.open_results("speeds.nc") as again:
        ...     print(dict(again.sizes)["speed_rpm"])
        2
    """
    import xarray

    place = Path(file)
    check_regular(place, "a results file")
    with damage_told(place):
        results = xarray.open_dataset(place, engine="h5netcdf", cache=False)
    version = results.attrs.get("qsbearing_format")
    if version != dataset.FORMAT:
        results.close()
        made = results.attrs.get("qsbearing_version", "another program")
        raise refused(place, f"is not a results file of this version (made by {made})", "Run the sweep again")
    try:
        json_of(results.attrs.get("study"), place)
        with damage_told(place):
            of_results(results.attrs)
    except SceneFileError:
        results.close()
        raise
    return results


def _json_of(place: Path) -> Any:
    """What a file holds; None where that cannot be read."""
    try:
        return parsed(read_bytes(place, LARGEST_RESULT, "a plan"), place)
    except SceneFileError:
        return None


def _write(place: Path, data: bytes) -> None:
    temporary = place.with_suffix(".part")
    temporary.write_bytes(data)
    temporary.replace(place)
