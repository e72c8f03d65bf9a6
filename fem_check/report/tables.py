"""Records as Markdown tables."""

from __future__ import annotations

from typing import Any

Entry = dict[str, Any]

UNITS = {"m": (1e6, "µm"), "Pa": (1e-6, "MPa"), "m/N": (1e9, "nm/N"), "1": (1.0, "")}


def number(value: float | None, digits: int = 6, signed: bool = False) -> str:
    """A number of a record, shortened."""
    if value is None:
        return ""
    return f"{value:+.{digits}g}" if signed else f"{value:.{digits}g}"


def summary(entries: list[Entry]) -> str:
    """One line a check."""
    lines = [
        "| check | scene | verdict | level | s (processor s) | MB | unknowns | per semi-axis | solver | mesh |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for entry in entries:
        mesh = entry["mesh"]
        lines.append(
            f"| [{entry['check']}](#{entry['check']}) | {entry['scene']} | {entry['verdict']} | {entry['level']} | "
            f"{entry['seconds']:.1f} ({entry['cpu_seconds']:.1f}) | {entry['peak_memory_MB']} | {mesh['dofs'] or ''} | "
            f"{mesh['elements_per_semi_axis'] or ''} | {entry['solver']} | {mesh['file'] or ''} |"
        )
    return "\n".join(lines)


def agreement(rows: list[Entry]) -> str:
    """Rows of a check, those of one case under its name."""
    lines = [
        "| quantity | reference | found | deviation % | uncertainty ±% | tolerance % | verdict | worst at |",
        "|---|---|---|---|---|---|---|---|",
    ]
    case = None
    for row in rows:
        if row["case"] != case:
            case = row["case"]
            lines.append(f"| **{case}** | | | | | | | |")
        factor, unit = UNITS.get(row["unit"], (1.0, row["unit"]))
        name = row["quantity"].replace("_", " ")
        lines.append(
            f"| {name}{f' [{unit}]' if unit else ''} | {number(row['reference'] * factor)} | "
            f"{number(row['found'] * factor)} | {number(row['deviation_percent'], 2, signed=True)} | "
            f"{number(row['uncertainty_percent'], 2)} | {number(row['tolerance_percent'], 2)} | "
            f"{'**fail**' if row['verdict'] == 'fail' else row['verdict']} | {row['worst_at'] or ''} |"
        )
    return "\n".join(lines)


def sources(rows: list[Entry]) -> str:
    """Every source and every reason for a tolerance that rows name, once."""
    gated = [row for row in rows if row["tolerance_percent"] is not None]
    findings = [row for row in rows if row["verdict"] == "finding" and row["why_tolerance"].startswith("a finding: ")]
    lists = {
        "References": [row["reference_source"] for row in gated],
        "Tolerances": [f"{number(row['tolerance_percent'], 2)} %: {row['why_tolerance']}" for row in gated],
        "Findings, without a tolerance": [
            f"{row['case']}, {row['quantity'].replace('_', ' ')}: {row['why_tolerance'].removeprefix('a finding: ')}"
            for row in findings
        ],
    }
    return "\n\n".join(
        f"{heading}:\n\n" + "\n".join(f"- {item}" for item in dict.fromkeys(items))
        for heading, items in lists.items()
        if items
    )
