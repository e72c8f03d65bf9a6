"""The survey of mutations itself: what it changes, which tests it runs, and what it takes for seen."""

import pytest

from tests.verification import mutations
from tests.verification.mutations import ROOT, Mutation

FILE = ROOT / "qsbearing" / "readings" / "film_thickness.py"


def test_each_change_is_one_operator_or_digit_of_its_line():
    source = FILE.read_text()
    every = mutations.candidates([FILE])
    assert len(every) > 20
    for each in every:
        changed = each.applied(source)
        different = [(a, b) for a, b in zip(source.splitlines(), changed.splitlines(), strict=True) if a != b]
        assert len(different) == 1 and len(changed) == len(source)


def test_what_is_no_code_is_left_out():
    line = next(n for n, text in enumerate(FILE.read_text().splitlines(), 1) if text.startswith("from"))
    path = FILE.relative_to(ROOT).as_posix()
    assert not mutations.is_code(Mutation(path, line, 0, "f", "-"))
    assert mutations.is_code(mutations.candidates([FILE])[0])


def test_a_survey_may_keep_to_some_folders():
    under = ("qsbearing/systems/sets", "fem_check/rows")
    some = mutations.drawn(20, 3, under)
    assert len(some) == 20
    assert all(each.path.startswith(under) for each in some)
    assert len({each.path.split("/")[0] for each in some}) == 2
    assert some == mutations.drawn(20, 3, under) != mutations.drawn(20, 4, under)


def test_tests_of_a_module_come_first_by_its_name():
    assert mutations.tests_of("qsbearing/readings/film_thickness.py")[0].startswith("tests/readings/")
    assert (
        mutations.tests_of("fem_check/mechanics/boundary_element.py")[0] == "tests/fem_check/test_boundary_element.py"
    )


@pytest.mark.parametrize(("path", "is_plain"), [("model/kernel/newton.py", True), ("readings/lubricant.py", False)])
def test_a_kernel_that_is_changed_runs_as_plain_python(path, is_plain, tmp_path, monkeypatch):
    """Its machine code has no change."""
    modes = []
    monkeypatch.setattr(mutations, "commands_for", lambda path: {"tests": ("pytest",)})
    monkeypatch.setattr(mutations, "run", lambda *command, plain: modes.append(plain) or ("pass", ""))
    assert mutations.seen_by(tmp_path, tmp_path / "module.py", "as it is", "changed", f"qsbearing/{path}") == ("", [])
    assert modes == [is_plain]


@pytest.mark.parametrize("is_seen", [True, False])
def test_a_test_that_fails_without_the_change_sees_nothing(is_seen, tmp_path, monkeypatch):
    """test_a fails always, test_b where the file is changed and anything looks at it."""
    target = tmp_path / "module.py"

    def run(folder, *command, plain):
        failing = [name for name in ("test_a", "test_b") if f"--deselect={name}" not in command]
        if command[-1] in failing:
            failing = [command[-1]]
        if target.read_text() == "as it is" or not is_seen:
            failing = [name for name in failing if name != "test_b"]
        return ("fail" if failing else "pass"), "".join(f"FAILED {name} - assert\n" for name in failing[:1])

    monkeypatch.setattr(mutations, "commands_for", lambda path: {"tests": ("pytest",)})
    monkeypatch.setattr(mutations, "run", run)
    by, late = mutations.seen_by(tmp_path, target, "as it is", "changed", "module.py")
    assert by == ("test_b" if is_seen else "")
    assert late == ["fails or ends late without the change: test_a"]
    assert target.read_text() == "as it is"
