"""What the tests cost, as recorded, and what follows: which are quick, and which process of `-n` takes which files.

`pytest -n auto --record-durations` writes the record anew. It holds processor time: whatever else the machine does, the
same tests are quick.
"""

from __future__ import annotations

import json
import os
import time
from collections import defaultdict
from functools import cache
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[1]
RECORD = Path(__file__).with_suffix(".json")
SLOW = 0.1
"""Seconds from which on a test has an entry of its own, all its parameters together."""
QUICK = 0.38
"""Seconds that a file may take without these, for its others to be quick (chosen: all of them take half a minute)."""
UNKNOWN = {"": 2.5}
"""Of a file that is not in the record: not quick."""


@cache
def recorded() -> dict[str, dict[str, float]]:
    """Of each file seconds by the name of a slow test; by "" those of all others, of fixtures and of what is cleared
    up. The processes of a test are part of it; imports and heavy tests are not."""
    return dict(json.loads(RECORD.read_text(encoding="utf-8")))


def of_file(path: Path) -> dict[str, float]:
    name = path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else ""
    return recorded().get(name, UNKNOWN)


def has_quick(path: Path) -> bool:
    """Whether `-m quick` need import a file of tests."""
    return of_file(path)[""] <= QUICK


def is_quick(item: pytest.Item) -> bool:
    is_slow = getattr(item, "originalname", item.name) in of_file(item.path)
    return has_quick(item.path) and not is_slow and item.get_closest_marker("heavy") is None


def shared(paths: list[Path], count: int) -> list[list[Path]]:
    """Neighbouring files, which import and solve much the same, for each of several processes, of like cost."""
    costs = [sum(of_file(path).values()) + 0.1 for path in paths]
    parts: list[list[Path]] = [[] for _ in range(count)]
    done = 0.0
    for path, cost in zip(paths, costs, strict=True):
        parts[min(int(count * (done + 0.5 * cost) / sum(costs)), count - 1)].append(path)
        done += cost
    return parts


class OwnFiles:
    """A process of `-n` collects and runs its own files: collecting all of them takes 20 to 40 s in each."""

    def __init__(self, config: pytest.Config, given: dict[str, Any]) -> None:
        asked = [Path(config.invocation_params.dir, each.partition("::")[0]) for each in config.args]
        files = {file.resolve() for path in asked for file in ([path] if path.is_file() else path.rglob("test_*.py"))}
        if config.option.markexpr == "quick":
            files = {file for file in files if has_quick(file)}
        number = int(given["workerid"].removeprefix("gw")) % given["workercount"]
        self.own = set(shared(sorted(files), given["workercount"])[number])

    def pytest_ignore_collect(self, collection_path: Path) -> bool | None:
        return True if collection_path.is_file() and collection_path.resolve() not in self.own else None

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """A file that the command names is not asked for above."""
        items[:] = [item for item in items if item.path.resolve() in self.own]


class AllFiles:
    """Where the reports arrive: the tests are those of all processes. pytest-xdist counts those of the last one, and
    ends with "no tests" if it has none."""

    def __init__(self) -> None:
        self.count = 0

    def pytest_sessionstart(self, session: pytest.Session) -> None:
        self.session = session

    @pytest.hookimpl(optionalhook=True)
    def pytest_xdist_node_collection_finished(self, ids: list[str]) -> None:
        self.count += len(ids)

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_logstart(self) -> None:
        self.session.testscollected = self.count or self.session.testscollected


class Recorder:
    """Measures each test where it runs; adds up and writes where the reports of all processes arrive."""

    def __init__(self) -> None:
        self.before = 0.0
        self.tests: dict[str, dict[str, float]] = defaultdict(lambda: defaultdict(float))

    def pytest_runtest_logstart(self) -> None:
        self.before = _processor_time()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self, item: pytest.Item, call: pytest.CallInfo[None]) -> Any:
        report = yield
        before, self.before = self.before, _processor_time()
        name = getattr(item, "originalname", item.name) if call.when == "call" else ""
        report.user_properties.append(("seconds", (name, self.before - before)))
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        name, seconds = dict(report.user_properties)["seconds"]
        self.tests[report.location[0]][name] += seconds

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        if hasattr(session.config, "workerinput"):
            return
        found = recorded() | {file: _with_slow(tests) for file, tests in self.tests.items()}
        lines = (f" {json.dumps(file)}: {json.dumps(found[file])}" for file in sorted(found) if (ROOT / file).is_file())
        RECORD.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


def _with_slow(tests: dict[str, float]) -> dict[str, float]:
    slow = {name: round(seconds, 1) for name, seconds in sorted(tests.items()) if name and seconds >= SLOW}
    return {"": round(sum(seconds for name, seconds in tests.items() if name not in slow), 2)} | slow


def _processor_time() -> float:
    """Of this process and of those that it has waited for."""
    ended = os.times()
    return time.process_time() + ended.children_user + ended.children_system
