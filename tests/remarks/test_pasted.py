"""The line that a remark ends with works where it is pasted, and does what the remark asks for."""

from __future__ import annotations

import json
import shlex
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from qsbearing.cli import cli
from qsbearing.files.file_keys import IN_FILE
from qsbearing.inference import infer
from qsbearing.remarks.kinds import KINDS, Kind
from qsbearing.remarks.remark import Of, Remark
from tests.guide.pages import GUIDE

B218 = '[bearing]\nname = "B218"\n[operation]\nspeed_rpm = 10000\naxial_load_N = 17800\n'
EFFECTS = '[effects]\nball = ["centrifugal_force", "gyroscopic_moment"]\nraceway_control = "outer"\n'
PAIR = (
    '[bearing]\nname = "7210C"\n[operation]\nspeed_rpm = 18000\naxial_load_N = 300\n[preload]\nrigid_N = 300\n'
    '[[rows]]\nposition_mm = 0\ncarries = "+x"\n[[rows]]\nposition_mm = 40\ncarries = "-x"\n'
)
ISO_281 = '[readings.life]\nrating = "iso_281"\n'
RADIAL = B218.replace("17800", "8000\nradial_load_y_N = 4000\ntilt_z_mrad = 0\ntilt_y_mrad = 0")
OWN = (
    "[bearing]\nball_count = 16\nball_diameter_mm = 22.225\npitch_diameter_mm = 125.26\ninner_groove_radius_mm = 12\n"
    'outer_groove_radius_mm = 12\nfree_contact_angle_deg = 40\nball_material = "steel"\nring_material = "steel"\n'
)


def remarks(*words: str | Path) -> list[dict[str, Any]]:
    result = CliRunner().invoke(cli, ["run", *map(str, words), "--json"])
    assert result.exit_code in (0, 1), result.output  # 1: a free ring in which nothing holds a load across
    said: list[dict[str, Any]] = json.loads(result.stdout)["remarks"]
    return said


LIGHTER = B218.replace("17800", "8000")
SCENES: dict[str, tuple[str, set[str]]] = {
    "beyond": (B218 + EFFECTS.replace("outer", "inner"), {"friction_beyond"}),
    "axis": (LIGHTER + EFFECTS + "[readings.ball_slip]\nfriction_coefficient = 0.05\n", {"axis_not_held"}),
    "low": (B218 + EFFECTS + "[readings.friction]\nfriction_coefficient = 0.07\n", {"friction_may_be_low"}),
}
"""Scenes with remarks, beside those of the test itself, and the codes of these."""
STAYING = ("axis_not_held",)
"""Remarks that are right by friction too, which then moves such balls: they ask for nothing any more."""
UNREACHED = {
    "control_inconsistent": "no scene of the tests has it",
    "friction_above_load": "only wide random scenes have it",
    "friction_given_exceeded": "by friction those scenes have no equilibrium, and it names another hypothesis",
    "rows_press": "it is of rows, whose lines are those of the guide",
    "sheet_sets_left_out": "a data sheet with so many ball sets takes minutes",
    "sheet_ratings_unstated": "no data sheet of the guide leaves open what its ratings mean",
}
"""Kinds of remarks with a setting of which no scene here has a line, and why."""


@pytest.mark.parametrize(
    ("text", "codes"),
    [
        *SCENES.values(),
        (B218, {"effects_missing", "effect_data_missing"}),
        (B218 + EFFECTS, {"hypotheses_differ", "friction_doubtful", "effect_data_missing"}),
        (RADIAL + EFFECTS, {"momentum_gap"}),
        (RADIAL.replace("tilt_z_mrad = 0\ntilt_y_mrad = 0", "moment_z_Nm = 0\nmoment_y_Nm = 0") + EFFECTS, set()),
        (B218 + EFFECTS.replace("outer", "friction"), {"friction_assumed"}),
        (OWN + B218.partition("\n")[2].partition("\n")[2] + EFFECTS + ISO_281, {"life_grooves_uncovered"}),
        (PAIR, {"effects_missing", "effect_data_missing"}),
        (PAIR + EFFECTS, {"hypotheses_differ"}),
    ],
    ids=[*SCENES, "static", "at speed", "radial", "free tilts", "friction", "life", "pair", "pair at speed"],
)  # fmt: skip
def test_what_is_pasted_does_it(text: str, codes: set[str], tmp_path: Path) -> None:
    (tmp_path / "my.toml").write_text(text)
    said = [each for each in remarks(tmp_path / "my.toml") if each["paste"].startswith("--set ")]
    assert codes <= {each["code"] for each in said}
    for each in said:
        after = remarks(tmp_path / "my.toml", *shlex.split(each["paste"]))
        effect = each["values"].get("effect")
        asking = [one for one in after if one["code"] not in STAYING or one["paste"].startswith("--set ")]
        still = [(one["code"], one["values"].get("effect")) for one in asking]
        assert (each["code"], effect) not in still or (
            each["code"] == "hypotheses_differ" and "friction" not in each["paste"]  # another hypothesis is as open
        ), each


def test_every_kind_of_line_is_pasted_somewhere() -> None:
    """By what the parametrization above claims of its scenes, which it checks."""
    (mark,) = (each for each in test_what_is_pasted_does_it.pytestmark if each.name == "parametrize")  # type: ignore[attr-defined]
    assert infer.Kind is Kind  # its kinds are among them, whatever was imported before
    pasted = set.union(*(codes for _, codes in mark.args[1]))
    assert {code for code, kind in KINDS.items() if kind.setting} == pasted | UNREACHED.keys()
    assert not pasted & UNREACHED.keys()


def test_every_remark_has_a_line() -> None:
    for kind in KINDS.values():
        line = Remark(kind, Of(rows=(1,))).paste(IN_FILE)
        assert line == f"qsbearing guide {kind.see}"
        assert (GUIDE / f"{kind.see.partition('#')[0]}.md").is_file()


def test_the_terminal_ends_each_remark_with_it(tmp_path: Path) -> None:
    (tmp_path / "my.toml").write_text(B218 + EFFECTS + "[readings.life]\n")
    lines = CliRunner().invoke(cli, ["run", str(tmp_path / "my.toml")]).output.splitlines()
    pasted = [line.strip() for line in lines if line.startswith("    ") and ("--set" in line or "guide" in line)]
    assert set(pasted) >= {each["paste"] for each in remarks(tmp_path / "my.toml")}
    assert "--set effects.raceway_control=friction" in pasted
    for line in pasted:
        if line.startswith("qsbearing guide "):
            assert f"(see {line})" not in " ".join(lines)
            assert CliRunner().invoke(cli, shlex.split(line)[1:]).exit_code == 0


def test_notes_end_with_it_too() -> None:
    said = CliRunner().invoke(cli, ["stiffness", "b218", "--format", "json"]).stderr.splitlines()
    assert "    --set effects.raceway_control=friction" in said
    points = CliRunner().invoke(cli, ["sweep", "b218", "--vary", "speed_rpm=9000:10000:2"]).output.splitlines()
    assert "    --set effects.raceway_control=friction" in points
