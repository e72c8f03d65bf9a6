"""The page of symbols says of each name what the tables of keys and results say: that it is there, and its unit."""

from __future__ import annotations

import re

import pytest

import qsbearing as qs
from qsbearing.documents.guide import topics
from qsbearing.files.file_keys import numbers
from qsbearing.model.effects import GyroscopicMoment
from qsbearing.model.solution.friction_balance import FrictionMotion
from qsbearing.model.solution.groups import CONTACT, OF_BALL
from qsbearing.model.solution.result_keys import DISPLACEMENT, LOAD, Result, place_of
from qsbearing.readings.asked import READINGS, every_group
from qsbearing.reports.guide_lists import LISTS
from qsbearing.studies import keys
from tests.guide.pages import GUIDE

LINES = re.findall(r"^\| (.+?) \| (`.+?`) \| .*? \| (.+?) \|$", (GUIDE / "symbols.md").read_text("utf-8"), re.MULTILINE)
WRITTEN = {"um": "µm", "Mrev": "million revolutions", "1": "-", "": "-", "balls": "-"}
"""Units that the page writes otherwise."""
OTHERS = (qs.Solution, FrictionMotion, qs.RacewayContacts, qs.PointContact, qs.Scene, GyroscopicMoment)


def described() -> list[Result]:
    """Every result of contacts, balls and readings."""
    return [
        *CONTACT,
        *OF_BALL,
        *(each for entry in READINGS.values() for group in entry.groups for each in group.results),
    ]


def units() -> dict[str, set[str]]:
    """Of each name of a key or result the units that it has in files."""
    found: dict[str, set[str]] = {"displacement": {each.unit for each in DISPLACEMENT}}
    found["load"] = {each.unit for each in LOAD}
    for table in numbers().values():
        for key in table:
            found.setdefault(key.field, set()).add(key.unit)
    for name, key in keys.ALL.items():
        found.setdefault(name, set()).add(key.unit)
    for each in described():
        found.setdefault(str(each.path or each.name), set()).add(each.unit)
    return {name: {WRITTEN.get(unit, unit) for unit in each} for name, each in found.items()}


@pytest.mark.parametrize(("names", "written"), [line[1:] for line in LINES], ids=lambda text: text.replace("`", ""))
def test_a_name_has_the_unit_that_the_page_says(names: str, written: str) -> None:
    known = units()
    named = [name.rpartition(".")[2] for name in re.findall(r"`([\w.]+)`", names)]
    for name in named:
        has_it = name in known or any(name in (*dir(each), *getattr(each, "__annotations__", ())) for each in OTHERS)
        assert has_it, f"{name} is no key, result or attribute"
        if name in known:
            assert known[name] & set(written.split(", ")), (name, known[name], written)


def test_every_line_with_a_name_was_read() -> None:
    assert len(LINES) > 12


def test_a_result_with_a_symbol_stands_on_the_page_once() -> None:
    """In the list that is made of the table of results, not by hand as well."""
    page = topics(lists=LISTS)["symbols"].text
    for each in {each for each in described() if each.symbol}:
        lines = [
            line
            for line in page.splitlines()
            if re.match(rf"\|.*{'inner.' if each in CONTACT else '[`.]'}{each.path or each.name}`", line)
        ]
        assert len(lines) == 1 and lines[0].startswith(f"| ${each.symbol}$ |"), each.key


@pytest.mark.parametrize("name", ["inner_max_pressure", "outer_film_film_parameter_min", "ring_load_axial"])
def test_datasets_say_symbol_and_source_of_a_result(name: str) -> None:
    place = place_of(name, every_group())
    assert place is not None
    found = place.attributes
    known = {"p_0": "Hertz 1881; Johnson 1985", r"\Lambda": READINGS["film"].by}
    assert found.get("source") == known.get(found.get("symbol", ""))
    assert ("symbol" in found) == (name != "ring_load_axial")
