"""Times, sizes and counts that pages of the guide state outside of what records and commands make, each with the
reason."""

from __future__ import annotations

import re
from pathlib import Path

READER = "of the reader's machine and network, said roughly"
RECORD = "rounded from the table that timing.md has from the record"
LIMIT = "a limit of the program, not a measurement"
CLAIM = "compared with the record by tests/guide/test_claims.py"
SETS = "tests/verification/benchmarks/sets_cost.py prints it; no other page or test needs a record of it"
READINGS = "tests/verification/benchmarks/readings_cost.py prints it; no other page or test needs a record of it"
BOOK = "the case mfpt_rig of the validation book counts them"
CHECK = "what a heavy command of the page took on two idle cores, said so that nobody waits in vain"
ONCE = "measured once, in the study that the paragraph tells of; nothing in the program depends on it"

STATED = {
    "README.md": {
        "about a minute": READER,
        "31 µs": CLAIM,
        "3.5 µs": CLAIM,
    },
    "agreement.md": {"about a minute": CHECK},
    "data_sheet.md": {"2 of 5": "a name as the command on the page gives it, which a test runs"},
    "decisions.md": {"56 of 60 random": "as the table of alternatives in timing.md has it from the record"},
    "design.md": {"28 s": ONCE},
    "finite_elements.md": {
        "half a minute": CHECK,
        "0.9 GB": CHECK,
        "about a minute": CHECK,
        "one minute": CHECK,
        "1.3 GB": CHECK,
    },
    "how_to.md": {
        "98 of 130 bad": ONCE,
        "15 seconds": CHECK,
        "some minutes": CHECK,
        "1 MB": LIMIT,
        "50 MB": LIMIT,
        "20 MB": LIMIT,
        "100 MB": LIMIT,
    },
    "language_models.md": {"120 s": LIMIT, "1 MB": LIMIT},
    "limits.md": {"13 of 14 groups": BOOK, "8 of 14 with": BOOK},
    "model.md": {"5 of 200,000 random": ONCE},
    "readings.md": {
        "0.053 of 0.05": "a rounding, not a count",
        "13 of 14 groups": BOOK,
        "8 of 14 with": BOOK,
        "15.5 µs": READINGS,
        "0.4 s": READINGS,
        "8.7 µs": READINGS,
    },
    "releasing.md": {"83 minutes": "a trial of two ways to run the same steps; nothing depends on it"},
    "sets.md": dict.fromkeys(
        (
            "6.4 µs", "11.1 µs", "18.1 µs", "9.2 µs", "22.9 µs", "40.5 µs", "11.7 µs", "20.5 µs", "31.4 µs", "15.9 µs",
            "45.2 µs", "83.7 µs",
        ),
        SETS,
    ),
    "studies.md": {"0.03 s": ONCE, "0.46 GB": ONCE, "16 s": ONCE, "0.52 GB": ONCE, "9.5 s": ONCE},
    "timing.md": {"2 to 50 ms": READER, "about a minute": READER},
}  # fmt: skip
"""By page and text."""

_NUMBER = r"(?<![\w.,])\d[\d.,]*(?: to \d[\d.,]*)?"
_MEASURED = re.compile(
    rf"{_NUMBER} (?:s|ms|µs|min|minutes?|seconds?|hours?|GB|MB)\b(?!/)|{_NUMBER} of [\d,.]*\d(?: [a-z]+)?"
    r"|half a (?:second|minute)|some (?:seconds|minutes)|(?:about (?:a|ten)|one) (?:second|minute|hour)s?\b"
)


def stated(page: Path) -> set[str]:
    """Of a page, outside of blocks, tables made from records, and code."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"<!-- (.+?): made by .*?<!-- end of \1 -->", "", text, flags=re.DOTALL)
    return set(_MEASURED.findall(re.sub(r"\s+", " ", re.sub(r"`[^`]*`", "", text))))
