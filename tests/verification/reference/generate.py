"""Solve every scene and write `reference.json`:  python -m tests.verification.reference.generate"""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

from .jones_harris import solve
from .scenes import SCENES

REFERENCE = Path(__file__).with_name("reference.json")


def main() -> None:
    """Solve the scenes one after the other, one line of progress each."""
    entries = []
    for case in SCENES:
        begin = time.perf_counter()
        result = solve(case)
        entries.append({"case": case, "result": result})
        print(f"{case['name']:45s} residual {result['residual']:10s} {time.perf_counter() - begin:5.1f} s", flush=True)
    REFERENCE.write_text(as_text(entries), encoding="utf-8")


def load_reference() -> list[dict[str, Any]]:
    """The stored scenes and results: a list of {"case", "result"}."""
    return json.loads(REFERENCE.read_text(encoding="utf-8"))


def as_text(entries: list[dict[str, Any]]) -> str:
    """JSON with one line for every entry of a case or result and one for every ball."""
    blocks = []
    for entry in entries:
        parts = []
        for title in ("case", "result"):
            lines = [f"  {json.dumps(key)}: {field_text(key, value)}" for key, value in entry[title].items()]
            parts.append(f' "{title}": {{\n' + ",\n".join(lines) + "\n }")
        blocks.append("{\n" + ",\n".join(parts) + "\n}")
    return "[\n" + ",\n".join(blocks) + "\n]\n"


def field_text(key: str, value: Any) -> str:
    """One field of a case or result; the balls each on a line of their own."""
    if key != "balls":
        return json.dumps(value)
    return "[\n" + ",\n".join("   " + json.dumps(ball) for ball in value) + "\n  ]"


if __name__ == "__main__":
    main()
