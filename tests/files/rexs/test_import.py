"""A REXS model becomes scene files: the same from XML, JSON and ZIP, in every version, with what it lacks."""

from __future__ import annotations

import base64
import copy
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.rexs import importing
from qsbearing.files.rexs.importing import Imported, import_model
from qsbearing.files.rexs.names import _histories, current, version_of
from qsbearing.files.rexs.scene_text import text_of
from qsbearing.files.scene_or_set import scene_or_set_of
from tests.files.rexs.models import ROLLING, b218, gearbox, json_text, part, xml, zipped

VERSIONS = ("1.0", "1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "2.0.0")


@pytest.fixture
def imported(tmp_path: Path) -> Any:
    """Import the bytes of a model."""

    def of(data: bytes, **options: Any) -> Imported:
        file = tmp_path / "model.rexs"
        file.write_bytes(data)
        return import_model(file, **options)

    return of


def texts(found: Imported) -> dict[str, str]:
    return {each.name: each.text for each in found.files}


def tables(found: Imported, name: str) -> dict[str, Any]:
    return tomllib.loads(texts(found)[name])


def test_xml_json_and_zip_make_the_same_scenes(imported: Any) -> None:
    wanted = texts(imported(xml(b218())))
    assert list(wanted) == ["bearing_6.toml", "shaft_3.toml"]
    assert "spindle" in wanted["shaft_3.toml"]
    mark = b"\xef\xbb\xbf"
    for data in (
        *(json_text(b218()), zipped(xml(b218())), zipped(json_text(b218()), "a.rexsj"), xml(b218(), "\r\n")),
        *(mark + xml(b218()), mark + json_text(b218()), zipped(mark + xml(b218()))),
    ):
        assert texts(imported(data)) == wanted


def test_the_imported_b218_carries_what_the_catalogues_does(imported: Any) -> None:
    found = imported(xml(b218()))
    assert [each.lacks for each in found.files] == [[], []]
    scene = scene_or_set_of(tables(found, "bearing_6.toml"), "")
    point = {"speed_rpm": 10000, "axial_load_N": 17800, "tilt_y_mrad": 0, "tilt_z_mrad": 0,
             "radial_load_y_N": 0, "radial_load_z_N": 0}  # fmt: skip
    effects = {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"}
    own = qs.solve(scene)
    wanted = qs.solve(
        scene_or_set_of({"bearing": {"name": "B218"}, "operation": point, "effects": effects}, "")  # type: ignore[arg-type]
    )
    for side in ("inner", "outer"):
        assert np.abs(getattr(own, side).load - getattr(wanted, side).load).max() == 0.0
    assert np.abs(own.stiffness - wanted.stiffness).max() == 0.0
    turned = texts(imported(xml(b218(mirrored=True))))["bearing_6.toml"]
    assert turned == texts(found)["bearing_6.toml"]  # its u points the other way, and all that is said along it


@pytest.mark.parametrize("version", VERSIONS)
def test_each_version_has_its_own_names_and_units(imported: Any, version: str) -> None:
    model = b218(contacts=False)
    of = version_of(version)
    for component in model["components"]:
        renamed = {}
        for name, (unit, value) in component["attributes"].items():
            last = next(
                last for last, ids in _histories().items() if any(name in (each.name for each in one) for one in ids)
            )
            own = current(last, of)
            if own is not None and last not in ("thermal_expansion_coefficient_plus",):
                unit = own[1] if unit == current(last, (1, 4))[1] else unit  # type: ignore[index]
                renamed[own[0]] = (unit, value)
        component["attributes"] = renamed
    model["version"] = version
    wanted = tables(imported(xml(b218())), "bearing_6.toml")
    found = tables(imported(xml(model)), "bearing_6.toml")
    if version == "1.0":  # which has no positions of balls
        assert "first_ball_azimuth_deg" not in found["operation"]
    assert found == wanted


def test_a_gearbox_of_catalogue_and_concept_bearings_lists_what_it_lacks(imported: Any) -> None:
    found = imported(xml(gearbox()))
    assert texts(found) == texts(imported(json_text(gearbox())))
    assert [each.split(" (")[0] for each in found.not_ours] == [
        "component 5",
        "component 11",
        "component 12",
        "component 14",
    ]
    assert "radial_tapered_roller_bearing" in found.not_ours[2]
    lacks = {each.name: each.lacks for each in found.files}
    assert all(lacks.values())
    assert lacks["bearing_10_case_1.toml"][-1].startswith("readings.life: needs load ratings")
    said = "\n".join(lacks["shaft_3_case_2.toml"])
    for name in ("the forces of component 5", "component 11 (concept_bearing, spring)", "component 12", "component 14"):
        assert name in said
    assert "component 14" in "\n".join(lacks["shaft_4_case_1.toml"])
    with pytest.raises(SceneFileError, match=r"the forces of component 5") as refusal:
        scene_or_set_of(tables(found, "shaft_3_case_1.toml"), "")  # nobody solves it as it is
    assert {"rexs.missing"} == {each.key for each in refusal.value.errors}  # type: ignore[attr-defined]
    assert tables(found, "shaft_4_case_2.toml")["operation"]["speed_rpm"] == 0
    assert tables(found, "bearing_10_case_2.toml")["operation"]["speed_rpm"] == 2000
    assert [each.name for each in imported(xml(gearbox()), shaft="output").files] == [
        f"{kind}_case_{case}.toml" for case in (1, 2) for kind in ("bearing_13", "shaft_4")
    ]
    with pytest.raises(SceneFileError, match=r"Shafts of this model: 3 \(input\), 4 \(output\)"):
        imported(xml(gearbox()), shaft="middle")


def spindle() -> dict[str, Any]:
    """Two catalogue bearings back to back and one that floats, on a stepped shaft, with fits, temperatures and oil."""
    kind = "rolling_bearing_with_catalog_geometry"
    common = {"bearing_type": "angular_contact_ball_bearing", "catalogue_designation": "7210C"}
    warm = {"mean_operating_temperature_inner_ring": ("C", 50), "mean_operating_temperature_outer_ring": ("C", 40),
            "shaft_tolerance_class": "k5", "bearing_tolerance_class": "P5", "inner_diameter": ("mm", 50),
            "outer_diameter": ("mm", 90)}  # fmt: skip
    limits = {
        **{f"{end}_casing_bore_diameter": ("mm", 90 + by) for end, by in (("minimum", 0.0), ("maximum", 0.022))},
        **{f"{end}_bearing_outer_diameter": ("mm", 90 + by) for end, by in (("minimum", -0.015), ("maximum", 0.0))},
        **{f"{end}_shaft_diameter": ("mm", 50 + by) for end, by in (("minimum", 0.002), ("maximum", 0.013))},
        **{f"{end}_bearing_bore_diameter": ("mm", 50 + by) for end, by in (("minimum", -0.012), ("maximum", 0.0))},
        "casing_outer_diameter": ("mm", 150), "inner_diameter": ("mm", 50), "outer_diameter": ("mm", 90),
    }  # fmt: skip
    components = [
        part(1, "gear_casing", temperature_lubricant=("C", 60)), part(2, "shaft", rotational_speed=("1 / min", 3000)),
        part(3, "shaft_section", u_coordinate_on_shaft=("mm", 0), length=("mm", 100), outer_diameter_begin=("mm", 40),
             outer_diameter_end=("mm", 50)),
        part(4, "shaft_section", u_coordinate_on_shaft=("mm", 100), length=("mm", 200), outer_diameter_begin=("mm", 50),
             outer_diameter_end=("mm", 50), inner_diameter_begin=("mm", 10), inner_diameter_end=("mm", 10)),
        part(5, kind, "left", axial_force_absorption="positive", u_coordinate_on_shaft_inner_side=("mm", 110),
             preload_force=("kN", 0.4), **common, **warm),
        part(6, kind, "right", axial_force_absorption="negative", u_coordinate_on_shaft_inner_side=("mm", 150),
             **common, **limits),
        part(7, "external_load", u_coordinate_on_shaft=("mm", 0), force_v_direction=("N", 500),
             torque_around_w_axis=("N m", 2)),
        part(8, "lubricant", viscosity_at_40_degree_celsius=("mm^2 / s", 68),
             viscosity_at_100_degree_celsius=("mm^2 / s", 9)),
    ]  # fmt: skip
    relations = [("assembly", 0, {"assembly": 2, "part": at}) for at in (3, 4, 7)]
    relations += [("side", 0, {"assembly": at, "inner_part": 2, "outer_part": 1}) for at in (6, 5)]
    relations += [("reference", 0, {"origin": 1, "referenced": 8})]
    return {"version": "1.5", "components": components, "relations": relations, "load_cases": []}


def test_a_spindle_becomes_a_set_on_an_elastic_shaft(imported: Any) -> None:
    found = imported(xml(spindle()))
    shaft = tables(found, "shaft_2.toml")
    assert [each.lacks for each in found.files if each.name == "shaft_2.toml"] == [[]]
    assert [(row["position_mm"], row["carries"]) for row in shaft["rows"]] == [(110, "+x"), (150, "-x")]
    sections = shaft["shaft"]["sections"]
    assert [(each["length_mm"], each["outer_diameter_mm"], each.get("end_outer_diameter_mm")) for each in sections] == [
        (100, 40, 50), (200, 50, None),
    ]  # fmt: skip
    assert [each.get("inner_diameter_mm") for each in sections] == [None, 10]
    assert shaft["shaft"]["loads"] == [{"position_mm": 0, "radial_y_N": 500, "moment_z_Nm": 2}]
    assert (shaft["preload"], shaft["operation"]["moment_z_Nm"]) == ({"rigid_N": 400}, 0)
    assert shaft["rexs"] == {"bearings": [5, 6], "shaft": 2}
    rings = shaft["rows"][0]["ring_expansion"]
    assert (rings["shaft_fit"], rings["tolerance_class"], rings["inner_ring_temperature_C"]) == ("k5", "P5", 50)
    rings = shaft["rows"][1]["ring_expansion"]
    assert (rings["shaft_interference_um"], rings["housing_interference_um"]) == pytest.approx((13.5, -18.5), rel=1e-9)
    assert rings["housing_outside_diameter_mm"] == 150
    assert [row["bearing"].get("ball_material") for row in shaft["rows"]] == [None, None]  # that of the designation
    assert shaft["readings"]["lubricant"] == {
        "viscosity_at_40C_mm2_s": 68, "viscosity_at_100C_mm2_s": 9, "oil_temperature_C": 60,
    }  # fmt: skip
    rigid = copy.deepcopy(spindle())
    rigid["relations"] = [each for each in rigid["relations"] if each[2].get("part") not in (3, 4)]
    (found,) = (each for each in imported(xml(rigid)).files if each.name == "shaft_2.toml")
    stiff = tomllib.loads(found.text)["shaft"]
    assert (found.lacks, "sections" in stiff, stiff["loads"]) == ([], False, shaft["shaft"]["loads"])
    gap = copy.deepcopy(spindle())
    gap["components"][3]["attributes"]["u_coordinate_on_shaft"] = ("mm", 101)
    lacks = next(each.lacks for each in imported(xml(gap)).files if each.name == "shaft_2.toml")
    assert "a gap of 1 mm before component 4" in lacks[0]


def test_an_oil_is_read_with_its_density_and_left_out_without_both_viscosities(imported: Any) -> None:
    """One viscosity makes no oil, whatever else is told of it."""
    model = spindle()
    oil = model["components"][7]["attributes"]
    oil["density_at_15_degree_celsius"] = ("kg / m^3", 900)
    assert tables(imported(xml(model)), "shaft_2.toml")["readings"]["lubricant"] == {
        "viscosity_at_40C_mm2_s": 68, "viscosity_at_100C_mm2_s": 9, "oil_temperature_C": 60, "oil_density_kg_m3": 900,
    }  # fmt: skip
    for name in [name for name in oil if name.startswith("viscosity")]:
        lacking = copy.deepcopy(model)
        del lacking["components"][7]["attributes"][name]
        assert "lubricant" not in tables(imported(xml(lacking)), "shaft_2.toml")["readings"]


def test_lengths_hold_at_the_temperature_of_the_gear_unit(imported: Any) -> None:
    def reference(model: dict[str, Any]) -> float:
        rows: list[dict[str, Any]] = tables(imported(xml(model)), "shaft_2.toml")["rows"]
        return float(rows[0]["ring_expansion"]["reference_temperature_C"])

    model = spindle()
    assert reference(model) == 20
    model["components"].append(part(9, "gear_unit", reference_temperature=("C", 25)))
    assert reference(model) == 25


def test_arrays_in_base64_read_as_plain_ones(imported: Any) -> None:
    wanted = texts(imported(xml(b218(mirrored=True))))
    for code, kind in (("float64", "<f8"), ("float32", "<f4"), ("int32", "<i4")):
        data = base64.b64encode(np.array([-1.0, 0.0, 0.0]).astype(kind).tobytes()).decode()
        text = xml(b218(mirrored=True)).decode()
        plain = "<array><c>-1.0</c><c>0.0</c><c>0.0</c></array>"
        assert plain in text
        coded = f'<array code="{code}">\n {data[:6]}\n {data[6:]}\n</array>'
        assert texts(imported(text.replace(plain, coded).encode())) == wanted


def test_loads_that_stand_as_results_are_taken_where_the_shaft_has_others_to_carry_it(imported: Any) -> None:
    model = b218()
    model["components"].append(part(9, "concept_bearing"))
    model["relations"].append(("side", 0, {"assembly": 9, "inner_part": 3, "outer_part": 2}))
    bearing = next(each for each in model["components"] if each["type"] == ROLLING)
    found = tables(imported(xml(model)), "bearing_6.toml")
    assert set(found["operation"]) == {"speed_rpm"}  # nothing tells its load: none is made up
    for axis, value in zip("uvw", (-2.5, 0.5, 0.0), strict=True):
        bearing["attributes"][f"force_acting_on_inner_component_{axis}"] = ("kN", value)
    bearing["attributes"]["angular_deflection_in_w"] = ("rad", 1e-4)
    bearing["attributes"]["angular_deflection_in_v"] = ("rad", 0.0)
    operation = tables(imported(xml(model)), "bearing_6.toml")["operation"]
    assert (operation["axial_load_N"], operation["radial_load_y_N"], operation["tilt_z_mrad"]) == (2500, -500, 0.1)


def beside(model: dict[str, Any], kind: str, role: str, **attributes: Any) -> dict[str, Any]:
    """The model with one more component on its shaft."""
    model["components"].append(part(9, kind, **attributes))
    kinds = {"part": ("assembly", 0, {"assembly": 3, "part": 9})}
    model["relations"].append(kinds.get(role) or ("side", 0, {"assembly": 9, role: 3, "outer_part": 2}))
    return model


BALLS = {"bearing_type": "angular_contact_ball_bearing", "catalogue_designation": "7210C"}
ROLLERS = {"bearing_type": "radial_tapered_roller_bearing"}
OTHERS: dict[str, Any] = {
    "another ball bearing": (ROLLING, "inner_part", BALLS), "rollers": (ROLLING, "inner_part", ROLLERS),
    "a spring": ("concept_bearing", "inner_part", {}), "a gear": ("cylindrical_gear", "part", {}),
    "a coupling": ("coupling", "part", {}),
    "what nobody knows": ("custom_thing", "part", {}),
}  # fmt: skip
"""What may bear on a shaft beside a bearing of it."""


@pytest.mark.parametrize("preload", [{}, {"preload_force": ("N", 500)}])
@pytest.mark.parametrize("other", OTHERS)
def test_a_bearing_that_shares_its_shaft_is_not_solved_without_its_load(
    imported: Any, other: str, preload: dict[str, Any]
) -> None:
    """With a preload it would run and have a life, which is not that of the system."""
    kind, role, attributes = OTHERS[other]
    model = beside(b218(), kind, role, **attributes)
    bearing = next(each for each in model["components"] if each["id"] == 6)
    bearing["attributes"] |= preload
    found = imported(xml(model))
    own = tables(found, "bearing_6.toml")
    (lacks,) = (each.lacks for each in found.files if each.name == "bearing_6.toml")
    assert lacks == own["rexs"]["missing"]
    assert "which shares component 3" in lacks[0] and "`qsbearing run shaft_3.toml` prints it" in lacks[0]
    assert "preload" not in own and set(own["operation"]) == {"speed_rpm"}
    with pytest.raises(SceneFileError):
        scene_or_set_of(own, "")


@pytest.mark.parametrize("given", [True, False])
def test_a_preload_is_all_where_nothing_else_bears_on_the_shaft(imported: Any, given: bool) -> None:
    model = b218()
    bearing = next(each for each in model["components"] if each["id"] == 6)
    bearing["attributes"] |= {"preload_force": ("N", 500)} if given else {}
    model["components"] = [each for each in model["components"] if each["type"] != "external_load"]
    model["relations"] = [each for each in model["relations"] if 5 not in each[2].values()]
    (file,) = (each for each in imported(xml(model)).files if each.name == "bearing_6.toml")
    assert tomllib.loads(file.text).get("preload") == ({"rigid_N": 500.0} if given else None)
    assert "missing" not in tomllib.loads(file.text)["rexs"] and bool(file.lacks) != given


def test_the_table_of_the_origin_is_read_as_strictly_as_others(imported: Any) -> None:
    wanted = tables(imported(xml(b218())), "bearing_6.toml")
    for wrong, said in (
        (3, "is not a table"),
        ({"bearing": [6]}, "unknown key"),
        ({"missing": ["a", "b"]}, "2 errors"),
    ):
        with pytest.raises(SceneFileError, match=said):
            scene_or_set_of(wanted | {"rexs": wrong}, "")


def test_load_cases_have_files_of_their_own_and_with_shares_a_spectrum(imported: Any) -> None:
    model = b218()
    model["load_cases"] = [
        {1: {"load_duration_fraction": ("%", 20)}, 3: {"rotational_speed": ("1 / min", 500)}},
        {1: {"operating_time_fraction": ("%", 80)}, 5: {"force_u_direction": ("kN", 3.0)}},
    ]
    found = imported(xml(model))
    points = [tables(found, f"bearing_6_case_{number}.toml")["operation"] for number in (1, 2)]
    assert [(each["speed_rpm"], each["axial_load_N"]) for each in points] == [(500, 17800), (10000, 3000)]
    assert tables(found, "bearing_6_case_2.toml")["rexs"]["load_case"] == 2
    whole = tables(found, "bearing_6_spectrum.toml")
    assert whole["spectrum"] == [{"share": 0.2, **points[0]}, {"share": 0.8, **points[1]}]
    scene = scene_or_set_of(whole, "")
    assert scene.readings["spectrum"]["time_share"].tolist() == [0.2, 0.8]
    model["load_cases"][0][1] = {}
    assert "bearing_6_spectrum.toml" not in texts(imported(xml(model)))


def loaded_spindle() -> dict[str, Any]:
    """The spindle under two load cases, in which one external load changes and the other has its own directions."""
    model = spindle()
    model["components"] += [part(9, "gear_unit"), part(10, "external_load", u_coordinate_on_shaft=("mm", 250))]
    model["relations"].append(("assembly", 0, {"assembly": 2, "part": 10}))
    model["load_cases"] = [
        {9: {"operating_time_fraction": ("%", 25)}, 2: {"rotational_speed": ("1 / min", 6000)},
         10: {"force_u_direction": ("N", 300)}},
        {9: {"operating_time_fraction": ("%", 75)}, 7: {"force_v_direction": ("N", 100)}},
    ]  # fmt: skip
    return model


def test_the_load_cases_of_a_shaft_are_points_of_its_set(imported: Any) -> None:
    found = imported(xml(loaded_spindle()))
    whole = tables(found, "shaft_2_spectrum.toml")
    assert "load_case" not in whole["rexs"] and "bearing_5_spectrum.toml" not in texts(found)
    solved = qs.solve_set(scene_or_set_of(whole, ""))  # type: ignore[arg-type]
    for number, share in ((1, 0.25), (2, 0.75)):
        own = qs.solve_set(scene_or_set_of(tables(found, f"shaft_2_case_{number}.toml"), ""))  # type: ignore[arg-type]
        at = number - 1
        assert whole["spectrum"][at]["share"] == share
        for row, alone in zip(solved.rows, own.rows, strict=True):
            assert np.allclose(row.load[at], alone.load, rtol=1e-9, atol=1e-6)


def test_load_cases_that_differ_in_what_no_point_can_have_are_told(imported: Any) -> None:
    """The distance of a support makes another set, and a shaft that is turned in one case alone has another key."""
    model = loaded_spindle()
    model["load_cases"][0][10] |= {"u_coordinate_on_shaft": ("mm", 260)}
    found = imported(xml(model))
    assert "shaft_2_spectrum.toml" not in texts(found)
    (told,) = [each for each in found.remarks if "no load spectrum" in each]
    assert "its load cases differ in shaft.loads.2.position_mm" in told


CONTROLS = [chr(code) for code in (*range(1, 32), 0x7F, 0x85, 0x2028, 0x2029, 0x202E)]


def test_no_name_writes_lines_of_the_model(imported: Any) -> None:
    """Of every component, with every control character that JSON can hold; all is read back as it is written."""
    wanted = imported(json_text(loaded_spindle()))
    model = loaded_spindle()
    for each in model["components"]:
        if "catalogue_designation" in each["attributes"]:
            each["attributes"]["radial_clearance_class"] = ("none", "C3" + CONTROLS[0])
        each["name"] = "".join(f"{control}[note]{control}#" for control in CONTROLS) + "\"'\\"
    found = imported(json_text(model))
    assert [each.name for each in found.files] == [each.name for each in wanted.files]
    for each, same in zip(found.files, wanted.files, strict=True):
        plain, other = tomllib.loads(each.text), tomllib.loads(same.text)
        for one in (plain, other):
            one["rexs"].pop("missing", None)
        assert plain == other
        assert not any(control in each.text for control in CONTROLS if control != "\n")


def test_a_text_that_is_read_as_something_else_is_not_written(imported: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        importing, "text_of", lambda table: text_of(table).replace("ball_count = 16", "ball_count = 15")
    )
    with pytest.raises(SceneFileError, match="its text is read as something else"):
        imported(xml(b218()))


def double_row(version: str = "1.4") -> dict[str, Any]:
    """The model of one B218 made one of two rows, back to back, at 12 mm and 40 mm apart; its u against the shaft's."""
    model = b218(version, contacts=False, mirrored=True)
    for each in model["components"]:
        if each["type"] == ROLLING:
            each["attributes"] |= {"number_of_bearing_rows": ("none", 2), "distance_between_bearing_rows": ("mm", 40),
                                   "axial_force_absorption": ("none", "both_directions")}  # fmt: skip
        if each["type"] == "rolling_bearing_row":
            each["attributes"]["axial_force_absorption_of_row"] = ("none", "positive")
            second = copy.deepcopy(each) | {"id": 70}
            second["attributes"]["axial_force_absorption_of_row"] = ("none", "negative")
    ball = part(71, "rolling_element", diameter_of_rolling_element=("mm", 22.225))
    model["components"] += [second, ball]
    model["relations"] += [("ordered_assembly", 2, {"assembly": 6, "part": 70}),
                           ("ordered_assembly", 1, {"assembly": 70, "part": 71})]  # fmt: skip
    return model


def test_a_bearing_of_two_rows_is_a_set(imported: Any) -> None:
    found = imported(xml(double_row()))
    assert [each.lacks for each in found.files] == [[], []]
    for name in ("bearing_6.toml", "shaft_3.toml"):
        rows = tables(found, name)["rows"]
        assert [(row["position_mm"], row["carries"]) for row in rows] == [(32, "-x"), (-8, "+x")]
        assert tables(found, name)["rexs"]["bearings"] == [6, 6]


@pytest.mark.parametrize(
    ("absorbs", "carries"),
    [("no_direction", "none"), ("both_directions", "both"), ("positive", "+x"), ("negative", "-x"), (None, "both")],
)
def test_how_a_deep_groove_bearing_is_held(imported: Any, absorbs: str | None, carries: str) -> None:
    """As the model says it; where it does not, located, which is said."""
    model = spindle()
    own = model["components"][5]["attributes"]
    own["bearing_type"] = ("none", "radial_grooved_ball_bearing")
    own.pop("axial_force_absorption")
    if absorbs is not None:
        own["axial_force_absorption"] = ("none", absorbs)
    found = imported(xml(model))
    assert tables(found, "shaft_2.toml")["rows"][1]["carries"] == carries
    assert "floating" not in tables(found, "shaft_2.toml")
    text = next(each.text for each in found.files if each.name == "shaft_2.toml")
    assert ("assumed: the model does not say how its outer ring is held" in text) == (absorbs is None)


def test_an_angular_contact_bearing_that_carries_no_axial_load_floats(imported: Any) -> None:
    model = spindle()
    model["components"][5]["attributes"]["axial_force_absorption"] = ("none", "no_direction")
    assert tables(imported(xml(model)), "shaft_2.toml")["floating"] == [{"rows": [2]}]
