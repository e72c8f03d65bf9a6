"""What is known not to hold, by name, so that a release can be judged by everything else.

A scene stands here only with its reason, the report still says that its bar is missed, and it fails the gate as soon as
it is solved: then it is to be taken out.
"""

from __future__ import annotations

from fem_check.rows.record import Record

NOT_CONVERGED = {
    "realistic/1/78/44": "nearly at rest, the outer ring turns; one ball in twelve is about to leave its raceways",
    "realistic/1/256/830": "nearly at rest, the outer ring turns, radial load above the axial one, tilt prevented",
    "realistic/1/306/375": "nearly at rest, the outer ring turns, radial load above the axial one, tilt prevented",
}
"""Scenes of the campaigns that no way of the solver finds an equilibrium of; three of 500,000 realistic ones."""


_CHUNK = 1000
"""Scenes of a campaign's chunk, by which its scenes are numbered."""


def objections(record: Record) -> list[str]:
    """What the scenes of a campaign that did not converge speak against a release."""
    lost, bar = record["not_converged"], record["bar"]
    unknown = [name for name in lost if name not in NOT_CONVERGED]
    faults = []
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
