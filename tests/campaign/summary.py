"""What a campaign comes to: the chunks' summaries put together."""

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

QUANTILES = {"median": 0.5, "99 %": 0.99, "99.9 %": 0.999, "99.99 %": 0.9999, "most": 1.0}

CERTIFICATES = {
    "unsupported direction": "proof: a ring direction along which the load works and no ball is pressed, found by "
    "non-negative least squares and checked by its scalar products",
    "null motion": "proof: a ring motion that moves no groove centre and along which the load works",
    "open side, unique balance": "proof: at rest the balance with shoulders on both sides is unique; it is checked, "
    "and has load at a negative inner angle",
    "none": "nothing found: counted as a failure",
}
"""What the kinds prove; the others all alike:"""

EVIDENCE = (
    "evidence: the balance of the equations as they stand is checked, at the full speed or where it was followed up to "
    "in speed, and breaks what the kind is named after; that there is no other is not proved"
)


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
    rows: dict[str, list[dict[str, int]]] = defaultdict(list)
    for part in parts:
        for name, counts in part.items():
            rows[name].append(counts)
    return {name: added(rows[name]) for name in sorted(rows)}


def spread(chunks: list[dict[str, Any]], key: str) -> dict[str, int | None]:
    """Quantiles of iterations."""
    counts = {int(value): number for value, number in added(chunk[key] for chunk in chunks).items()}
    return {name: quantile(counts, share) for name, share in QUANTILES.items()}


def summarise(seed: int, chunks: list[dict[str, Any]], seconds: float, memory_MB: float) -> dict[str, Any]:
    """The summary of these chunks.

    Args:
        seconds: wall time.
        memory_MB: peak of all processes together.
    """
    chunks = sorted(chunks, key=lambda chunk: chunk["chunk"])
    scenes = sum(chunk["scenes"] for chunk in chunks)
    reasons = added_tables(chunk["reasons"] for chunk in chunks)
    kinds = added(reasons.values())
    failures = added({_sort(failure): 1} for chunk in chunks for failure in chunk["failures"])
    worst = max(chunks, key=lambda chunk: chunk["worst"]["iterations"], default=None)
    digest = hashlib.sha256("".join(chunk["digest"] for chunk in chunks).encode()).hexdigest()[:16]
    return {
        "seed": seed,
        "count": scenes,
        "classes": added(chunk["classes"] for chunk in chunks),
        "failures": failures,
        "failures_total": sum(failures.values()),
        "failures_whose_file_ends_otherwise": sum(
            failure["reproduced"] is False for chunk in chunks for failure in chunk["failures"]
        ),
        "iterations_of_converged": spread(chunks, "iterations"),
        "iterations_of_the_rest": spread(chunks, "iterations_without"),
        "most_iterations": None
        if worst is None
        else f"{seed}/{worst['chunk']}/{worst['worst'].get('index')}: {worst['worst']['iterations']}",
        "largest": {
            name: max((chunk["largest"][name] for chunk in chunks), default=0.0)
            for name in ("residual", "imbalance", "closure", "hertz")
        },
        "noted": added(chunk["noted"] for chunk in chunks),
        "no_equilibrium": {
            "reasons_and_certificates": reasons,
            "certificates": kinds,
            "proofs": sum(number for kind, number in kinds.items() if CERTIFICATES.get(kind, "").startswith("proof")),
            "evidence": sum(number for kind, number in kinds.items() if kind not in CERTIFICATES),
            "what_they_are": {kind: CERTIFICATES.get(kind, EVIDENCE) for kind in kinds},
        },
        "families": added_tables(chunk["families"] for chunk in chunks),
        "digest": digest,
        "seconds": round(seconds, 1),
        "microseconds_of_work_per_scene": round(1e6 * sum(chunk["seconds"] for chunk in chunks) / max(scenes, 1), 1),
        "peak_memory_MB": round(memory_MB),
        "versions": {
            "qsbearing": qsbearing.__version__,
            "source": source_digest(),
            "python": platform.python_version(),
            **{name: version(name) for name in ("numpy", "numba", "scipy")},
        },
        "cores": os.cpu_count(),
    }


def _sort(failure: dict[str, Any]) -> str:
    """What went wrong, without its numbers."""
    return failure["what"] if not failure["what"].startswith("raises") else failure["what"].partition(":")[0]
