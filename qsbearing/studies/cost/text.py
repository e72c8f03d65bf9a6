"""What `run --accuracy` says: before solving, afterwards, and under the key "accuracy" of its JSON."""

from __future__ import annotations

from typing import Any

from qsbearing.studies.cost.accuracy import Choice, Option, Reached
from qsbearing.studies.cost.indicators import OMISSIONS


def before(choice: Choice) -> str:
    """The choice, and the time it should take."""
    said = _chosen(choice.option, choice.option.error)
    if not choice.option.left_out:
        said += "; nothing simpler will do"
    return f"Accuracy {choice.asked:g}: {said}. Expected: {_time(choice.option.seconds)} to solve."


def after(reached: Reached) -> str:
    """What was reached, and the time it took."""
    said = "the scene's own full result"
    if reached.option.left_out:
        said = f"within {reached.error:.1e} of the full result by the loads and angles found"
    said = f"Reached: {said}; {_time(reached.seconds)} to solve."
    if reached.solves == 1:
        return said
    chosen = _chosen(reached.option, reached.error)
    return f"That would not have done, by the loads and angles found; solved instead: {chosen}. {said}"


def as_data(reached: Reached) -> dict[str, Any]:
    """The object under "accuracy"."""
    chosen = reached.choice.option
    return {
        "asked": reached.choice.asked,
        "fidelity": reached.option.level.name if reached.option.left_out else "full",
        "left_out": list(reached.option.left_out),
        "expected_error": chosen.error,
        "expected_seconds": chosen.seconds,
        "reached_error": reached.error if reached.solution.converged else None,
        "seconds": reached.seconds,
        "solves": reached.solves,
    }


def _chosen(option: Option, error: float) -> str:
    if not option.left_out:
        return "the full scene, nothing left out"
    left_out = " and ".join(OMISSIONS[name] for name in option.left_out)
    level = option.level.text.split(",")[0]  # the control and the Hertz formula are the scene's own
    return f"{level}, will do, within {error:.1e}; left out: {left_out}"


def _time(seconds: float) -> str:
    return f"{seconds * 1e6:.0f} us" if seconds < 1e-3 else f"{seconds * 1e3:.2g} ms"
