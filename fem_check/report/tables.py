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
        "| check | verdict | level | s (processor s) | MB | unknowns | elements per semi-axis | solver | mesh |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for entry in entries:
        mesh = entry["mesh"]
        lines.append(
            f"| [{entry['check']}](#{entry['check']}) | {entry['verdict']} | {entry['level']} | {entry['seconds']:.1f} "
            f"({entry['cpu_seconds']:.1f}) | {entry['peak_memory_MB']} | {mesh['dofs']} | "
            f"{mesh['elements_per_semi_axis']} | {entry['solver']} | `{mesh['file']}` |"
        )
    return "\n".join(lines)


def agreement(entry: Entry) -> str:
    """All rows of a check."""
    lines = [
        "| case | quantity | reference | found | deviation % | uncertainty ±% | tolerance % | verdict |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in entry["rows"]:
        factor, unit = UNITS.get(row["unit"], (1.0, row["unit"]))
        name = row["quantity"].replace("_", " ")
        lines.append(
            f"| {row['case']} | {name}{f' [{unit}]' if unit else ''} | {number(row['reference'] * factor)} | "
            f"{number(row['found'] * factor)} | {number(row['deviation_percent'], 2, signed=True)} | "
            f"{number(row['uncertainty_percent'], 2)} | {number(row['tolerance_percent'], 2)} | "
            f"{'**fail**' if row['verdict'] == 'fail' else row['verdict']} |"
        )
    return "\n".join(lines)


def sources(entry: Entry) -> str:
    """Every source and every reason for a tolerance that a check's rows name, once."""
    sources = dict.fromkeys(
        f"- {row['reference_source']}" for row in entry["rows"] if row["tolerance_percent"] is not None
    )
    reasons = dict.fromkeys(
        f"- {number(row['tolerance_percent'], 2)} %: {row['why_tolerance']}"
        for row in entry["rows"]
        if row["tolerance_percent"] is not None
    )
    findings = dict.fromkeys(
        f"- {row['case']}, {row['quantity'].replace('_', ' ')}: {row['why_tolerance'].removeprefix('a finding: ')}"
        for row in entry["rows"]
        if row["verdict"] == "finding" and row["why_tolerance"].startswith("a finding: ")
    )
    text = "References:\n\n" + "\n".join(sources) + "\n\nTolerances:\n\n" + "\n".join(reasons)
    return text + ("\n\nFindings, without a tolerance:\n\n" + "\n".join(findings) if findings else "")
