"""Files of the packages, read as programs."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGES = (ROOT / "qsbearing", ROOT / "fem_check")


def trees(having: str, *folders: Path) -> Iterator[tuple[Path, ast.Module]]:
    """Of each file below folders that has a regular expression in its text. Reading all takes seconds: who looks for a
    name says so."""
    for folder in folders:
        for path in sorted(folder.rglob("*.py")):
            text = path.read_text(encoding="utf-8")
            if re.search(having, text):
                yield path, ast.parse(text)
