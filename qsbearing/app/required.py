"""What a scene or set requires of its results, with the answers; and the names of results to require something of."""

from __future__ import annotations

import math
from typing import Any

from qsbearing.app.scenes import Tables, read
from qsbearing.documents.html import part
from qsbearing.files.file_keys import REQUIRE
from qsbearing.files.require_table import known_of
from qsbearing.model.scene.requirement import ENDS, SOURCE
from qsbearing.model.solution.limit import Answer
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.results import requirements
from qsbearing.results.requirements import COLOURS, SIGNS, numbers_of, required_answers, verdict, whose

ENDINGS = [{"end": end, "sign": SIGNS[sense]} for end, sense in ENDS.items()]
"""How a limit is written: its key in the table of a requirement, and its sign."""
_END_OF = {sense: end for end, sense in ENDS.items()}


def told(solution: Any, readings: Any) -> dict[str, Any]:
    """How a solution answers what is required, a requirement each; how many are met; and why others are open."""
    every = required_answers(solution, readings)
    if not every:
        return {"headline": "", "answers": [], "open": ""}
    _, _, *why = requirements.blocks(every, solution)
    return {
        "headline": requirements.headline(every),
        "answers": [_told(each) for each in every],
        "open": part(why),
    }


def _told(answer: Answer) -> dict[str, Any]:
    shown, _ = numbers_of(answer)
    limit, used = answer.limit, answer.used
    return {
        "path": [REQUIRE, limit.name, _END_OF[limit.sense]],
        "found": shown,
        "unit": printed_unit(limit.unit),
        "look": COLOURS[answer.state],
        "verdict": verdict(answer),
        "used": used if math.isfinite(used) and used >= 0.0 else None,
        "of": whose(answer),
        SOURCE: limit.source,
    }


def names(document: Tables, label: str) -> dict[str, Any]:
    """The results that a requirement may name, with what each is and its unit."""
    places = known_of(read(document, label)).by_name
    results = [
        {"name": name, "words": place.label, "unit": printed_unit(place.unit)}
        for name, place in places.items()
        if not place.result.is_azimuth
    ]
    return {"results": results}
