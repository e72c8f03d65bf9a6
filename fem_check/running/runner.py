"""Runs checks: refuses what cannot work before starting, then one record after another."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path

from fem_check.checks import ALL, OF_BEARING, OPTIONAL, usual
from fem_check.mechanics import half_space_contact
from fem_check.mechanics.contact import ContactError
from fem_check.meshing import MeshError
from fem_check.product import scenes
from fem_check.product.scenes import SceneProblemError
from fem_check.rows.agreement import EXAMPLE, Check, MeshLevel, Progress
from fem_check.rows.record import CheckRecord
from fem_check.running import memory, records_store


class BadInputError(Exception):
    """Something was not run; the message says what and what to change."""


def selected(names: tuple[str, ...], of_bearing: bool = False, level: MeshLevel = MeshLevel.RELEASE) -> list[Check]:
    """The named checks; for none all of a level, or, of a bearing that is named, its contacts."""
    known = ALL | OPTIONAL
    unknown = [name for name in names if name not in known]
    if unknown:
        raise BadInputError(f"no check named {', '.join(unknown)}; there are: {', '.join(known)}")
    return [known[name] for name in names or (OF_BEARING if of_bearing else usual(level))]


def refuse_too_large(dofs: int, what: str) -> None:
    """Refuse what would not fit into memory."""
    need, have = memory.estimate_MB(dofs), memory.available_MB()
    if have is not None and need > have:
        raise BadInputError(
            f"{what} needs about {need:.0f} MB ({dofs} unknowns), {have:.0f} MB are free: take a lower level or fewer "
            "elements, or free some memory"
        )


def run(
    checks: list[Check],
    level: MeshLevel,
    folder: Path,
    progress: Callable[[Check], Progress],
    scene: str = EXAMPLE,
) -> Iterator[CheckRecord]:
    """Run checks on a scene and keep their records; each record is handed out as it is written.

    Raises:
        BadInputError: the scene has no equilibrium or no elastic contact, and nothing was run; or some checks could not
            be run. The others were, and an earlier record of one that was not stays.
    """
    for check in checks:
        refuse_too_large(check.largest_dofs(level), f"{check.name} at level {level}")
    if scene != EXAMPLE:
        try:
            scenes.solved(scene)
        except SceneProblemError as problem:
            raise BadInputError(str(problem)) from problem
    not_run = []
    for check in checks:
        memory.restart_peak()
        start, cpu = time.perf_counter(), time.process_time()
        try:
            findings = check.run(level, progress(check), scene)
        except (MeshError, SceneProblemError, ContactError) as problem:
            not_run.append(f"{check.name} was not run: {problem}")
            continue
        seconds, cpu_seconds = time.perf_counter() - start, time.process_time() - cpu
        entry = records_store.record(check, check.name, level, findings, seconds, cpu_seconds, memory.peak_MB(), scene)
        records_store.write(entry, folder)
        if level is MeshLevel.RELEASE:
            half_space_contact.clear_cache()
        yield entry
    if not_run:
        raise BadInputError("\n".join(not_run))
