"""Remarks that differ in their numbers alone are said once, and nothing that they say is lost."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.operation import STRAIGHT
from qsbearing.readings.ball_motion import CONTROL_ASSUMED
from qsbearing.remarks.balls import BALLS_UNLOADED, FRICTION_BEYOND, FRICTION_DOUBTFUL
from qsbearing.remarks.expansion import BALLS_WEDGED
from qsbearing.remarks.missing_effects import EFFECT_DATA_MISSING
from qsbearing.remarks.preload import PRELOAD_LOST
from qsbearing.remarks.remark import Of, Remark, remark
from qsbearing.remarks.ring import TILT_LARGE
from qsbearing.remarks.wording import numbered
from qsbearing.results.remarks import blocks, every_remark, together
from tests.systems.sets.arrangements import PAIR_FILE


def of_row(number: int, said: Remark) -> Remark:
    """The remark, of a row of a set."""
    return replace(said, of=replace(said.of, rows=(number,), bearing="7210C", carries="+x"))


def texts(*said: Remark) -> list[str]:
    """As people read them."""
    return [each.text for each in together(said)]


def lost(carried: float, given: float = 100.0, state: str = "mounted") -> Remark:
    return remark(PRELOAD_LOST, carried_N=carried, given_N=given, state=state)


@pytest.mark.parametrize(
    ("numbers", "words"),
    [([2], "row 2"), ([1, 2], "rows 1 and 2"), ([1, 3], "rows 1 and 3"), ([1, 2, 3, 4], "rows 1 to 4"),
     ([1, 2, 4], "rows 1, 2 and 4")],
)  # fmt: skip
def test_rows_are_named_by_their_numbers(numbers: list[int], words: str) -> None:
    assert numbered("row", numbers) == words


def test_rows_share_a_remark_with_the_range_of_its_numbers() -> None:
    found = texts(*(of_row(n, lost(carried)) for n, carried in ((1, 0.9), (2, 0.07), (3, 0.5))))
    assert found == [
        "Rows 1 to 3: Preload lost: each carries 0.07 to 0.9 N in operation; its preload is 100 N mounted."
    ]


def test_a_single_row_is_named_once() -> None:
    alone = texts(of_row(2, lost(0.5)), of_row(3, remark(TILT_LARGE, tilt_mrad=30.0)))
    assert alone == [
        "Row 3 (7210C, carries +x): The ring tilts by 30 mrad: beyond the small rotations that the model assumes.",
        "Preload lost: row 2 (7210C, carries +x) carries 0.5 N in operation; its preload is 100 N mounted.",
    ]
    assert texts(lost(0.5)) == ["Preload lost: the bearing carries 0.5 N in operation; its preload is 100 N mounted."]
    twice = [of_row(1, lost(0.5)), of_row(1, lost(0.6))]
    assert together(twice) == twice, "of one row: two facts"


def test_names_and_words_have_no_range() -> None:
    """Balls, seats, states: what tells one thing from another."""
    of_balls = [of_row(n, remark(BALLS_UNLOADED, balls=[n == 1, n == 2, True])) for n in (1, 2)]
    assert together(of_balls) == of_balls
    states = [of_row(n, lost(0.5, state=state)) for n, state in ((1, "mounted"), (2, "before fitting"))]
    assert together(states) == states
    other_bearing = [of_row(n, remark(BALLS_UNLOADED, balls=[True] * count)) for n, count in ((1, 3), (2, 4))]
    assert together(other_bearing) == other_bearing


def test_both_raceways_share_a_remark() -> None:
    typical = {"typical_least": 0.06, "typical_most": 0.1}
    both = [
        remark(FRICTION_DOUBTFUL, side, [True] * 9, required=mu, **typical)
        for side, mu in (("inner", 0.07), ("outer", 0.09))
    ]
    assert texts(both[0], remark(BALLS_WEDGED, interference_um=3.0), both[1]) == [
        "The expansion is larger than the diametral clearance by 3 µm: the balls are wedged between the rings.",
        "The gyroscopic moment requires a friction coefficient of 0.07 to 0.09 at the inner and the outer raceway of "
        "all 9 balls: slip may begin (typical: 0.06 to 0.1).",
    ]  # fmt: skip
    assert len(together([both[0], replace(both[1], kind=FRICTION_BEYOND)])) == 2
    rows = [of_row(n, each) for n in (1, 2) for each in both]
    (all_four,) = texts(*rows)
    assert all_four.startswith("Rows 1 and 2: The gyroscopic moment requires a friction coefficient of 0.07 to 0.09 at")


def test_readings_points_and_bearings_share_a_remark() -> None:
    said = [Remark(CONTROL_ASSUMED, Of(readings=(name,))) for name in ("kinematics", "friction")]
    assert len(together(said)) == 1
    at = [replace(each, of=replace(each.of, points=(n,))) for n in (1, 2) for each in said]
    (found,) = texts(*at)
    assert found.startswith("Points 1 and 2: no raceway control is named")
    compared = [replace(each, of=replace(each.of, bearings=(name,))) for name in ("B218", "7210C") for each in at]
    (found,) = texts(*compared)
    assert found.startswith("B218 and 7210C: Points 1 and 2: no raceway")


def test_numbers_of_lists_have_ranges_too() -> None:
    change = {
        "quantity": "stiffness",
        "under": ("steel housing", "free"),
        "is_estimated": False,
        "effect": "elastic_rings",
    }
    said = [Remark(EFFECT_DATA_MISSING, Of(points=(n,)), change | {"changes": (0.064 * n, 0.26)}) for n in (1, 2)]
    (found,) = texts(*said)
    assert "the locked stiffness by about 6.4 to 13 % (steel housing) to 26 % (free)." in found


def test_run_says_once_what_rows_share_and_json_each(tmp_path: Path) -> None:
    rows = tuple(qs.Row(qs.load_scene("b218").bearing, at, way) for at, way in ((0.0, "+x"), (0.06, "-x")))
    turning = qs.Operation(speed=9000 * qs.rpm, **STRAIGHT)
    balls = {"ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment()), "raceway_control": qs.RacewayControl.OUTER}
    solution = qs.solve_set(qs.BearingSet(rows, turning, preload=qs.Preload(rigid=300.0), **balls))
    each, shared = solution.warnings(), together(every_remark(solution))
    assert len(shared) < len(each)
    assert any(said.text.startswith("Rows 1 and 2: ") for said in shared)
    assert [block.text for block in blocks(shared)] == [said.said(IN_FILE).line for said in shared]
    file = tmp_path / "pair.toml"
    heavy = PAIR_FILE.replace("7210C", "B218").replace("= 720", "= 1_200_000")
    file.write_text(heavy, encoding="utf-8")
    text = CliRunner().invoke(cli, ["run", str(file)]).output
    found = json.loads(CliRunner().invoke(cli, ["run", str(file), "--json"]).output)["warnings"]
    assert sum(said.startswith("Row 1 ") for said in found) == sum(said.startswith("Row 2 ") for said in found) == 1
    assert text.count("Rows 1 and 2: ") == 1 and "Row 1 (B218, carries +x): The" not in text
