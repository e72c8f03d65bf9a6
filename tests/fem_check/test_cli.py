"""The command line: exit codes, sentences, records kept whole, the report's sameness."""

import json
import subprocess
import sys
from dataclasses import replace

import pytest
from click.testing import CliRunner

from fem_check import meshing
from fem_check.checks import ALL
from fem_check.cli import cli
from fem_check.rows.agreement import AgreementRow, Findings, MeshLevel
from fem_check.running import memory, records_store, runner


def call(*arguments: str):
    return CliRunner().invoke(cli, list(arguments))


def test_list_names_every_check():
    result = call("list")
    assert result.exit_code == 0
    assert set(ALL) <= {line.split(" ")[0] for line in result.output.splitlines()}  # whole, at 80 columns


def test_the_short_form_of_help():
    assert call("-h").output == call("--help").output
    assert call("run", "-h").exit_code == 0


def test_run_keeps_and_prints_one_record(tmp_path):
    result = call("run", "patch_test", "--json", "--out", str(tmp_path))
    assert result.exit_code == 0
    printed = json.loads(result.stdout)
    kept = json.loads((tmp_path / "quick" / "patch_test.json").read_text())
    assert printed == kept
    assert set(records_store.FIELDS) <= set(kept)
    assert kept["verdict"] == "pass"
    made = kept["provenance"]
    assert (made["command"], made["level"]) == ("fem-check run patch_test --level quick", "quick")
    assert {"numpy", "numba", "scikit-fem"} <= set(made["packages"])
    assert made["commit"] is None or len(made["commit"]) == 40
    assert {"elements_per_semi_axis", "dofs", "file"} <= set(kept["mesh"])
    assert set(kept["rows"][0]) == {
        "case", "quantity", "unit", "reference", "reference_source", "found", "deviation_percent",
        "uncertainty_percent", "tolerance_percent", "why_tolerance", "verdict", "worst_at",
    }  # fmt: skip


def test_a_row_out_of_tolerance_is_exit_1(tmp_path, monkeypatch):
    bad = AgreementRow("case", "approach", "m", 1.0, "source", 1.1, None, 1.0, "why")
    monkeypatch.setitem(ALL, "patch_test", _replaced(Findings([bad], {"dofs": 1}, "none")))
    result = call("run", "patch_test", "--out", str(tmp_path))
    assert result.exit_code == 1
    assert "fail" in result.output


def _replaced(findings):
    return replace(ALL["patch_test"], run=lambda level, progress, scene="": findings)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["run", "patch_tst"], "no check named patch_tst"),
        (["run", "patch_test", "--scene", "no_such"], "no_such"),
        (["contact", "--scene", "b218", "--race", "inner", "--load-N", "0"], "must be above 0 N"),
        (["contact", "--scene", "b218", "--race", "inner", "--load-N", "nan"], "must be above 0 N"),
        (["contact", "--scene", "b218", "--race", "cage", "--load-N", "10"], "must be one of inner, outer, both"),
        (["contact", "--scene", "no_such", "--race", "inner", "--load-N", "10"], "no_such"),
        (["contact", "--scene", "b218", "--race", "inner", "--load-N", "10", "--elements", "2"], "at least 5"),
        (["contact", "--scene", "b218", "--race", "inner", "--load-N", "10", "--elements", "400"], "MB are free"),
        (
            [
                "contact",
                "--scene",
                "b218",
                "--race",
                "inner",
                "--load-N",
                "10",
                "--geometry",
                "true",
                "--elements",
                "5",
            ],
            "at least 6",
        ),
        (
            [
                "contact",
                "--scene",
                "b218",
                "--race",
                "inner",
                "--load-N",
                "9",
                "--geometry",
                "true",
                "--accuracy",
                "0.1",
            ],
            "give --elements instead",
        ),
    ],
)
def test_bad_input_is_exit_2_with_a_sentence(arguments, said):
    result = call(*arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert "Traceback" not in result.output


@pytest.mark.parametrize("command", ["list", "book", "report"])
def test_a_package_that_is_not_installed_is_exit_2_with_the_extra(command, tmp_path):
    """Of the extra `fem`, where only `all` is installed; in a process of its own, which has loaded nothing yet."""
    code = "import sys; sys.modules['pydantic'] = None; from fem_check.__main__ import main; main()"
    words = [sys.executable, "-c", code, command]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "this needs pydantic: pip install" in done.stderr and "[fem]'" in done.stderr


def test_too_little_memory_is_said_before_starting(tmp_path, monkeypatch):
    monkeypatch.setattr(memory, "available_MB", lambda: 100.0)
    (tmp_path / "quick").mkdir()
    (tmp_path / "quick" / "patch_test.json").write_text("earlier")
    result = call("run", "patch_test", "--out", str(tmp_path))
    assert result.exit_code == 2
    assert "100 MB are free" in result.stderr
    assert (tmp_path / "quick" / "patch_test.json").read_text() == "earlier"


def test_a_lost_mesh_is_exit_2_and_leaves_the_record(tmp_path, monkeypatch):
    (tmp_path / "meshes").mkdir()
    committed = meshing.committed_folder()
    (tmp_path / "meshes" / meshing.MANIFEST).write_text((committed / meshing.MANIFEST).read_text())
    monkeypatch.setattr(meshing.files, "committed_folder", lambda: tmp_path / "meshes")
    (tmp_path / "quick").mkdir()
    (tmp_path / "quick" / "patch_test.json").write_text("earlier")
    result = call("run", "patch_test", "--out", str(tmp_path))
    assert result.exit_code == 2
    assert "half_space_04.msh.xz is missing" in result.stderr
    assert (tmp_path / "quick" / "patch_test.json").read_text() == "earlier"


def test_interrupted_it_says_what_is_kept(tmp_path, monkeypatch):
    monkeypatch.setitem(ALL, "half_space_contacts", _interrupting())
    result = call("run", "patch_test", "half_space_contacts", "--out", str(tmp_path))
    assert result.exit_code == 130
    assert "interrupted" in result.stderr
    assert f"records of patch_test are kept in {tmp_path}" in result.stderr
    assert (tmp_path / "quick" / "patch_test.json").is_file()


def test_a_check_that_cannot_run_does_not_stop_the_others(tmp_path, monkeypatch):
    def fail(level, progress, scene=""):
        raise meshing.MeshError("no mesh")

    monkeypatch.setitem(ALL, "half_space_contacts", replace(ALL["patch_test"], name="half_space_contacts", run=fail))
    result = call("run", "half_space_contacts", "patch_test", "--out", str(tmp_path))
    assert result.exit_code == 2
    assert "half_space_contacts was not run: no mesh" in result.stderr
    assert (tmp_path / "quick" / "patch_test.json").is_file()


def test_results_go_to_the_working_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shipped = {path: path.stat().st_mtime_ns for path in records_store.FOLDER.rglob("*")}
    assert call("run", "patch_test").exit_code == 0
    assert (tmp_path / "fem_check_results" / "quick" / "patch_test.json").is_file()
    assert {path: path.stat().st_mtime_ns for path in records_store.FOLDER.rglob("*")} == shipped


def test_an_interrupted_run_leaves_the_earlier_records(tmp_path, monkeypatch):
    checks = [ALL["patch_test"], _interrupting()]
    done = []
    with pytest.raises(KeyboardInterrupt):
        for entry in runner.run(checks, MeshLevel.QUICK, tmp_path, lambda check: lambda stage, part: None):
            done.append(entry["check"])
    assert done == ["patch_test"]
    assert [path.name for path in (tmp_path / "quick").iterdir()] == ["patch_test.json"]
    json.loads((tmp_path / "quick" / "patch_test.json").read_text())


def _interrupting():
    def stop(level, progress, scene=""):
        raise KeyboardInterrupt

    return replace(ALL["patch_test"], name="stopped", run=stop)
