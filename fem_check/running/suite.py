"""The tests as part of a release: all of them and those that take minutes, counted, with why some are skipped."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree

from fem_check.rows.record import Record
from fem_check.running import records_store
from qsbearing.results import provenance

COMMANDS = {
    "tests": ("-n", "auto"),
    "heavy tests": ("-m", "heavy", "-n", "auto", "--dist", "loadfile"),
}
"""Arguments of pytest by step. Without `-m` it leaves the heavy tests out (pyproject.toml): none is run twice."""
FAILED = 1
"""pytest's exit code where tests failed; every larger one means that they were not run."""


class SuiteError(Exception):
    """The tests could not be run; the message says why."""


def command_of(name: str) -> str:
    """As it is typed."""
    return " ".join(("python", "-m", "pytest", *COMMANDS[name]))


def file_of(name: str) -> str:
    """Of its record, in the gate's folder."""
    return f"{name.replace(' ', '_')}.json"


def run(name: str, root: Path, target: Path, log: Path, arguments: tuple[str, ...] = ()) -> None:
    """Run the tests of a step, and write what they came to.

    Args:
        root: of the checkout.
        log: what pytest says.
        arguments: further ones of pytest.

    Raises:
        SuiteError: it was interrupted, or found no tests, or an error in itself.
    """
    for path in (target, log):
        path.parent.mkdir(parents=True, exist_ok=True)
    results, began = log.with_suffix(".xml"), time.perf_counter()
    results.unlink(missing_ok=True)
    command = [sys.executable, "-m", "pytest", *COMMANDS[name], *arguments, f"--junitxml={results}"]
    with log.open("w", encoding="utf-8") as file:
        done = subprocess.run(
            command, cwd=root, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT, check=False
        )
    if not 0 <= done.returncode <= FAILED or not results.is_file():
        raise SuiteError(f"pytest ended with exit code {done.returncode} (all it said: {log})")
    record = counted(results) | {
        "tests": name,
        "command": command_of(name),
        "seconds": round(time.perf_counter() - began, 1),
        "provenance": provenance.of_run(command_of(name)),
    }
    records_store.replace(target, (json.dumps(record, indent=1) + "\n").encode())


def counted(results: Path) -> Record:
    """What pytest's XML says: how many tests passed, were skipped for which reason, and failed by name."""
    passed, skipped, expected, failed = 0, Counter[str](), Counter[str](), dict[str, str]()
    for case in ElementTree.parse(results).getroot().iter("testcase"):
        name = f"{case.get('classname', '')}.{case.get('name', '')}"
        kinds = {each.tag: each for each in case}
        bad = kinds.get("failure", kinds.get("error"))
        if bad is not None:
            failed[name] = (bad.get("message") or "").partition("\n")[0]
        elif (left := kinds.get("skipped")) is not None:
            reasons = expected if left.get("type") == "pytest.xfail" else skipped
            reasons[_reason(left)] += 1
        else:
            passed += 1
    return {
        "passed": passed,
        "skipped": dict(skipped.most_common()),
        "expected_to_fail": dict(expected.most_common()),
        "failed": failed,
    }


def _reason(left: ElementTree.Element) -> str:
    """Of a test that was left out. A file that is left out as a whole counts as one, and its text ends with why."""
    said = left.get("message") or "no reason given"
    if said == "collection skipped" and left.text:
        said = str(ast.literal_eval(left.text.strip())[-1]).removeprefix("Skipped: ")
    return said.partition("\n")[0]


def wrong(record: Record) -> list[str]:
    """What speaks against a release: each test that failed, and tests of which none passed."""
    faults = [f"{name} failed: {why}" for name, why in record["failed"].items()]
    return faults if record["passed"] or faults else ["no test passed"]
