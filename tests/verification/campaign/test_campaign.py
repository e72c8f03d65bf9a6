"""The campaign itself: hundreds of scenes against the bar, and how what goes wrong is counted, kept and told."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from tests.verification.campaign import __main__ as command_line
from tests.verification.campaign import chunk as judging
from tests.verification.campaign.campaign import append, missing, open_journal, run_campaign, write_scene
from tests.verification.campaign.certificates import NONE, NOT_PROVED, Certificate
from tests.verification.campaign.chunk import not_returned, solve_range
from tests.verification.campaign.envelope import CHUNK, chunk_groups, scene_file
from tests.verification.campaign.group import GROUP
from tests.verification.campaign.summary import quantile, summarise

compiled_only = pytest.mark.skipif(not has_fast_code(), reason="thousands of scenes take hours in plain Python")

COUNTS = {"wild": 75, "realistic": CHUNK + 100, "mounted": 50}
"""The release gate asks more, at its quick level too. Realistic scenes: two chunks, of which the second is compared."""
FEW = GROUP if has_fast_code() else 4


# Hundreds of scenes ---------------------------------------------------------------------------------------------------

Campaigns = dict[str, tuple[dict[str, Any], Path]]


@pytest.fixture(scope="module")
def campaigns(tmp_path_factory: pytest.TempPathFactory) -> Campaigns:
    """Summary and folder of one campaign of each envelope."""
    folders = {envelope: tmp_path_factory.mktemp(envelope) for envelope in COUNTS}
    return {name: (run_campaign(name, COUNTS[name], 1, folder, workers=1), folder) for name, folder in folders.items()}


def assert_bar_is_met(summary: dict[str, Any]) -> None:
    """Converged and checked, or refused and certified; the few not converged are no more than allowed."""
    assert summary["failures"] == {}
    assert summary["bar"]["met"], summary["bar"]
    assert len(summary["not_converged"]) <= summary["bar"]["allowed"]
    assert summary["no_equilibrium"]["without"] == 0
    assert summary["largest"]["residual"] <= 1e-10
    assert summary["iterations_of_converged"]["median"] <= 7


@compiled_only
@pytest.mark.parametrize("envelope", COUNTS)
def test_hundreds_of_scenes_meet_the_bar(campaigns: Campaigns, envelope: str) -> None:
    summary, folder = campaigns[envelope]
    assert_bar_is_met(summary)
    assert summary["count"] == COUNTS[envelope] == sum(summary["classes"].values())
    assert len(list(folder.glob("*/*.toml"))) == len(summary["not_converged"])


@compiled_only
def test_most_realistic_scenes_have_an_equilibrium(campaigns: Campaigns) -> None:
    """And some have none: what a catalogue bearing does under a load that it is not chosen for stays in."""
    summary, _ = campaigns["realistic"]
    assert 0.97 <= summary["classes"]["converged"] / summary["count"] < 1.0


@compiled_only
def test_a_summary_adds_up(campaigns: Campaigns) -> None:
    for summary, _ in campaigns.values():
        assert sum(sum(row.values()) for row in summary["families"].values()) == summary["count"]
        refused, certified = summary["classes"]["no_equilibrium"], summary["no_equilibrium"]
        assert sum(certified["certificates"].values()) == refused
        assert certified["not_proved"] == certified["certificates"].get(NOT_PROVED, 0)
        strengths = ("proofs", "evidence", "without", "not_proved")
        assert sum(certified[name] for name in strengths) == refused
        if summary["envelope"] != "mounted":  # of which so few are refused that they have a test of their own
            assert min(certified["proofs"], certified["evidence"]) > 0 and not certified["not_proved"]


@compiled_only
def test_a_campaign_that_is_done_is_read_from_its_journal(campaigns: Campaigns) -> None:
    """The summary is the same, and the one on file; nothing is solved again."""
    summary, folder = campaigns["realistic"]
    assert json.loads((folder / "summary.json").read_text(encoding="utf-8")) == summary
    again = run_campaign("realistic", COUNTS["realistic"], 1, folder, resume=True)
    of_the_run = {"seconds": None, "provenance": None}
    assert again | of_the_run == summary | of_the_run
    with pytest.raises(ValueError, match="already"):
        run_campaign("realistic", COUNTS["realistic"], 1, folder)


@compiled_only
def test_the_same_scenes_twice_to_the_last_bit(campaigns: Campaigns) -> None:
    """In a worker or here, before or after others: the digest covers every status, load and displacement."""
    lines = (campaigns["realistic"][1] / "chunks.jsonl").read_text(encoding="utf-8").splitlines()[1:]
    [there] = [line for line in map(json.loads, lines) if line["first"] == CHUNK]
    here = solve_range("realistic", 1, CHUNK, COUNTS["realistic"])
    assert here | {"seconds": None} == there | {"seconds": None}


def test_a_range_cut_in_two_comes_to_the_same() -> None:
    """Whatever company scenes are solved in."""
    stop, middle = (4 * GROUP, GROUP + 12) if has_fast_code() else (3, 1)
    whole = summarise("wild", 1, [solve_range("wild", 1, CHUNK, CHUNK + stop)], 0.0)
    parts = [solve_range("wild", 1, CHUNK + middle, CHUNK + stop), solve_range("wild", 1, CHUNK, CHUNK + middle)]
    cut = summarise("wild", 1, parts, 0.0)
    differ = {"digest", "processor_microseconds_per_scene", "provenance"}
    assert {key for key in whole if whole[key] != cut[key]} <= differ


# What goes wrong ------------------------------------------------------------------------------------------------------


def line_of(monkeypatch: pytest.MonkeyPatch, **changes: Any) -> dict[str, Any]:
    """The line of a few scenes of which the second is judged otherwise than it should be."""
    judge = judging.judge

    def changed(group: Any) -> judging.Judged:
        solution, found, certificates = judge(group)
        if "code" in changes:
            solution.codes[1] = changes["code"]
        if "check" in changes:
            found = replace(found, **{changes["check"]: np.arange(group.size) == 1})
        certificates = {k: Certificate(changes.get("kind", "null motion")) for k in range(group.size)}
        return solution, found, certificates

    monkeypatch.setattr(judging, "judge", changed)
    return solve_range("realistic", 9, 0, FEW)


NOT_CONVERGED_CODE, REFUSED_CODE = 2, 1


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"check": "tension"}, "converged, but fails its check of tension"),
        ({"code": REFUSED_CODE, "kind": NONE}, "no equilibrium by reason of unsaid, but no certificate of it is found"),
    ],
)
def test_one_scene_that_is_wrong_fails_the_campaign(
    changes: dict[str, Any], what: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    line = line_of(monkeypatch, **changes)
    for envelope in COUNTS:
        summary = summarise(envelope, 9, [line], 0.0)
        assert summary["failures"] == {what: 1}
        assert not summary["bar"]["met"]
    assert [entry["scene"] for entry in line["listed"]] == [1]


def test_a_certified_refusal_is_no_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    assert summarise("realistic", 9, [line_of(monkeypatch, code=REFUSED_CODE)], 0.0)["bar"]["met"]


def test_not_converged_is_a_class_of_its_own(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """No failure, counted and kept; allowed of a few wild scenes, and of no realistic one."""
    line = line_of(monkeypatch, code=NOT_CONVERGED_CODE)
    for envelope, is_met in (("wild", True), ("realistic", False)):
        summary = summarise(envelope, 9, [line], 0.0)
        assert summary["classes"]["not_converged"] == 1
        assert summary["failures"] == {}
        assert summary["not_converged"] == [f"{envelope}/9/0/1"]
        assert summary["bar"]["met"] == is_met
    summary = summarise("wild", 9, [line, line], 0.0)
    assert not summary["bar"]["met"]
    write_scene(tmp_path, "realistic", 9, line["listed"][0])
    [path] = tmp_path.glob("not_converged/*.toml")
    assert path.name == "not_converged-realistic-9-0-1.toml"
    assert path.read_text(encoding="utf-8") == scene_file("realistic", 9, 1, "not converged")


def test_a_scene_that_raises_is_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its neighbours are solved and counted, once."""
    spoilt = float(np.asarray(chunk_groups(9, 0)[0].part([1]).scene().operation.speed)[0])
    solve = qs.solve

    def solve_but(scene: qs.Scene, **options: Any) -> qs.Solution:
        if spoilt in np.atleast_1d(scene.operation.speed):
            raise ZeroDivisionError("on purpose")
        return solve(scene, **options)

    monkeypatch.setattr(qs, "solve", solve_but)
    line = solve_range("wild", 9, 0, FEW)
    assert [entry["scene"] for entry in line["listed"] if entry["status"] == "raised"] == [1]
    assert sum(line["classes"].values()) == FEW
    summary = summarise("wild", 9, [line], 0.0)
    assert summary["failures"] == {"raises ZeroDivisionError": 1}
    assert not summary["bar"]["met"]


def test_a_scene_that_hangs_is_a_failure() -> None:
    line = not_returned("wild", 9, 2 * CHUNK + 57, 3.0)
    assert (line["first"], line["stop"], line["classes"]) == (2057, 2058, {"hung": 1})
    summary = summarise("wild", 9, [line], 3.0)
    assert summary["failures"] == {"the solver does not come back": 1}
    assert not summary["bar"]["met"]


# Keeping count --------------------------------------------------------------------------------------------------------


def test_quantiles() -> None:
    assert quantile({3: 98, 7: 1, 50: 1}, 0.5) == 3
    assert quantile({3: 98, 7: 1, 50: 1}, 0.99) == 7
    assert quantile({3: 98, 7: 1, 50: 1}, 0.9999) == 50
    assert quantile({}, 0.5) is None


def test_a_campaign_is_resumed_where_it_stopped(tmp_path: Path) -> None:
    """A journal cut off in the middle of a line: what is whole is kept, the rest done again."""
    path, heading = tmp_path / "new" / "chunks.jsonl", {"seed": 5}
    assert open_journal(path, heading, resume=False) == []
    lines = [{"first": 0, "stop": 10}, {"first": 10, "stop": 20}]
    for line in lines:
        append(path, line)
    assert open_journal(path, heading, resume=True) == lines
    path.write_text(path.read_text(encoding="utf-8")[:-5], encoding="utf-8")
    assert open_journal(path, heading, resume=True) == lines[:1]
    append(path, lines[1])
    assert open_journal(path, heading, resume=True) == lines
    with pytest.raises(ValueError, match="already"):
        open_journal(path, heading, resume=False)
    with pytest.raises(ValueError, match="another campaign"):
        open_journal(path, {"seed": 6}, resume=True)


def test_what_is_missing_is_cut_at_chunks() -> None:
    assert missing({}, 2 * CHUNK + 5) == [(0, CHUNK), (CHUNK, 2 * CHUNK), (2 * CHUNK, 2 * CHUNK + 5)]
    done = {0: CHUNK, CHUNK + 10: CHUNK + 20}
    assert missing(done, 2 * CHUNK) == [(CHUNK, CHUNK + 10), (CHUNK + 20, 2 * CHUNK)]
    assert missing({0: 10}, 10) == []


# The command ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("code", "exit_code", "word"), [(None, 0, "met"), (NOT_CONVERGED_CODE, 1, "NOT MET")])
def test_the_exit_code_is_the_bar(
    code: int | None, exit_code: int, word: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    line = line_of(monkeypatch, **({} if code is None else {"code": code}))
    summary = summarise("realistic", 9, [line], 0.0)
    monkeypatch.setattr(command_line, "run_campaign", lambda *_, **__: summary)
    options = ["--envelope", "realistic", "--seed", "9", "--count", str(FEW), "--out", str(tmp_path)]
    ended = CliRunner().invoke(command_line.main, options)
    assert ended.exit_code == exit_code
    assert f"bar          {word}: at most 0 of {FEW} scenes not converged" in ended.output


def test_a_folder_in_use_is_bad_input(tmp_path: Path) -> None:
    (tmp_path / "chunks.jsonl").write_text("{}\n", encoding="utf-8")
    ended = CliRunner().invoke(command_line.main, ["--out", str(tmp_path)])
    assert ended.exit_code == 2
    assert "holds a campaign already" in ended.output


def test_a_scene_is_printed() -> None:
    ended = CliRunner().invoke(command_line.main, ["--envelope", "realistic", "--seed", "3", "--scene", "2/79"])
    assert ended.output == scene_file("realistic", 3, 2 * CHUNK + 79)
    for wrong in ("2", "2/x", f"2/{CHUNK}"):
        assert CliRunner().invoke(command_line.main, ["--scene", wrong]).exit_code == 2
