"""Requirement, check, record and its sum; and how to make all of it again."""

from __future__ import annotations

import hashlib
import subprocess
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any

from fem_check.report.evidence import Evidence, Kept
from fem_check.report.question import Question
from fem_check.report.rows import counts
from fem_check.running import kept_files, suite
from qsbearing import __version__
from qsbearing.documents.model import Badge, Block, Bullets, Cell, Code, Facts, Md, Paragraph, RowGroup, Section, Table
from qsbearing.results import provenance

NOT_RECORDED = "not recorded"
PASSED = Badge("pass", "pass")


def section(evidence: Evidence, questions: Sequence[Question]) -> Section:
    """Each requirement with its records; then those that answer none."""
    used = [kept for each in questions for kept in each.records]
    rest = [kept for kept in evidence.all() if kept not in used]
    groups = [*((f"{n}. {each.text}", each.records) for n, each in enumerate(questions, 1)), ("Further records", rest)]
    lines: list[list[Cell] | RowGroup] = []
    for name, records in groups:
        lines += [RowGroup(name), *map(_line, records)] if records else []
    unknown = [kept.name for kept in evidence.all() if not kept.provenance.get("commit")]
    headings = ("check", "record", "made at", "rows", "sha256")
    blocks: list[Block] = [Table(headings, lines, "lllll", "Requirement, check, record, sum", stack=True)]
    if unknown:
        blocks.append(Paragraph(f"{len(unknown)} records do not name their commit: {', '.join(unknown)}."))
    return Section("Requirements and their records", blocks, "requirements")


def _line(kept: Kept) -> list[Cell]:
    file = kept.name.rpartition("/")[2].removesuffix(".json").replace("_", " ")
    made, rows = kept.provenance, kept.data.get("rows") if "verdict" in kept.data else None
    commit = f"{made['commit'][:8]}{' +' if made['dirty'] else ''}" if made.get("commit") else "no commit"
    day = made["date"][:10].replace("-", "\N{NON-BREAKING HYPHEN}") if made else NOT_RECORDED
    tally = " + ".join(f"{n} {word}" for word, n in counts(rows or []).items() if n)
    name = str(kept.data.get("check") or kept.data.get("case") or file)
    return [name, kept.name.removeprefix("fem_check/records/"), f"{commit} {day}", tally, kept.digest[:12]]


def tally(records: Iterable[Kept], tested: str) -> tuple[int, int, int]:
    """Of records: made at the commit that was tested, at another, at one that is not known."""
    commits = [_commit(kept) for kept in records]
    here = sum(each == tested for each in commits if each)
    return here, sum(bool(each) for each in commits) - here, sum(not each for each in commits)


def tested(evidence: Evidence) -> str:
    """The commit that most records are of, the last made of several that have as many; empty where none is known."""
    commits = Counter(_commit(kept) for kept in evidence.all() if _commit(kept))
    last = {_commit(kept): _date(kept) for kept in sorted(evidence.all(), key=_date)}
    return max(commits, key=lambda each: (commits[each], last[each]), default="")


def _date(kept: Kept) -> str:
    return str(kept.provenance.get("date") or "")


def _commit(kept: Kept) -> str:
    """Empty where it is not known; one with changes that nobody committed is like no other."""
    commit = str(kept.provenance.get("commit") or "")
    return f"{commit} changed" if commit and kept.provenance["dirty"] else commit


def is_mixed(evidence: Evidence) -> bool:
    """Whether the records are not of one commit, all of them known."""
    commits = {_commit(kept) for kept in evidence.all()}
    return len(commits) > 1 or "" in commits


NAMED = 3
"""Records or files that a sentence names."""


def origins(evidence: Evidence) -> str:
    """Of how many commits the records are, and which are not of that of the most."""
    commits, most = [_commit(kept) for kept in evidence.all()], tested(evidence)
    known, unknown = len({each for each in commits if each}), commits.count("")
    said = f"the records come from {known} commit{'' if known == 1 else 's'}"
    said += f", and {unknown} of {len(commits)} do not name theirs" if unknown else ""
    strange = [kept.name.removeprefix("fem_check/records/") for kept in evidence.all() if _commit(kept) != most]
    return f"{said}; not of {most[:12]}: {named(strange)}" if most else said


def named(names: Sequence[str]) -> str:
    """The first of them, and how many more."""
    more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
    return ", ".join(names[:NAMED]) + more


def objections(evidence: Evidence) -> list[str]:
    """What forbids to call records of one commit a release: code that is not theirs, a gate that did not pass."""
    of, faults = tested(evidence), []
    if provenance.commit():  # not an installed package, which holds the records that it was built with
        try:
            changed = kept_files.others(of)
            faults += (
                [f"the code is not that of the records: {named(changed)} changed since {of[:12]}"] if changed else []
            )
        except (OSError, subprocess.SubprocessError):
            faults.append(f"the commit {of[:12]} of the records is not one of this repository")
        faults += ["the source has changes that are not committed"] if provenance.is_dirty() else []
    versions = {kept.version for kept in evidence.all()} | {__version__}
    if len(versions) > 1:
        faults.append(
            f"the records are of version {listed(sorted(versions - {__version__}))}, the code is {__version__}"
        )
    verdicts = evidence.gate.data.get("verdicts") if evidence.gate else None
    if verdicts is None:
        faults.append("no release run that ended is on record")
    else:
        failed = [name for name, reasons in verdicts.items() if reasons]
        faults += [f"the release run failed at: {named(failed)}"] if failed else []
    if len(evidence.tests) < len(suite.COMMANDS):
        faults.append("not all tests were run by the release run")
    return faults


def digest(records: Iterable[Kept]) -> str:
    """Of all records together: changes with any digit of one."""
    return hashlib.sha256("".join(sorted(kept.digest for kept in records)).encode()).hexdigest()[:8]


def listed(values: Iterable[Any]) -> str:
    """Each value once."""
    return ", ".join(dict.fromkeys(str(value) for value in values if value)) or NOT_RECORDED


def reproducing(evidence: Evidence) -> Section:
    """Commands, machines, packages, and the steps of the last release run."""
    levels = dict.fromkeys(kept.data["level"] for kept in evidence.checks.values())
    lines = [*(f"fem-check run --level {level} --out X" for level in levels), "fem-check report --records X --out DIR"]
    words = "This report prints stored results; nothing is recomputed. Finite elements and this report are made by:"
    blocks: list[Block] = [Paragraph(words), Code("\n".join(lines), "sh"), *_others(evidence)]
    return Section("Reproducing this report", [*blocks, Facts(_facts(evidence)), *_gate(evidence.gate)], "reproducing")


def _others(evidence: Evidence) -> list[Block]:
    """The commands of the other records, by where they run; one makes all published cases."""
    of_cases = {kept.command for kept in evidence.book.values()}
    commands = {
        "fem-check book" if kept.command in of_cases else kept.command: kept.needs_checkout for kept in evidence.all()
    }
    blocks: list[Block] = []
    for words, inside in (
        ("The other records:", False),
        ("In a checkout of the repository, because these need files that an installed package does not have:", True),
    ):
        lines = [each for each, needs in commands.items() if needs == inside and not each.startswith("fem-check run ")]
        blocks += [Paragraph(words), Code("\n".join(lines), "sh")] if lines else []
    return blocks


def _facts(evidence: Evidence) -> list[tuple[str, Cell]]:
    records = list(evidence.all())
    machines = [
        f"{each['processor']}, {each['cores']} cores, {each['memory_GB']:g} GB, {each['system']}, Python "
        f"{each['python']}"
        for each in (kept.provenance["machine"] for kept in records if kept.provenance)
    ]
    packages: dict[str, dict[str, None]] = {}
    for kept in records:
        for name, version in (kept.provenance.get("packages") or kept.data.get("versions") or {}).items():
            if name not in ("qsbearing", "source", "python"):
                packages.setdefault(name, {})[version] = None
    named = (f"{name} {' and '.join(versions)}" for name, versions in packages.items())
    return [("Machines", "; ".join(dict.fromkeys(machines)) or NOT_RECORDED), ("Packages", listed(named))]


def _gate(kept: Kept | None) -> list[Block]:
    """The last release run: that a step made its records says nothing of what they hold."""
    if kept is None:
        return []
    steps, verdicts = kept.data["steps"], kept.data.get("verdicts", {})
    errors = [f"{name}: {done['error']}" for name, done in steps.items() if done["error"]]
    seconds = sum(done["seconds"] for done in steps.values())
    words = (
        f"**Last release run**, {kept.data['level']} level, commit {kept.data['commit'][:12]}: "
        f"{len(steps) - len(errors)} of {len(steps)} steps made their records. "
        f"Their times, of which some ran side by side, add up to {seconds / 60.0:.0f} min."
    )
    lines: list[list[Cell]] = [
        [name, f"{steps[name]['seconds']:.0f}" if name in steps else "", Badge("fail", "fail") if why else PASSED]
        for name, why in verdicts.items()
    ]
    table = [Table(("step", "seconds", "verdict"), lines, "lrl", "Steps of the release run")] if lines else []
    return [Paragraph(Md(words)), *([Bullets(errors)] if errors else []), *table, kept.trace]
