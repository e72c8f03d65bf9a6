"""Warnings that differ in their numbers alone are said once, and nothing that they say is lost."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.messages.bearing_set import warnings_by_rows
from qsbearing.messages.equal_warnings import both_raceways, in_ranges, numbered, rows_together, together
from qsbearing.model.operation import STRAIGHT
from qsbearing.model.ranked_warning import check_data, good_to_know, wrong_model
from qsbearing.results.tables import remarks
from tests.systems.sets.arrangements import PAIR_FILE

NAMES = {1: "row 1 (7210C, carries +x)", 2: "row 2 (7210C, carries -x)", 3: "row 3 (7210C, carries -x)"}


@pytest.mark.parametrize(
    ("numbers", "words"),
    [([2], "row 2"), ([1, 2], "rows 1 and 2"), ([1, 3], "rows 1 and 3"), ([1, 2, 3, 4], "rows 1 to 4"),
     ([1, 2, 4], "rows 1, 2 and 4")],
)  # fmt: skip
def test_rows_are_named_by_their_numbers(numbers: list[int], words: str) -> None:
    assert numbered("row", numbers) == words


def test_rows_share_a_warning_with_the_range_of_its_numbers() -> None:
    said = {
        n: [check_data(f"Preload excessive: {NAMES[n]} is pressed by {load} N, -{load} N before.", "sets#preload")]
        for n, load in ((1, "90"), (2, "756.7"), (3, "110"))
    }
    (found,) = together("row", said, NAMES)
    assert found == "Rows 1 to 3: Preload excessive: each is pressed by 90 to 756.7 N, -756.7 to -90 N before."
    assert found.rank, found.see == (said[1][0].rank, "sets#preload")


def test_a_single_row_is_named_once() -> None:
    said = {1: [], 2: [good_to_know("All balls slip.", "limits"), check_data(f"{NAMES[2]} is loose.", "sets")], 3: []}
    assert together("row", said, NAMES) == [f"{NAMES[2]} is loose.", "Row 2 (7210C, carries -x): All balls slip."]
    twice = {1: ["It bends by 3.", "It bends by 4."]}
    assert together("row", twice) == ["Row 1: It bends by 3.", "Row 1: It bends by 4."]


def test_numbers_that_are_names_have_no_range() -> None:
    """Balls, rows and bearings: what names others stays by itself."""
    of_balls = {n: [f"2 balls (no. {n}, 7) carry no load."] for n in (1, 2)}
    assert len(together("row", of_balls)) == 2
    of_rows = {n: [f"Row {n} (7210C, carries +x): Not simulated (≈ {n}0 %)."] for n in (1, 2)}
    assert len(together("point", of_rows)) == 2
    assert in_ranges(["100Cr6, 4 N", "100Cr6, 3 N"]) == "100Cr6, 3 to 4 N"


def test_another_rank_or_other_words_are_another_warning() -> None:
    said = {
        1: [wrong_model("It slips by 3.", "limits")],
        2: [good_to_know("It slips by 3.", "limits")],
        3: ["It slips"],
    }
    assert len(together("row", said)) == 3


def test_sentences_of_rows_stand_once_where_only_numbers_differ() -> None:
    said = [f"Row {n} (7210C, carries +x): too much, 3 times, at {speed} rpm." for n, speed in ((2, 10640), (1, 10660))]
    others = ["All rows keep it.", "Row 3 (7210C, carries +x) loses it at 9 rpm.", "Row 4 (7210C, carries -x): none."]
    assert rows_together([*said, *others]) == ["Rows 1 and 2: too much, 3 times, at 10640 to 10660 rpm.", *others]


def test_both_raceways_share_a_warning() -> None:
    text = "The moment requires 0.{} at the {} raceway of all 9 balls."
    found = both_raceways([text.format("07", "inner"), "Between.", text.format("12", "outer")])
    assert found == ["The moment requires 0.07 to 0.12 at the inner and the outer raceway of all 9 balls.", "Between."]
    alone = [text.format("07", "inner"), text.format("12", "inner"), "Other at the outer raceway."]
    assert both_raceways(alone) == alone
    assert [each.text for each in remarks([text.format("07", "inner"), text.format("07", "outer")])] == [
        "Check your data: The moment requires 0.07 at the inner and the outer raceway of all 9 balls."
    ]


def test_run_says_once_what_rows_share_and_json_each(tmp_path: Path) -> None:
    rows = tuple(qs.Row(qs.load_scene("b218").bearing, at, way) for at, way in ((0.0, "+x"), (0.06, "-x")))
    turning = qs.Operation(speed=9000 * qs.rpm, **STRAIGHT)
    balls = {"ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment()), "raceway_control": qs.RacewayControl.OUTER}
    solution = qs.solve_set(qs.BearingSet(rows, turning, preload=qs.Preload(rigid=300.0), **balls))
    each, shared = solution.warnings(), warnings_by_rows(solution)
    assert len(shared) < len(each)
    assert any(said.startswith("Rows 1 and 2: ") for said in shared)
    file = tmp_path / "pair.toml"
    heavy = PAIR_FILE.replace("7210C", "B218").replace("= 720", "= 1_200_000")
    file.write_text(heavy, encoding="utf-8")
    text = CliRunner().invoke(cli, ["run", str(file)]).output
    found = json.loads(CliRunner().invoke(cli, ["run", str(file), "--json"]).output)["warnings"]
    assert sum(said.startswith("Row 1 ") for said in found) == sum(said.startswith("Row 2 ") for said in found) == 1
    assert text.count("Rows 1 and 2: ") == 1 and "Row 1 (B218, carries +x): The" not in text
