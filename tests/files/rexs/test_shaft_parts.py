"""What loads a shaft of a model beside external loads: gears with results, masses and gravity, widths of loads, preload
travel, misalignment; and the names of attributes that nobody read."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.rexs import importing
from qsbearing.files.rexs.importing import Imported, import_model
from qsbearing.files.rexs.names import current
from qsbearing.files.scene_or_set import scene_or_set_of
from tests.files.rexs.models import b218, part, xml


@pytest.fixture
def imported(tmp_path: Path) -> Any:
    def of(model: dict[str, Any]) -> Imported:
        file = tmp_path / "model.rexs"
        file.write_bytes(xml(model))
        return import_model(file)

    return of


def with_parts(*parts: dict[str, Any], unit: dict[str, Any] | None = None, bearing: Any = None) -> dict[str, Any]:
    """The shaft of the B218 with these on it; attributes of the gear unit and the bearing."""
    model = b218("1.7")
    for each in parts:
        model["components"].append(each)
        model["relations"].append(("assembly", 0, {"assembly": 3, "part": each["id"]}))
    for number, more in ((1, unit), (6, bearing)):
        given = {name: each if isinstance(each, tuple) else ("none", each) for name, each in (more or {}).items()}
        next(each for each in model["components"] if each["id"] == number)["attributes"] |= given
    return model


def tables(found: Imported, name: str = "shaft_3.toml") -> dict[str, Any]:
    return tomllib.loads(next(each.text for each in found.files if each.name == name))


def lacks(found: Imported, name: str = "shaft_3.toml") -> list[str]:
    return next(each.lacks for each in found.files if each.name == name)


FORCES = {"force_acting_on_shaft_u": ("N", 250.0), "force_acting_on_shaft_v": ("kN", -0.6),
          "force_acting_on_shaft_w": ("N", 1500.0)}  # fmt: skip
PINION = part(9, "cylindrical_gear", "pinion", u_coordinate_on_shaft=("mm", 40), **FORCES,
              torque_acting_on_shaft_v=("N m", 3.0), torque_acting_on_shaft_w=("N m", -4.0),
              normal_module=("mm", 2.0))  # fmt: skip


def test_forces_of_a_gear_become_a_load(imported: Any) -> None:
    found = imported(with_parts(PINION))
    assert lacks(found) == [] and found.not_ours == []
    loads = tables(found)["shaft"]["loads"]
    assert {"position_mm": 40.0, "axial_N": 250.0, "radial_y_N": -600.0, "radial_z_N": 1500.0, "moment_y_Nm": 3.0,
            "moment_z_Nm": -4.0} in loads  # fmt: skip
    assert found.unread == ["of cylindrical_gear: normal_module (9)"]
    alone = tables(found, "bearing_6.toml")["operation"]
    assert (alone["axial_load_N"], alone["radial_load_y_N"]) == (17800 + 250, -600)


def test_forces_that_point_by_the_gear_s_own_axes_are_turned(imported: Any) -> None:
    turned = {"u_axis_vector": ("mm", [-1.0, 0.0, 0.0]), "w_axis_vector": ("mm", [0.0, 0.0, 1.0])}
    pinion = part(9, "cylindrical_gear", "pinion", u_coordinate_on_shaft=("mm", 40), **FORCES, **turned)
    (load,) = (each for each in tables(imported(with_parts(pinion)))["shaft"]["loads"] if each["position_mm"] == 40.0)
    assert (load["axial_N"], load["radial_y_N"], load["radial_z_N"]) == (-250.0, 600.0, 1500.0)


@pytest.mark.parametrize("name", FORCES)
def test_a_gear_without_one_of_its_forces_is_missing_as_before(imported: Any, name: str) -> None:
    forces = {key: each for key, each in FORCES.items() if key != name}
    pinion = part(9, "cylindrical_gear", "pinion", u_coordinate_on_shaft=("mm", 40), **forces)
    found = imported(with_parts(pinion))
    assert any("the forces of component 9" in each for each in lacks(found))
    assert [each.partition(" (")[0] for each in found.not_ours] == ["component 9"]


UNIT = {"account_for_gravity": "true", "gravitational_acceleration": ("m / s^2", 9.81),
        "direction_vector_gravity_u": ("none", 0.0), "direction_vector_gravity_v": ("none", 0.0),
        "direction_vector_gravity_w": ("none", -2.0)}  # fmt: skip
ROTOR = part(9, "additional_mass", "rotor", u_coordinate_on_shaft=("mm", 50), mass_of_component=("kg", 3.0),
             moment_of_inertia_u_axis=("kg m^2", 0.01), moment_of_inertia_v_axis=("kg m^2", 0.006),
             moment_of_inertia_w_axis=("kg m^2", 0.006))  # fmt: skip


def test_masses_and_gravity_are_weight(imported: Any) -> None:
    found = imported(with_parts(ROTOR, unit=UNIT))
    shaft = tables(found)["shaft"]
    assert shaft["gravity_m_s2"] == [0.0, 0.0, -9.81]
    assert shaft["masses"] == [{"position_mm": 50.0, "mass_kg": 3.0, "polar_inertia_kg_m2": 0.01,
                                "diametral_inertia_kg_m2": 0.006}]  # fmt: skip
    of = scene_or_set_of(tables(found), "shaft")
    assert isinstance(of, qs.BearingSet)
    solution = qs.solve_set(of)
    steel = 7800 * np.pi / 4 * 0.09**2 * 0.1
    assert solution.row_loads[0, 2] == pytest.approx(-(3.0 + steel) * 9.81, rel=1e-9)
    (said,) = lacks(found, "bearing_6.toml")
    assert "which carries the weight of component 3" in said


@pytest.mark.parametrize("change", [{"account_for_gravity": "false"}, {"account_for_gravity": "0"}])
def test_gravity_that_does_not_count_is_none(imported: Any, change: dict[str, Any]) -> None:
    found = imported(with_parts(ROTOR, unit=UNIT | change))
    assert "gravity_m_s2" not in tables(found)["shaft"] and lacks(found, "bearing_6.toml") == []


def test_gravity_without_a_direction_is_missing(imported: Any) -> None:
    unit = {name: each for name, each in UNIT.items() if "vector" not in name}
    assert any("the direction of gravity" in each for each in lacks(imported(with_parts(ROTOR, unit=unit))))
    half = {name: each for name, each in UNIT.items() if name != "gravitational_acceleration"}
    found = imported(with_parts(unit=half))
    assert tables(found)["shaft"]["gravity_m_s2"] == [0.0, 0.0, -9.80665]
    assert "9.80665 m/s2 assumed" in next(each.text for each in found.files if each.name == "shaft_3.toml")


def test_a_mass_without_a_place_matters_only_with_gravity(imported: Any) -> None:
    rotor = part(9, "additional_mass", "rotor", mass_of_component=("kg", 3.0))
    still = imported(with_parts(rotor))
    assert lacks(still) == [] and "masses" not in tables(still)["shaft"]
    assert "has no position" in next(each.text for each in still.files if each.name == "shaft_3.toml")
    heavy = imported(with_parts(rotor, unit=UNIT))
    assert any("the position of component 9" in each for each in lacks(heavy))


def test_a_load_over_a_width_bends_as_many_small_ones(imported: Any) -> None:
    """Seen from outside its width: the two halves have force, moment and second moment of the whole."""
    wide = part(9, "external_load", "wide", u_coordinate_on_shaft=("mm", 40), width_of_external_load=("mm", 30),
                force_v_direction=("N", 600))  # fmt: skip
    halves = [each for each in tables(imported(with_parts(wide)))["shaft"]["loads"] if "radial_y_N" in each]
    assert [each["radial_y_N"] for each in halves] == [300.0, 300.0]
    places = np.array([each["position_mm"] for each in halves])
    for power, mean in ((1, 40.0), (2, 40.0**2 + 30.0**2 / 12), (3, 40.0**3 + 3 * 40.0 * 30.0**2 / 12)):
        assert (places**power).mean() == pytest.approx(mean, rel=1e-9)


def test_preload_travel_and_misalignment_are_the_row_s(imported: Any) -> None:
    bearing = {"preload_distance": ("mum", 15.0), "misalignment_in_v_direction": ("mum", 20.0),
               "angular_misalignment_around_w_axis": ("deg", 0.01)}  # fmt: skip
    (row,) = tables(imported(with_parts(bearing=bearing)))["rows"]
    assert (row["offset_um"], row["housing_radial_y_um"]) == (15.0, 20.0)
    assert row["housing_tilt_z_mrad"] == pytest.approx(np.radians(0.01) * 1e3)
    assert "housing_radial_z_um" not in row
    mirrored = {"u_axis_vector": ("mm", [-1.0, 0.0, 0.0]), "w_axis_vector": ("mm", [0.0, 0.0, 1.0])}
    (row,) = tables(imported(with_parts(bearing=bearing | mirrored)))["rows"]
    assert row["housing_radial_y_um"] == -20.0 and row["housing_tilt_z_mrad"] > 0.0


def test_a_preload_travel_alone_preloads_the_bearing(imported: Any) -> None:
    model = b218("1.7")
    model["relations"] = [each for each in model["relations"] if each[0] != "side"]
    next(each for each in model["components"] if each["id"] == 6)["attributes"]["preload_distance"] = ("mum", 12.0)
    assert tables(imported(model), "bearing_6.toml")["preload"] == {"axial_displacement_um": 12.0}


def test_every_attribute_that_nobody_read_is_named(imported: Any) -> None:
    bearing = {"axial_stiffness": ("N / m", 1e8), "start_up_time": ("h", 0.0), "lubrication_type": "oil",
               "has_outer_ring": "false", "custom_colour": "red", "part_number": "17"}  # fmt: skip
    found = imported(with_parts(bearing=bearing))
    (line,) = (each for each in found.unread if each.startswith("of rolling_bearing_with"))
    assert "axial_stiffness (6)" in line and "lubrication_type (6)" in line
    assert not any(name in line for name in ("start_up_time", "has_outer_ring", "custom_colour", "part_number"))
    assert imported(b218("1.7")).unread == []


@pytest.mark.parametrize("version", ["1.0", "1.3", "1.7", "2.0.0"])
def test_new_names_have_their_versions(version: str) -> None:
    of = tuple(map(int, version.split(".")))
    name = current("preload_distance", of)
    assert name == ("initial_load_shift" if of < (1, 1) else "preload_distance", "mum")
    assert (current("mass_of_component", of) is None) == (of < (1, 3))


# Too many of something -----------------------------------------------------------------------------------------------


def many(what: str, count: int) -> dict[str, Any]:
    model = b218("1.7")
    for number in range(1000, 1000 + count):
        if what == "load cases":
            model["load_cases"].append({3: {"rotational_speed": ("1 / min", number)}})
        elif what == "rows":
            model["components"].append(part(number, "rolling_bearing_row"))
            model["relations"].append(("ordered_assembly", number, {"assembly": 6, "part": number}))
        else:
            model["components"].append(part(number, "shaft_section"))
            model["relations"].append(("assembly", 0, {"assembly": 3, "part": number}))
    return model


@pytest.mark.parametrize(
    ("what", "told"),
    [("load cases", "1,001 load cases"), ("rows", "1,002 rows of bearings on component 3"),
     ("relations", "1,005 relations of component 3")],
)  # fmt: skip
def test_more_than_a_thousand_is_refused_before_work_begins(
    imported: Any, what: str, told: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(importing, "_of_shaft", None)
    with pytest.raises(qs.SceneFileError) as caught:
        imported(many(what, 1001))
    assert f"has {told}" in str(caught.value) and "at most 1,000 are read" in str(caught.value)
