"""A whole campaign: chunks given to workers, a journal, scene files of what failed, and the summary."""

from __future__ import annotations

import json
import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.campaign.journal import Journal
from tests.campaign.sizes import CHUNK
from tests.campaign.summary import source_digest, summarise
from tests.campaign.worker import PATIENCE, Task, memory_MB, solve_chunks


def run_campaign(
    count: int,
    seed: int,
    folder: Path,
    *,
    workers: int = 2,
    resume: bool = False,
    patience: float = PATIENCE,
    progress: Callable[[int, dict[str, int]], None] = lambda scenes, classes: None,
) -> dict[str, Any]:
    """Solve and judge the first `count` scenes of a seed; the summary, which is also written to the folder.

    Args:
        resume: go on with the campaign that the folder holds.
        patience: seconds after which a group of scenes counts as not coming back.
        progress: told after each chunk how many scenes are done, and of which classes.

    Raises:
        ValueError: the folder holds another campaign.
    """
    began = time.perf_counter()
    journal = Journal(folder, seed, source_digest(), resume=resume)
    sizes = {chunk: min(CHUNK, count - CHUNK * chunk) for chunk in range(-(-count // CHUNK))}
    done = journal.done()
    journal.chunks = [chunk for chunk in journal.chunks if sizes.get(chunk["chunk"]) == chunk["scenes"]]
    tasks = [Task(chunk, size) for chunk, size in sizes.items() if done.get(chunk) != size]
    peaks: dict[int, float] = {}
    classes: dict[str, int] = {}

    def note(chunk: dict[str, Any]) -> None:
        for name, number in chunk["classes"].items():
            classes[name] = classes.get(name, 0) + number
        failed = len(chunk["failures"])
        if failed:
            classes["failed"] = classes.get("failed", 0) + failed
        progress(sum(number for name, number in classes.items() if name != "failed"), classes)

    for chunk in journal.chunks:
        note(chunk)
    for chunk in solve_chunks(tasks, seed, workers, patience):
        peaks[chunk["worker"]] = chunk["memory_MB"]
        journal.add(chunk)
        write_failures(folder, seed, chunk)
        note(chunk)
    seconds = time.perf_counter() - began
    summary = summarise(seed, journal.chunks, seconds, sum(peaks.values()) + memory_MB())
    (folder / "summary.json").write_text(json.dumps(summary, indent=1) + "\n", encoding="utf-8")
    worst = max(journal.chunks, key=lambda chunk: chunk["worst"]["iterations"], default=None)
    if worst is not None and "toml" in worst["worst"]:
        (folder / "most_iterations.toml").write_text(worst["worst"]["toml"], encoding="utf-8")
    return summary


def write_failures(folder: Path, seed: int, chunk: dict[str, Any]) -> None:
    """Every failure of a chunk as a scene file that reproduces it."""
    if chunk["failures"]:
        (folder / "failures").mkdir(exist_ok=True)
    for failure in chunk["failures"]:
        what = re.sub(r"[^a-z0-9]+", "_", failure["what"].lower()).strip("_")[:60]
        path = folder / "failures" / f"{what}-{seed}-{chunk['chunk']}-{failure['index']}.toml"
        path.write_text(failure["toml"], encoding="utf-8")
