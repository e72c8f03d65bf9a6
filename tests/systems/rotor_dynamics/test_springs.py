"""A stiffness as combined springs: their sum, and CalculiX, which solves a cantilever on them."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from numpy.typing import NDArray
from scipy.io import loadmat

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.stiffness_files import (
    FIRST_NODE,
    Seat,
    abaqus_deck,
    ansys_deck,
    calculix_deck,
    json_text,
    nastran_deck,
    seats_of,
)
from qsbearing.systems.rotor_dynamics.model_frame import OWN, ModelFrame, directions_of, in_model
from qsbearing.systems.rotor_dynamics.springs import asymmetry, combined_springs, from_shaft


@pytest.fixture(scope="module")
def fast() -> qs.Solution:
    """B218 at 18,000 rpm under combined load."""
    scene = qs.load_scene("b218")
    point = qs.Operation(speed=18_000 * qs.rpm, axial_load=5000.0, radial_load_y=1650.0, tilt_y=0.0, tilt_z=0.0)
    return qs.solve(replace(scene, operation=point))


def test_the_springs_add_up_to_the_symmetric_part(fast: qs.Solution) -> None:
    (seat,) = seats_of(fast, "N-mm-t")
    constants, combinations = combined_springs(seat.stiffness, seat.lever)
    total = np.einsum("k,ki,kj->ij", constants, combinations, combinations)
    half = 0.5 * (seat.stiffness + seat.stiffness.T)
    scale = np.array([1.0, 1.0, 1.0, seat.lever, seat.lever])
    assert np.abs((total - half) / (scale[:, None] * scale)).max() < 1e-11 * np.abs(half).max()
    assert (constants > 0.0).all()
    assert seat.asymmetry == pytest.approx(0.0386, abs=5e-5)
    at_rest = qs.solve(replace(fast.scene, operation=replace(fast.scene.operation, speed=0.0)))
    assert asymmetry(at_rest.stiffness, 0.06) < 1e-12


def test_units_and_a_mirrored_bearing(fast: qs.Solution) -> None:
    (si,), (mm,) = (seats_of(fast, units) for units in ("N-m-kg", "N-mm-t"))
    assert mm.stiffness[0, 0] == pytest.approx(1e-3 * si.stiffness[0, 0], rel=1e-14)
    assert mm.stiffness[1, 4] == pytest.approx(si.stiffness[1, 4], rel=1e-14)
    assert mm.stiffness[4, 4] == pytest.approx(1e3 * si.stiffness[4, 4], rel=1e-14)
    assert mm.load[4] == pytest.approx(1e3 * si.load[4], rel=1e-14)
    (turned,) = seats_of(fast, "N-m-kg", mirrored=True)
    sign = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])
    assert turned.stiffness == pytest.approx(sign[:, None] * sign * si.stiffness, rel=1e-12)
    shift = fast.scene.bearing.groove_centre_offsets[0]
    assert si.load[4] == pytest.approx(fast.load[4] + shift * fast.load[1], rel=1e-12)
    assert from_shaft(fast, 1.0)[1, 4] == shift


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, 0, -3), (2, -3, 6), (1, 1, 1)])
def test_directions_are_a_right_handed_system(axis: tuple[float, ...]) -> None:
    directions = directions_of(axis)
    assert directions @ directions.T == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(directions) == pytest.approx(1.0)
    assert directions[0] == pytest.approx(np.array(axis) / np.linalg.norm(axis))


def test_named_axes_are_those_of_rotor_dynamics() -> None:
    assert directions_of([1, 0, 0]).tolist() == np.eye(3).tolist()
    # Along z: x, y of the model are y, z of the scene, as in rotor dynamics.
    assert directions_of([0, 0, 2]).tolist() == [[0, 0, 1], [1, 0, 0], [0, 1, 0]]


def test_turning_twice_is_turning_once(fast: qs.Solution) -> None:
    """And back gives what was turned; single numbers of a shaft along z stand where they belong."""
    (seat,) = seats_of(fast, "N-mm-t")
    whole = np.insert(np.insert(seat.stiffness, 3, 0.0, axis=0), 3, 0.0, axis=1)
    one, other = directions_of([2.0, -3.0, 6.0]), directions_of([0.0, 1.0, 0.2])
    once = in_model(whole, one @ other)
    assert np.abs(in_model(in_model(whole, one), other) - once).max() < 1e-12 * np.abs(whole).max()
    assert np.abs(in_model(once, (one @ other).T) - whole).max() < 1e-12 * np.abs(whole).max()
    upright = in_model(whole, directions_of([0, 0, 1]))
    assert (upright[2, 2], upright[0, 0], upright[1, 1]) == (whole[0, 0], whole[1, 1], whole[2, 2])
    assert (upright[0, 4], upright[1, 3], upright[5, 5]) == (whole[1, 5], whole[2, 4], 0.0)


def springs_of(deck: str) -> tuple[NDArray, list[NDArray]]:
    """What equations and springs of a deck of CalculiX add up to, put together by hand: the stiffness (6, 6) against
    displacements and rotations of the row's two nodes, and the equations that are of none of the springs."""
    moved, turned = f"{FIRST_NODE + 101}", f"{FIRST_NODE + 102}"
    total, others = np.zeros((6, 6)), []
    constants = dict(re.findall(r"\*SPRING, ELSET=QS_(\d+)\n1\n(\S+)", deck))
    for count, body in re.findall(r"\*EQUATION\n(\d+)\n((?:[-\d., e+]+\n)+)", deck):
        terms = [each.split(",") for each in re.findall(r"\d+, [123], [-+\d.e]+", body)]
        assert len(terms) == int(count)
        row = np.zeros(6)
        for node, dof, part in terms:
            if node.strip() in (moved, turned):
                row[int(dof) - 1 + 3 * (node.strip() == turned)] = -float(part)
        if terms[0][0] in constants:
            total += float(constants[terms[0][0]]) * np.outer(row, row)
        else:
            others.append(row)
    return total, others


@pytest.mark.parametrize("axis", ["z", "2,-3,6"])
def test_a_turned_deck_adds_up_to_the_turned_stiffness(axis: str) -> None:
    """The deck of the command, added up, is the symmetric part of the matrix that JSON has turned, which is that of the
    scene turned here."""
    words = ["stiffness", "b218", "--set", "operation.radial_load_y_N=2000", "--set", "operation.tilt_y_mrad=0"]
    words += ["--set", "operation.tilt_z_mrad=0", "--axis", axis, "--origin", "10,-20,30.5", "--format"]
    deck, text = (CliRunner().invoke(cli, [*words, form]).stdout for form in ("calculix", "json"))
    (row,) = json.loads(text)["rows"]
    assert row["place"] == [10.0, -20.0, 30.5]
    stiffness = np.array(row["stiffness"])
    total, others = springs_of(deck)
    scale = np.repeat([1.0, 62.63], 3)
    half = 0.5 * (stiffness + stiffness.T) / np.outer(scale, scale)
    assert np.abs(total / np.outer(scale, scale) - half).max() < 1e-9 * np.abs(half).max()
    along = directions_of([0, 0, 1] if axis == "z" else [2, -3, 6])
    (own,) = json.loads(CliRunner().invoke(cli, [*words[:8], "--format", "json"]).stdout)["rows"]
    assert np.abs(in_model(np.array(own["stiffness"]), along) - stiffness).max() < 1e-12 * np.abs(stiffness).max()
    assert np.array(row["load"][:3]) == pytest.approx(own["load"][0] * along[0] + own["load"][1] * along[1])
    if axis == "z":
        assert others == [] and f"*BOUNDARY\n{FIRST_NODE + 102}, 3, 3\n" in deck
    else:
        assert -others[0][3:] == pytest.approx(along[0], rel=1e-12)
    assert f"{FIRST_NODE + 101}, 1.0000000000000e+01, -2.0000000000000e+01, 3.0500000000000e+01" in deck


def test_rows_of_a_set_lie_along_the_axis() -> None:
    scene = qs.load_scene("7210c")
    rows = (qs.Row(scene.bearing, 0.0, "+x"), qs.Row(scene.bearing, 0.04, "-x"))  # type: ignore[arg-type]
    seats = seats_of(qs.solve_set(qs.BearingSet(rows, preload=qs.Preload(rigid=500.0))), "N-mm-t")
    frame = ModelFrame(np.array([5.0, 6.0, 7.0]), directions_of([0.0, 3.0, 4.0]))
    places = [row["place"] for row in json.loads(json_text(seats, "N-mm-t", frame))["rows"]]
    assert places == [[5.0, 6.0, 7.0], [5.0, 30.0, 39.0]]
    cards = large_cards(nastran_deck(seats, "N-mm-t", frame))
    (system,) = (each for each in cards if each[0] == "CORD2R*")
    corner, above, beside = (np.array([float(part) for part in system[at : at + 3]]) for at in (3, 6, 9))
    assert (corner.tolist(), system[1]) == ([5.0, 6.0, 7.0], "900000")
    assert np.array([beside - corner, above - corner]) == pytest.approx(frame.directions[[0, 2]], abs=1e-11)
    grids = {each[1]: each[3:8] for each in cards if each[0] == "GRID*"}
    assert grids[f"{FIRST_NODE + 101}"] == ["5.00000000000+0", "6.00000000000+0", "7.00000000000+0", "900000", "4"]
    assert grids[f"{FIRST_NODE + 201}"][2:] == ["3.90000000000+1", "900000", ""], "the other row's rotation is free"
    assert grids[f"{FIRST_NODE + 111}"][3:] == ["", "23456"], "springs have axes of the model"


def large_cards(deck: str) -> list[list[str]]:
    """Cards in large fields, each with its name and its fields; numbers with their E."""
    cards: list[list[str]] = []
    for line in (each for each in deck.splitlines() if not each.startswith("$")):
        fields = [line[at : at + 16].strip() for at in range(8, 72, 16)]
        if line[0] != "*":
            cards.append([line[:8].strip()])
        cards[-1] += fields
    return [
        [re.sub(r"(\.\d+)([-+]\d+)$", r"\1E\2", each) if of[0] == "CORD2R*" else each for each in of] for of in cards
    ]


def test_wrong_axes_are_told_at_once() -> None:
    done = CliRunner().invoke(cli, ["stiffness", "b218", "--format", "nastran", "--axis", "0,0,0", "--origin", "1,2"])
    assert done.exit_code == 2 and "--axis 0,0,0" in done.stderr and "--origin 1,2" in done.stderr
    for form in ("csv", "ansys", "mat"):
        done = CliRunner().invoke(cli, ["stiffness", "b218", "--format", form, "--axis", "z", "--origin", "1,2,3"])
        assert done.exit_code == 2 and "--axis: of --format" in done.stderr and "--origin: of --format" in done.stderr


def test_a_set_has_each_row_in_its_place() -> None:
    scene = qs.load_scene("7210c")
    rows = (qs.Row(scene.bearing, 0.0, "+x"), qs.Row(scene.bearing, 0.04, "-x"))  # type: ignore[arg-type]
    found = json.loads(
        json_text(seats_of(qs.solve_set(qs.BearingSet(rows, preload=qs.Preload(rigid=500.0))), "N-mm-t"), "N-mm-t")
    )
    assert [row["position"] for row in found["rows"]] == [0.0, 40.0]
    first, second = (np.array(row["stiffness"]) for row in found["rows"])
    sign = np.array([-1.0, 1.0, 1.0, 1.0, -1.0, -1.0])
    assert second == pytest.approx(sign[:, None] * sign * first, rel=1e-6, abs=1e-3)
    assert not first[3].any()
    assert not first[:, 3].any()


def test_the_command(tmp_path: Path) -> None:
    out = tmp_path / "springs.inp"
    done = CliRunner().invoke(cli, ["stiffness", "b218", "--format", "calculix", "--out", str(out)])
    assert (done.exit_code, out.read_text().count("*SPRING")) == (0, 5)
    done = CliRunner().invoke(cli, ["stiffness", "b218", "--format", "mat", "--out", str(tmp_path / "b218.mat")])
    rows = loadmat(tmp_path / "b218.mat", simplify_cells=True)["rows"]
    shown = json.loads(CliRunner().invoke(cli, ["stiffness", "b218", "--format", "json"]).stdout)
    assert rows["stiffness"].tolist() == shown["rows"][0]["stiffness"]
    for wrong in (["--format", "mat"], ["--format", "json", "--vary", "speed_rpm=0,1"], ["--units", "N-m-kg"]):
        assert CliRunner().invoke(cli, ["stiffness", "b218", *wrong]).exit_code == 2


@pytest.mark.parametrize("form", ["json", "calculix", "nastran", "ross", "mat", "abaqus", "ansys"])
def test_formats_that_go_say_so_and_what_is_in_their_place(form: str, tmp_path: Path) -> None:
    out = tmp_path / "b218"
    done = CliRunner().invoke(cli, ["stiffness", "b218", "--format", form, "--out", str(out)])
    assert (done.exit_code, out.stat().st_size > 0) == (0, True)
    told = [line for line in done.stderr.splitlines() if "0.5.0" in line]
    assert len(told) == (form in ("mat", "abaqus", "ansys"))
    assert all(f"--format {form} goes" in line and ("json has" in line or "calculix has" in line) for line in told)


def test_decks_that_were_not_run_say_so_and_hold_the_symmetric_part(fast: qs.Solution) -> None:
    """Abaqus: the sum of its springs, on the combinations of its equations; ANSYS: the matrix, row by row."""
    (seat,) = seats_of(fast, "N-mm-t")
    wanted = np.insert(np.insert(0.5 * (seat.stiffness + seat.stiffness.T), 3, 0.0, axis=0), 3, 0.0, axis=1)
    node = FIRST_NODE + 101
    found = np.zeros((6, 6))
    parts = abaqus_deck([seat], "N-mm-t").split("*SPRING, ELSET=")[1:]
    for part in parts:
        own, equation = part.split("*EQUATION\n")
        count, *lines = equation.split("*")[0].splitlines()
        terms = np.array(",".join(lines).split(","), float).reshape(int(count), 3)
        assert terms[0, 1:].tolist() == [1.0, 1.0]
        assert set(terms[1:, 0]) == {node}
        combination = np.zeros(6)
        combination[terms[1:, 1].astype(int) - 1] = -terms[1:, 2]
        found += float(own.split()[2]) * np.outer(combination, combination)
    scale = np.array([1.0, 1.0, 1.0, *[seat.lever] * 3])
    assert np.abs((found - wanted) / np.outer(scale, scale)).max() < 1e-11 * np.abs(wanted).max()
    deck = ansys_deck([seat], "N-mm-t")
    constants = [each for line in deck.splitlines() if line.startswith(("R,", "RMORE")) for each in line.split(",")]
    numbers = np.array([each for each in constants if "e" in each], float)
    assert (numbers[0], numbers[6], numbers[57]) == (pytest.approx(wanted[0, 0]), 0.0, 0.0), "C1, C7, C58 of the manual"
    whole = np.zeros((12, 12))
    whole[np.triu_indices(12)] = numbers
    assert whole[:6, :6] == pytest.approx(np.triu(wanted), rel=1e-12)
    assert not whole[:, 6:].any()
    for text in (deck, abaqus_deck([seat], "N-mm-t")):
        assert "Not run here" in text
    assert f"*BOUNDARY\n{node}, 4, 4\n" in abaqus_deck([seat], "N-mm-t")
    assert f"D,{node},ROTX,0" in deck


def test_the_module_for_ross_holds_the_whole_matrices(tmp_path: Path) -> None:
    """Those of JSON, to the last digit."""
    shown = json.loads(CliRunner().invoke(cli, ["stiffness", "b218", "--format", "json", "--units", "N-m-kg"]).stdout)
    text = CliRunner().invoke(cli, ["stiffness", "b218", "--format", "ross"]).stdout
    names: dict[str, Any] = {}
    exec(compile(text, "bearings.py", "exec"), names)
    [(speed, matrix)] = names["ROWS"]
    whole = np.array(shown["rows"][0]["stiffness"])
    assert np.array_equal(matrix, np.delete(np.delete(whole, 3, axis=0), 3, axis=1))
    assert speed == pytest.approx(shown["rows"][0]["speed"] * qs.rpm, rel=1e-15)
    wrong = CliRunner().invoke(cli, ["stiffness", "b218", "--format", "ross", "--units", "N-mm-t"])
    assert wrong.exit_code == 2


@pytest.mark.heavy
@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
def test_calculix_moves_a_cantilever_on_the_bearing_as_its_stiffness_says(fast: qs.Solution, tmp_path: Path) -> None:
    """The tip on the bearing minus the tip of the same bar clamped: a rigid motion, known without the bar."""
    (seat,) = seats_of(fast, "N-mm-t")
    tips = []
    force = FORCE
    for is_clamped in (True, False):
        folder = tmp_path / str(is_clamped)
        folder.mkdir()
        (folder / "springs.inp").write_text(calculix_deck([seat], "N-mm-t"))
        (folder / "bar.inp").write_text(bar(force, is_clamped))
        subprocess.run(["ccx", "bar"], cwd=folder, check=True, capture_output=True)
        last = (folder / "bar.dat").read_text().strip().splitlines()[-1].split()
        tips.append(np.array(last[1:], float))
    assert tips[1] - tips[0] == pytest.approx(rigid(seat, force), abs=1e-6 * np.abs(tips[1]).max())  # of seven digits


SKEWED = ModelFrame(np.array([120.0, -40.0, 7.0]), directions_of([-2.0, 3.0, 6.0]))
UPRIGHT = ModelFrame(np.array([0.0, 0.0, 50.0]), directions_of([0.0, 0.0, 1.0]))


@pytest.mark.heavy
@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
@pytest.mark.parametrize("frame", [SKEWED, UPRIGHT], ids=["skewed", "upright"])
def test_calculix_does_so_wherever_the_shaft_lies(fast: qs.Solution, frame: ModelFrame, tmp_path: Path) -> None:
    """The tip of the same bar, turned with its loads into another model, moves as the turned one."""
    (seat,) = seats_of(fast, "N-mm-t")
    tips = []
    for number, of in enumerate((OWN, frame)):
        folder = tmp_path / str(number)
        folder.mkdir()
        (folder / "springs.inp").write_text(calculix_deck([seat], "N-mm-t", of))
        (folder / "bar.inp").write_text(bar(FORCE, False, of))
        subprocess.run(["ccx", "bar"], cwd=folder, check=True, capture_output=True)
        last = (folder / "bar.dat").read_text().strip().splitlines()[-1].split()
        tips.append(np.array(last[1:], float))
    assert tips[1] == pytest.approx(frame.vector(tips[0]), abs=1e-6 * np.abs(tips[0]).max())


@pytest.mark.heavy
@pytest.mark.skipif(shutil.which("mystran") is None, reason="MYSTRAN is not installed")
@pytest.mark.parametrize("frame", [OWN, SKEWED, UPRIGHT], ids=["own", "skewed", "upright"])
def test_mystran_does_likewise(fast: qs.Solution, frame: ModelFrame, tmp_path: Path) -> None:
    (seat,) = seats_of(fast, "N-mm-t")
    tips = []
    for held in (["SPC = 7"], []):
        lines = ["SOL 101", "CEND", f"MPC = {FIRST_NODE}", "LOAD = 1", "DISP = ALL", *held, "BEGIN BULK"]
        lines += nastran_deck([seat], "N-mm-t", frame).splitlines()
        tip, load = frame.place(LENGTH), frame.vector(FORCE)
        aside = tip + 10.0 * frame.directions[1]  # a grid that says how the bar's section lies, in no grid's own axes
        lines += [f"GRID,2,,{fields(tip)}", f"GRID,3,,{fields(aside)},,123456", "MAT1,1,208000.,,0.3"]
        lines += [f"CBAR,1,1,{FIRST_NODE + 101},2,3", "PBAR,1,1,3600.,1.08E6,1.08E6,2.16E6"]
        lines += [f"FORCE,1,2,,1.,{fields(load)}"]
        lines += [f"SPC1,7,123456,{FIRST_NODE + 101}", "ENDDATA", ""]
        (tmp_path / "bar.dat").write_text("\n".join(lines))
        subprocess.run(["mystran", "bar.dat"], cwd=tmp_path, check=True, capture_output=True)
        text = (tmp_path / "bar.F06").read_text().partition("D I S P L A C E M E N T S")[2]
        row = next(each for line in text.splitlines() if (each := line.split())[:1] == ["2"])
        tips.append(np.array(row[2:5], float))
    moved = frame.vector(rigid(seat, FORCE))
    assert tips[1] - tips[0] == pytest.approx(moved, abs=MYSTRAN * np.abs(tips[1]).max())


def fields(vector: NDArray) -> str:
    """Three numbers in small fields."""
    return ",".join(f"{each:.4f}"[:8] for each in vector)


MYSTRAN = 1e-6
LENGTH = 300.0
FORCE = np.array([300.0, 500.0, -200.0])


def rigid(seat: Seat, force: NDArray) -> NDArray:
    """How the tip of a rigid bar moves on the symmetric part of the stiffness."""
    arm = np.array([LENGTH, 0.0, 0.0])
    symmetric = 0.5 * (seat.stiffness + seat.stiffness.T)
    moved = np.linalg.solve(symmetric, np.array([*force, *np.cross(arm, force)[1:]]))
    return np.asarray(moved[:3] + np.cross([0.0, *moved[3:]], arm))


def bar(force: NDArray, is_clamped: bool, frame: ModelFrame = OWN) -> str:
    """A steel bar of 300 mm along x, its end face rigid at the bearing, its tip loaded."""
    along, across = 12, 2
    x, y = np.linspace(0.0, LENGTH, along + 1), np.linspace(-30.0, 30.0, across + 1)
    numbers = np.arange((along + 1) * (across + 1) ** 2).reshape(along + 1, across + 1, across + 1) + 1
    lines = ["*NODE, NSET=ALL"]
    places = {(i, j, k): frame.origin + frame.vector([x[i], y[j], y[k]]) for i, j, k in np.ndindex(numbers.shape)}
    lines += [f"{numbers[at]}, {', '.join(f'{each:.12e}' for each in place)}" for at, place in places.items()]
    lines.append("*ELEMENT, TYPE=C3D8I, ELSET=BAR")
    for count, (i, j, k) in enumerate(np.ndindex(along, across, across), 1):
        corners = [numbers[i + a, j + b, k + c] for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        lines.append(", ".join(map(str, [count, *corners])))
    seat, tip = numbers[0].ravel(), numbers[-1, across // 2, across // 2]
    moved, turned = FIRST_NODE + 101, FIRST_NODE + 102
    lines += ["*NSET, NSET=SEAT", *(f"{node}," for node in seat), "*NSET, NSET=TIP", f"{tip},"]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "208000., 0.3", "*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL"]
    lines += ["*INCLUDE, INPUT=springs.inp", f"*RIGID BODY, NSET=SEAT, REF NODE={moved}, ROT NODE={turned}"]
    if is_clamped:
        lines += ["*BOUNDARY", f"{moved}, 1, 3", f"{turned}, 1, 3"]
    lines += ["*STEP", "*STATIC", "*CLOAD"]
    lines += [f"{tip}, {dof}, {each}" for dof, each in enumerate(frame.vector(force), 1)]
    return "\n".join([*lines, "*NODE PRINT, NSET=TIP", "U", "*END STEP", ""])
