"""What share of small errors the tests and quick checks see: one character of the packages changed at a time.

    python -m tests.verification.mutations --count 100 --first 36 --seed 1
    python -m tests.verification.mutations --count 60 --under qsbearing/systems/sets qsbearing/files --record FILE

draws operators and digits from the code of both packages, changes each in a copy, and runs the tests of its module and
then quick checks on the copy, each with at most 60 s of processor time. The kernel runs as plain Python where the
change is in its own source, else as its machine code. What it finds is kept in `mutations.json` from one change to the
next, so an interrupted run goes on where it was; `mutations_of_*.json` are records of some folders. A change that
nothing sees is a missing test, or makes no difference; which of the two somebody has to find out, and writes into
`survivors`.
"""

from __future__ import annotations

import argparse
import io
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import tokenize
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

from fem_check.checks import ALL
from qsbearing.model.compiler import library
from qsbearing.results import provenance

ROOT = Path(__file__).parents[2]
RECORD = Path(__file__).with_name("mutations.json")
PACKAGES = ("qsbearing", "fem_check")
SECONDS = 60
"""Of processor time, for the tests and for each check."""
MOST_FILES = 6
NOT_RUN = {"verification", "test_planted_errors.py"}
"""The latter knows lines of code as they stand."""
OTHER = {"+": "-", "-": "+", "*": "/", "/": "*", "<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "!=", "!=": "=="}
CHECKS = {
    "qsbearing/model": ("solution_contacts", "solution_parts"),
    "qsbearing/systems": ("solution_parts", "solution_contacts"),
    "qsbearing/readings": ("solution_parts", "contact_at_the_edge"),
    "qsbearing": ("solution_parts",),
    "fem_check/mechanics": ("half_space_contacts", "contact_at_the_edge"),
    "fem_check/elements": ("patch_test", "half_space_contacts"),
    "fem_check/independent": ("solution_contacts", "solution_parts"),
    "fem_check/solids": ("patch_test",),
    "fem_check/checks": ("solution_parts", "solution_contacts"),
    "fem_check": ("patch_test",),
}
"""By the beginning of a file's path, the longest first."""


@dataclass(frozen=True)
class Mutation:
    """A character of a file, and the other one in its place."""

    path: str
    line: int
    column: int
    old: str
    new: str

    def applied(self, source: str) -> str:
        """The file with it."""
        lines = source.splitlines(keepends=True)
        text = lines[self.line - 1]
        assert text.startswith(self.old, self.column), self
        lines[self.line - 1] = text[: self.column] + self.new + text[self.column + len(self.old) :]
        return "".join(lines)


def candidates(files: Iterable[Path]) -> list[Mutation]:
    """Every operator and number of these files outside texts."""
    found = []
    for path in files:
        name = path.relative_to(ROOT).as_posix()
        for token in tokenize.generate_tokens(io.StringIO(path.read_text(encoding="utf-8")).readline):
            (line, column), text = token.start, token.string
            if token.type == tokenize.NUMBER and text[0].isdigit():
                digit = text[0]  # 0 to 1, as an index or a sign that is lost would
                found.append(Mutation(name, line, column, digit, str((int(digit) + 1) % 10)))
            elif token.type == tokenize.OP and text in OTHER and "import" not in token.line:
                found.append(Mutation(name, line, column, text, OTHER[text]))
    return found


def is_code(mutation: Mutation) -> bool:
    """Whether the file can be read with it: a star before an argument is no multiplication."""
    source = mutation.applied((ROOT / mutation.path).read_text(encoding="utf-8"))
    try:
        compile(source, mutation.path, "exec")
    except SyntaxError:
        return False
    return True


def drawn(count: int, seed: int, under: Iterable[str] = PACKAGES) -> list[Mutation]:
    """So many of them, of files below these folders."""
    every = candidates(sorted(file for folder in under for file in (ROOT / folder).rglob("*.py")))
    random.Random(seed).shuffle(every)
    return list(islice(filter(is_code, every), count))


def tests_of(path: str) -> list[str]:
    """Test files of a module: those of its name, then those that import it, then those of its folder; the shorter
    first."""
    module, stem = path.removesuffix(".py").replace("/", "."), Path(path).stem
    package, _, name = module.rpartition(".")
    imported = re.compile(rf"\b{re.escape(module)}\b|from {re.escape(package)} import [^\n]*\b{name}\b")
    folder = ROOT / "tests" / Path(path).parent.relative_to("qsbearing" if path.startswith("qsbearing") else "")
    ranked = []
    for file in (ROOT / "tests").rglob("test_*.py"):
        text = file.read_text(encoding="utf-8")
        of_name, imports = file.stem == f"test_{stem}", bool(imported.search(text))
        if not NOT_RUN & {*file.parts, file.name} and (of_name or imports or file.parent == folder):
            ranked.append((not of_name, not imports, len(text), file.relative_to(ROOT).as_posix()))
    return [name for *_, name in sorted(ranked)[:MOST_FILES]]


def run(folder: Path, *command: str, plain: bool) -> tuple[str, str]:
    """pass, fail, or timeout; and what it printed."""

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))

    environment = os.environ | {"PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}
    environment |= {"NUMBA_DISABLE_JIT": "1"} if plain else {}
    done = subprocess.run(
        [sys.executable, "-m", *command], cwd=folder, env=environment,
        capture_output=True, text=True, check=False, preexec_fn=limited,
    )  # fmt: skip
    return "timeout" if done.returncode < 0 else "fail" if done.returncode else "pass", done.stdout


def commands_for(path: str) -> dict[str, tuple[str, ...]]:
    """Tests and checks by what the record calls them."""
    found, tests, stem = {}, tests_of(path), Path(path).stem
    if tests:
        found["tests"] = ("pytest", "-qx", "-p", "no:cacheprovider", *tests)
    if path.startswith("fem_check/book/cases"):
        shipped = ("pytest", "-qx", "-p", "no:cacheprovider", "tests/fem_check/test_book.py", "-k", stem)
        return found | {"tests": shipped, f"book {stem}": ("fem_check", "book", stem, "--out", "out")}
    start = next(start for start in sorted(CHECKS, key=len, reverse=True) if path.startswith(start))
    checks = (stem,) if stem in ALL else CHECKS[start]
    return found | {f"check {each}": ("fem_check", "run", each, "--out", "out") for each in checks}


def seen_by(folder: Path, target: Path, source: str, changed: str, path: str) -> tuple[str, list[str]]:
    """What sees a changed file (nothing: ""), and what did not end in its time.

    A test that fails must pass without the change.
    """
    late: list[str] = []
    plain = path in json.loads((library.FOLDER / library.MANIFEST).read_text(encoding="utf-8"))["sources"]
    for name, command in commands_for(path).items():
        broken: list[str] = []
        while True:
            target.write_text(changed, encoding="utf-8")
            ended, said = run(folder, *command, *(f"--deselect={each}" for each in broken), plain=plain)
            target.write_text(source, encoding="utf-8")
            if ended != "fail":
                late += [name] if ended == "timeout" else []
                break
            failed = re.findall(r"^(?:FAILED|ERROR) (\S+)", said, re.MULTILINE) if name == "tests" else []
            again = ("pytest", "-qx", "-p", "no:cacheprovider", *failed) if failed else command
            if run(folder, *again, plain=plain)[0] == "pass":
                return ", ".join(failed) or name, late
            late.append(f"fails or ends late without the change: {', '.join(failed) or name}")
            if not failed or len(late) > 3:
                break
            broken += failed
    return "", late


def main() -> None:
    """Go on with the survey, and keep each result at once."""
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--count", type=int, default=100, help="drawn")
    asked.add_argument("--first", type=int, default=None, help="how many of them are run; all, if left out")
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument(
        "--under", nargs="+", default=PACKAGES, help="folders of the code; all of both packages, if left out"
    )
    asked.add_argument("--record", type=Path, default=RECORD, help="file that keeps what is found")
    given = asked.parse_args()
    some, kept_in = drawn(given.count, given.seed, given.under)[: given.first], given.record
    record: dict[str, Any] = {
        "seed": given.seed,
        "count": given.count,
        "seconds": SECONDS,
        "under": list(given.under),
        "found": [],
        "survivors": {},
    }
    if kept_in.is_file():
        kept = json.loads(kept_in.read_text(encoding="utf-8"))
        asked_of = kept["seed"], kept["count"], kept.get("under", list(PACKAGES))
        record = kept if asked_of == (given.seed, given.count, list(given.under)) else record
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        for name in (*PACKAGES, "tests"):
            shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        for name in ("meshes", "README.md", "CHANGELOG.md"):
            (folder / name).symlink_to(ROOT / name)
        shutil.copy(ROOT / "pyproject.toml", folder)
        for each in some[len(record["found"]) :]:
            target = folder / each.path
            source = target.read_text(encoding="utf-8")
            by, late = seen_by(folder, target, source, each.applied(source), each.path)
            line = source.splitlines()[each.line - 1].strip()
            record["found"].append(vars(each) | {"text": line, "seen_by": by, "not_ended": late})
            record["provenance"] = provenance.of_run("python -m tests.verification.mutations", "survey")
            kept_in.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
            print(
                f"{len(record['found'])}: {each.path}:{each.line} {each.old} -> {each.new}: {by or 'not seen'}",
                flush=True,
            )


if __name__ == "__main__":
    main()
