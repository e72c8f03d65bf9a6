"""What a gate has done so far, so that an interrupted one goes on: steps.json, and the sums of the records made."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from pathlib import Path

from fem_check import records_store
from fem_check.agreement import Level
from fem_check.release import manifest
from fem_check.release.steps import Place, Step
from qsbearing import provenance


@dataclass
class Done:
    """A step that was run."""

    seconds: float
    error: str | None = None
    """Why it made no records."""
    records: dict[str, str] = field(default_factory=dict)
    """sha256 of each record, by its path in the output folder."""


class Journal:
    """The steps run for one commit at one level."""

    def __init__(self, place: Place, steps: dict[str, Done]) -> None:
        self.place = place
        self.steps = steps

    def keep(self, step: Step, seconds: float, error: str | None) -> None:
        """Enter a step and write the journal."""
        out = self.place.out
        made = {} if error else manifest.sums(out, step.records)
        self.steps[step.name] = Done(round(seconds, 1), error, made)
        self.write()

    def write(self) -> None:
        """Write the journal, and the sums as the folder's manifest."""
        content = {
            "commit": self.place.commit,
            "level": str(self.place.level),
            "provenance": provenance.of_run(f"fem-check release --level {self.place.level}", str(self.place.level)),
            "steps": {name: asdict(done) for name, done in self.steps.items()},
        }
        path = path_of(self.place.out, self.place.level)
        path.parent.mkdir(parents=True, exist_ok=True)
        records_store.replace(path, (json.dumps(content, indent=1) + "\n").encode())
        known = {name: value for done in self.steps.values() for name, value in done.records.items()}
        manifest.write(self.place.out / manifest.NAME, known)

    def problems(self) -> list[str]:
        """Records changed, deleted or added since their steps made them."""
        known = {name: value for done in self.steps.values() for name, value in done.records.items()}
        level = self.place.level
        patterns = (f"{level}/*.json", "book/*.json", f"gate/{level}/**/summary.json", *known)
        return manifest.problems(known, manifest.sums(self.place.out, patterns))


def path_of(out: Path, level: Level) -> Path:
    """Where a level's journal is kept."""
    return out / "gate" / level / "steps.json"


def resumed(place: Place, steps: list[Step], without: Iterable[str] = ()) -> Journal:
    """The journal of an interrupted gate: the steps that have made their records.

    Steps of another commit count for nothing, and those that ended with an error are run again.

    Args:
        without: steps that are to be run again, too.
    """
    path = path_of(place.out, place.level)
    if not path.is_file():
        return Journal(place, {})
    try:
        kept = json.loads(path.read_text(encoding="utf-8"))
        if (kept["commit"], kept["level"]) != (place.commit, place.level):
            return Journal(place, {})
        done = {name: Done(**entry) for name, entry in kept["steps"].items()}
    except (ValueError, KeyError, TypeError):  # cut off or damaged: as if there were none
        return Journal(place, {})
    known = {step.name for step in steps} - set(without)
    return Journal(place, {name: each for name, each in done.items() if name in known and each.error is None})
