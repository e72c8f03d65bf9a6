"""Results into a REXS model: what is added, and that nothing else changes."""

from __future__ import annotations

import json
import tomllib
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.rexs.importing import import_model
from qsbearing.files.rexs.reader import AttributeReader
from qsbearing.files.rexs.source import model_in, opened
from qsbearing.files.rexs.write_back import WriteBack
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.model.units import MPa, deg, mm
from qsbearing.results.readings_record import taken
from tests.files.rexs.models import b218, gearbox, json_text, part, xml, zipped
from tests.files.rexs.test_import import double_row, loaded_spindle, spindle

Result = tuple[dict[str, Any], Any, Any]
RADIAL = {"radial_load_y_N": 3000.0, "tilt_y_mrad": 0.1}
FORMS: dict[str, Callable[[dict[str, Any]], bytes]] = {
    "XML": xml,
    "XML of Windows": lambda model: b"\xef\xbb\xbf" + xml(model, "\r\n"),
    "JSON": json_text,
    "JSON on one line": lambda model: json.dumps(json.loads(json_text(model))).encode(),
    "ZIP": lambda model: zipped(xml(model)),
}


def solved(file: Path, name: str, **operation: float) -> Result:
    """The tables of an imported file, its solution, and what is read off."""
    (text,) = (each.text for each in import_model(file).files if each.name == name)
    tables = tomllib.loads(text)
    tables["operation"] |= operation
    solution = qs.solve(scene) if isinstance(scene := scene_or_set_of(tables, ""), qs.Scene) else qs.solve_set(scene)
    rows = solution.rows if hasattr(solution, "rows") else None
    return tables, solution, taken(solution) if rows is None else [taken(row) for row in rows]


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Result:
    """B218 under combined load."""
    file = tmp_path_factory.mktemp("rexs") / "model.rexs"
    file.write_bytes(xml(b218()))
    return solved(file, "bearing_6.toml", **RADIAL)


def written(file: Path, result: Result) -> WriteBack:
    tables, solution, readings = result
    model = WriteBack(file, tables)
    file.write_bytes(model.put(solution, readings))
    return model


def text_in(data: bytes) -> bytes:
    return zipfile.ZipFile(BytesIO(data)).read("model.rexs") if data.startswith(b"PK") else data


@pytest.mark.parametrize("contacts", [True, False])
@pytest.mark.parametrize("form", FORMS)
def test_no_other_line_changes_and_writing_twice_is_writing_once(
    tmp_path: Path, result: Result, form: str, contacts: bool
) -> None:
    file = tmp_path / "model.rexs"
    before = FORMS[form](b218(contacts=contacts))
    file.write_bytes(before)
    scenes = [each.text for each in import_model(file).files]
    assert written(file, result).count == 41 + 5 * 32
    once = file.read_bytes()
    after = iter(text_in(once).splitlines())
    if "one line" not in form:
        assert all(line in after for line in text_in(before).splitlines())  # each of them, in their order
    assert text_in(once).count(b"\r\n") == (text_in(once).count(b"\n") if "Windows" in form else 0)
    written(file, result)
    assert file.read_bytes() == once
    assert [each.text for each in import_model(file).files] == scenes
    if form == "ZIP":
        assert zipfile.ZipFile(BytesIO(once)).read("readme.txt") == b"not a model"
    if "XML" in form:
        assert len(ElementTree.fromstring(text_in(once)).findall(".//component")) == 24 + 32


@pytest.mark.parametrize("version", ["1.4", "2.0.0"])
@pytest.mark.parametrize("mirrored", [False, True])
def test_numbers_read_back_are_those_of_the_solution(
    tmp_path: Path, result: Result, version: str, mirrored: bool
) -> None:
    file = tmp_path / "model.rexs"
    file.write_bytes(xml(b218(version, mirrored=mirrored)))
    written(file, result)
    _, solution, readings = result
    model = model_in(opened(file))
    reader = AttributeReader(model, None, [])
    bearing, sign = model.components[6], -1.0 if mirrored else 1.0

    def read(*names: str) -> list[float | None]:
        return [reader.number(bearing, name) for name in names]

    forces = [f"force_acting_on_inner_component_{axis}" for axis in "uvw"]
    assert read(*forces) == [-17800.0 * sign, -3000.0 * sign, 0.0]  # turned by 180 degrees about w
    assert read("maximum_hertzian_pressure") == pytest.approx([solution.inner.max_pressure.max()], rel=1e-15)
    life = "nominal_reference_rating_life_time_iso_16281_2008"
    assert read(life) == pytest.approx([float(readings["life"].basic_duration)], rel=1e-15)
    lever = solution.scene.bearing.groove_centre_offsets[0]
    axial, radial, tilt = solution.stiffness[0, 0], solution.stiffness[1, 1], solution.stiffness[4, 4]
    coupled = solution.stiffness[1, 4] + solution.stiffness[4, 1]
    names = ("f_u_d_u", "f_v_d_v", "m_w_rot_w", "f_u_d_v", "f_u_d_w")
    wanted = [axial, radial, tilt + lever * coupled + lever**2 * radial,
              solution.stiffness[0, 1], sign * solution.stiffness[0, 2]]  # fmt: skip
    found = read(*(f"operating_point_stiffness_{name}" for name in names))
    assert found == pytest.approx(wanted, rel=1e-12, abs=1e-6)  # sums of some terms each
    moment = solution.load[4] + lever * solution.load[1]
    assert read("torque_acting_on_inner_component_w") == pytest.approx([-moment], rel=1e-12)
    for ball in (0, 5):
        angles = reader.number(model.components[100 + ball], "angular_position_around_u")
        assert angles == pytest.approx(
            (np.pi - solution.azimuth[ball]) % (2 * np.pi) if mirrored else solution.azimuth[ball]
        )
        for side, at in (("inner", 200), ("outer", 300)):
            contact, own = model.components[at + ball], getattr(solution, side)
            assert reader.number(contact, "rolling_element_force") == pytest.approx(own.load[ball], rel=1e-15)
            assert reader.number(contact, "operating_pressure_angle") == pytest.approx(own.angle[ball], rel=1e-15)
    unit = "MPa" if version == "2.0.0" else "N / mm^2"
    assert bearing.attributes["maximum_hertzian_pressure"].unit == unit
    assert (life in bearing.attributes) == (version == "2.0.0")
    assert ("nominal_reference_rating_life_time_din_26281" in bearing.attributes) == (version == "1.4")


def test_what_is_there_is_replaced_in_its_own_unit_and_load_cases_take_their_own(
    tmp_path: Path, result: Result
) -> None:
    model = b218()
    changed = {3: {"rotational_speed": ("1 / min", 10000)}, 6: {"maximum_hertzian_pressure": ("GPa", 9.0)}}
    model["load_cases"] = [{}, changed]
    tables, solution, readings = result
    tables = tables | {"rexs": {"bearings": [6], "load_case": 2}}
    for form in ("XML", "JSON"):
        file = tmp_path / "model.rexs"
        file.write_bytes(FORMS[form](model))
        assert written(file, (tables, solution, readings)).count == 201
        once = file.read_bytes()
        written(file, (tables, solution, readings))
        assert file.read_bytes() == once
        found = model_in(opened(file))
        assert not found.load_cases[0].components
        own = found.load_cases[1].components
        assert (len(own[6].attributes), len(own[205].attributes), len(own)) == (41, 5, 2 + 32)
        pressure = own[6].attributes["maximum_hertzian_pressure"]
        assert pressure.unit == "GPa"
        assert float(pressure.value) == pytest.approx(solution.inner.max_pressure.max() / (1e3 * MPa), rel=1e-14)
        assert "force_acting_on_inner_component_u" not in found.components[6].attributes
        new = b218(contacts=False)
        file.write_bytes(FORMS[form](new | {"load_cases": model["load_cases"]}))
        written(file, (tables, solution, readings))
        found = model_in(opened(file))
        contacts = [each for each in found.components.values() if each.kind == "rolling_element_contact"]
        assert [len(each.attributes) for each in contacts] == [1] * 32  # their type; their results are the load case's
        assert {len(found.load_cases[1].components[each.number].attributes) for each in contacts} == {5}


@pytest.mark.parametrize("form", FORMS)
def test_the_life_of_a_spectrum_is_what_the_load_cases_accumulate_to(tmp_path: Path, form: str) -> None:
    """In an element of its own, which is added or changed; no other line is."""
    model, file = b218(), tmp_path / "model.rexs"
    model["load_cases"] = [
        {1: {"operating_time_fraction": ("%", share)}, 5: {"force_u_direction": ("kN", load)}}
        for share, load in ((20, 8.0), (80, 3.0))
    ]
    file.write_bytes(FORMS[form](model))
    (text,) = (each.text for each in import_model(file).files if each.name == "bearing_6_spectrum.toml")
    (tmp_path / "spectrum.toml").write_text(text, encoding="utf-8")
    before = lines_of(file)
    call = ["run", str(tmp_path / "spectrum.toml"), "--into", str(file)]
    done = CliRunner().invoke(cli, call, catch_exceptions=False)
    assert done.exit_code == 0
    hours = qs.solve(qs.load_scene(tmp_path / "spectrum.toml"))
    reading = taken(hours)
    name = "nominal" if reading["life"].modified_reference_rating_life is None else "modified"
    found = model_in(opened(file)).accumulation
    assert found is not None
    [life] = found.components[6].attributes.values()
    assert life.name.startswith(f"{name}_reference_rating_life_time_")
    assert (float(life.value), life.unit) == (pytest.approx(reading["spectrum"].duration / 3600.0, rel=1e-14), "h")
    once = file.read_bytes()
    if "one line" not in form:
        after = iter(lines_of(file))
        assert all(line in after for line in before), "every old line, in its order"
    assert CliRunner().invoke(cli, call, catch_exceptions=False).exit_code == 0
    assert file.read_bytes() == once
    assert [len(each.components) for each in model_in(opened(file)).load_cases] == [2, 2]


def test_the_lives_of_a_set_over_its_load_cases_go_to_each_bearing(tmp_path: Path) -> None:
    file, scene = tmp_path / "model.rexs", tmp_path / "spectrum.toml"
    file.write_bytes(xml(loaded_spindle()))
    (text,) = (each.text for each in import_model(file).files if each.name == "shaft_2_spectrum.toml")
    scene.write_text(text, encoding="utf-8")
    call = ["run", str(scene), "--into", str(file)]
    assert CliRunner().invoke(cli, call, catch_exceptions=False).exit_code == 0
    found = model_in(opened(file)).accumulation
    assert found is not None
    for number, row in zip((5, 6), qs.solve_set(qs.load_set(scene)).rows, strict=True):
        [life] = found.components[number].attributes.values()
        assert float(life.value) == pytest.approx(taken(row)["spectrum"].duration / 3600.0, rel=1e-12)


def test_a_gearbox_s_shaft_comes_back_with_the_lives_of_its_set(tmp_path: Path) -> None:
    """Gear forces in three load cases, a rotor, weight; each life is that of the cases alone, added up by hours."""
    model, file = loaded_spindle(), tmp_path / "model.rexs"
    model["components"] += [
        part(11, "cylindrical_gear", "pinion", u_coordinate_on_shaft=("mm", 200), mass_of_component=("kg", 1.5)),
        part(12, "additional_mass", "rotor", u_coordinate_on_shaft=("mm", 280), mass_of_component=("kg", 4.0)),
    ]
    model["relations"] += [("assembly", 0, {"assembly": 2, "part": at}) for at in (11, 12)]
    next(each for each in model["components"] if each["id"] == 9)["attributes"] |= {
        "account_for_gravity": ("none", "true"), "direction_vector_gravity_v": ("none", -1.0)
    }  # fmt: skip
    forces = ((0.3, -0.6, 1.5), (0.1, -0.3, 0.8), (-0.2, 0.5, -1.2))
    model["load_cases"] = [
        {
            9: {"operating_time_fraction": ("%", share)}, 2: {"rotational_speed": ("1 / min", speed)},
            11: {f"force_acting_on_shaft_{axis}": ("kN", value) for axis, value in zip("uvw", force, strict=True)}
            | {"torque_acting_on_shaft_w": ("N m", 30.0 * force[0]), "torque_acting_on_shaft_v": ("N m", 0.0)},
        }
        for share, speed, force in zip((20, 50, 30), (9000, 6000, 3000), forces, strict=True)
    ]  # fmt: skip
    file.write_bytes(xml(model))
    made = import_model(file)
    assert made.unread == []
    texts = {each.name: each.text for each in made.files}
    scene = tmp_path / "spectrum.toml"
    scene.write_text(texts["shaft_2_spectrum.toml"], encoding="utf-8")
    call = ["run", str(scene), "--into", str(file)]
    assert CliRunner().invoke(cli, call, catch_exceptions=False).exit_code == 0
    rates = np.zeros(2)
    for number, share in enumerate((0.2, 0.5, 0.3), 1):
        _, solution, readings = solved(file, f"shaft_2_case_{number}.toml")
        loads = solution.set.shaft.loads
        assert [float(load.axial) for load in loads if load.position == 0.2] == [1e3 * forces[number - 1][0]]
        assert solution.set.shaft.gravity == (0.0, -9.80665, 0.0) and len(solution.set.shaft.masses) == 2
        rates += [share / float(each["life"].duration) for each in readings[:2]]
    together = model_in(opened(file)).accumulation
    assert together is not None
    for number, rate in zip((5, 6), rates, strict=True):
        [life] = together.components[number].attributes.values()
        assert float(life.value) == pytest.approx(1.0 / rate / 3600.0, rel=1e-9)


def lines_of(file: Path) -> list[bytes]:
    source = opened(file)
    return (source.text.encode() if isinstance(source.text, str) else source.text).splitlines()


def test_a_set_writes_each_bearing_and_the_deflection_of_its_shaft(tmp_path: Path) -> None:
    file = tmp_path / "model.rexs"
    file.write_bytes(xml(spindle()))
    result = solved(file, "shaft_2.toml")
    _, solution, _ = result
    model = written(file, result)
    assert len(model.notes) == 0  # bearings without rows have no contacts to speak of
    found = model_in(opened(file))
    reader = AttributeReader(found, None, [])
    names = [f"force_acting_on_inner_component_{axis}" for axis in "uvw"]
    forces = np.array([[reader.number(found.components[at], name) for name in names] for at in (5, 6)], float)
    assert forces.sum(axis=0) == pytest.approx(
        [0.0, -500.0, 0.0], abs=1e-4
    )  # of a residual of 1e-9 of some kilonewtons
    assert forces[:, 0] == pytest.approx(np.array([-1.0, 1.0]) * solution.axial_loads, rel=1e-12)
    nodes = np.array(reader.array(found.components[2], "u_coordinates_of_beam_nodes"))
    assert nodes / mm == pytest.approx([0, 100, 300])
    moved = reader.array(found.components[2], "displacement_v_of_nodes")
    assert moved == pytest.approx(solution.deflection(nodes)[:, 1], rel=1e-12)
    tilt = reader.number(found.components[6], "angular_deflection_in_w")
    assert tilt == pytest.approx(solution.deflection([0.150])[0, 4], rel=1e-12)
    assert abs(tilt or 0.0) < deg


DEEP_GROOVE = {
    "kind": "deep_groove", "ball_count": 9, "ball_diameter_mm": 11.90625, "pitch_diameter_mm": 60.0,
    "groove_radius_coefficient": 0.52, "diametral_clearance_mm": 0.02, "ball_material": "steel",
    "ring_material": "steel", "bore_diameter_mm": 40, "outside_diameter_mm": 80,
}  # fmt: skip


def test_deep_groove_bearings_write_loads_and_moments_in_their_middle_planes(tmp_path: Path) -> None:
    """Forces and moments on both bearings balance those of the shaft; the one that floats has no axial force."""
    file = tmp_path / "model.rexs"
    file.write_bytes(xml(spindle()))
    (text,) = (each.text for each in import_model(file).files if each.name == "shaft_2.toml")
    tables = tomllib.loads(text)
    for row, carries in zip(tables["rows"], ("both", "none"), strict=True):
        row |= {"bearing": DEEP_GROOVE, "carries": carries}
    tables["operation"]["axial_load_N"] = -900.0
    tables.pop("preload", None)
    solution = qs.solve_set(scene_or_set_of(tables, ""))  # type: ignore[arg-type]
    assert solution.converged
    written(file, (tables, solution, [taken(row) for row in solution.rows]))
    found = model_in(opened(file))
    reader = AttributeReader(found, None, [])

    def of(name: str, axes: str) -> Any:
        return np.array([[reader.number(found.components[at], f"{name}_{axis}") for axis in axes] for at in (5, 6)])

    forces, moments = of("force_acting_on_inner_component", "uvw"), of("torque_acting_on_inner_component", "vw")
    assert forces[:, 0] == pytest.approx([900.0, 0.0], abs=1e-6)
    at = np.array([float(row.position) for row in solution.set.rows])  # type: ignore[arg-type]
    arms = at - float(solution.set.reference) + solution.set.growth[0](at)
    about = np.stack([moments[:, 0] - arms * forces[:, 2], moments[:, 1] + arms * forces[:, 1]], axis=-1)
    shares = solution.row_loads[:, 3:]
    assert -about == pytest.approx(shares, abs=1e-6 * np.abs(shares).max())


def test_the_rows_of_a_bearing_add_up_in_its_middle(tmp_path: Path) -> None:
    file = tmp_path / "model.rexs"
    file.write_bytes(xml(double_row()))
    result = solved(file, "bearing_6.toml")
    solution = result[1]
    model = written(file, result)
    (note,) = model.notes
    assert note.startswith("component 70 (rolling_bearing_row): its rolling elements are not the balls")
    bearing = model_in(opened(file)).components[6]
    reader = AttributeReader(model_in(opened(file)), None, [])
    assert solution.set.reference == pytest.approx(0.012)
    sign = np.array([-1.0, -1.0, 1.0, -1.0, 1.0])  # the bearing's axes are turned about w
    for (row, column), name in (
        ((0, 0), "f_u_d_u"),
        ((1, 4), "f_v_rot_w"),
        ((4, 4), "m_w_rot_w"),
        ((2, 3), "f_w_rot_v"),
    ):
        wanted = sign[row] * sign[column] * solution.stiffness[row, column]
        assert reader.number(bearing, f"operating_point_stiffness_{name}") == pytest.approx(wanted, rel=1e-12), name
    force = reader.number(bearing, "force_acting_on_inner_component_u")
    assert force == pytest.approx(17800.0, rel=1e-9)  # as the solver balances the shaft


@pytest.mark.parametrize(
    ("origin", "wanted"),
    [
        (None, "qsbearing import model.rexs"),
        ({"bearings": [66], "shaft": 4711, "load_case": 5}, "3 errors"),
        ({"bearings": [5]}, "is no ball bearing that is solved here"),
        ({"bearings": [6, 6]}, "names 2 bearings for 1 rows"),
        ({"bearings": [6], "x_along": "up"}, "neither"),
    ],
)
def test_another_model_is_refused_before_anything_is_solved(
    tmp_path: Path, result: Result, origin: dict[str, Any] | None, wanted: str
) -> None:
    file = tmp_path / "model.rexs"
    file.write_bytes(xml(b218()))
    tables = {key: each for key, each in result[0].items() if key != "rexs"}
    with pytest.raises(SceneFileError, match=wanted):
        WriteBack(file, tables if origin is None else tables | {"rexs": origin})


def test_the_commands(tmp_path: Path) -> None:
    def call(*arguments: object) -> Any:
        return CliRunner().invoke(cli, list(map(str, arguments)))

    model, out = tmp_path / "model.rexs", tmp_path / "out"
    model.write_bytes(xml(b218()))
    done = call("import", model, "--out", out)
    assert (done.exit_code, "wrote" in done.stdout) == (0, True)
    done = call("run", out / "bearing_6.toml", "--into", model)
    assert (done.exit_code, "201 attributes written" in done.stderr) == (0, True)
    assert b"rolling_element_force" in model.read_bytes()
    assert call("run", "b218", "--into", model).exit_code == 2
    assert call("import", out / "bearing_6.toml", "--out", out).exit_code == 2
    gears = tmp_path / "gears.rexs"
    gears.write_bytes(xml(gearbox()))
    done = call("import", gears, "--shaft", "input", "--out", out)
    assert done.exit_code == 1  # nothing of it can be solved as it is
    assert "shaft_3_case_1.toml, shaft_3_case_2.toml: missing" in done.stdout
    assert call("import", gears, "--out", out).exit_code == 1
    model.write_bytes(xml(b218()).replace(b'unit="kN">17.8', b'unit="kN">-17.8'))
    before = model.read_bytes()
    call("import", model, "--out", out)
    assert call("run", out / "bearing_6.toml", "--into", model).exit_code == 1  # no equilibrium: nothing is written
    assert model.read_bytes() == before
