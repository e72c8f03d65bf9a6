"""Up to how many times its loads a set keeps its preload."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.systems.sets import preload_search
from qsbearing.systems.sets.preload_limits import load_changes, load_sentence, speed_changes, speed_sentence
from tests.systems.sets.arrangements import pair, solved, with_load


def test_the_load_found_is_where_the_row_is_lost() -> None:
    of = pair("DB", 240.0, axial_load=300.0)
    (found,) = qs.preload_loads(of)
    assert (found.row, found.state) == (1, "lost")
    for part, state in ((0.999, "reduced"), (1.001, "lost")):
        at = found.factor * part
        other = solved(with_load(of, axial_load=300.0 * at))
        assert list(other.preload_state) == ["maintained", state]
    assert found.sentence == f"Row 2 (S 6210 C, carries -x) loses its preload at {found.factor:.3g} times the loads."
    assert qs.preload_loads(of, 0.99 * found.factor) == []


def test_twice_the_load_is_lost_at_half_the_multiple() -> None:
    one, other = (qs.preload_loads(pair("DB", 240.0, axial_load=load), 8.0)[0].factor for load in (300.0, 600.0))
    assert other == pytest.approx(0.5 * one, abs=8.0 / 64**2)


def test_more_than_the_spring_is_an_end() -> None:
    first, second = pair("DB", 100.0).rows
    sprung = qs.Row(second.bearing, second.position, "-x", sprung=True)  # type: ignore[arg-type]
    of = qs.BearingSet((first, sprung), qs.Operation(axial_load=-100.0), qs.Preload(spring=400.0))
    found = {each.state: each for each in qs.preload_loads(of)}
    assert found["no_equilibrium"].factor == pytest.approx(4.0, rel=5e-3)


def test_few_are_tried_beyond_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """That there is no equilibrium takes a hundred times as long to find as one: of 130 values almost all are below."""
    tried: list[bool] = []

    def watched(of: qs.BearingSet, **how: Any) -> qs.SetSolution:
        found = qs.solve_set(of, **how)
        tried.extend(found.converged)
        return found

    monkeypatch.setattr(preload_search, "solve_set", watched)
    of = pair("DB", 720.0, axial_load=20_000.0)
    (end,) = [each for each in load_changes(of) if each.after == "no_equilibrium"]
    assert 0 < tried.count(False) <= 4
    around = with_load(of, axial_load=20_000.0 * (end.value + np.array([-10.0 / 64**2, 0.0])))
    assert list(qs.solve_set(around).status) == ["converged", "no_equilibrium"]


def test_what_comes_back_with_the_speed_is_told() -> None:
    """A row that the shaft load frees at rest is pressed again by what speed adds."""
    of = pair("DB", 240.0, axial_load=800.0, speed=0.0)
    lost, back, *_ = speed_changes(of, 20_000 * qs.rpm)
    assert (lost.row, lost.value, lost.after) == (1, 0.0, "lost")
    assert speed_sentence(of, lost).endswith("has lost its preload already at rest, under these loads.")
    assert (back.row, back.before, back.after) == (1, "lost", "maintained")
    around = back.value + np.array([-2.0, 1.0]) * 20_000 * qs.rpm / 64**2
    below, above = solved(with_load(of, speed=around)).preload_state[:, 1]
    assert (below, above) == ("lost", "reduced"), "which is not lost"
    assert "regains its preload at" in speed_sentence(of, back)


def test_what_speed_alone_makes_of_a_preload_is_no_matter_of_loads() -> None:
    of = pair("DB", 100.0, speed=25_000 * qs.rpm, axial_load=10.0)
    assert set(solved(of).preload_state) == {"excessive"}
    assert qs.preload_loads(of, 2.0) == []
    for each in load_changes(of, 1000.0):
        assert each.after == "lost" and "loses its preload" in load_sentence(of, each)


def test_what_is_wrong_is_said_at_once() -> None:
    with pytest.raises(qs.SceneError) as caught:
        qs.preload_loads(pair("DT", None, speed=100.0), -1.0)
    said = str(caught.value)
    for words in ("highest", "all carry in one direction", "has no load or moment that could grow"):
        assert words in said
