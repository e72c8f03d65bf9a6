"""Stiffness over the frequency of a load: another program's numbers, a small load that stands still, refusals."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.model.validation import SceneError
from qsbearing.systems.rotor_dynamics.over_frequency import LoadFrequency, frequencies_of
from tests.qsbearing.scenes import B218, BOTH, UPRIGHT

N_UM = 1e6
SPEED = 18_000 * qs.rpm
SPINDLE = qs.BallBearing(20, 11.1125e-3, 90e-3, 0.53 * 11.1125e-3, 0.52 * 11.1125e-3, 25 * qs.deg)
FILE = """
[bearing]
ball_count = 20
ball_diameter_mm = 11.1125
pitch_diameter_mm = 90
free_contact_angle_deg = 25
inner_groove_radius_coefficient = 0.53
outer_groove_radius_coefficient = 0.52
ball_material = "steel"
ring_material = "steel"
[operation]
axial_load_N = 600
[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "{control}"
"""


def solved(of: qs.BallBearing = SPINDLE, control: str = "friction", **operation: Any) -> qs.Solution:
    return qs.solve(qs.Scene(of, qs.Operation(**operation), BOTH, control))  # type: ignore[arg-type]


def table_of(path: Path, *words: str) -> list[dict[str, str]]:
    done = CliRunner().invoke(cli, ["stiffness", str(path), "--vary", "speed_rpm=0:18000:3", *words])
    assert done.exit_code == 0, done.output
    return list(csv.DictReader(io.StringIO(done.stdout)))


def test_a_spindle_bearing_has_the_numbers_of_another_program() -> None:
    """Of 7014 size, 25 degrees: to their last digit."""
    solution = solved(speed=SPEED, axial_load=600.0)
    stiffness = qs.stiffness_over_frequency(solution, (0.0, SPEED))
    np.testing.assert_allclose(stiffness.radial / N_UM, (32.2, 34.3), atol=0.06)
    np.testing.assert_allclose(stiffness.axial / N_UM, (32.4, 26.3), atol=0.06)
    assert solution.orbital_speed is not None
    cage = solution.orbital_speed[0]
    near = qs.stiffness_over_frequency(solution, (0.95 * cage, cage, 1.05 * cage))
    assert np.isnan(near.radial).all() and np.isfinite(near.axial).all()


def test_nothing_turns_at_nothing() -> None:
    """A radial load of 10 N in the periodic balance of unlike balls, 0.05 % of the thrust, moves the ring by 10 N over
    the radial stiffness at 0; what is left is its curvature."""
    thrust = {"speed": 10_000 * qs.rpm, "axial_load": 17.8e3}
    loaded = solved(B218, radial_load_y=10.0, **thrust, **UPRIGHT)
    stiffness = qs.stiffness_over_frequency(solved(B218, **thrust), 0.0)
    shape = loaded.displacement[1:3]
    along = 10.0 * shape[0] / (shape @ shape)
    assert stiffness.radial[0] == pytest.approx(along, rel=1e-4)
    assert stiffness.radial[0] / N_UM == pytest.approx(227.99, rel=2e-3)
    assert stiffness.axial[0] == pytest.approx(solved(B218, **thrust).stiffness[0, 0], rel=1e-9)


def test_a_whirl_either_way_and_a_shaft_either_way() -> None:
    forth, back = (solved(speed=sign * SPEED, axial_load=600.0) for sign in (1.0, -1.0))
    nu = np.array([-SPEED, 500.0, SPEED])
    one, other = qs.stiffness_over_frequency(forth, nu), qs.stiffness_over_frequency(back, -nu)
    np.testing.assert_allclose(one.radial, other.radial, rtol=1e-7)
    np.testing.assert_allclose(one.axial, qs.stiffness_over_frequency(forth, -nu).axial, rtol=1e-9)
    assert abs(one.radial[0] / one.radial[2] - 1.0) > 0.01


def test_each_case_may_have_its_own_frequencies_and_rest_has_the_static_number() -> None:
    speed = np.array([0.0, 0.5, 1.0]) * SPEED
    many = solved(speed=speed, axial_load=600.0)
    nu = np.stack([0.0 * speed, speed], axis=-1)
    stiffness = qs.stiffness_over_frequency(many, nu)
    assert stiffness.radial.shape == stiffness.axial.shape == (3, 2)
    np.testing.assert_array_equal(stiffness.radial[0], many.stiffness[0, 1, 1])
    for k in (1, 2):
        alone = qs.stiffness_over_frequency(solved(speed=speed[k], axial_load=600.0), nu[k])
        np.testing.assert_allclose(stiffness.radial[k], alone.radial, rtol=1e-7)
    still = solved(speed=0.0, axial_load=600.0)
    np.testing.assert_array_equal(qs.stiffness_over_frequency(still, (0.0, 99.0)).axial, still.stiffness[0, 0])


@pytest.mark.parametrize(
    ("changed", "field"),
    [
        ({"control": "outer"}, "raceway_control"),
        ({"radial_load_y": 100.0, **UPRIGHT}, "operation.radial_load_y"),
        ({"radial_displacement_z": 1e-6, **UPRIGHT}, "operation.radial_displacement_z"),
    ],
)
def test_what_it_does_not_know_is_refused_by_name(changed: dict[str, Any], field: str) -> None:
    solution = solved(**({"speed": SPEED, "axial_load": 600.0} | changed))
    with pytest.raises(SceneError) as caught:
        qs.stiffness_over_frequency(solution, 0.0)
    assert [each.field for each in caught.value.errors] == [field]


def test_the_command_adds_a_column_for_each_frequency(tmp_path: Path) -> None:
    path = tmp_path / "spindle.toml"
    path.write_text(FILE.format(control="friction"), "utf-8")
    rows, plain = table_of(path, "--frequency", "0,1x,500"), table_of(path)
    assert list(rows[0])[: len(plain[0])] == list(plain[0])
    added = list(rows[0])[len(plain[0]) :]
    assert added == [f"k_{way}_{at}_N_per_m" for way in ("radial", "axial") for at in ("0Hz", "1x", "500Hz")]
    scene = qs.load_scene(path)
    for row, speed in zip(rows, (0.0, 0.5 * SPEED, SPEED), strict=True):
        one = qs.solve(replace(scene, operation=replace(scene.operation, speed=speed)))
        stiffness = qs.stiffness_over_frequency(one, (0.0, speed, 1000.0 * np.pi))
        printed = [float(row[name]) for name in added]
        np.testing.assert_allclose(printed, [*stiffness.radial, *stiffness.axial], rtol=1e-7)


def test_the_command_refuses(tmp_path: Path) -> None:
    """What is no frequency, each; hypotheses; formats of one stiffness; sets."""
    path = tmp_path / "spindle.toml"
    path.write_text(FILE.format(control="friction"), "utf-8")
    other = tmp_path / "outer.toml"
    other.write_text(FILE.format(control="outer"), "utf-8")
    pair = tmp_path / "pair.toml"
    rows = "".join(f'[[rows]]\nposition_mm = {k}\ncarries = "+x"\n' for k in (0, 30))
    pair.write_text(FILE.format(control="outer") + rows, "utf-8")
    vary = ["--vary", "speed_rpm=1000,2000"]
    for words, said in (
        ([str(path), *vary, "--frequency", "0,two,1x,1x"], ("'two'", "stands twice")),
        ([str(other), *vary, "--frequency", "0"], ("raceway_control", "must be friction")),
        ([str(path), "--format", "json", "--frequency", "0"], ("--frequency",)),
        ([str(pair), *vary, "--frequency", "0"], ("a set has no stiffness over frequency",)),
    ):
        done = CliRunner().invoke(cli, ["stiffness", *words])
        assert done.exit_code == 2, (words, done.output)
        assert all(each in done.output for each in said), done.output
    still = tmp_path / "still.toml"
    still.write_text(path.read_text("utf-8").replace("[operation]", "[operation]\nspeed_rpm = 9000"), "utf-8")
    done = CliRunner().invoke(cli, ["stiffness", str(still), "--format", "json"])
    assert done.exit_code == 1 and "stiffness against tilts has no number" in done.output


def test_frequencies_are_hertz_or_times_the_shaft_s_speed() -> None:
    still, synchronous, fixed = frequencies_of("0, 1x,50")
    assert (still.label, synchronous.label, fixed.label) == ("0Hz", "1x", "50Hz")
    speed = np.array([10.0, -20.0])
    np.testing.assert_array_equal(synchronous.angular(speed), speed)
    np.testing.assert_allclose(fixed.angular(speed), 100.0 * np.pi)
    assert LoadFrequency(-0.5, True).label == "-0.5x"
