"""What a set's file must say of its loads, and what the head of its results says of its speeds."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.file_errors import SceneFileError
from qsbearing.reports import set_document
from tests.systems.sets.arrangements import solved

ROWS = 'bearing.name = "7210C"\nrows = [{position_mm = 0, carries = "+x"}, {position_mm = 20, carries = "-x"}]\n'
OTHER_LOADS = (
    "shaft.loads = [{position_mm = 50, radial_y_N = 500}]",
    "shaft = {gravity_m_s2 = [0, -9.81, 0], masses = [{position_mm = 10, mass_kg = 20}]}",
    "preload.rigid_N = 300",
    "spacers = [{rows = [1, 2], inner_length_mm = 10, outer_length_mm = 10.004}]",
    'rows = [{position_mm = 0, carries = "+x", offset_um = 4}, {position_mm = 20, carries = "-x"}]',
)
"""Each loads rows, beside [operation]."""
OPERATIONS = ("", "operation = {}\n", "operation.speed_rpm = 1000\n")
"""Without a load or displacement."""


def written(folder: Path, *parts: str) -> Path:
    """A file of a set; what gives the rows anew replaces them."""
    file = folder / "set.toml"
    head = ROWS.splitlines()[0] + "\n" if any(part.startswith("rows") for part in parts) else ROWS
    file.write_text(head + "\n".join(parts))
    return file


@pytest.mark.parametrize("operation", OPERATIONS)
@pytest.mark.parametrize("loads", OTHER_LOADS)
def test_loads_elsewhere_are_loads(tmp_path: Path, loads: str, operation: str) -> None:
    """[operation] may be empty or absent: as with a load of zero there."""
    found = solved(qs.load_set(written(tmp_path, loads, operation)))
    speed = "" if "speed" not in operation else ", speed_rpm = 1000"
    stated = solved(qs.load_set(written(tmp_path, loads, f"operation = {{axial_load_N = 0{speed}}}")))
    assert (found.axial_loads == stated.axial_loads).all()
    assert found.axial_loads.max() > 0.0


@pytest.mark.parametrize("operation", OPERATIONS)
def test_a_set_that_nothing_loads_is_asked_whether_that_is_meant(tmp_path: Path, operation: str) -> None:
    with pytest.raises(SceneFileError) as caught:
        qs.load_set(written(tmp_path, operation))
    (error,) = caught.value.errors
    assert str(error).startswith("operation: no load is given")
    assert "axial_load_N = 0 if that is meant" in str(error)


@pytest.mark.parametrize("rpm", [0, -1500])
def test_the_head_says_how_fast_outer_rings_turn(tmp_path: Path, rpm: int) -> None:
    loads = f"preload.rigid_N = 300\noperation = {{speed_rpm = 1000, outer_speed_rpm = {rpm}}}"
    shown = CliRunner().invoke(cli, ["run", str(written(tmp_path, loads))]).stdout
    assert f"shaft 1000 rpm, outer ring {str(rpm).replace('-', '−')} rpm, its channels" in " ".join(shown.split())
    summary = set_document._summary(qs.solve_set(qs.load_set(tmp_path / "set.toml")))
    assert f"Shaft 1000 rpm, outer ring {rpm} rpm." in summary
