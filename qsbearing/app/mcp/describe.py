"""What there is to know of scenes, bearings, results and remarks, out of the places that the program itself uses."""

from __future__ import annotations

import json
from typing import Any

from qsbearing.documents.guide import meant_by, skill_text, topics
from qsbearing.files import catalogue
from qsbearing.files.file_errors import refused
from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.solution.result_keys import Place, printed_unit
from qsbearing.model.validation import alike, question
from qsbearing.model.version import __version__
from qsbearing.readings.asked import every_group
from qsbearing.reports.guide_lists import LISTS, every_kind
from qsbearing.studies.schema import file_schema

RESULTS, SKILL = "results", "skill"


def described(topic: str) -> dict[str, Any]:
    """What a topic is; without one, which topics there are.

    Raises:
        SceneFileError: there is no such topic.
    """
    schema, kinds = file_schema(), every_kind()
    tables, pages = schema["definitions"] | schema["properties"], topics(lists=LISTS)
    page, _, section = topic.partition("#")
    if not topic:
        return {
            "version": __version__,
            "bearings": [entry.name for entry in catalogue.entries()],
            "tables_of_a_scene": list(schema["properties"]),
            "results": f"names and units: describe('{RESULTS}')",
            "remarks": list(kinds),
            "how_to_work_with_it": f"describe('{SKILL}')",
            "guide": {each.topic: each.title for each in pages.values()},
        }
    if topic == SKILL:
        return {"text": skill_text()}
    if topic == RESULTS:
        every = (Place(group, result) for group in every_group() for result in group.results)
        return {each.name: f"{each.attributes['long_name']} [{printed_unit(each.unit)}]" for each in every}
    if topic in tables:
        return {"table": topic, "schema": tables[topic], "definitions": _named_in(tables[topic], schema["definitions"])}
    if topic in kinds:
        kind = kinds[topic]
        record = {"code": topic, "severity": kind.severity.name.lower(), "values": list(kind.values)}
        return record | {"sentence": kind.outline(IN_FILE), "guide": kind.see}
    if page in pages and (text := pages[page].plain(section)):
        return {"guide": topic, "text": text}
    entry = catalogue.find(topic)
    if entry is not None:
        return {**vars(entry), "scene": {"bearing": {"name": entry.name}, **entry.example}}
    meant = question(alike(topic, [*tables, *kinds, *pages]))
    cause = meant or meant_by(page, pages) or catalogue.nearest(topic)
    raise refused(topic, "is no table, result list, remark, page of the guide or bearing", cause)


def _named_in(schema: Any, definitions: dict[str, Any]) -> dict[str, Any]:
    """The definitions that a schema refers to, and those that these do."""
    named: dict[str, Any] = {}
    seen = [schema]
    while seen:
        text = json.dumps(seen.pop())
        for name in definitions.keys() - named.keys():
            if f'"#/definitions/{name}"' in text:
                named[name] = definitions[name]
                seen.append(definitions[name])
    return named
