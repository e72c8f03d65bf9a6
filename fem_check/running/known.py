"""What is known not to hold, by name, so that a release can be judged by everything else.

A scene stands here only with its reason. These scenes and no others of the realistic ones may end as not converged;
page 1 of the report names each of them on record. One that is solved fails the gate: then it is to be taken out.
"""

from __future__ import annotations

from typing import Any

from fem_check.rows.record import Record

NOT_CONVERGED = {
    "realistic/1/78/44": "nearly at rest, the outer ring turns; one ball in twelve is about to leave its raceways",
    "realistic/1/256/830": "nearly at rest, the outer ring turns, radial load above the axial one, tilt prevented",
    "realistic/1/306/375": "nearly at rest, the outer ring turns, radial load above the axial one, tilt prevented",
}
"""Scenes of the campaigns that no way of the solver finds an equilibrium of; three of 500,000 realistic ones."""


REFUSED = "no_equilibrium"
"""How a case ended that is said to have no equilibrium, and in records the key of all of them."""
NO_LIMIT = "no limit recorded"
"""Of a campaign whose record has no `bar`, as those of elastic rings, sets and spindles of 0.2.0."""
_CHUNK = 1000
"""Scenes of a campaign's chunk, by which its scenes are numbered."""


def of_status(ended: dict[str, int], status: str) -> int:
    """How many cases of a campaign ended so, whatever the reason."""
    return sum(number for how, number in ended.items() if how.partition(":")[0] == status)


def unnamed(lost: list[str]) -> list[str]:
    """Of scenes that did not converge those that do not stand here."""
    return [name for name in lost if name not in NOT_CONVERGED]


def above(record: Record) -> list[str]:
    """What is to be said where more cases of a campaign did not converge than its limit allows, or it has none."""
    if "bar" not in record:
        return [NO_LIMIT]
    bar: dict[str, Any] = record["bar"]
    lost, allowed = bar["not_converged"], bar["allowed"]
    return [f"{lost} not converged, {allowed} allowed ({bar['basis']})"] if lost > allowed else []


def unsaid(record: Record) -> list[str]:
    """What is to be said where some refused cases of a campaign count neither as certified nor as not proved."""
    refused = of_status(record["ended"], REFUSED)
    said = sum(record.get(REFUSED, {}).get("certificates", {}).values())
    if said == refused:
        return []
    return [f"{refused} cases are refused, and of {said} a certificate or its lack is recorded"]


def objections(record: Record) -> list[str]:
    """What the scenes of a campaign that did not converge speak against a release."""
    if "bar" not in record:
        return [NO_LIMIT]
    lost, bar = record["not_converged"], record["bar"]
    unknown, faults = unnamed(lost), []
    if len(unknown) > bar["allowed"]:
        faults.append(f"the bar is missed ({bar['asked']}): {len(unknown)} not converged, {', '.join(unknown[:5])}")
    for name in NOT_CONVERGED:
        envelope, seed, chunk, index = name.split("/")
        is_drawn = (envelope, int(seed)) == (record["envelope"], record["seed"])
        if is_drawn and int(chunk) * _CHUNK + int(index) < record["count"] and name not in lost:
            faults.append(
                f"{name} is known as not converged and is solved now: take it from fem_check/running/known.py"
            )
    return faults
