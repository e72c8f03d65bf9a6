"""A whole campaign: ranges given to workers, a journal of what is done, scene files of what failed, and the summary."""

from __future__ import annotations

import json
import re
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from tests.verification.campaign.chunk import UNCONVERGED, compile_kernel, not_returned, solve_range
from tests.verification.campaign.envelope import CHUNK, scene_file, scene_name
from tests.verification.campaign.group import GROUP
from tests.verification.campaign.summary import source_digest, summarise
from tests.verification.campaign.worker import PATIENCE, Range, solve_ranges


def run_campaign(
    envelope: str,
    count: int,
    seed: int,
    folder: Path,
    *,
    workers: int = 2,
    resume: bool = False,
    patience: float = PATIENCE,
    progress: Callable[[int, int], None] = lambda scenes, listed: None,
) -> dict[str, Any]:
    """Solve and judge the first `count` scenes of a seed; the summary, which is also written to the folder.

    Args:
        resume: go on with the campaign that the folder holds.
        patience: seconds after which a chunk counts as not coming back.
        progress: told after each chunk how many scenes are done, and how many failed or did not converge.

    Raises:
        ValueError: the folder holds another campaign, or one that was not asked to be resumed.
    """
    began = time.perf_counter()
    path = folder / "chunks.jsonl"
    heading = {"envelope": envelope, "seed": seed, "chunk": CHUNK, "group": GROUP, "source": source_digest()}
    lines = [line for line in open_journal(path, heading, resume=resume) if line["stop"] <= count]
    ranges = missing({line["first"]: line["stop"] for line in lines}, count)
    solve = partial(solve_range, envelope, seed)
    if ranges:
        compile_kernel()  # once, not by every worker
    for (first, _), line in solve_ranges(ranges, solve, workers, patience):
        lines.append(line or not_returned(envelope, seed, first, patience))
        append(path, lines[-1])
        for entry in lines[-1]["listed"]:
            write_scene(folder, envelope, seed, entry)
        progress(sum(line["stop"] - line["first"] for line in lines), sum(len(line["listed"]) for line in lines))
    summary = summarise(envelope, seed, lines, time.perf_counter() - began)
    (folder / "summary.json").write_text(json.dumps(summary, indent=1) + "\n", encoding="utf-8")
    return summary


def open_journal(path: Path, heading: dict[str, Any], *, resume: bool) -> list[dict[str, Any]]:
    """The lines of the chunks that are done; a new journal has its heading only.

    Raises:
        ValueError: it is another campaign's, or one that was not asked to be resumed.
    """
    if path.exists() and not resume:
        raise ValueError(f"{path} holds a campaign already: --resume to go on with it, or another --out")
    whole = path.read_bytes() if path.exists() else b""
    kept = whole[: whole.rfind(b"\n") + 1]  # a line that was cut off is done again
    found, *lines = [json.loads(line) for line in kept.splitlines()] or [None]
    if found not in (None, heading):
        raise ValueError(f"{path} holds another campaign: {found}, not {heading}")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(kept)
    if found is None:
        append(path, heading)
    return lines


def append(path: Path, line: dict[str, Any]) -> None:
    """One line more, whole or, if the campaign ends meanwhile, without its end."""
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(line) + "\n")


def missing(done: dict[int, int], count: int) -> list[Range]:
    """What lies between the ranges that are done, {first: stop}, cut at the chunks."""
    ranges, first = [], 0
    while first < count:
        if first in done:
            first = done[first]
            continue
        stop = min([count, CHUNK * (first // CHUNK + 1), *(begin for begin in done if begin > first)])
        ranges.append((first, stop))
        first = stop
    return ranges


def write_scene(folder: Path, envelope: str, seed: int, entry: dict[str, Any]) -> None:
    """A scene that failed, or did not converge, as a file that reproduces it."""
    kind = folder / (UNCONVERGED if entry["status"] == UNCONVERGED else "failures")
    kind.mkdir(exist_ok=True)
    what = re.sub(r"[^a-z0-9]+", "_", entry["what"].lower()).strip("_")[:60]
    name = scene_name(envelope, seed, entry["scene"]).replace("/", "-")
    path = kind / f"{what}-{name}.toml"
    path.write_text(scene_file(envelope, seed, entry["scene"], entry["what"]), encoding="utf-8")
