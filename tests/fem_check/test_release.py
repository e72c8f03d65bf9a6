"""The release gate, on a repository of its own with two real checks: whatever is wrong makes it fail and is named."""

from __future__ import annotations

import json
import os
import shutil
import signal
import time
from copy import deepcopy
from dataclasses import fields, replace
from functools import cache, partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from fem_check.checks import ALL, usual
from fem_check.cli import cli
from fem_check.release import drift, gate, manifest, steps, tree
from fem_check.release.steps import GateFolders, Step, StepError
from fem_check.rows.agreement import AgreementRow, Findings, MeshLevel
from fem_check.running import kept_files, known
from qsbearing.documents.numbers import plain
from qsbearing.results import provenance
from tests.verification.campaign.envelope import ENVELOPES

CHECKS = ("check patch_test", "check formula")
RECORDS = Path("fem_check") / "records"
PATCH = "quick/patch_test.json"
ROOT = Path(__file__).parents[2]
CAMPAIGNS = "fem_check/records/gate/release/campaign"
every_step = steps.all_steps


def commit(folder: Path, message: str = "a change") -> None:
    """All that is there."""
    provenance.git("add", "-A", folder=folder)
    author = ("-c", "user.name=a", "-c", "user.email=a@b.c")
    provenance.git(*author, "commit", "-qm", message, folder=folder)


def kept_in(folder: Path) -> None:
    """The manifest of the repository's records, as they stand."""
    manifest.write(folder)


def formula(level: MeshLevel, progress: Any, scene: str = "") -> Findings:
    """A check of one row."""
    return Findings([AgreementRow("a circle", "approach", "m", 2e-6, "closed form", 2e-6, None, 1e-6, "rounding")])


run_patch_test = cache(partial(ALL["patch_test"].run, progress=lambda stage, part: None))


def patch_test(level: MeshLevel, progress: Any, scene: str = "") -> Findings:
    """A real check, which finds the same each time: run once."""
    return deepcopy(run_patch_test(level))


def stand_for_all(patch: pytest.MonkeyPatch) -> None:
    """Two checks."""
    patch.setitem(ALL, "patch_test", replace(ALL["patch_test"], run=patch_test))
    patch.setitem(ALL, "formula", replace(ALL["patch_test"], name="formula", run=formula))
    patch.setattr(steps, "all_steps", lambda level: [s for s in every_step(level) if s.name in CHECKS])


@pytest.fixture(autouse=True)
def two_checks(monkeypatch):
    stand_for_all(monkeypatch)
    monkeypatch.setattr(gate, "write_tables", lambda place: None)


def at(monkeypatch, folder: Path) -> None:
    """The gate's tree, and that of the records it makes, is this folder."""
    monkeypatch.setattr(tree, "root", lambda: folder)
    monkeypatch.setattr(provenance, "FOLDER", folder)
    provenance._source.cache_clear()


def release(out: Path, *options: str) -> Result:
    """Run the command at the quick level."""
    provenance._source.cache_clear()
    return CliRunner().invoke(cli, ["release", "--level", "quick", "--workers", "1", "--out", str(out), *options])


def verdicts(result: Result) -> dict[str, list[str]]:
    """Reasons of each step, from `--json`."""
    return {each["step"]: each["reasons"] for each in json.loads(result.stdout)}


@pytest.fixture(scope="module")
def made(tmp_path_factory) -> Path:
    """A repository with records of a first release, and the folder of a finished gate beside it."""
    place = tmp_path_factory.mktemp("gate")
    repository = place / "repository"
    with pytest.MonkeyPatch.context() as patch:
        stand_for_all(patch)
        patch.setattr(gate, "write_tables", lambda place: None)
        repository.mkdir()
        provenance.git("init", "-q", folder=repository)
        (repository / ".gitignore").write_text("results/\n")
        (repository / RECORDS).mkdir(parents=True)
        kept_in(repository)
        commit(repository, "first")
        at(patch, repository)
        first = release(place / "out", "--keep")
        assert first.exit_code == 0, first.output
        commit(repository, "records of the first release")
        shutil.rmtree(place / "out")
        second = release(place / "out")
        assert second.exit_code == 0, second.output
    provenance._source.cache_clear()
    return place


@pytest.fixture
def place(made, tmp_path, monkeypatch):
    """The same, to be spoilt."""
    shutil.copytree(made, tmp_path, dirs_exist_ok=True)
    at(monkeypatch, tmp_path / "repository")
    yield tmp_path
    provenance._source.cache_clear()


def change(path: Path, **values: Any) -> None:
    """Change the first row of a record, or, of the whole, what is no field of a row."""
    record = json.loads(path.read_text())
    names = {field.name for field in fields(AgreementRow)}
    row = record["rows"][0] | {name: value for name, value in values.items() if name in names}
    if "deviation_percent" not in values:
        row = AgreementRow(**{name: row[name] for name in names}).as_dict()
    record["rows"][0] = row
    path.write_text(json.dumps(record | {k: v for k, v in values.items() if k not in row}))


# Passing --------------------------------------------------------------------------------------------------------------


def test_a_gate_that_passes_has_records_of_its_commit(place):
    result = release(place / "out", "--resume", "--json")
    assert result.exit_code == 0, result.output
    assert verdicts(result) == {name: [] for name in ("clean tree", "previous release", *CHECKS)}
    head = tree.head(place / "repository")
    for name in CHECKS:
        record = json.loads((place / "out" / "quick" / f"{name.split()[1]}.json").read_text())
        assert (record["provenance"]["commit"], record["provenance"]["dirty"]) == (head, False)


def test_it_needs_every_check_and_all_the_rest():
    for level in MeshLevel:
        names = {step.name for step in every_step(level)}
        checks = {f"check {name}" for name in usual(level)}
        if level is MeshLevel.RELEASE:  # whose records of the quick level are made anew, too
            checks |= {f"check {name}, quick level" for name in usual(MeshLevel.QUICK)}
        assert checks == {each for each in names if each.startswith("check ")}
        campaigns = (*ENVELOPES, *steps.RECOMPUTED[level])
        assert {"hard cases", *(f"campaign {name}" for name in campaigns), "benchmarks", "reports"} < names
        assert "validation book" in names
    assert usual(MeshLevel.RELEASE) == ALL
    assert set(ALL) - set(usual(MeshLevel.QUICK)) == {"load_power_law", "body_size", "conformity"}


def test_the_programs_and_records_of_every_step_exist():
    """At the release level all of its records are in the repository, but those of a campaign that is new."""
    missing = {
        f"{CAMPAIGNS}/friction/summary.json",
        f"{CAMPAIGNS}/arched/summary.json",
        f"{CAMPAIGNS}/deep_groove/summary.json",
        f"{RECORDS}/release/formula.json",
        f"{RECORDS}/quick/formula.json",
    }  # these tests alone have the latter
    new = (f"{RECORDS}/gate/release/tests.json", f"{RECORDS}/gate/release/heavy_tests.json", f"{RECORDS}/gate/quick/")
    for step in every_step(MeshLevel.RELEASE):
        words = step.command.split()
        if words[:2] == ["python", "-m"]:
            assert find_spec(words[2]), step.name
        for name in step.records:
            kept = kept_files.place_of(name, ROOT, ROOT / RECORDS).relative_to(ROOT).as_posix()
            assert kept in missing or kept.startswith(new) or any(ROOT.glob(kept)), step.name


def test_the_records_of_a_pass_become_those_of_the_repository(place):
    repository = place / "repository"
    assert release(place / "out", "--resume", "--keep").exit_code == 0
    assert provenance.git("status", "--porcelain", folder=repository)
    for name in (PATCH, "gate/quick/steps.json"):
        assert (repository / RECORDS / name).read_bytes() == (place / "out" / name).read_bytes()
    commit(repository)
    assert release(place / "out").exit_code == 0


# Failing --------------------------------------------------------------------------------------------------------------


def test_a_dirty_tree_is_refused_before_anything_is_run(place):
    (place / "repository" / "new.py").write_text("")
    result = release(place / "new", "--json")
    assert result.exit_code == 1
    assert verdicts(result)["clean tree"] == ["dirty tree: new.py is not committed"]
    assert not (place / "new").exists()


def test_a_commit_during_the_gate_is_seen(place, monkeypatch):
    def run(where: GateFolders) -> None:
        (where.root / "late.py").write_text("")
        commit(where.root)

    real = steps.all_steps
    monkeypatch.setattr(steps, "all_steps", lambda level: [*real(level), Step("late", "nothing", run)])
    reasons = verdicts(release(place / "new", "--json"))["clean tree"]
    assert len(reasons) == 1 and "the gate began with" in reasons[0]


@pytest.mark.parametrize("committed", [True, False])
def test_a_digit_changed_in_the_previous_records_is_named(place, committed):
    path = place / "repository" / RECORDS / PATCH
    text = path.read_text()
    digits = str(json.loads(text)["seconds"])
    path.write_text(text.replace(f'"seconds": {digits}', f'"seconds": {digits}1'))
    if committed:
        commit(place / "repository")
    result = release(place / "out", "--resume", "--json")
    assert result.exit_code == 1
    assert verdicts(result)["previous release"] == [f"{RECORDS / PATCH} was changed"]
    assert (verdicts(result)["clean tree"] == []) == committed


def test_a_record_deleted_from_the_previous_ones_is_named(place):
    (place / "repository" / RECORDS / PATCH).unlink()
    commit(place / "repository")
    assert f"{RECORDS / PATCH} was deleted" in release(place / "out").stdout


def test_without_a_manifest_the_previous_records_are_not_trusted(place):
    (place / "repository" / kept_files.MANIFEST).unlink()
    commit(place / "repository")
    result = release(place / "out", "--json")
    assert result.exit_code == 1
    assert "no manifest" in verdicts(result)["previous release"][0]


def test_a_digit_changed_in_a_record_just_made_contradicts_the_rest_of_its_row(place):
    path = place / "out" / PATCH
    record = json.loads(path.read_text())
    record["rows"][0]["found"] += 1e-12
    path.write_text(json.dumps(record))
    result = release(place / "out", "--resume", "--json")
    assert result.exit_code == 1
    assert "contradicts itself" in verdicts(result)["check patch_test"][0]


def test_a_record_deleted_after_it_was_made_is_named(place):
    (place / "out" / PATCH).unlink()
    result = release(place / "out", "--resume", "--json")
    assert result.exit_code == 1
    assert verdicts(result)["check patch_test"] == [
        f"{PATCH} of the previous release is not made any more",
        f"it left no record {PATCH}",
    ]


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"commit": "0" * 40}, "records of several commits"),
        ({"dirty": True}, "with changes that are not committed"),
        (None, "not recorded"),
    ],
)
def test_records_of_several_commits_are_named(place, changed, said):
    path = place / "out" / PATCH
    record = json.loads(path.read_text())
    record["provenance"] = record["provenance"] | changed if changed else None
    path.write_text(json.dumps(record))
    result = release(place / "out", "--resume", "--json")
    assert result.exit_code == 1
    assert len(verdicts(result)["check patch_test"]) == 1
    assert said in verdicts(result)["check patch_test"][0]


def test_a_row_out_of_tolerance_fails(place, monkeypatch):
    change(place / "out" / PATCH, found=1.0, verdict="fail")
    reasons = verdicts(release(place / "out", "--resume", "--json"))["check patch_test"]
    assert "is out of tolerance" in reasons[0]


def drifted(place: Path, **values: Any) -> list[str]:
    """Reasons of the patch test, when the previous release's first row had these values."""
    repository = place / "repository"
    change(repository / RECORDS / "quick" / "formula.json", **values)
    kept_in(repository)
    commit(repository)
    result = release(place / "new", "--json")
    assert result.exit_code == 1
    by_step = verdicts(result)
    assert [name for name, reasons in by_step.items() if reasons] == ["check formula"]
    return by_step["check formula"]


def test_drift_within_the_tolerance_is_named(place):
    row = json.loads((place / "out" / "quick" / "formula.json").read_text())["rows"][0]
    tolerance = row["tolerance_percent"]
    (reason,) = drifted(place, found=row["reference"] * (1.0 + 0.002 * tolerance))
    assert f"moved by {plain(0.2 * tolerance, '.2g')} %" in reason
    assert f"(limit {plain(drift.OF_TOLERANCE * tolerance, '.2g')} %)" in reason


def test_a_tolerance_that_was_widened_is_named(place):
    (reason,) = drifted(place, tolerance_percent=1e-7)
    assert reason.endswith("its tolerance was 1e-07 % and is 1e-06 %")


def test_a_reference_that_moved_is_named(place):
    row = json.loads((place / "out" / "quick" / "formula.json").read_text())["rows"][0]
    factor = 1.0 + 1e-7
    (reason,) = drifted(place, reference=row["reference"] * factor, found=row["found"] * factor)
    assert "its reference moved by 0.00001 %" in reason


def test_a_check_that_is_no_longer_made_is_named(place):
    repository = place / "repository"
    record = json.loads((repository / RECORDS / PATCH).read_text())
    (repository / RECORDS / "quick" / "old.json").write_text(json.dumps(record | {"check": "old"}))
    kept_in(repository)
    commit(repository)
    assert "quick/old.json is on record, and no step makes it any more" in release(place / "out").stdout


# Steps that end badly -------------------------------------------------------------------------------------------------


def test_a_step_that_raises_is_a_failure_and_the_others_are_run(place, monkeypatch):
    def broken(level: MeshLevel, progress: Any, scene: str = "") -> Any:
        raise ZeroDivisionError("planted")

    monkeypatch.setitem(ALL, "patch_test", replace(ALL["patch_test"], run=broken))
    result = release(place / "new", "--json")
    assert result.exit_code == 1
    reasons = verdicts(result)
    assert reasons["check patch_test"] == ["ZeroDivisionError: planted"]
    assert reasons["check formula"] == []


def test_steps_for_one_core_share_the_cores_and_the_others_follow(place, monkeypatch):
    ran = place / "processes"
    ran.mkdir()

    def noted(step: Step) -> Step:
        def run(where: GateFolders) -> None:
            time.sleep(0.5)  # so that one process cannot take both
            (ran / step.name).write_text(f"{os.getpid()} {time.monotonic()}")
            step.run(where)

        return replace(step, run=run, is_alone=step.name == "reports")

    monkeypatch.setattr(steps, "all_steps", lambda level: [*map(noted, reports_and_checks(level))])

    def reports_and_checks(level: MeshLevel) -> list[Step]:
        alone = Step("reports", "nothing", lambda where: None)
        return [alone, *(step for step in every_step(level) if step.name in CHECKS)]

    result = release(place / "new", "--workers", "2")
    assert result.exit_code == 0, result.output
    processes = {path.name: path.read_text().split() for path in ran.iterdir()}
    assert len({processes[name][0] for name in CHECKS} | {str(os.getpid())}) == 3
    assert processes["reports"][0] == str(os.getpid())
    assert all(float(processes["reports"][1]) > float(processes[name][1]) for name in CHECKS)


def test_the_longest_of_the_gate_before_begin_first(place):
    """One that it did not have may be the longest; a journal that cannot be read orders nothing."""
    before = place / "before" / "gate" / "quick" / "steps.json"
    before.parent.mkdir(parents=True)
    where = GateFolders(place, MeshLevel.QUICK, place / "new", "", before.parents[2])

    def begun(seconds: dict[str, float]) -> list[str]:
        before.write_text(json.dumps({"steps": {name: {"seconds": each} for name, each in seconds.items()}}))
        ran, order = place / "order", ("short", "long", "new")
        ran.write_text("")

        def run(name: str, where: GateFolders) -> None:
            with ran.open("a") as file:
                file.write(f"{name} ")

        listed = [Step(name, "nothing", partial(run, name), is_alone=False) for name in order]
        list(gate._side_by_side(listed, where, 1))
        return ran.read_text().split()

    assert begun({"short": 1.0, "long": 2.0}) == ["new", "long", "short"]
    before.write_text("damaged")
    assert gate.seconds_before(where) == {}
    assert gate.seconds_before(replace(where, previous=None)) == {}
    real = gate.seconds_before(GateFolders(ROOT, MeshLevel.RELEASE, place, "", ROOT / RECORDS))
    assert real["check bearing_sector"] > 60.0, "the records of the repository have the times of their gate"


def test_a_step_whose_process_is_killed_has_failed(place, monkeypatch):
    def killed(where: GateFolders) -> None:
        os.kill(os.getpid(), signal.SIGKILL)

    listed = [Step("check formula", "nothing", killed, is_alone=False)]
    monkeypatch.setattr(steps, "all_steps", lambda level: listed)
    journal: dict[str, Any] = {}
    gate.run(
        listed, GateFolders(place / "repository", MeshLevel.QUICK, place / "new", ""), journal, lambda said: None, 2
    )
    assert journal["check formula"]["error"].startswith("BrokenProcessPool")


def test_an_interrupted_gate_runs_only_what_is_left(place, monkeypatch):
    ran, stop = [], [True]

    def counted(step: Step) -> Step:
        def run(where: GateFolders) -> None:
            ran.append(step.name)
            if stop and step.name == CHECKS[1]:
                raise KeyboardInterrupt
            step.run(where)

        return replace(step, run=run)

    monkeypatch.setattr(steps, "all_steps", lambda level: [counted(s) for s in every_step(level) if s.name in CHECKS])
    result = release(place / "new")
    assert result.exit_code == 130 and "--resume` goes on" in result.stderr
    stop.clear()
    assert release(place / "new", "--resume").exit_code == 0
    assert ran == [*CHECKS, CHECKS[1]]
    # Another commit: nothing of what was done counts for it.
    (place / "repository" / "later.py").write_text("")
    commit(place / "repository")
    assert release(place / "new", "--resume").exit_code == 0
    assert ran == [*CHECKS, CHECKS[1], *CHECKS]


def test_a_process_that_fails_is_told_with_its_last_words(tmp_path):
    where = GateFolders(ROOT, MeshLevel.QUICK, tmp_path, "0" * 40)
    with pytest.raises(StepError, match=r"no_such_module ended with exit code 1: .*No module named"):
        steps._python(where, "log", "no_such_module", accept=0)
    with pytest.raises(StepError, match="ZeroDivisionError"):  # a traceback is not "a row is out of tolerance"
        steps._python(where, "log", "timeit", "1/0", accept=1)


# What it is compared with, and where it writes ------------------------------------------------------------------------


def test_another_folder_or_a_tag_can_be_the_previous_release(place):
    provenance.git("tag", "v1", folder=place / "repository")
    change(place / "out" / PATCH, found=1.0)
    for previous, moved in ((str(place / "out"), 1), ("v1", 0)):
        reasons = verdicts(release(place / "new", "--json", "--previous", previous))
        assert len(reasons["check patch_test"]) == moved
    result = release(place / "new", "--previous", "v2")
    assert result.exit_code == 2
    assert "neither a folder nor a tag" in result.stderr


def test_records_without_provenance_serve_as_values_only(place):
    repository = place / "repository"
    path = repository / RECORDS / PATCH
    record = json.loads(path.read_text())
    del record["provenance"]
    path.write_text(json.dumps(record))
    kept_in(repository)
    commit(repository)
    result = release(place / "new", "--json")
    assert result.exit_code == 0, result.output
    (step,) = [each for each in json.loads(result.stdout) if each["step"] == "previous release"]
    assert "; 1 of 2 do not say from what: values only" in step["said"]


def test_it_does_not_write_into_the_tree(place):
    result = release(place / "repository" / RECORDS)
    assert result.exit_code == 2 and "would be changes of the tree" in result.stderr
    assert release(place / "repository" / "results").exit_code == 0


def test_what_is_no_checkout_is_refused(tmp_path, monkeypatch):
    monkeypatch.undo()
    monkeypatch.setattr(tree, "__file__", str(tmp_path / "site-packages" / "fem_check" / "release" / "tree.py"))
    result = release(tmp_path / "out")
    assert result.exit_code == 2
    assert "is not a checkout of the source" in result.stderr


def test_the_manifest_is_that_of_the_records():
    """After a change of records: `python -m fem_check.release.manifest`."""
    assert manifest.problems(ROOT) == []


# Drift of what is no check --------------------------------------------------------------------------------------------


def record_of(name: str) -> dict[str, Any]:
    return json.loads((ROOT / name).read_text())


def test_drift_of_hard_cases():
    old, new = (record_of("tests/verification/hard_cases/table.json") for _ in range(2))
    assert drift.of_hard_cases(new, old) == []
    case = new["cases"][0]
    case["loads"] = 1e-10  # within 1e-9 still
    assert "hard case one_ball_held: the error of its loads" in drift.of_hard_cases(new, old)[0]
    case["verdict"] = "explained by its condition"
    assert "was converged, within 1e-9, and is converged, explained" in drift.of_hard_cases(new, old)[0]
    del new["cases"][0]
    assert drift.of_hard_cases(new, old) == ["the hard case one_ball_held of the previous release is gone"]


def test_drift_of_a_campaign():
    old, new = (record_of(f"{CAMPAIGNS}/wild/summary.json") for _ in range(2))
    for record in (old, new):
        record["count"] = steps.SCENES[MeshLevel.RELEASE]["wild"]
        record["classes"] = {"converged": record["count"] - 22, "not_converged": 22}
    limit = round(drift.CAMPAIGN_SCENES * old["count"])
    assert drift.of_campaign(new, old) == []
    new["classes"]["not_converged"] += limit
    new["classes"]["converged"] -= limit
    assert drift.of_campaign(new, old) == []
    new["classes"]["not_converged"] += 1
    (reason,) = drift.of_campaign(new, old)
    assert reason.startswith(f"not converged: 22 of {old['count']} scenes before, {23 + limit} now (limit {limit})")
    missed = old | {"not_converged": ["wild/1/0/1"] * 52}
    (reason,) = _step("campaign wild").wrong(missed)
    assert reason.startswith("the bar is missed") and "wild/1/0/1" in reason
    assert _step("campaign wild").wrong(old) == []


def test_a_recomputed_campaign_of_another_number_or_with_a_wrong_case_fails():
    kept = record_of(f"{CAMPAIGNS}/spindles/summary.json")
    refused = sum(number for how, number in kept["ended"].items() if how.startswith("no_equilibrium"))
    record = kept | {
        "bar": {"not_converged": 21, "allowed": 22, "basis": "2026-11-28: mounted"},
        "no_equilibrium": {"certificates": {"unsupported direction": 1209, "not proved": refused - 1209}},
    }
    step = _step("campaign spindles")
    assert step.wrong(record) == []
    lost = {"bar": record["bar"] | {"not_converged": 23}}
    assert step.wrong(record | lost) == ["23 not converged, 22 allowed (2026-11-28: mounted)"]
    (reason,) = step.wrong(record | {"no_equilibrium": {"certificates": {"not proved": refused - 1}}})
    assert reason == f"{refused} cases are refused, and of {refused - 1} a certificate or its lack is recorded"
    assert step.moved(record, record) == []
    assert step.wrong(record | {"wrong": ["3/4: sleeve"]}) == ["3/4: sleeve"]
    assert step.wrong(record | {"count": 19_900}) == ["19900 cases are counted, 20000 were asked for"]
    other = record | {"ended": record["ended"] | {"not_converged": 200}}
    before = record["ended"]["not_converged"]
    assert step.moved(other, record) == [f"not converged: {before} of 20000 scenes before, 200 now (limit 4)"]


def test_a_campaign_without_a_limit_is_said_to_have_none_and_is_no_release():
    """Those of 0.2.0 that compute their cases a second time; the other campaigns say it alike."""
    assert known.NO_LIMIT in _step("campaign spindles").wrong(record_of(f"{CAMPAIGNS}/spindles/summary.json"))
    wild = record_of(f"{CAMPAIGNS}/wild/summary.json")
    del wild["bar"]
    assert _step("campaign wild").wrong(wild) == [known.NO_LIMIT]


def test_known_scenes_pass_by_name_and_only_while_they_are_not_solved():
    record = record_of(f"{CAMPAIGNS}/realistic/summary.json")
    count = record["count"]
    wrong = steps._campaign(MeshLevel.RELEASE, "realistic", count).wrong
    numbers = {name: 1000 * int(name.split("/")[2]) + int(name.split("/")[3]) for name in known.NOT_CONVERGED}
    assert set(record["not_converged"]) == {name for name, number in numbers.items() if number < count} != set()
    assert wrong(record) == []
    (reason,) = wrong(record | {"not_converged": [*record["not_converged"], "realistic/1/2/3"]})
    assert reason.startswith("the bar is missed") and "1 not converged, realistic/1/2/3" in reason
    (reason,) = wrong(record | {"not_converged": record["not_converged"][1:]})
    assert reason.startswith(record["not_converged"][0]) and "is solved now" in reason


def test_drift_of_benchmarks():
    spread = {"median": 2.0, "low": 1.9, "high": 2.2}
    old = {"ratios": {"point": spread}, "points": 10, "converged": 10, "mean_iterations": 5.0}
    old["provenance"] = {"level": "release"}
    slower = {name: 1.6 * value for name, value in spread.items()}
    assert drift.of_benchmarks(old, old) == []
    (reason,) = drift.of_benchmarks(old | {"ratios": {"point": slower}}, old)
    assert reason.startswith("point: 2 before, 3.2 (3.04 to 3.52) now")
    assert drift.of_benchmarks(old | {"ratios": {"point": slower}, "provenance": {"level": "quick"}}, old) == []
    (reason,) = drift.of_benchmarks(old | {"mean_iterations": 5.1}, old)
    assert reason.startswith("mean iterations: 5 before, 5.1 now")
    assert _step("benchmarks").wrong(old | {"converged": 9}) == ["1 of 10 points did not converge"]


def _step(name: str) -> Step:
    return next(step for step in every_step(MeshLevel.RELEASE) if step.name == name)


def test_drift_on_another_mesh_is_limited_by_both_uncertainties():
    row = AgreementRow("c", "approach", "m", 1.0, "s", 1.0, 0.01, 1.0, "w").as_dict()
    moved = AgreementRow("c", "approach", "m", 1.0, "s", 1.00019, 0.01, 1.0, "w").as_dict()
    old = {"mesh": {"dofs": 1}, "rows": [row]}
    assert drift.of_check({"mesh": {"dofs": 2}, "rows": [moved]}, old) == []
    (reason,) = drift.of_check({"mesh": {"dofs": 1}, "rows": [moved]}, old)
    assert reason.endswith(f"(limit {plain(drift.SAME_MESH, '.2g')} %)")
    moved["found"], moved["deviation_percent"] = 1.00021, 0.021
    (reason,) = drift.of_check({"mesh": {"dofs": 2}, "rows": [moved]}, old)
    assert reason.endswith("the mesh is another one)")
    assert drift.of_check({"mesh": {"dofs": 1}, "rows": []}, old) == [
        "the row 'approach' of 'c' of the previous release is gone"
    ]


def test_a_refused_row_has_no_number_that_could_drift():
    row = AgreementRow("c", "approach", "m", 1.0, "s", 1.0, 0.01, None, "w").as_dict()
    refused = AgreementRow("c", "approach", "m", 1.0, "s", None, None, None, "w").as_dict()
    records = [{"rows": [each]} for each in (row, refused)]
    assert [drift.of_check(each, each) for each in records] == [[], []]
    assert drift.of_check(*records) == ["'approach' of 'c': refused before, finding now"]
    assert drift.of_check(*reversed(records)) == ["'approach' of 'c': finding before, refused now"]


def test_gate_verdicts_need_no_terminal_and_say_how_to_run_again(place):
    table = release(place / "out", "--resume").stdout
    assert "fem-check run patch_test --level quick" in table
    assert table.rstrip().endswith("pass")
    assert gate.StepVerdict("x", ["bad"]).passes is False
