"""Lists within pages of the guide that the code knows: readings, results, remarks."""

from __future__ import annotations

from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.solution.result_keys import BALL, CONTACT, printed_unit, split
from qsbearing.readings.asked import READINGS
from qsbearing.remarks.kinds import KINDS, Kind


def _readings() -> str:
    """Rows of the guide's table of readings, in the words of each."""
    return "".join(f"| `{name}` | {each.gives} | {each.by} |\n" for name, each in READINGS.items())


def _results() -> str:
    """Rows of the page of symbols: those of the results that have one."""
    found = [(f"`inner.{shown.path}`, `outer.{shown.path}`", shown, shown.source) for shown in CONTACT]
    found += [(f"`{shown.path}`", shown, shown.source) for shown in BALL]
    found += [
        (f"`{name}.{shown.path}`", shown, each.by)
        for name, each in READINGS.items()
        for shown in (*each.of_case, *each.of_contact, *each.of_ball)
    ]

    def written(key: str) -> str:
        return printed_unit(split(key)[1]) or "-"

    return "".join(
        f"| ${shown.symbol}$ | {names} | {shown.plain_name} | {written(shown.key)} | {source} |\n"
        for names, shown, source in found
        if shown.symbol
    )


def _remarks() -> str:
    """Rows of the table of remarks."""

    def row(kind: Kind) -> str:
        values = ", ".join(f"`{name}`" for name in kind.values)
        return f"| `{kind.code}` | {kind.severity.words} | {values} | {kind.outline(IN_FILE)} |\n"

    return "".join(map(row, KINDS.values()))


LISTS = {"readings": _readings, "results": _results, "remarks": _remarks}
"""By the names of their marks in a page."""
