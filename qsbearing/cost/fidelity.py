"""The fidelity ladder measured: for each rung its time, its memory, and its error against the top rung."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.cost import answers, measuring, situations
from qsbearing.cost.ladder import LADDER, TOP
from qsbearing.cost.thrust_estimate import thrust_estimate
from qsbearing.solving import solve

if TYPE_CHECKING:
    from collections.abc import Callable

    from qsbearing.cost.ladder import Rung
    from qsbearing.cost.settings import Settings
    from qsbearing.scene import Scene

    Progress = Callable[[str], None]


def measure(scene: Scene, settings: Settings, progress: Progress) -> list[dict[str, Any]]:
    """One entry a situation, with one entry a rung; `qsbearing.cost.record` says what is in them."""
    places = situations.situations(scene)
    progress("fidelities: errors")
    judged = [errors(place.scene) for place in places]
    runs = []
    for turn in range(settings.processes):
        progress(f"fidelities: times, process {turn + 1} of {settings.processes}")
        runs += measuring.in_fresh_processes(times, scene, settings.rounds, settings.batch, processes=1)
    seconds = measuring.pooled(runs)
    jobs = {rung.name: (memory_of, rung.name, places[-1].scene) for rung in LADDER}
    memory = measuring.peaks(jobs, settings.processes, progress)
    return [
        {
            "name": place.name,
            "speed_rpm": round(float(np.asarray(place.scene.operation.speed)) * 30.0 / np.pi, 3),
            "dm_n_mm_rpm": float(f"{situations.dm_n(place.scene):.4g}"),
            "rungs": [_entry(rung, place.name, found[rung.name], seconds, memory) for rung in LADDER],
        }
        for place, found in zip(places, judged, strict=True)
    ]


def errors(scene: Scene) -> dict[str, dict[str, float | None] | None]:
    """Error of every answer of every rung against the top rung; None for a rung, or an answer, that there is not."""
    top = TOP.of(scene)
    solution = solve(top)
    full = answers.read(top, solution)
    found: dict[str, dict[str, float | None] | None] = {}
    for rung in LADDER:
        given = _answers(rung, scene) if solution.converged else None
        if given is None:
            found[rung.name] = None
            continue
        judged = answers.errors(given, full)
        found[rung.name] = {
            name: None if value is None else float(value) for name, value in judged.items() if value is not None
        }
    return found


def by_speed(scene: Scene) -> dict[str, Any]:
    """Error of each group of answers by rung along the speeds of `situations.SWEEP`; None where the top has no
    answer."""
    swept = situations.sweep(scene)
    top = TOP.of(swept)
    solution = solve(top)
    full = answers.read(top, solution)
    parameter = situations.swept_dm_n()
    found: dict[str, Any] = {"dm_n_mm_rpm": [float(f"{value:.4g}") for value in parameter], "rungs": {}}
    for rung in LADDER[:-1]:
        given = _answers(rung, swept, scene)
        if given is None:
            continue
        judged = answers.errors(given, full)
        found["rungs"][rung.name] = {
            group: [_short(value) for value in np.where(solution.converged, worst, np.nan)]
            for group, names in answers.GROUPS.items()
            if (worst := _worst(judged, names)) is not None
        }
    return found


def _worst(judged: dict[str, Any], names: tuple[str, ...]) -> Any:
    known = [judged[name] for name in names if judged[name] is not None]
    return answers.accuracy(judged, names) if known else None


def _answers(rung: Rung, scene: Scene, still: Scene | None = None) -> answers.Answers | None:
    """What a rung answers; `still` is the single case of a scene along speeds, for the formula that knows none."""
    if rung.is_solved:
        simple = rung.of(scene)
        solution = solve(simple)
        return answers.read(simple, solution) if np.any(solution.converged) else None
    estimate = thrust_estimate(still or scene)
    if estimate is None:
        return None
    given: answers.Answers = dict.fromkeys(answers.NAMES)
    given.update({name: np.array([value]) for name, value in estimate.items()})
    given["ring_load"] = None  # what was imposed is no answer
    return given


def times(scene: Scene, rounds: int, batch: int) -> measuring.Times:
    """Seconds of one solve and of one case in a batch, for every situation and rung; taken in turn."""
    tasks: dict[Any, Any] = {}
    for place in situations.situations(scene):
        for rung in LADDER:
            if not rung.is_solved:
                if thrust_estimate(place.scene) is not None:
                    tasks[place.name, rung.name, "one"] = partial(thrust_estimate, place.scene)
                continue
            one = rung.of(place.scene)
            tasks[place.name, rung.name, "one"] = partial(solve, one, threads=1)
            tasks[place.name, rung.name, "batch"] = partial(solve, situations.many(one, batch), threads=1)
    found = measuring.interleaved(tasks, rounds)
    return {key: [value / batch for value in row] if key[2] == "batch" else row for key, row in found.items()}


def memory_of(name: str, scene: Scene) -> float | None:
    """Peak memory of this process once it has read the scene and solved it at a rung; None where the rung does not
    apply."""
    rung = next(rung for rung in LADDER if rung.name == name)
    if rung.is_solved:
        simple = rung.of(scene)
        answers.read(simple, solve(simple))
    elif thrust_estimate(scene) is None:
        return None
    return measuring.peak_MB()


def _entry(
    rung: Rung,
    place: str,
    judged: dict[str, float | None] | None,
    seconds: measuring.Times,
    memory: dict[str, dict[str, float] | None],
) -> dict[str, Any]:
    entry: dict[str, Any] = {"rung": rung.name, "words": rung.words}
    for key, what in (("one_case_s", "one"), ("batch_case_s", "batch")):
        own, top = (place, rung.name, what), (place, TOP.name, what)
        entry[key] = measuring.spread(seconds[own]) if own in seconds else None
        entry[key.replace("_s", "_over_top")] = measuring.ratio(seconds, own, top) if own in seconds else None
    entry["memory_MB"] = memory[rung.name]
    entry["errors"] = None if judged is None else {name: _short(value) for name, value in judged.items()}
    known = [] if judged is None else [value for value in judged.values() if value is not None]
    # The worst of the answers that the rung gives; a formula that gives some of them only says so by leaving keys out.
    entry["accuracy"] = _short(max(known)) if known else None
    return entry


def _short(value: float | None) -> float | None:
    if value is None or not np.isfinite(value):
        return None
    return float(f"{value:.4g}")


def contact(settings: Settings, truth: dict[str, Any]) -> dict[str, Any]:
    """One Hertz contact by each form: time, and error of approach, semi-axes and pressure against 50 digits."""
    from qsbearing.hertz import HertzForm, point_contact

    given = {key: float(truth[key]) for key in ("load", "curvature_x", "curvature_y", "effective_modulus")}
    tasks: dict[Any, Any] = {form: partial(point_contact, **given, form=form) for form in HertzForm}
    seconds = measuring.interleaved(tasks, settings.rounds * settings.processes)
    forms = []
    for form, task in tasks.items():
        found = task()
        judged = {
            name: float(f"{abs(getattr(found, name) / float(truth[name]) - 1.0):.4g}")
            for name in ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")
        }
        forms.append({"form": str(form), "seconds": measuring.spread(seconds[form]), "errors": judged})
    return {"what": truth["what"], "load_N": given["load"], "forms": forms}
