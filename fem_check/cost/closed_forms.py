"""The closed forms of the same contact: their time, compiled in a batch and called from Python, and their errors.

Their errors are against `references`, Hertz in another form; the exact form's error is the rounding of the two.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

import qsbearing
from fem_check.contact_problem import Array, ContactProblem
from fem_check.cost.timing import spread
from fem_check.references import hertz
from qsbearing.compiled import COMPILED, entry
from qsbearing.contact.hertz import FORM_CODES, HertzForm, effective_modulus, ellipse_constants

CASES = 2000
"""Contacts in one compiled batch."""
CALLS = 200
"""Calls from Python in one timing."""
REPEATS = 15

LABELS = {
    HertzForm.BREWE_HAMROCK_1977: "Brewe & Hamrock 1977",
    HertzForm.HAMROCK_BREWE_1983: "Hamrock & Brewe 1983",
    HertzForm.EXACT: "exact Hertz",
}
QUANTITIES = ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")


@entry
def _batch(form: int, load: Array, curvature_x: Array, curvature_y: Array, modulus: float, results: Array) -> None:
    for i in range(load.size):
        a, b, stiffness, _ = ellipse_constants(form, curvature_x[i], curvature_y[i], modulus)
        scale = load[i] ** (1.0 / 3.0)
        results[i, 0] = (load[i] / stiffness) ** (2.0 / 3.0)
        results[i, 1] = a * scale
        results[i, 2] = b * scale
        results[i, 3] = 1.5 * load[i] / (np.pi * a * b * scale * scale)


def measure(problem: ContactProblem) -> list[dict[str, Any]]:
    """Each form's errors and seconds per contact; `compiled` is None where the kernel runs as plain Python."""
    modulus = effective_modulus(
        problem.ball.elastic_modulus,
        problem.ball.poisson_ratio,
        problem.race.elastic_modulus,
        problem.race.poisson_ratio,
    )
    # A scatter of one per cent: as in a sweep, no two contacts alike, all of this shape.
    generator = np.random.default_rng(0)
    load, x, y = (
        value * generator.uniform(0.99, 1.01, CASES)
        for value in (problem.load, problem.curvature_x, problem.curvature_y)
    )
    results = np.zeros((CASES, len(QUANTITIES)))
    single: dict[HertzForm, Callable[[], Any]] = {
        form: partial(qsbearing.point_contact, problem.load, problem.curvature_x, problem.curvature_y, modulus, form)
        for form in LABELS
    }
    batch: dict[HertzForm, Callable[[], Any]] = {
        form: partial(_batch, FORM_CODES[form], load, x, y, modulus, results) for form in LABELS
    }
    python = _in_turn(single, CALLS)
    compiled = _in_turn(batch, 1) if COMPILED else None
    exact = hertz(problem)
    found = []
    for form, label in LABELS.items():
        contact = single[form]()
        error = {name: getattr(contact, name) / getattr(exact, name) - 1.0 for name in QUANTITIES}
        found.append(
            {
                "form": str(form),
                "label": label,
                "error": error,
                "worst_error": max(abs(value) for value in error.values()),
                "python_seconds": spread(python[form]),
                "compiled_seconds": None if compiled is None else spread([s / CASES for s in compiled[form]]),
            }
        )
    return found


def _in_turn(functions: dict[HertzForm, Callable[[], Any]], calls: int) -> dict[HertzForm, list[float]]:
    """Seconds of one call: each repeat the mean over so many, after one that warms up."""
    times: dict[HertzForm, list[float]] = {form: [] for form in functions}
    for turn in range(REPEATS + 1):
        for form, function in functions.items():
            start = time.perf_counter()
            for _ in range(calls):
                function()
            if turn:
                times[form].append((time.perf_counter() - start) / calls)
    return times
