"""Lists within pages of the guide that the code knows: readings, results, remarks."""

from __future__ import annotations

from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.solution.groups import GROUPS
from qsbearing.model.solution.result_keys import Result, printed_unit
from qsbearing.readings.asked import READINGS
from qsbearing.remarks.kinds import KINDS, Kind


def every_kind() -> dict[str, Kind]:
    """All kinds of remarks, in the order of their codes.

    With the readings, what is imported here describes all that there are; it is loaded only where they are listed.
    """
    from qsbearing.files import sheet_by_name  # noqa: F401
    from qsbearing.inference import infer  # noqa: F401
    from qsbearing.remarks import of_solution  # noqa: F401
    from qsbearing.studies import inferred  # noqa: F401
    from qsbearing.studies.design import compare  # noqa: F401
    from qsbearing.systems.sets import remarks  # noqa: F401

    return dict(sorted(KINDS.items()))


def _readings() -> str:
    """Rows of the guide's table of readings, in the words of each."""
    return "".join(f"| `{name}` | {each.gives} | {each.by} |\n" for name, each in READINGS.items())


def _results() -> str:
    """Rows of the page of symbols: those of the results that have one."""
    groups = (*GROUPS, *(group for each in READINGS.values() for group in each.groups))
    rows: dict[tuple[Result, str], list[str]] = {}
    for group in groups:
        for each in (each for each in group.results if each.symbol):
            whose = (group.reading or group.raceway, str(each.path or each.name))
            rows.setdefault((each, each.source or group.source), []).append(f"`{'.'.join(filter(None, whose))}`")
    return "".join(
        f"| ${each.symbol}$ | {', '.join(dict.fromkeys(names))} | {each.plain_name} | {printed_unit(each.unit) or '-'} "
        f"| {source} |\n"
        for (each, source), names in rows.items()
    )


def _remarks() -> str:
    """Rows of the table of remarks."""

    def row(kind: Kind) -> str:
        values = ", ".join(f"`{name}`" for name in kind.values)
        return f"| `{kind.code}` | {kind.severity.words} | {values} | {kind.outline(IN_FILE)} |\n"

    return "".join(map(row, every_kind().values()))


LISTS = {"readings": _readings, "results": _results, "remarks": _remarks}
"""By the names of their marks in a page."""
