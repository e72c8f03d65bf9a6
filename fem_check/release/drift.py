"""What moved from the previous release: each function compares one record and says in sentences what moved too far."""

from __future__ import annotations

from typing import Any

from fem_check.release import limits

Record = dict[str, Any]


def of_check(new: Record, old: Record) -> list[str]:
    """Of a check's rows: values found, references and tolerances; and rows that are gone."""
    known = {(row["case"], row["quantity"]): row for row in old["rows"]}
    found = {(row["case"], row["quantity"]): row for row in new["rows"]}
    same_mesh = new.get("mesh") == old.get("mesh") and _gmsh(new) == _gmsh(old)
    moved = [f"the row {_name(row)} of the previous release is gone" for key, row in known.items() if key not in found]
    for key, row in found.items():
        if key in known:
            moved += _of_row(row, known[key], same_mesh)
    return moved


def _gmsh(record: Record) -> str | None:
    return record.get("versions", {}).get("gmsh")


def _name(row: Record) -> str:
    return f"{row['quantity']!r} of {row['case']!r}"


def _of_row(row: Record, old: Record, same_mesh: bool) -> list[str]:
    moved = []
    if row["tolerance_percent"] != old["tolerance_percent"]:
        before, now = (_percent(each["tolerance_percent"]) for each in (old, row))
        moved.append(f"{_name(row)}: its tolerance was {before} and is {now}")
    # Where one row stands for the worst of several, another may be the worst now: only the deviations compare.
    same_worst = row["worst_at"] == old["worst_at"]
    scale = abs(old["reference"])
    if same_worst and scale > 0.0:
        change = 100.0 * abs(row["reference"] - old["reference"]) / scale
        if not change <= limits.REFERENCE.value:
            moved.append(
                f"{_name(row)}: its reference moved by {change:.2g} %, from {old['reference']:.10g} to "
                f"{row['reference']:.10g} (limit {limits.REFERENCE.value:g}: {limits.REFERENCE.why})"
            )
    change = abs(row["deviation_percent"] - old["deviation_percent"])
    uncertainties = old["uncertainty_percent"], row["uncertainty_percent"]
    limit = limits.of_row(row["quantity"], same_mesh, uncertainties, old["tolerance_percent"])
    if not change <= limit.value:
        where = "" if same_worst else f" (worst at {row['worst_at']}, before at {old['worst_at']})"
        moved.append(
            f"{_name(row)} moved by {change:.2g} %, from {old['found']:.10g} to {row['found']:.10g}{where} "
            f"(limit {limit.value:.2g}: {limit.why})"
        )
    return moved


def _percent(value: float | None) -> str:
    return "none" if value is None else f"{value:g} %"


def of_hard_cases(new: Record, old: Record) -> list[str]:
    """Of the table of hard cases: outcomes, and errors beyond rounding."""
    known = {case["case"]: case for case in old["cases"]}
    found = {case["case"]: case for case in new["cases"]}
    moved = [f"the hard case {name} of the previous release is gone" for name in known if name not in found]
    for name, case in found.items():
        before = known.get(name)
        if before is None:
            continue
        if (case["verdict"], case["status"]) != (before["verdict"], before["status"]):
            moved.append(
                f"the hard case {name} was {before['status']}, {before['verdict']}, and is {case['status']}, "
                f"{case['verdict']}"
            )
        for quantity in ("loads", "angles", "displacements"):
            if quantity not in case or quantity not in before:
                continue
            rounding = limits.HARD_CASE_ROUNDING.value * max(before[quantity], before["unavoidable"])
            if not case[quantity] <= max(rounding, limits.HARD_CASE_LEAST.value):
                moved.append(
                    f"the hard case {name}: the error of its {quantity} was {before[quantity]:.1e} and is "
                    f"{case[quantity]:.1e} (limit {limits.HARD_CASE_ROUNDING.value:g} {limits.HARD_CASE_ROUNDING.why})"
                )
    return moved


def of_campaign(new: Record, old: Record) -> list[str]:
    """Of a campaign's classes, over the same scenes; scenes of another number or seed do not compare."""
    if any(new[key] != old[key] for key in ("envelope", "seed", "count")):
        return []
    limit = max(1, round(limits.CAMPAIGN_SCENES.value * new["count"]))
    moved = []
    for name in sorted({*new["classes"], *old["classes"]}):
        before, now = (record["classes"].get(name, 0) for record in (old, new))
        # Fewer without an answer is what a release is for, and shows in the other classes.
        if abs(now - before) > limit and not (name == "not_converged" and now < before):
            moved.append(
                f"{name.replace('_', ' ')}: {before} of {new['count']} scenes before, {now} now "
                f"(limit {limit}: {limits.CAMPAIGN_SCENES.value:.2%} {limits.CAMPAIGN_SCENES.why})"
            )
    return moved


def of_benchmarks(new: Record, old: Record) -> list[str]:
    """Of times over those of plain loops, and of the iterations of the same points."""
    moved = []
    limit = limits.QUICK_TIME_RATIO if new["provenance"]["level"] == "quick" else limits.TIME_RATIO
    for name, before in old["ratios"].items():
        now = new["ratios"].get(name)
        if now is None:
            moved.append(f"the ratio {name} of the previous release is gone")
        elif not now["low"] <= limit.value * before["median"]:
            moved.append(
                f"{name.replace('_', ' ')}: {before['median']:g} before, {now['median']:g} ({now['low']:g} to "
                f"{now['high']:g}) now (limit {limit.value:g} {limit.why})"
            )
    if new["points"] == old["points"]:
        change = 100.0 * (new["mean_iterations"] / old["mean_iterations"] - 1.0)
        if not change <= limits.ITERATIONS.value:
            moved.append(
                f"mean iterations: {old['mean_iterations']:.4g} before, {new['mean_iterations']:.4g} now "
                f"(limit {limits.ITERATIONS.value:g} {limits.ITERATIONS.why})"
            )
    return moved
