"""What `run --accuracy` says: before solving, afterwards, and under the key "accuracy" of its JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from qsbearing.cost.accuracy import Choice, Reached, Way


def before(choice: Choice) -> str:
    """The choice, and the time it should take."""
    said = _chosen(choice.way)
    if not choice.way.left_out:
        said += "; what is simpler and would do takes as long" if len(choice.ways) > 1 else "; nothing simpler will do"
    return f"Accuracy {choice.asked:g}: {said}. Expected: {_time(choice.way.seconds)} to solve."


def after(reached: Reached) -> str:
    """What was reached, and the time it took."""
    said = ""
    if reached.solves > 1:
        said = f"That would not have done, by the loads and angles found; solved instead: {_chosen(reached.way)}. "
    said += "Reached: " + (
        f"within {reached.error:.1e} of the full answer by the loads and angles found"
        if reached.way.left_out
        else "the scene's own full answer"
    )
    return f"{said}; {_time(reached.seconds)} to solve."


def as_data(reached: Reached) -> dict[str, Any]:
    """The object under "accuracy"."""
    chosen = reached.choice.way
    return {
        "asked": reached.choice.asked,
        "fidelity": reached.way.rung.name if reached.way.left_out else "full",
        "left_out": [one.name for one in reached.way.left_out],
        "expected_error": chosen.error,
        "expected_seconds": chosen.seconds,
        "reached_error": reached.error if reached.solution.converged else None,
        "seconds": reached.seconds,
        "solves": reached.solves,
    }


def _chosen(way: Way) -> str:
    if not way.left_out:
        return "the full scene, nothing left out"
    left_out = " and ".join(one.words for one in way.left_out)
    return f"{way.rung.words}, will do, within {way.error:.1e}; left out: {left_out}"


def _time(seconds: float) -> str:
    return f"{seconds * 1e6:.0f} us" if seconds < 1e-3 else f"{seconds * 1e3:.2g} ms"
