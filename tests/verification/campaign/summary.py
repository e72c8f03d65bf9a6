"""What a campaign comes to: the ranges' lines put together, and held against the bar."""

from __future__ import annotations

import hashlib
import os
import platform
from collections import Counter, defaultdict
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import qsbearing
from fem_check.running import known
from qsbearing.results import provenance
from tests.verification.campaign.certificates import by_strength
from tests.verification.campaign.chunk import UNCONVERGED
from tests.verification.campaign.envelope import CHANCE, ENVELOPES, WHOLE, scene_name

QUANTILES = {"median": 0.5, "99 %": 0.99, "99.9 %": 0.999, "99.99 %": 0.9999, "most": 1.0}


def quantile(counts: dict[int, int], share: float) -> int | None:
    """The least value that this share of the counted does not exceed."""
    total = sum(counts.values())
    reached = 0
    for value in sorted(counts):
        reached += counts[value]
        if reached >= share * total:
            return value
    return None


def source_digest() -> str:
    """Of the package that was tried."""
    digest = hashlib.sha256()
    folder = Path(qsbearing.__file__).parent
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.relative_to(folder).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def added(parts: Iterable[dict[str, int]]) -> dict[str, int]:
    """Counts by name, the most frequent first."""
    total: Counter[str] = Counter()
    for part in parts:
        total.update(part)
    return dict(sorted(total.items(), key=lambda item: (-item[1], item[0])))


def added_tables(parts: Iterable[dict[str, dict[str, int]]]) -> dict[str, dict[str, int]]:
    """The same for tables of counts."""
    rows: defaultdict[str, list[dict[str, int]]] = defaultdict(list)
    for part in parts:
        for name, counts in part.items():
            rows[name].append(counts)
    return {name: added(rows[name]) for name in sorted(rows)}


def bar(envelope: str, count: int, lost: list[str], failures: int) -> dict[str, Any]:
    """Whether the campaign is what it must be: no failure, and no more scenes not converged than allowed, beside those
    that are known by name."""
    limits = ENVELOPES[envelope]
    allowed = limits.allowed(count)
    unnamed = known.unnamed(lost)
    words = f"at most {allowed} of {count} scenes not converged beside those that are named ({100 * limits.rate:g} %"
    if limits.rate > 0.0 and count < WHOLE:
        words += f", and what chance adds in {CHANCE:.0%} of so small samples"
    words += "); none converged wrongly, raised or hung"
    words += ", refused without certificate" if limits.is_certified else ", or differing as warm all through"
    return {
        "asked": words,
        "basis": limits.basis,
        "not_converged": len(lost),
        "named": len(lost) - len(unnamed),
        "allowed": allowed,
        "failures": failures,
        "met": failures == 0 and len(unnamed) <= allowed,
    }


def summarise(envelope: str, seed: int, lines: list[dict[str, Any]], seconds: float) -> dict[str, Any]:
    """The summary of these lines of the journal.

    Args:
        seconds: wall time.
    """
    lines = sorted(lines, key=lambda line: line["first"])
    scenes = sum(line["stop"] - line["first"] for line in lines)
    classes = added(line["classes"] for line in lines)
    reasons = added_tables(line["reasons"] for line in lines)
    kinds = added(reasons.values())
    listed = [entry for line in lines for entry in line["listed"]]
    failed = [entry for entry in listed if entry["status"] != UNCONVERGED]
    lost = [scene_name(envelope, seed, entry["scene"]) for entry in listed if entry["status"] == UNCONVERGED]
    iterations = {
        which: {int(value): number for value, number in table.items()}
        for which, table in added_tables(line["iterations"] for line in lines).items()
    }
    most, worst = max((line["most_iterations"] for line in lines), default=[-1, -1])
    return {
        "envelope": envelope,
        "seed": seed,
        "count": scenes,
        "classes": classes,
        "bar": bar(envelope, scenes, lost, len(failed)),
        "failures": added({entry["what"].partition(":")[0]: 1} for entry in failed),
        "not_converged": lost,
        **{
            f"iterations_of_{which}": {
                name: quantile(iterations.get(which, {}), share) for name, share in QUANTILES.items()
            }
            for which in ("converged", "rest")
        },
        "most_iterations": f"{scene_name(envelope, seed, worst)}: {most}" if most >= 0 else None,
        "largest": {
            name: max((line["largest"][name] for line in lines), default=0.0)
            for name in ("residual", "imbalance", "closure", "hertz")
        },
        "noted": added(line["noted"] for line in lines),
        "no_equilibrium": {"reasons_and_certificates": reasons, **by_strength(kinds)},
        "families": added_tables(line["families"] for line in lines),
        "digest": hashlib.sha256("".join(line["digest"] for line in lines).encode()).hexdigest()[:16],
        "seconds": round(seconds, 1),
        "processor_microseconds_per_scene": round(1e6 * sum(line["seconds"] for line in lines) / max(scenes, 1), 1),
        "versions": {
            "qsbearing": qsbearing.__version__,
            "source": source_digest(),
            "python": platform.python_version(),
            **{name: version(name) for name in ("numpy", "numba", "scipy")},
        },
        "cores": os.cpu_count(),
        "provenance": provenance.of_run(
            f"python -m tests.verification.campaign --envelope {envelope} --count {scenes} --seed {seed}"
        ),
    }
