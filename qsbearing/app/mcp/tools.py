"""The tools: what is asked of a scene, answered as plain data by what the commands call.

A scene is given by a bearing's name in the catalogue, a file below the folder, the text of such a file, or its tables.
Raises, all of them:
    SceneError: everything that is wrong with what is asked, at once.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from copy import deepcopy
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from qsbearing.app.mcp.describe import described
from qsbearing.app.mcp.folder import Folder
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError, refused
from qsbearing.files.limits import LARGEST_FILE
from qsbearing.files.scene_file import document_of, text_of
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.toml import check_tables, tables_of
from qsbearing.model.accuracy import COARSEST, DEFAULT_ACCURACY, FINEST
from qsbearing.model.scene.scene import Scene
from qsbearing.results.readings_record import all_taken
from qsbearing.results.whole import whole_record, with_input
from qsbearing.studies.changed_keys import ChangedKey, changed, text_with
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.studies.chooser.explained import explained
from qsbearing.studies.study import Read
from qsbearing.systems.sets.bearing_set import BearingSet

Answer = dict[str, Any]
MOST_POINTS = 100_000
"""Of a sweep or a search; some seconds of work."""
MOST_CELLS = 2000
"""Numbers of a table that stands in an answer; of a larger one there is the summary, and a file."""
TABLES = (".csv", ".parquet", ".nc")

Tables = Annotated[
    str | dict[str, Any],
    Field(description="a bearing of the catalogue, a file below the folder, the text of a scene file, or its tables"),
]
Vary = Annotated[dict[str, Any], Field(description='keys and what they take, as {"axial_load_N": "500:2000:4"}')]
Changes = Annotated[
    dict[str, Any] | None,
    Field(description='keys of the scene and the value of each instead, as {"operation.speed_rpm": 12000}'),
]
Tolerance = Annotated[float, Field(ge=FINEST, le=COARSEST)]
Seed = Annotated[int, Field(ge=0)]
Points = Annotated[int | None, Field(ge=1, le=MOST_POINTS)]


class Tools:
    """What may be asked, with files below one folder."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def describe(self, topic: str = "") -> Answer:
        """What there is to know: a table of scene files with its keys, units and ranges; "results", their names and
        units; a bearing of the catalogue with its sources and a scene that uses it; a remark by its code; a page of the
        guide. Without a topic: which topics there are."""
        return described(topic)

    def solve(self, scene: Tables, balls: bool = False, changes: Changes = None) -> Answer:
        """Solve a bearing, a set of rows or a load spectrum: status, message, answers to what its [require] says,
        remarks, displacements, loads, stiffness and the readings that it asks for. With balls: also each ball's
        contacts."""
        of, _, changed_keys = self._scene_or_set(scene, changes)
        solution = solve_any(of)
        record = with_input(of, whole_record(solution, all_taken(solution)))
        return _told(record, balls) | _of_changes(changed_keys)

    def explain(self, scene: Tables, tolerance: Tolerance = DEFAULT_ACCURACY, changes: Changes = None) -> Answer:
        """How much each effect and choice matters at this operating point, each solved with and without, and whether it
        is needed: whether it changes a result by more than the tolerance."""
        of, _, changed_keys = self._scene_or_set(scene, changes)
        if "spectrum" in of.readings:
            raise _refused("[[spectrum]]", "has several operating points", "Leave it out here; `solve` takes it")
        return explained(of, tolerance).record | _of_changes(changed_keys)

    def find(
        self,
        scene: Tables,
        vary: Vary,
        goals: list[str] | None = None,
        limits: list[str] | None = None,
        minimise: str | None = None,
        maximise: str | None = None,
        points: Points = None,
        seed: Seed = 0,
        changes: Changes = None,
    ) -> Answer:
        """Find values of up to six keys of a scene, each with "LOW:HIGH", that meet goals ("NAME=VALUE") and limits
        ("NAME<=VALUE") of results, and make one as small or large as possible. The answer's input is the scene found.
        """
        from qsbearing.studies.design import shown
        from qsbearing.studies.design.find import prepared, searched

        search, _, changed_keys = changed(
            self._read(scene),
            _pairs(changes),
            lambda read: prepared(read, vary, goals or (), limits or (), minimise, maximise),
        )
        return _told(shown.record(searched(search, points, seed))) | _of_changes(changed_keys)

    def sweep(
        self,
        scene: Tables,
        vary: Vary,
        quantities: list[str] | None = None,
        samples: Points = None,
        seed: Seed = 0,
        out: str = "",
        changes: Changes = None,
    ) -> Answer:
        """Solve a scene at all combinations of what keys take: "START:STOP:COUNT", a list, or "normal(MEAN,SD)". The
        answer is how points ended and the spread of each result; a small table as a whole; out: a file for all, .csv,
        .parquet or .nc."""
        from qsbearing.files.output_file import output_stream
        from qsbearing.studies.points import Points as Grid
        from qsbearing.studies.study import Study
        from qsbearing.studies.summary import record
        from qsbearing.studies.sweep import sweep
        from qsbearing.studies.tables import frame_of, write_table

        study, _, changed_keys = changed(
            self._read(scene, True),
            _pairs(changes),
            lambda read: Study.of(read, vary, samples=samples, seed=seed, quantities=quantities),
        )
        if (count := Grid(study).count) > MOST_POINTS:
            raise _refused("vary", f"are {count:,} points; at most {MOST_POINTS:,} are solved", "Take fewer values")
        place = self.folder.new(out) if out else None
        if place is not None and place.suffix.lower() not in TABLES:
            raise _refused("out", f"must end in one of {', '.join(TABLES)}")
        results = sweep(study)
        summary = record(results) | _of_changes(changed_keys)
        frame = frame_of(results) if results["status"].size <= MOST_CELLS else None
        if frame is not None and frame.size <= MOST_CELLS:
            summary["table"] = frame.astype(object).where(frame.notna(), None).to_dict("list")
        if place is not None:
            with output_stream(str(place)) as file:
                if place.suffix.lower() == ".nc":
                    file.write(results.to_netcdf(engine="h5netcdf"))
                else:
                    write_table(results, file, place.suffix.lower())
            summary["file"] = self.folder.named(place)
        return summary

    def report(self, scene: Tables, name: str, changes: Changes = None) -> Answer:
        """Write the design report, NAME.html and NAME.pdf below the folder; the answer names both."""
        from contextlib import ExitStack

        from qsbearing.documents.html import html
        from qsbearing.documents.pdf import pdf
        from qsbearing.files.output_file import output_file
        from qsbearing.remarks.of_solution import message
        from qsbearing.reports.of_any import document_of_any

        places = [self.folder.new(f"{name}{ending}") for ending in (".html", ".pdf")]
        of, document, changed_keys = self._scene_or_set(scene, changes)
        solution = solve_any(of)
        if not np.all(solution.converged):
            status = np.ravel(solution.status)[np.argmin(solution.converged)]
            return {"status": str(status), "message": message(solution)}
        text = text_with(document, changed_keys) if changed_keys else self._text(scene)
        made = document_of_any(solution, of, text, "the tool `report` of qsbearing mcp", changed_keys)
        forms = html(made).encode(), pdf(made)
        with ExitStack() as stack:  # both or none
            writers = [stack.enter_context(output_file(str(place))) for place in places]
            for writer, data in zip(writers, forms, strict=True):
                writer.fill(data)
            for writer in writers:
                writer.put()
        files = [self.folder.named(place) for place in places]
        return {"status": "converged", "files": files} | _of_changes(changed_keys)

    def _read(self, scene: str | dict[str, Any], of_study: bool = False) -> Read:
        if isinstance(scene, str) and "\n" not in scene:
            return Read(*document_of(scene, of_study, self.folder.place))
        if len(scene if isinstance(scene, str) else json.dumps(scene)) > LARGEST_FILE:
            raise refused("scene", f"is longer than {LARGEST_FILE / 1e6:g} MB")
        tables = tables_of(scene, Path("scene")) if isinstance(scene, str) else scene
        check_tables(tables, Path("scene"))
        return Read(tables, "scene", "")

    def _scene_or_set(
        self, scene: str | dict[str, Any], changes: dict[str, Any] | None
    ) -> tuple[Scene | BearingSet, dict[str, Any], tuple[ChangedKey, ...]]:
        """Of these tables with changes; the tables, and what has changed."""
        of, read, changed_keys = changed(
            self._read(scene), _pairs(changes), lambda read: scene_or_set_of(deepcopy(read.document), *read[1:])
        )
        return of, read.document, changed_keys

    def _text(self, scene: str | dict[str, Any]) -> str:
        """Of a scene as a file has it; empty for an example of the catalogue."""
        if isinstance(scene, dict):
            import tomli_w

            return tomli_w.dumps(scene)
        return scene if "\n" in scene else text_of(str(self.folder.place(scene)))


def _refused(key: str, problem: str, cause: str = "") -> SceneFileError:
    return SceneFileError("question", [FileErrorDetail(key, problem, cause=cause)])


def _pairs(changes: dict[str, Any] | None) -> list[tuple[str, Any]]:
    return list((changes or {}).items())


def _of_changes(changes: Sequence[ChangedKey]) -> Answer:
    return {"changed_input": [each.record() for each in changes]} if changes else {}


def _told(record: Any, balls: bool = False) -> Any:
    """A record without sentences that its remarks repeat, and without each ball's contacts, if they are not wanted.

    Also within rows and points.
    """
    if isinstance(record, list):
        return [_told(each, balls) for each in record]
    if not isinstance(record, dict):
        return record
    contacts = record.get("balls")
    left_out = {"warnings"} if balls or not contacts or isinstance(contacts[0], int) else {"warnings", "balls"}
    return {key: _told(value, balls) for key, value in record.items() if key not in left_out}
