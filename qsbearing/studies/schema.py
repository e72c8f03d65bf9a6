"""The JSON Schema of every file that qsbearing reads: that of scenes and sets, with the tables [vary] and [study]."""

from __future__ import annotations

from typing import Any

from qsbearing.files.schema import closed, scene_schema
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.studies import keys
from qsbearing.studies.study import MOST_SAMPLES, Sampling
from qsbearing.studies.variables import DISTRIBUTIONS, FORMS, RANGE_KEYS

_NUMBER = {"type": ["integer", "number", "string"]}
"""A study reads "0.3" as well."""


def file_schema() -> dict[str, Any]:
    """A JSON Schema, draft-07, as data."""
    schema = scene_schema()
    of_range = closed(dict.fromkeys(RANGE_KEYS[:3], _NUMBER) | {"scale": {"enum": ["linear", "log"]}})
    of_parameters = {
        name: {"type": "array", "items": _NUMBER, "minItems": len(given), "maxItems": len(given),
               "description": ", ".join(given)}
        for name, given in DISTRIBUTIONS.items()
    }  # fmt: skip
    schema["definitions"]["varied"] = {
        "description": FORMS,
        "anyOf": [
            _NUMBER,
            {"type": "array", "items": _NUMBER, "minItems": 1},
            of_range | {"required": list(RANGE_KEYS[:3])},
            closed(of_parameters) | {"minProperties": 1, "maxProperties": 1},
        ],
    }
    varied = {"$ref": "#/definitions/varied"}
    told = {key.name: f"{key.name} [{printed_unit(key.unit)}]" for key in keys.ALL.values()}
    vary = {
        "type": "object",
        "properties": {name: {"description": text, "allOf": [varied]} for name, text in told.items()},
        "patternProperties": {r"\.": varied, rf"^{keys.EACH_BALL}(_\d+)?$": varied},
        # a table within, as `ball_material.density_kg_m3` is one; no range, which belongs to a key
        "additionalProperties": {"type": "object", "propertyNames": {"not": {"enum": [*RANGE_KEYS, *DISTRIBUTIONS]}}},
    }
    names = {"type": "string"}
    study: dict[str, Any] = {
        "samples": {"type": "integer", "minimum": 1, "maximum": MOST_SAMPLES},
        "sampling": {"enum": [str(each) for each in Sampling]},
        "seed": {"type": "integer", "minimum": 0, "maximum": MOST_SAMPLES},
        "quantities": {"anyOf": [names, {"type": "array", "items": names}]},
    }
    schema["properties"] |= {"vary": vary, "study": closed(study)}
    return schema
