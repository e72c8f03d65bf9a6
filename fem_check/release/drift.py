"""What moved from the previous release: each function compares one record and says in sentences what moved too far.

A value may be within its tolerance and have moved all the same; the limits of that, with their reasons, stand here.
"""

from __future__ import annotations

from typing import Any

from fem_check.rows.record import Record
from qsbearing.documents.numbers import plain

REFERENCE = 1e-6
"""Per cent of the value: a reference is a closed form, a quadrature or a boundary-element solution converged to 1e-10;
only rounding moves it."""
SAME_MESH = 1e-5
"""Per cent of the reference: on the same mesh only rounding moves a value, by 1e-12 % where another linear solver is
taken (measured), and by what the tolerance of an iterated equilibrium leaves. On another mesh: both uncertainties."""
FLAT, FLAT_MAXIMUM = ("max_shear_depth", "depth of the largest shear stress"), 1e-3
"""Per cent, of quantities that are places of a maximum, near which the curve is flat: moved by 1e-5, the value there
differs by 1e-10, and the search for it sees no more; a reference that is such a place moves by 2e-6 between
processors."""
OF_TOLERANCE = 0.1
"""Of the tolerance, where that is less than rounding may move other values: such a row is itself about rounding."""
HARD_CASE_ROUNDING, HARD_CASE_LEAST = 10.0, 1e-12
"""Times the larger of the previous error and what the case's condition number makes of 2^-52: such errors are sums of
roundings, which differ between processors and mathematical libraries. Below the solver's tolerance they are nothing."""
CAMPAIGN_SCENES = 2e-4
"""Of all scenes: those on the verge of two classes, which rounding decides; as many as may be not converged."""
TIME_RATIO = {"quick": 2.0, "release": 1.5}
"""Times the previous ratio, by the lower end of its spread: on one machine under a load of 7 medians of three runs
differ by 7 %, between processors by more; the quick level has a few rounds in one process."""
ITERATIONS = 1.0
"""Per cent of the mean: the same points from the same start, up to rounding."""


def of_check(new: Record, old: Record) -> list[str]:
    """Of a check's rows: computed values, references and tolerances; and rows that are gone."""
    gmsh = [each.get("versions", {}).get("gmsh") for each in (new, old)]
    same_mesh = new.get("mesh") == old.get("mesh") and gmsh[0] == gmsh[1]
    gone, both = _matched("row", *({_name(row): row for row in each["rows"]} for each in (new, old)))
    return gone + [each for _, row, before in both for each in _of_row(row, before, same_mesh)]


def _matched(what: str, new: dict[str, Any], old: dict[str, Any]) -> tuple[list[str], list[tuple[str, Any, Any]]]:
    """What is gone, said; what is in both: name, now, before."""
    gone = [f"the {what} {name} of the previous release is gone" for name in old if name not in new]
    return gone, [(name, now, old[name]) for name, now in new.items() if name in old]


def _name(row: Record) -> str:
    return f"{row['quantity']!r} of {row['case']!r}"


def _of_row(row: Record, old: Record, same_mesh: bool) -> list[str]:
    moved, name = [], _name(row)
    if not _is_same(row["tolerance_percent"], old["tolerance_percent"]):
        before, now = (
            "none" if each["tolerance_percent"] is None else f"{each['tolerance_percent']:g} %" for each in (old, row)
        )
        moved.append(f"{name}: its tolerance was {before} and is {now}")
    # Where one row stands for the worst of several, another may be the worst now: only the deviations compare.
    same_worst, scale = row["worst_at"] == old["worst_at"], abs(old["reference"])
    change = 100.0 * abs(row["reference"] - old["reference"]) / scale if same_worst and scale > 0.0 else 0.0
    most = FLAT_MAXIMUM if _is_flat(row) else REFERENCE
    if not change <= most:
        moved.append(
            f"{name}: its reference moved by {plain(change, '.2g')} %, from {old['reference']:.10g} to "
            f"{row['reference']:.10g} (limit {most:g} %)"
        )
    if row["found"] is None or old["found"] is None:
        if row["verdict"] != old["verdict"]:
            moved.append(f"{name}: {old['verdict']} before, {row['verdict']} now")
        return moved
    change, limit = abs(row["deviation_percent"] - old["deviation_percent"]), _limit(row, old, same_mesh)
    if not change <= limit:
        where = "" if same_worst else f" (worst at {row['worst_at']}, before at {old['worst_at']})"
        moved.append(
            f"{name} moved by {plain(change, '.2g')} %, from {old['found']:.10g} to {row['found']:.10g}{where} "
            f"(limit {plain(limit, '.2g')} %{'' if same_mesh else ', the mesh is another one'})"
        )
    return moved


def _is_flat(row: Record) -> bool:
    return any(name in row["quantity"] for name in FLAT)


def _is_same(new: float | None, old: float | None) -> bool:
    """Tolerances, which may be computed ones: only rounding moves them."""
    return new is old if new is None or old is None else abs(new - old) <= 0.01 * REFERENCE * old


def _limit(row: Record, old: Record, same_mesh: bool) -> float:
    """In per cent of the reference."""
    rounding = FLAT_MAXIMUM if _is_flat(row) else SAME_MESH
    both = sum(each["uncertainty_percent"] or 0.0 for each in (old, row))
    if not same_mesh and both > rounding:
        return float(both)
    tolerance = old["tolerance_percent"]
    return rounding if tolerance is None else min(rounding, OF_TOLERANCE * tolerance)


def of_hard_cases(new: Record, old: Record) -> list[str]:
    """Of the table of hard cases: outcomes, and errors beyond rounding."""
    moved, both = _matched("hard case", *({case["case"]: case for case in each["cases"]} for each in (new, old)))
    for name, case, before in both:
        was, now = (f"{each['status']}, {each['verdict']}" for each in (before, case))
        if was != now:
            moved.append(f"the hard case {name} was {was}, and is {now}")
        for quantity in {"loads", "angles", "displacements"} & case.keys() & before.keys():
            limit = max(HARD_CASE_ROUNDING * max(before[quantity], before["unavoidable"]), HARD_CASE_LEAST)
            if not case[quantity] <= limit:
                moved.append(
                    f"the hard case {name}: the error of its {quantity} was {before[quantity]:.1e} and is "
                    f"{case[quantity]:.1e} (limit {limit:.1e})"
                )
    return moved


def of_campaign(new: Record, old: Record) -> list[str]:
    """Of a campaign's classes, over the same scenes; scenes of another number or seed do not compare."""
    if any(new[key] != old[key] for key in ("envelope", "seed", "count")):
        return []
    limit, moved = max(1, round(CAMPAIGN_SCENES * new["count"])), []
    for name in sorted({*new["classes"], *old["classes"]}):
        before, now = (record["classes"].get(name, 0) for record in (old, new))
        # Fewer without an answer is what a release is for, and shows in the other classes.
        if abs(now - before) > limit and not (name == "not_converged" and now < before):
            what = name.replace("_", " ")
            moved.append(f"{what}: {before} of {new['count']} scenes before, {now} now (limit {limit})")
    return moved


def of_recomputed(new: Record, old: Record) -> list[str]:
    """Of a campaign that computes its cases a second time: how its cases ended, as `of_campaign` compares classes."""
    both = [
        {"envelope": each["campaign"], "seed": each["seed"], "count": each["count"], "classes": each["ended"]}
        for each in (new, old)
    ]
    return of_campaign(*both)


def of_benchmarks(new: Record, old: Record) -> list[str]:
    """Of times over those of plain loops, and of the iterations of the same points."""
    limit = TIME_RATIO[new["provenance"]["level"]]
    moved, both = _matched("ratio", new["ratios"], old["ratios"])
    for name, now, before in both:
        if not now["low"] <= limit * before["median"]:
            reach = f"{now['median']:g} ({now['low']:g} to {now['high']:g}) now (limit {limit:g} times)"
            moved.append(f"{name.replace('_', ' ')}: {before['median']:g} before, {reach}")
    iterations = old["mean_iterations"], new["mean_iterations"]
    if new["points"] == old["points"] and not 100.0 * (iterations[1] / iterations[0] - 1.0) <= ITERATIONS:
        moved.append(f"mean iterations: {iterations[0]:.4g} before, {iterations[1]:.4g} now (limit {ITERATIONS:g} %)")
    return moved
