"""`qsbearing explain` of a set: what it finds is what two solves differ by, and what it says of the preload is so."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.effects import EFFECTS
from qsbearing.studies.chooser.explain import explain
from qsbearing.studies.chooser.explain_set import explain_set
from qsbearing.systems.sets.preload_limits import preload_summary
from tests.systems.sets.arrangements import PAIR_FILE, S6210C, pair, rows, solved, with_load


def call(folder: Path, text: str, *options: str) -> Result:
    (folder / "pair.toml").write_text(text)
    return CliRunner().invoke(cli, ["explain", str(folder / "pair.toml"), *options], catch_exceptions=False)


def effects_of(of: qs.BearingSet, tolerance: float = 0.01) -> dict[str, Any]:
    return {row.effect: row for row in explain_set(of, tolerance)[1]}


def test_what_is_found_is_what_two_solves_differ_by() -> None:
    of = pair("DB", 720.0, speed=10_000 * qs.rpm, axial_load=200.0)
    row = effects_of(of)["gyroscopic_moment"]
    without = solved(replace(of, ball_effects=(qs.CentrifugalForce(),)))
    full = solved(of)
    loads = np.concatenate([np.abs(one.inner.load - two.inner.load) for one, two in zip(without.rows, full.rows)])  # noqa: B905
    assert (row.in_scene, row.verdict) == (True, "needed")
    assert row.actual["load"] >= loads.max() / max(each.inner.load.max() for each in full.rows) * (1.0 - 1e-9)
    stiffness = np.abs(without.locked_stiffness / full.locked_stiffness - 1.0)
    assert row.actual["stiffness"] == pytest.approx(stiffness.max(), rel=1e-9)
    assert row.actual["displacement"] == pytest.approx(
        abs(without.displacement[0] - full.displacement[0])
        / max(abs(full.displacement[0]), max((each.inner.approach + each.outer.approach).max() for each in full.rows)),
        rel=1e-9,
    )


def test_a_set_of_one_row_is_explained_as_its_bearing_is() -> None:
    """Solved with and without, the bearing alone gives the same numbers and verdicts; but for the lever of tilts, which
    moves the plane in which a bearing's own channels are meant, and not the shaft's, for tilt stiffnesses, which are
    about either plane, and for the common motion of balls, which sets do not know."""
    operation = qs.Operation(10_000 * qs.rpm, axial_load=800.0, radial_load_y=300.0, tilt_z=0.0)
    effects: dict[str, Any] = {"ball_effects": (qs.CentrifugalForce(),), "raceway_control": qs.RacewayControl.OUTER}
    found = effects_of(qs.BearingSet((qs.Row(S6210C),), operation, reference_position=0.0, **effects))
    _, alone = explain(qs.Scene(S6210C, operation, **effects), 0.01)
    for row in (each for each in alone if each.effect not in ("tilt_lever", "ball_motion")):
        assert found[row.effect].in_scene == row.in_scene
        if row.actual is None:
            assert found[row.effect].actual is None
            continue
        assert found[row.effect].verdict == row.verdict
        exact = {name: change for name, change in row.actual.items() if name != "stiffness" or not row.alternatives}
        same = {name: found[row.effect].actual[name] for name in exact}
        assert same == pytest.approx(exact, rel=1e-6, abs=1e-7), row.effect
        for one, other in zip(found[row.effect].alternatives, row.alternatives, strict=True):
            assert one["under"] == other["under"]
            straight = [each for each in other["stiffness"] if "mrad" not in each]
            for of, keys in (("displacement", list(other["displacement"])), ("stiffness", straight)):
                given = [other[of][key] for key in keys]
                assert [one[of][key] for key in keys] == pytest.approx(given, rel=1e-6, abs=1e-7), row.effect


def test_a_row_s_own_effects_count_and_go() -> None:
    grown = (qs.RingExpansion(bore_diameter=50 * qs.mm, outside_diameter=90 * qs.mm),)
    first, second = rows("DB")
    of = qs.BearingSet(
        (replace(first, ring_effects=grown), second), qs.Operation(15_000 * qs.rpm), qs.Preload(rigid=720.0)
    )
    row = effects_of(of)["ring_expansion"]
    assert row.in_scene
    assert row.actual["load"] > 0.0
    plain = effects_of(replace(of, rows=(first, second)))["ring_expansion"]
    assert not plain.in_scene and plain.actual is None
    assert "needs [effects.ring_expansion]" in plain.why
    (assumed,) = plain.assumed
    assert 0.5 < assumed["actual"]["load"] / row.actual["load"] < 3.0  # of both rows
    sprung = replace(of, rows=(first, replace(second, sprung=True)), preload=qs.Preload(spring=720.0))
    assert effects_of(sprung)["ring_expansion"].assumed[0]["actual"]["load"] < 0.2 * assumed["actual"]["load"]


def test_a_change_without_a_number_says_why() -> None:
    """At speed the relieved row's balls still touch; at rest they do not, and have no contact angle."""
    relieved = pair("DB", 200.0, speed=10_000 * qs.rpm, axial_load=900.0)
    row = effects_of(replace(relieved, ball_effects=(qs.CentrifugalForce(),)))["centrifugal_force"]
    assert row.actual["contact_angle"] is None
    assert (row.verdict, row.why) == ("needed", "without it some contacts carry no load")


def test_arrays_are_refused() -> None:
    with pytest.raises(ValueError, match="one case at a time"):
        explain_set(pair("DB", np.array([240.0, 720.0])), 0.01)


def test_the_preload_s_sentences_hold() -> None:
    speed = 10_000 * qs.rpm
    solution = solved(pair("DB", 240.0, speed=speed, axial_load=300.0))
    said = preload_summary(solution)
    grown = solution.preload_in_operation[0] / 240.0
    assert f"the rows carry {grown:.3g} times" in said[1]
    of = with_load(solution.set, axial_load=900.0)
    (lost,) = (each for each in preload_summary(solved(of)) if "times the loads" in each)
    factor = float(lost.partition(" at ")[2].split()[0])
    around = solved(with_load(of, axial_load=900.0 * factor * np.array([0.98, 1.02])))
    assert [list(state) for state in around.preload_state] == [["maintained", "reduced"], ["maintained", "lost"]]


def test_json_and_table_of_a_file(tmp_path: Path) -> None:
    result = call(tmp_path, PAIR_FILE, "--json")
    found = json.loads(result.stdout)
    assert result.exit_code == 0
    assert [row["effect"] for row in found["effects"]] == [entry.name for entry in EFFECTS]
    assert (found["status"], found["arrangement"], found["tolerance"]) == ("converged", "DB (back to back)", 0.01)
    said = qs.warnings(qs.solve_set(qs.load_set(tmp_path / "pair.toml")))
    assert found["warnings"] == [each.remark.written(IN_FILE) for each in said]
    text = call(tmp_path, PAIR_FILE).stdout
    assert max(map(len, text.splitlines())) <= 120
    for words in (
        "DB (back to back)",
        "Rows: load on each",
        "The rings are held at a fixed distance",
        "verdict",
    ):
        assert words in text
    assert 'under [effects]: ball = ["centrifugal_force", "gyroscopic_moment"]' in " ".join(text.split())


def test_exit_codes(tmp_path: Path) -> None:
    overloaded = (
        PAIR_FILE.replace("rigid_N", "spring_N").replace('"-x"', '"-x"\nsprung = true').replace("= 200", "= -900")
    )
    result = call(tmp_path, overloaded, "--json")
    assert result.exit_code == 1
    assert {row["verdict"] for row in json.loads(result.stdout)["effects"]} == {"not assessed"}
    assert json.loads(result.stdout)["preload"] == []
    assert call(tmp_path, overloaded).exit_code == 1
    assert call(tmp_path, PAIR_FILE, "--tolerance", "0").exit_code == 2
    assert call(tmp_path, PAIR_FILE.replace('"-x"', '"-X"')).exit_code == 2
