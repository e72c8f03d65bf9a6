"""A record as a page of Markdown, and the index of all: formatting only."""

from __future__ import annotations

from typing import Any

from fem_check import row_text
from fem_check.book.not_yet import NOT_YET
from qsbearing import provenance

Record = dict[str, Any]

LISTS = {
    "missing": "What the source does not say",
    "fitted": "Fitted",
    "predicted": "Predicted",
    "chosen_after_seeing": "Chosen after seeing the data",
    "does_not_show": "What this does not show",
}

ROWS = ["of", "quantity", "published", "computed", "deviation, %", "tolerance", ""]


def markdown(record: Record) -> str:
    """One page; its picture is the file beside it."""
    picture = record["picture"]
    parts = [
        f"# {record['title']}",
        f"**{record['verdict']}**: {record['summary']}",
        record["question"],
        f"Evidence of kind {record['kind']}: {record['kind_text']}. " + "; ".join(record["sources"]) + ".",
        f"![{picture['alt']}]({picture['file']})",
        f"*{picture['caption']}*",
        "## Numbers",
        _table(ROWS, [_row(row) for row in record["rows"]]),
        "Tolerances:",
        "\n".join(f"- {reason}" for reason in dict.fromkeys(map(_reason, record["rows"]))),
        "## Inputs",
        _table(["input", "value", "from"], record["inputs"]),
    ]
    for key, heading in LISTS.items():
        parts += [f"## {heading}", "\n".join(f"- {item}" for item in record[key] or ["nothing"])]
    if record["points"]:
        parts += ["## Every point", record["points"]["caption"]]
        parts.append(_table(record["points"]["columns"], record["points"]["rows"]))
    made = f"{provenance.in_words(record)[:1].upper()}{provenance.in_words(record)[1:]}; {record['seconds']:.1f} s."
    return "\n\n".join([*parts, "## This run", made]) + "\n"


def index(records: list[Record]) -> str:
    """All cases, and those that wait for a document."""
    rows = [
        [f"[{each['title']}]({each['case']}.md)", each["kind"], each["verdict"], each["summary"]] for each in records
    ]
    kinds = {each["kind"]: each["kind_text"] for each in records}
    return (
        "\n\n".join(
            [
                "# The validation book",
                "One page per published case, made by the run that checks it. Kinds of evidence: "
                + "; ".join(f"{kind}, {kinds[kind]}" for kind in sorted(kinds))
                + ".",
                _table(["case", "kind", "verdict", "found"], rows),
                "## Cases that wait for a document",
                _table(["document", "would show", "what is at hand"], [list(each.values()) for each in NOT_YET]),
            ]
        )
        + "\n"
    )


def _row(row: Record) -> list[Any]:
    unit = row_text.in_unit(row)[1]
    worst = f", worst at {row['worst_at']}" if row["worst_at"] else ""
    told = row_text.of_row(row)
    return [
        row["case"] + worst,
        row["quantity"] + (f" [{unit}]" if unit else ""),
        told.reference,
        told.found,
        told.deviation,
        told.tolerance,
        f"**{row['verdict']}**" if row["verdict"] == "fail" else row["verdict"],
    ]


def _reason(row: Record) -> str:
    what = f"{row['quantity']}: {row['why_tolerance']}"
    return what if row["tolerance_percent"] is None else f"{what} (printed: {row['reference_source']})"


def _table(headings: list[str], rows: list[list[Any]]) -> str:
    lines = ["| " + " | ".join(headings) + " |", "|" + "---|" * len(headings)]
    lines += ["| " + " | ".join(_cell(value) for value in row) + " |" for row in rows]
    return "\n".join(lines)


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    return "" if value is None else str(value)
