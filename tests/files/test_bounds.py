"""Costs of wrong input are linear and bounded: what is too much is refused before any work begins."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from typing import Any

import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files import limits
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.scene_file import scene_of
from qsbearing.studies.design.point_table import solve_table
from tests.guide.pages import GUIDE

GOOD = {"bearing": {"name": "B218"}, "operation": {"axial_load_N": 1.0}}


def calls(run: Callable[[], object]) -> int:
    """Calls of Python's functions and of those in C: a cost that is the same on every computer."""
    count = 0

    def counted(*_: object) -> None:
        nonlocal count
        count += 1

    before = sys.getprofile()
    sys.setprofile(counted)
    try:
        run()
    finally:
        sys.setprofile(before)
    return count


def refused(document: dict[str, Any]) -> str:
    with pytest.raises(SceneFileError) as caught:
        scene_of({**GOOD, **document}, "scene")
    return str(caught.value)


@pytest.mark.parametrize("table", ["bearing", "operation", "effects", "preload", "material", "life", ""])
def test_unknown_keys_cost_the_same_each(table: str) -> None:
    """Also where each is compared with all that are there: sets that are built anew are the time that is looked for."""
    built = 0

    class Counted(dict[str, Any]):
        def __iter__(self) -> Any:
            nonlocal built
            built += 1
            return super().__iter__()

    def document(count: int) -> dict[str, Any]:
        keys = Counted({f"key_{number}": 1 for number in range(count)})
        places = {
            "material": {"bearing": {"name": "B218", "ball_material": keys}},
            "life": {"readings": {"life": keys}},
        }
        return keys if not table else places.get(table, {table: keys})

    refused(document(100))
    costs = []
    for count in (200, 400):
        built = 0
        costs.append(calls(lambda count=count: refused(document(count))))  # type: ignore[misc]
        assert built < 20, "the whole table is gone through once for each of its keys"
    assert costs[1] < 2.5 * costs[0]


def test_a_name_of_many_letters_is_compared_by_its_first() -> None:
    """Comparing takes the square of the length: 150,000 letters took ten seconds."""
    refused({"bearing": {"name": "a"}})  # what is read once is read
    assert calls(lambda: refused({"bearing": {"name": "a" * 3_000}})) < 2 * calls(
        lambda: refused({"bearing": {"name": "a" * 60}})
    )
    assert "B218" in refused({"bearing": {"name": "B2188"}})


@pytest.mark.parametrize(
    ("document", "words"),
    [
        ({**GOOD, "operation": {f"key_{i}": 1 for i in range(limits.MOST_KEYS)}}, "more than 10,000 keys"),
        ({**GOOD, "rows": [{"a": 1}] * limits.MOST_KEYS}, "more than 10,000 keys"),
    ],
    ids=["keys", "rows"],
)
def test_tables_of_python_have_the_bounds_of_a_file(document: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneFileError, match=words):
        solve_table(document, {"axial_load_N": [1.0]})
    deep: dict[str, Any] = {}
    for _ in range(limits.DEEPEST_KEY):
        deep = {"a": deep}
    with pytest.raises(SceneFileError, match="within each other"):
        qs.Study.of({**GOOD, "operation": deep}, {"speed_rpm": [0.0, 1.0]})


@pytest.mark.parametrize("given", ["-5:1e9", "3:1e30", "0:20", (2, 10**9)])
def test_no_list_of_ball_counts_is_built_that_no_bearing_has(given: Any) -> None:
    with pytest.raises(SceneFileError, match="1 to 1000 balls"):
        qs.find("b218", {"ball_count": given}, minimise="inner.max_pressure_MPa")


def test_the_guide_has_every_limit() -> None:
    text = (GUIDE / "how_to.md").read_text(encoding="utf-8").partition("## Sizes of input\n")[2].partition("\n## ")[0]
    rows = [line.partition("| ")[2].partition("| ")[2] for line in text.splitlines() if line.startswith("| ")][1:]
    told = [int(number.replace(",", "")) for row in rows for number in re.findall(r"\d[\d,]*\b", row)]
    mega = 1_000_000
    assert told == [
        *(limits.LARGEST_FILE // mega, limits.MOST_KEYS, limits.DEEPEST_KEY),
        *(limits.LARGEST_RESULT // mega, limits.MOST_VALUES, limits.DEEPEST_JSON),
        *(limits.LARGEST_MODEL // mega, limits.MOST_TAGS, limits.MOST_MODEL_FILES, limits.MOST_OF_SHAFT),
        *(limits.LARGEST_TABLE // mega, limits.MOST_ROWS, limits.MOST_COLUMNS, limits.MOST_CELLS),
        *(limits.LARGEST_SHEET // mega, limits.MOST_SHEET_CELLS, limits.LONGEST_CELL),
    ]


# Values that are replaced ---------------------------------------------------------------------------------------------

BASE = '[bearing]\nname = "B218"\n[operation]\nspeed_rpm = {}\naxial_load_N = 1000\n'


@pytest.mark.parametrize("value", ['"fast"', "nan", "inf", "-1e300", "1979-05-27", "true", "[1]", "1e5"])
@pytest.mark.parametrize("command", ["sweep", "points", "find", "stiffness"])
def test_the_value_of_a_key_that_varies_is_checked_too(command: str, value: str, tmp_path: Any) -> None:
    path, points = tmp_path / "scene.toml", tmp_path / "points.csv"
    path.write_text(BASE.format(value))
    points.write_text("speed_rpm\n100\n")
    vary = ["--vary", "speed_rpm=100,200"]
    arguments = {
        "sweep": ["sweep", path, *vary, "--out", tmp_path / "out.nc"],
        "stiffness": ["stiffness", path, *vary],
        "find": ["find", path, *vary, "--minimise", "inner.max_pressure_MPa"],
        "points": ["run", path, "--points", points, "--out", tmp_path / "out.csv"],
    }[command]
    ran = CliRunner().invoke(cli, list(map(str, arguments)))
    assert ran.exit_code == 2, ran.output
    assert "operation.speed_rpm = " in ran.stderr and "the file's own value" in ran.stderr
    assert len(list(tmp_path.iterdir())) == 2


def test_a_value_that_only_others_forbid_may_vary() -> None:
    """At the points its place is taken; of the file alone 30 balls are too many, and it has another diameter there."""
    document = {**GOOD, "bearing": {"name": "B218", "ball_count": 30}}
    with pytest.raises(SceneFileError):
        scene_of(document, "scene")
    results = qs.sweep(qs.Study.of(document, {"ball_count": [10.0, 12.0], "ball_diameter_mm": [12.0]}))
    assert results.sizes["ball_count"] == 2
    missing = {"bearing": {"name": "B218"}, "operation": {"speed_rpm": 100.0}}
    assert qs.sweep(qs.Study.of(missing, {"axial_load_N": [1000.0, 2000.0]})).sizes["axial_load_N"] == 2


@pytest.mark.parametrize("value", [1e-308, 5e-324])
def test_next_to_no_preload_overflows_nowhere(value: float) -> None:
    """Warnings are errors here."""
    from qsbearing.model.solution.preload_state import PreloadLoads, share, states

    loads = PreloadLoads(value, 800.0, 800.0)
    assert str(states(loads)) == "excessive" and share(loads) != share(loads)


# Words ----------------------------------------------------------------------------------------------------------------


def test_a_material_may_have_underscores() -> None:
    for word in ("silicon_nitride", "Silicon nitride", "SI3N4", "AISI_52100"):
        scene = scene_of({**GOOD, "bearing": {"name": "B218", "ball_material": word}}, "scene")
        assert scene.bearing.ball_material.name in ("silicon nitride", "100Cr6")


@pytest.mark.parametrize("name", ["name", "title"])
def test_a_title_outside_all_tables_is_not_sent_where_it_is_refused(name: str) -> None:
    said = refused({name: "my bearing"})
    assert "called after its file" in said and "It belongs under" not in said
