"""Scene files: what a file says becomes the scene, and every error of one is found, at once, in the file's words."""

from __future__ import annotations

import dataclasses
import re
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files import bearing_table, effects_table, table_checks
from qsbearing.files import keys as scene_keys
from qsbearing.files.file_keys import sections
from qsbearing.files.scene_file import load_scene
from qsbearing.files.usual_words import WORDS

BEARING = {
    "ball_count": "16",
    "ball_diameter_mm": "22.225",
    "pitch_diameter_mm": "125.26",
    "inner_groove_radius_mm": "11.6281",
    "outer_groove_radius_mm": "11.6281",
    "free_contact_angle_deg": "40.0",
    "ball_material": '"steel"',
    "ring_material": '"steel"',
}
OPERATION = {"speed_rpm": "10000", "axial_load_N": "8000"}
EFFECTS = {"ball": '["centrifugal_force", "gyroscopic_moment"]', "raceway_control": '"outer"'}


def scene_text(
    bearing: dict[str, str | None] | None = None,
    operation: dict[str, str | None] | None = None,
    effects: dict[str, str | None] | None = None,
) -> str:
    """A good scene file with some keys replaced, added, or (None) taken away."""
    lines = []
    for name, good, change in (
        ("bearing", BEARING, bearing),
        ("operation", OPERATION, operation),
        ("effects", EFFECTS, effects),
    ):
        lines.append(f"[{name}]")
        lines += [f"{key} = {value}" for key, value in {**good, **(change or {})}.items() if value is not None]
    return "\n".join(lines) + "\n"


@pytest.fixture
def load(tmp_path: Path) -> Any:
    """Load a scene from text or bytes."""

    def from_text(content: str | bytes) -> qs.Scene:
        file = tmp_path / "scene.toml"
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
        return load_scene(file)

    return from_text


@pytest.fixture
def errors(load: Any) -> Any:
    """The errors of a text, by key."""

    def of(content: str | bytes) -> dict[str, qs.FileErrorDetail]:
        with pytest.raises(qs.SceneFileError) as caught:
            load(content)
        by_key = {error.key: error for error in caught.value.errors}
        assert len(by_key) == len(caught.value.errors), "one key, one error"
        for error in caught.value.errors:
            assert str(error) in str(caught.value)
        return by_key

    return of


# What a good file becomes -------------------------------------------------------------------------------------------


def test_every_key_arrives_in_si_under_its_python_name(load: Any) -> None:
    scene = load(
        scene_text(
            {
                "kind": '"deep_groove"',
                "ball_material": "{elastic_modulus_GPa = 315, poisson_ratio = 0.26, density_kg_m3 = 3200, "
                "thermal_expansion_per_K = 3.2e-6}",
            },
            {
                "outer_speed_rpm": "-500",
                "axial_load_N": None,
                "axial_displacement_um": "12.5",
                "radial_load_y_N": "4000",
                "radial_displacement_z_um": "-3",
                "moment_y_Nm": "7",
                "tilt_z_mrad": "0.25",
                "first_ball_azimuth_deg": "11.25",
            },
            {"raceway_control": '"per_ball"', "moment_shares": '"harris"', "hertz_angle": '"actual"'}
            | {"hertz_form": '"brewe_hamrock_1977"', "tilt_lever": '"pitch_circle"'}
            | {"ball_expansion": "{ball_temperature_C = 60.5, reference_temperature_C = 15}"}
            | {
                "ring_expansion": "{bore_diameter_mm = 90, outside_diameter_mm = 160, shaft_interference_um = 20, "
                "shaft_bore_diameter_mm = 30, shaft_material = 'steel', shaft_temperature_C = 65, "
                "inner_ring_temperature_C = 70, outer_ring_temperature_C = 60, housing_interference_um = -5, "
                "housing_outside_diameter_mm = 200, housing_temperature_C = 50, "
                "housing_material = {elastic_modulus_GPa = 70, poisson_ratio = 0.33, density_kg_m3 = 2700, "
                "thermal_expansion_per_K = 23e-6}, "
                "reference_temperature_C = 15, yield_strength_MPa = 1800}"
            },
        )
    )
    bearing, operation = scene.bearing, scene.operation
    assert (bearing.ball_count, bearing.kind) == (16, qs.BearingKind.DEEP_GROOVE)
    assert bearing.ball_diameter == pytest.approx(0.022225, rel=1e-15)
    assert bearing.pitch_diameter == pytest.approx(0.12526, rel=1e-15)
    assert bearing.inner_groove_radius == pytest.approx(0.0116281, rel=1e-15)
    assert bearing.outer_groove_radius == pytest.approx(0.0116281, rel=1e-15)
    assert bearing.free_contact_angle == pytest.approx(40 * pi / 180, rel=1e-15)
    ball = bearing.ball_material
    assert (ball.elastic_modulus, ball.poisson_ratio, ball.density) == (315e9, 0.26, 3200)
    assert ball.thermal_expansion == 3.2e-6
    assert bearing.ring_material == qs.STEEL
    assert operation.speed == pytest.approx(10000 * pi / 30, rel=1e-15)
    assert operation.outer_speed == pytest.approx(-500 * pi / 30, rel=1e-15)
    assert operation.axial_load is None
    assert operation.axial_displacement == pytest.approx(12.5e-6, rel=1e-15)
    assert operation.radial_load_y == 4000
    assert operation.radial_displacement_z == pytest.approx(-3e-6, rel=1e-15)
    assert operation.moment_y == 7
    assert operation.tilt_z == pytest.approx(0.25e-3, rel=1e-15)
    assert operation.first_ball_azimuth == pytest.approx(11.25 * pi / 180, rel=1e-15)
    assert scene.ball_effects == (qs.CentrifugalForce(), qs.GyroscopicMoment(qs.MomentShares.HARRIS))
    assert scene.raceway_control is qs.RacewayControl.PER_BALL
    assert scene.hertz_angle is qs.HertzAngle.ACTUAL
    assert scene.hertz_form is qs.HertzForm.BREWE_HAMROCK_1977
    assert scene.tilt_lever is qs.TiltLever.PITCH_CIRCLE
    rings, balls = scene.ring_effects
    assert (rings.name, balls.name) == ("ring_expansion", "ball_expansion")
    assert balls.ball_temperature == pytest.approx(333.65, rel=1e-15)
    assert balls.reference_temperature == rings.reference_temperature == pytest.approx(288.15, rel=1e-15)
    assert (rings.bore_diameter, rings.outside_diameter) == pytest.approx((0.09, 0.16), rel=1e-15)
    assert (rings.shaft_interference, rings.housing_interference) == pytest.approx((20e-6, -5e-6), rel=1e-15)
    assert (rings.shaft_bore_diameter, rings.housing_outside_diameter) == pytest.approx((0.03, 0.2), rel=1e-15)
    assert (rings.shaft_temperature, rings.housing_temperature) == pytest.approx((338.15, 323.15), rel=1e-15)
    warm = (rings.inner_ring_temperature, rings.outer_ring_temperature)
    assert warm == pytest.approx((343.15, 333.15), rel=1e-15)
    assert rings.shaft_material == qs.STEEL
    assert rings.housing_material == qs.Material(70e9, 0.33, 2700.0, 23e-6)
    assert rings.yield_strength == pytest.approx(1.8e9, rel=1e-15)


def test_every_number_of_python_has_a_key_and_every_key_a_place() -> None:
    operation = {field.name for field in dataclasses.fields(qs.Operation)}
    assert {key.field for key in scene_keys.OPERATION} == operation
    bearing = {field.name for field in dataclasses.fields(qs.BallBearing)} - {"ball_material", "ring_material"}
    # A radial interference is a negative clearance in a file. The outline is printed numbers, and so is a data sheet.
    numbers = bearing - {"kind", "name", "radial_interference", "outline", "inferred"} | {
        "diametral_clearance",
        "axial_clearance",
    }
    assert {key.field for key in scene_keys.BEARING} == numbers
    models = (bearing_table._BEARING, table_checks._form(qs.Operation), effects_table._EFFECTS)
    for model, section in zip(models, ("bearing", "operation", "effects"), strict=True):
        elsewhere = {*scene_keys.EFFECT_TABLES, "traction"}
        assert set(model.checks) == set(scene_keys.SECTIONS[section]) - elsewhere
    law = {field.name for field in dataclasses.fields(qs.Traction)} - {"law", "has_curvature"}
    assert {key.field for key in (*scene_keys.TRACTION, scene_keys.FRICTION_RANGE)} == law
    for effect, keys in ((qs.RingExpansion, scene_keys.RING_EXPANSION), (qs.BallExpansion, scene_keys.BALL_EXPANSION)):
        fields = {field.name for field in dataclasses.fields(effect) if field.init}
        fields -= {*scene_keys.SEAT_MATERIALS, *scene_keys.SEAT_FITS}
        assert {key.field for key in keys} == fields
    assert {field.name for field in dataclasses.fields(qs.Material)} - {"name", "source"} == {
        key.field for key in scene_keys.MATERIAL
    }


def test_without_effects_the_scene_is_static(load: Any) -> None:
    text = scene_text(effects={"ball": None, "raceway_control": None})
    for form in (text, text.replace("[effects]\n", ""), text + "ball = []\n"):
        scene = load(form)
        assert scene.ball_effects == ()
        assert scene.raceway_control is None
        assert scene.hertz_angle is qs.HertzAngle.FREE


def test_clearance_defines_the_angle(load: Any) -> None:
    scene = load(scene_text({"free_contact_angle_deg": None, "diametral_clearance_mm": "0.4826"}))
    # cos(alpha0) = 1 - Pd/(2 BD); the 218 bearing of the literature.
    expected = np.arccos(1 - 0.4826 / (2 * (2 * 11.6281 - 22.225)))
    assert scene.bearing.free_contact_angle == pytest.approx(expected, rel=1e-12)
    assert scene.bearing.free_contact_angle / qs.deg == pytest.approx(40.004, abs=5e-4)


def test_a_negative_clearance_wedges_the_balls(load: Any) -> None:
    bearing = load(scene_text({"free_contact_angle_deg": None, "diametral_clearance_mm": "-0.02"})).bearing
    assert bearing.free_contact_angle == 0.0
    assert bearing.radial_interference == pytest.approx(10 * qs.um, rel=1e-12)
    assert bearing.diametral_clearance == pytest.approx(-20 * qs.um, rel=1e-12)


RACEWAYS = {"inner_raceway_diameter_mm": "102.7938", "outer_raceway_diameter_mm": "147.7264"}
"""Of the 218 bearing of the literature, of 0.4826 mm clearance."""
BY_RACEWAYS = {"free_contact_angle_deg": None, "pitch_diameter_mm": None, **RACEWAYS}


def test_raceway_diameters_make_clearance_and_pitch(load: Any) -> None:
    bearing = load(scene_text(BY_RACEWAYS)).bearing
    assert bearing.diametral_clearance == pytest.approx(0.4826 * qs.mm, rel=1e-9)
    assert bearing.pitch_diameter == pytest.approx(0.5 * (102.7938 + 147.7264) * qs.mm, rel=1e-12)
    unequal = {"outer_groove_radius_mm": "11.9", "inner_raceway_diameter_mm": "103.2", "ball_diameter_mm": "22.225"}
    for given in (BY_RACEWAYS, BY_RACEWAYS | unequal, BY_RACEWAYS | {"inner_raceway_diameter_mm": "103.3"}):
        made = load(scene_text(given)).bearing
        bottom = 2 * (made.inner_groove_centre_radius - made.inner_groove_radius)
        outer = 2 * (made.outer_groove_centre_radius + made.outer_groove_radius)
        assert bottom == pytest.approx(float(given["inner_raceway_diameter_mm"]) * qs.mm, rel=1e-12)
        assert outer == pytest.approx(float(given["outer_raceway_diameter_mm"]) * qs.mm, rel=1e-12)
    wider = load('[bearing]\nname = "B218"\ninner_raceway_diameter_mm = 102.7\nouter_raceway_diameter_mm = 147.7264\n'
                 "[operation]\naxial_load_N = 1000\n").bearing  # fmt: skip
    assert wider.diametral_clearance == pytest.approx(0.5764 * qs.mm, rel=1e-9)


def test_raceway_diameters_that_say_too_little_or_too_much(errors: Any) -> None:
    one = errors(scene_text({**BY_RACEWAYS, "outer_raceway_diameter_mm": None}))
    assert list(one) == ["bearing.outer_raceway_diameter_mm"]
    twice = errors(scene_text(RACEWAYS))
    assert set(twice) == {"bearing.pitch_diameter_mm", "bearing.free_contact_angle_deg"}
    far = errors(scene_text({**BY_RACEWAYS, "inner_raceway_diameter_mm": "112"}))
    assert far["bearing.diametral_clearance_mm"].note == "from the raceway diameters"


def test_angle_and_clearance_that_agree_within_their_digits(load: Any) -> None:
    for angle, clearance in (("40", "0.4826"), ("40.0", "0.4835"), ("40.004", "0.4826"), ("15.0", "0.0703")):
        scene = load(scene_text({"free_contact_angle_deg": angle, "diametral_clearance_mm": clearance}))
        assert scene.bearing.free_contact_angle == pytest.approx(float(angle) * qs.deg, rel=1e-15)


@pytest.mark.parametrize(
    ("angle", "clearance"), [("40.0", "0.4870"), ("40", "0.50"), ("40.0", "0.478"), ("40.0", "-0.4826")]
)
def test_angle_and_clearance_that_disagree(errors: Any, angle: str, clearance: str) -> None:
    found = errors(scene_text({"free_contact_angle_deg": angle, "diametral_clearance_mm": clearance}))
    assert list(found) == ["bearing.diametral_clearance_mm"]
    text = str(found["bearing.diametral_clearance_mm"])
    assert "free_contact_angle_deg = 40" in text
    assert "0.4825" in text, "the clearance that the angle makes"


def test_a_catalogue_entry_and_what_overrides_it(load: Any) -> None:
    plain = load('[bearing]\nname = "b218"\n[operation]\naxial_load_N = 1000\n')
    assert plain.bearing.name == "B218"
    assert plain.bearing.ball_count == 16
    changed = load('[bearing]\nname = "B218"\nball_count = 12\n[operation]\naxial_load_N = 1000\n')
    assert changed.bearing.ball_count == 12
    assert changed.bearing.pitch_diameter == plain.bearing.pitch_diameter
    assert changed.bearing.name == "B218, modified"


def test_a_given_clearance_replaces_the_entrys_angle_and_the_reverse(load: Any) -> None:
    wider = load('[bearing]\nname = "B218"\ndiametral_clearance_mm = 0.6\n[operation]\naxial_load_N = 1000\n')
    assert wider.bearing.diametral_clearance == pytest.approx(0.6e-3, rel=1e-12)
    angled = load('[bearing]\nname = "ISO16281_7ball"\nfree_contact_angle_deg = 12\n[operation]\naxial_load_N = 1\n')
    assert angled.bearing.free_contact_angle == pytest.approx(12 * qs.deg, rel=1e-15)


def test_the_bearing_without_a_catalogue_name_is_called_after_its_file(load: Any) -> None:
    assert load(scene_text()).bearing.name == "scene"


def test_a_bearing_of_one_s_own_has_the_name_that_its_file_gives(load: Any) -> None:
    assert load(scene_text({"name": '"Front spindle\\u001b[31m"'})).bearing.name == "Front spindle\\x1b[31m"
    with pytest.raises(qs.SceneFileError) as caught:
        load(scene_text({"name": '"Front spindle"', "ball_count": None, "ring_material": None}))
    assert "A bearing of your own may have a name, but needs ball_count, ring_material, too" in str(caught.value)


def test_built_in_examples_by_name_in_capitals_or_not() -> None:
    assert load_scene("b218").bearing == load_scene("B218").bearing
    assert qs.load_scene is load_scene


def test_a_file_goes_before_an_example_of_that_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "b218").write_text(scene_text({"ball_count": "9"}))
    assert load_scene("b218").bearing.ball_count == 9


def test_a_byte_order_mark_and_windows_line_ends_are_no_error(load: Any) -> None:
    text = scene_text().replace("\n", "\r\n")
    assert load(b"\xef\xbb\xbf" + text.encode()).bearing.ball_count == 16


# Files that are no scene --------------------------------------------------------------------------------------------


def refusal(source: str | Path) -> str:
    with pytest.raises(qs.SceneFileError) as caught:
        load_scene(source)
    assert isinstance(caught.value, qs.SceneError)
    return str(caught.value)


def test_unknown_names_and_missing_files(tmp_path: Path) -> None:
    assert "Did you mean B218?" in refusal("b219")
    assert "The catalogue holds 7210C, " in refusal("zzzz")
    assert "no such file" in refusal(tmp_path / "none.toml")
    assert "run by name, without .toml" in refusal(str(tmp_path / "b218.toml"))
    assert "folder" in refusal(tmp_path)
    assert "neither a file nor" in refusal("")
    assert refusal("a\0b")
    assert refusal("x" * 5000)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is empty"),
        (b" \n\t\n", "is empty"),
        (b'[bearing]\nname = "B218\xff"', "is not UTF-8 text (byte 23, line 2)"),
        ("[bearing]".encode("utf-16"), "UTF-16"),
        (b"# R\xe4der\n[bearing]\n", "Saved as Latin-1 (ANSI)? Save it again as UTF-8"),
        (b"[operation]\n[bearing]\n[operation]\n", "This table is in the file already: put all its keys in one place"),
        (b"[bearing]\nball_diameter_mm = 22.225\n", "bearing.pitch_diameter_mm: missing\n    A number in mm"),
        (b"[bearing]\nball_count 16\n", "line 2: ball_count 16"),
        (b'[bearing]\nname = "B218"\nname = "B218"\n', "line 3"),
        (b"[bearing]\nball_diameter_mm = -12,75  # Komma\n", "Decimals take a point: -12.75"),
        (
            b"[operation]\nspeed_rpm = 22,000\n",
            "Write 22000 (thousands take no comma) or 22.000, which is 22 (decimals take a point)",
        ),
        (b"[operation]\nspeed_rpm = 1,234.5 # rpm\n", "Thousands take no comma: 1234.5"),
        (b"[operation]\nspeed_rpm = 1,000,000\n", "Thousands take no comma: 1000000"),
        (b"[bearing]\nball_diameter_mm = 0,125\n", "Decimals take a point: 0.125"),
        (b"a = " + b"9" * 5000, "is not TOML"),
        (b"a = " + b"[" * 20000, "is not TOML"),
        (b"# " + b"x" * 1_000_001, "longer than 1 MB"),
        (b".".join([b"a"] * 20_000) + b" = 1\n", "more than 16 parts"),
        (b"a = {" + b" . ".join([b'"!"'] * 20_000) + b" = 1}\n", "more than 16 parts"),
        (b"[[" + b".".join([b"a"] * 20_000) + b"]]\n", "more than 16 parts"),
        (b"".join(b"k%d = 1\n" % k for k in range(10_001)), "has 10,001 keys; at most 10,000"),
        (b"".join(b"[k%d]\n" % k for k in range(10_001)), "has 10,001 keys; at most 10,000"),
    ],
    ids=lambda value: str(value)[:20],
)
def test_content_that_is_no_scene(load: Any, content: bytes, words: str) -> None:
    with pytest.raises(qs.SceneFileError, match=re.escape(words)):
        load(content)


def test_many_errors_are_counted_and_the_first_fifty_told(load: Any) -> None:
    """In any table; to look for what is meant by each would take a millisecond."""
    for table in ("", "[bearing]\n", "[readings]\n"):
        with pytest.raises(qs.SceneFileError) as raised:
            load((table + "".join(f"unknown{k} = 1\n" for k in range(9_000))).encode())
        told = str(raised.value).splitlines()
        count = len(raised.value.errors)
        assert count > 9_000
        assert told[0].endswith(f"{count} errors")
        assert told[-1] == f"... and {count - 50:,} more"
        assert len(told) <= 2 + 3 * 50
        searched = [error for error in raised.value.errors if error.problem == "unknown key" and error.cause]  # type: ignore[attr-defined]
        assert len(searched) <= 50


def test_what_is_no_key_is_not_counted_as_one(load: Any) -> None:
    """Comments with underlines, dots in numbers, text and lists."""
    comments = "# " + "=" * 70 + "\n" + "# a.b" * 20 + ".c" * 40 + "\n"
    deviations = ", ".join(["0.1"] * 16)
    text = '[bearing]\nname = "B218"\n[operation]\naxial_load_N = 1\n'
    text += f"[effects]\nball_diameter_deviations_um = [{deviations}]\n"
    assert load((comments * 200 + text).encode()).bearing.name == "B218"


def test_a_comma_elsewhere_is_no_decimal_comma(load: Any) -> None:
    for line in (b"x = [1, 2", b"x = 1,2,3", b'x = "1",5'):
        with pytest.raises(qs.SceneFileError) as raised:
            load(line + b"\n")
        assert "Decimals" not in str(raised.value)


# Structure ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", BEARING)
def test_missing_in_the_bearing(errors: Any, key: str) -> None:
    assert list(errors(scene_text({key: None}))) == [f"bearing.{key}"]


@pytest.mark.parametrize("key", ["elastic_modulus_GPa", "poisson_ratio", "density_kg_m3"])
def test_missing_in_a_material(errors: Any, key: str) -> None:
    numbers = {"elastic_modulus_GPa": 208, "poisson_ratio": 0.3, "density_kg_m3": 7800}
    del numbers[key]  # type: ignore[arg-type]
    table = "{" + ", ".join(f"{name} = {value}" for name, value in numbers.items()) + "}"
    assert list(errors(scene_text({"ring_material": table}))) == [f"bearing.ring_material.{key}"]


def test_missing_tables(errors: Any) -> None:
    assert set(errors("[effects]\nball = []\n")) == {"[bearing]", "[operation]"}
    found = errors('[bearing]\nname = "B218"\n')
    assert "axial_load_N = 1000" in found["[operation]"].cause


def test_an_operation_without_load_or_displacement(errors: Any) -> None:
    assert list(errors(scene_text(operation={"axial_load_N": None}))) == ["operation"]


@pytest.mark.parametrize(
    ("change", "key", "cause"),
    [
        ({"bearing": {"ball_diamter_mm": "22"}}, "bearing.ball_diamter_mm", "Did you mean ball_diameter_mm?"),
        ({"bearing": {"pitch_diameter": "125"}}, "bearing.pitch_diameter", "Did you mean pitch_diameter_mm?"),
        ({"bearing": {"speed_rpm": "1"}}, "bearing.speed_rpm", "It belongs under [operation]"),
        ({"bearing": {"xyzzy": "1"}}, "bearing.xyzzy", "Known here: name, kind, ball_count"),
        ({"bearing": {"Z": "16"}}, "bearing.Z", "Did you mean ball_count?"),
        ({"bearing": {"Dw": "22"}}, "bearing.Dw", "Did you mean ball_diameter_mm?"),
        ({"bearing": {"Dpw_mm": "125"}}, "bearing.Dpw_mm", "Did you mean pitch_diameter_mm?"),
        ({"bearing": {"pitch_dia": "125"}}, "bearing.pitch_dia", "Did you mean pitch_diameter_mm?"),
        ({"bearing": {"bore": "90"}}, "bearing.bore", "Did you mean bore_diameter_mm?"),
        ({"bearing": {"contact_angle": "40"}}, "bearing.contact_angle", "Did you mean free_contact_angle_deg?"),
        (
            {"bearing": {"fi": "1"}},
            "bearing.fi",
            "Did you mean inner_groove_radius_coefficient, the groove radius over",
        ),
        (
            {"bearing": {"outer_conformity": "1"}},
            "bearing.outer_conformity",
            "Did you mean outer_groove_radius_coefficient, the groove radius over",
        ),
        ({"bearing": {"osculation": "1"}}, "bearing.osculation", "Did you mean groove_radius_coefficient, the groove"),
        ({"bearing": {"rpm": "1"}}, "bearing.rpm", "Did you mean speed_rpm? It belongs under [operation]"),
        ({"operation": {"rpm": "1"}}, "operation.rpm", "Did you mean speed_rpm?"),
        ({"operation": {"preload_N": "1"}}, "operation.preload_N", "A preload has a table of its own: [preload]"),
        ({"operation": {"speed": "1"}}, "operation.speed", "Did you mean speed_rpm?"),
        ({"operation": {"axial_load_kN": '"1"'}}, "operation.axial_load_kN", "Did you mean axial_load_N?"),
        ({"operation": {"ball_count": "1"}}, "operation.ball_count", "It belongs under [bearing]"),
        ({"effects": {"raceway_contrl": '"outer"'}}, "effects.raceway_contrl", "Did you mean raceway_control?"),
    ],
)
def test_unknown_keys(errors: Any, change: dict[str, dict[str, str | None]], key: str, cause: str) -> None:
    found = errors(scene_text(**change))
    assert list(found) == [key]
    assert found[key].problem == "unknown key"
    assert found[key].cause.startswith(cause)


@pytest.mark.parametrize(
    ("wrong", "value", "key", "right"),
    [
        ("axial_load_kN", "8", "axial_load_N", "8000"),
        ("axial_load_kn", "8.5", "axial_load_N", "8500"),
        ("axial_load_lbf", "100", "axial_load_N", "444.8221615"),
        ("radial_load_y_kN", "-0.25", "radial_load_y_N", "-250"),
        ("speed_rad_s", "1000", "speed_rpm", "9549.296586"),
        ("speed_Hz", "50", "speed_rpm", "3000"),
        ("axial_displacement_mm", "0.02", "axial_displacement_um", "20"),
        ("tilt_z_deg", "0.1", "tilt_z_mrad", "1.745329252"),
        ("tilt_z_rad", "1e-3", "tilt_z_mrad", "1"),
        ("moment_z_Nmm", "4000", "moment_z_Nm", "4"),
        ("ball_diameter_um", "22225", "ball_diameter_mm", "22.225"),
        ("ball_diameter_in", "0.875", "ball_diameter_mm", "22.225"),
        ("free_contact_angle_rad", "0.5", "free_contact_angle_deg", "28.64788976"),
    ],
)
def test_a_number_in_another_unit_is_converted(errors: Any, wrong: str, value: str, key: str, right: str) -> None:
    section = "bearing" if key in BEARING else "operation"
    instead: dict[str, str | None] = {"axial_load_N": None} if key == "axial_displacement_um" else {}
    found = errors(scene_text(**{section: {wrong: value, **instead}}))
    found.pop("operation.moment_z_Nm", None)  # a radial load needs its tilt, whatever its unit
    assert list(found) == [f"{section}.{wrong}"]
    assert found[f"{section}.{wrong}"].cause.startswith(f"Did you mean {key} = {right}? (")


def test_every_usual_word_stands_for_a_key_that_there_is() -> None:
    keys = {key for keys in sections().values() for key in keys}
    assert {word.key for word in WORDS.values()} <= keys
    assert not keys & set(WORDS)


@pytest.mark.parametrize(
    ("value", "line", "cause"),
    [
        (
            "'22,225'",
            "= '22,225': is not a number",
            "A number in mm, without quotation marks. Write 22225 (thousands take no comma) or 22.225 "
            "(decimals take a point)",
        ),
        ("'22.225'", "= '22.225': is not a number", "A number in mm, without quotation marks"),
        ("true", "= true: is not a number", "A number in mm"),
    ],
)
def test_what_is_written_for_a_number(errors: Any, value: str, line: str, cause: str) -> None:
    found = errors(scene_text(bearing={"ball_diameter_mm": value}))["bearing.ball_diameter_mm"]
    assert found.cause == cause
    assert str(found).splitlines()[0] == f"bearing.ball_diameter_mm {line}"


def test_a_material_in_other_units(errors: Any) -> None:
    table = "{elastic_modulus_MPa = 208000, poisson_ratio = 0.3, density_g_cm3 = 7.8}"
    found = errors(scene_text({"ring_material": table}))
    assert len(found) == 2, "neither is missing as well"
    assert "elastic_modulus_GPa = 208?" in found["bearing.ring_material.elastic_modulus_MPa"].cause
    assert "density_kg_m3 = 7800?" in found["bearing.ring_material.density_g_cm3"].cause


@pytest.mark.parametrize(
    ("section", "key", "wrong"),
    [
        ("bearing", "ball_diameter_mm", "ball_diamter_mm"),
        ("bearing", "pitch_diameter_mm", "pitch_diameter"),
        ("bearing", "free_contact_angle_deg", "free_contact_angle"),
        ("operation", "axial_load_N", "axial_load_kN"),
        ("effects", "raceway_control", "raceway_contrl"),
        ("effects", "ball", "balls"),
    ],
)
def test_a_misspelt_key_is_one_error(errors: Any, section: str, key: str, wrong: str) -> None:
    good = {"bearing": BEARING, "operation": OPERATION, "effects": EFFECTS}[section]
    found = errors(scene_text(**{section: {key: None, wrong: good[key]}}))
    assert list(found) == [f"{section}.{wrong}"]
    assert f"Did you mean {key}" in found[f"{section}.{wrong}"].cause


def test_a_misspelt_table_is_one_error(errors: Any) -> None:
    for name in ("bearing", "operation", "effects"):
        assert list(errors(scene_text().replace(f"[{name}]", f"[{name}x]"))) == [f"[{name}x]"]


def test_unknown_tables_and_keys_outside_any(errors: Any) -> None:
    found = errors("speed_rpm = 3\nxyzzy = 1\n" + scene_text() + "[operatoin]\n[zzz]\n")
    assert found["speed_rpm"].cause == "It belongs under [operation]"
    assert found["[operatoin]"].cause == "Did you mean [operation]?"
    assert set(found) == {"speed_rpm", "xyzzy", "[operatoin]", "[zzz]"}


def test_a_table_that_is_none(errors: Any) -> None:
    assert list(errors("bearing = 3\n[operation]\naxial_load_N = 1\n")) == ["bearing"]
    assert list(errors('effects = "all"\n' + scene_text().partition("[effects]")[0])) == ["effects"]


NUMBERS = [
    *((f"bearing.{key}", key) for key in BEARING if not key.endswith("material")),
    ("operation.speed_rpm", "speed_rpm"),
    ("operation.axial_load_N", "axial_load_N"),
]


@pytest.mark.parametrize(("path", "key"), NUMBERS)
@pytest.mark.parametrize("value", ['"12"', "true", "[1, 2]", "{a = 1}", "2026-01-01", '""', "nan", "inf", "-inf"])
def test_values_that_are_no_number(errors: Any, path: str, key: str, value: str) -> None:
    section = path.partition(".")[0]
    found = errors(scene_text(**{section: {key: value}}))
    assert list(found) == [path]
    expected = "finite" if value in ("nan", "inf", "-inf") else "is not a number"
    assert expected in found[path].problem


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"bearing": {"ball_material": '"steal"'}}, "bearing.ball_material"),
        ({"bearing": {"ball_material": "3"}}, "bearing.ball_material"),
        ({"bearing": {"kind": '"angular"'}}, "bearing.kind"),
        ({"bearing": {"name": "218"}}, "bearing.name"),
        ({"bearing": {"name": '"B219"', "ball_count": None}}, "bearing.name"),
        ({"effects": {"ball": '"centrifugal_force"'}}, "effects.ball"),
        ({"effects": {"ball": '["centrifugal"]'}}, "effects.ball"),
        ({"effects": {"ball": "[1]"}}, "effects.ball"),
        ({"effects": {"raceway_control": '"outter"'}}, "effects.raceway_control"),
        ({"effects": {"moment_shares": "true"}}, "effects.moment_shares"),
        ({"effects": {"hertz_angle": '"fre"'}}, "effects.hertz_angle"),
        ({"effects": {"hertz_form": '"exakt"'}}, "effects.hertz_form"),
        ({"effects": {"tilt_lever": "0"}}, "effects.tilt_lever"),
    ],
)
def test_words_that_are_no_choice(errors: Any, change: dict[str, dict[str, str | None]], key: str) -> None:
    found = errors(scene_text(**change))
    assert list(found) == [key]
    value = next(iter(next(iter(change.values())).values()))
    if value in ('"steal"', '"outter"', '"fre"', '"exakt"', '["centrifugal"]', '"B219"'):
        assert "Did you mean" in found[key].cause


# Physics ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "key", "allowed", "cause"),
    [
        (
            {"ball_diameter_mm": "0.022225"},
            "ball_diameter_mm",
            (0.05, 1000),
            "Given in metres? 0.022225 metres = 22.225 mm",
        ),
        ({"ball_diameter_mm": "22225"}, "ball_diameter_mm", (0.05, 1000), "22225 micrometres = 22.225 mm"),
        ({"ball_diameter_mm": "-22.225"}, "ball_diameter_mm", (0.05, 1000), ""),
        ({"pitch_diameter_mm": "0.0126"}, "pitch_diameter_mm", (0.1, 20000), "Given in metres?"),
        ({"inner_groove_radius_mm": "0.0116281"}, "inner_groove_radius_mm", (0.025, 1000), "= 11.6281 mm"),
        ({"ball_count": "0"}, "ball_count", (1, 1000), ""),
        ({"ball_count": "15.5"}, "ball_count", (1, 1000), ""),
        ({"free_contact_angle_deg": "0.698"}, "free_contact_angle_deg", None, "0.698 rad = 39.992 deg"),
        ({"free_contact_angle_deg": "0.698"}, "free_contact_angle_deg", None, "give diametral_clearance_mm"),
        ({"free_contact_angle_deg": "698"}, "free_contact_angle_deg", (0, 85), "milliradians = 39.99"),
        ({"free_contact_angle_deg": "-40"}, "free_contact_angle_deg", (0, 85), ""),
        ({"outer_groove_radius_mm": "11.0"}, "outer_groove_radius_mm", (11.1125, 22.225), "touches at two edges"),
        ({"outer_groove_radius_mm": "23.2562"}, "outer_groove_radius_mm", (11.1125, 22.225), "diameter"),
        ({"pitch_diameter_mm": "62.8"}, "pitch_diameter_mm", (113.921, 20000), "larger pitch circle"),
        ({"pitch_diameter_mm": "100"}, "pitch_diameter_mm", (113.921, 20000), "larger pitch circle"),
        ({"ball_count": "40"}, "pitch_diameter_mm", (283.271, 20000), "Use fewer or smaller balls"),
    ],
)
def test_lengths_counts_and_angles_that_no_bearing_has(
    errors: Any, change: dict[str, str | None], key: str, allowed: tuple[float, float] | None, cause: str
) -> None:
    found = errors(scene_text(change))
    assert list(found) == [f"bearing.{key}"]
    error = found[f"bearing.{key}"]
    if allowed is not None:
        assert error.allowed == pytest.approx(allowed, rel=1e-5)
    assert error.value == float(change.get(key) or BEARING[key])
    assert cause in error.cause
    assert "qs." not in str(error), "advice for Python does not help a file's reader"
    if not cause:
        assert "Given in" not in error.cause


def test_a_small_angle_is_no_slip_in_a_deep_groove_bearing(load: Any) -> None:
    scene = load(scene_text({"kind": '"deep_groove"', "free_contact_angle_deg": "0.698"}))
    assert scene.bearing.free_contact_angle == pytest.approx(0.698 * qs.deg)
    assert load(scene_text({"free_contact_angle_deg": "0"})).bearing.free_contact_angle == 0


@pytest.mark.parametrize(
    ("numbers", "key", "cause"),
    [
        ((208000, 0.3, 7800), "elastic_modulus_GPa", "208000 megapascals = 208 GPa"),
        ((2.08e11, 0.3, 7800), "elastic_modulus_GPa", "pascals = 208 GPa"),
        ((208, 0.5, 7800), "poisson_ratio", ""),
        ((208, 0.3, 7.8), "density_kg_m3", "7.8 g/cm³ = 7800 kg/m³"),
        ((208, 0.3, 7.8e-6), "density_kg_m3", "kg/mm³ = 7800 kg/m³"),
    ],
)
def test_materials_that_nothing_is_made_of(errors: Any, numbers: tuple[float, ...], key: str, cause: str) -> None:
    modulus, ratio, density = numbers
    table = f"{{elastic_modulus_GPa = {modulus}, poisson_ratio = {ratio}, density_kg_m3 = {density}}}"
    found = errors(scene_text({"ball_material": table}))
    assert list(found) == [f"bearing.ball_material.{key}"]
    assert cause in found[f"bearing.ball_material.{key}"].cause


@pytest.mark.parametrize("clearance", ["-0.45", "2.5"])
def test_clearances_that_these_grooves_do_not_have(errors: Any, clearance: str) -> None:
    found = errors(scene_text({"free_contact_angle_deg": None, "diametral_clearance_mm": clearance}))
    error = found["bearing.diametral_clearance_mm"]
    assert list(found) == ["bearing.diametral_clearance_mm"]
    assert error.allowed == pytest.approx((-0.02 * 22.225, 2 * 1.0312 * (1 - np.cos(np.radians(85)))), rel=1e-6)


def test_a_clearance_in_micrometres(errors: Any) -> None:
    found = errors(scene_text({"free_contact_angle_deg": None, "diametral_clearance_mm": "482.6"}))
    assert "482.6 micrometres = 0.4826 mm" in found["bearing.diametral_clearance_mm"].cause


def test_an_entrys_value_that_an_override_spoils_is_named_as_the_entrys(errors: Any) -> None:
    found = errors('[bearing]\nname = "B218"\nball_diameter_mm = 25\n[operation]\naxial_load_N = 1\n')
    assert set(found) == {
        "bearing.inner_groove_radius_mm",
        "bearing.outer_groove_radius_mm",
        "bearing.pitch_diameter_mm",
    }
    assert "from the catalogue, B218" in str(found["bearing.inner_groove_radius_mm"])


@pytest.mark.parametrize(
    ("load_key", "displacement_key", "field"),
    [
        ("axial_load_N", "axial_displacement_um", "axial"),
        ("radial_load_y_N", "radial_displacement_y_um", "radial"),
        ("radial_load_z_N", "radial_displacement_z_um", "radial"),
        ("moment_y_Nm", "tilt_y_mrad", "tilt"),
        ("moment_z_Nm", "tilt_z_mrad", "tilt"),
    ],
)
def test_a_channel_given_twice(errors: Any, load_key: str, displacement_key: str, field: str) -> None:
    stated = {"moment_y_Nm": "0", "moment_z_Nm": "0"} if field == "radial" else {}
    found = errors(scene_text(operation={load_key: "1", displacement_key: "1", **stated}))
    assert list(found) == [f"operation.{load_key}"]
    assert displacement_key in found[f"operation.{load_key}"].problem


@pytest.mark.parametrize(
    ("given", "loaded", "held"),
    [
        ("radial_load_y_N", "moment_z_Nm", "tilt_z_mrad"),
        ("radial_displacement_y_um", "moment_z_Nm", "tilt_z_mrad"),
        ("radial_load_z_N", "moment_y_Nm", "tilt_y_mrad"),
        ("radial_displacement_z_um", "moment_y_Nm", "tilt_y_mrad"),
    ],
)
def test_a_radial_load_without_a_stated_tilt_names_both_remedies(
    errors: Any, load: Any, given: str, loaded: str, held: str
) -> None:
    found = errors(scene_text(operation={given: "5"}))
    assert list(found) == [f"operation.{loaded}"]
    text = str(found[f"operation.{loaded}"])
    assert f"missing: {given} tilts the ring" in text
    assert f"{loaded} = 0" in text
    assert f"{held} = 0" in text
    for remedy in (loaded, held):
        load(scene_text(operation={given: "5", remedy: "0"}))


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"tilt_z_mrad": "500"}, "tilt_z_mrad"),
        ({"axial_load_N": "1e11"}, "axial_load_N"),
        ({"speed_rpm": "1e7"}, "speed_rpm"),
        ({"outer_speed_rpm": "-1e5"}, "outer_speed_rpm"),
        ({"first_ball_azimuth_deg": "361"}, "first_ball_azimuth_deg"),
    ],
)
def test_operations_that_nobody_runs(errors: Any, change: dict[str, str | None], key: str) -> None:
    found = errors(scene_text(operation=change))
    assert list(found) == [f"operation.{key}"]
    allowed = found[f"operation.{key}"].allowed
    assert allowed is not None
    low, high = allowed
    assert not low <= float(change[key] or "") <= high


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"raceway_control": None}, "raceway_control"),
        ({"ball": None}, "raceway_control"),
        ({"ball": "[]"}, "raceway_control"),
        ({"ball": '["centrifugal_force"]', "moment_shares": '"harris"'}, "moment_shares"),
        ({"ball": '["centrifugal_force", "centrifugal_force"]'}, "ball"),
    ],
)
def test_effects_that_do_not_fit_together(errors: Any, change: dict[str, str | None], key: str) -> None:
    found = errors(scene_text(effects=change))
    assert list(found) == [f"effects.{key}"]
    assert found[f"effects.{key}"].cause or key == "ball"


def test_all_errors_of_all_tables_at_once(errors: Any) -> None:
    found = errors(
        scene_text(
            {
                "ball_diameter_mm": "0.022225",
                "pitch_diameter_mm": '"125"',
                "ring_material": "{elastic_modulus_GPa = 208000, poisson_ratio = 0.3, density_kg_m3 = nan, hue = 1}",
                "groove": "1",
            },
            {"axial_displacement_um": "3", "radial_load_z_N": "7", "speeed": "3"},
            {"raceway_control": None, "hertz_angle": '"freee"', "moment_shares": '"harris"'},
        )
    )
    assert set(found) >= {
        "bearing.ball_diameter_mm",
        "bearing.pitch_diameter_mm",
        "bearing.ring_material.elastic_modulus_GPa",
        "bearing.ring_material.density_kg_m3",
        "bearing.ring_material.hue",
        "bearing.groove",
        "operation.axial_load_N",
        "operation.moment_y_Nm",
        "operation.speeed",
        "effects.hertz_angle",
        "effects.raceway_control",
    }


def test_the_text_of_a_error_says_field_value_unit_range_and_cause(errors: Any) -> None:
    text = str(errors(scene_text({"ball_diameter_mm": "0.022225"}))["bearing.ball_diameter_mm"])
    assert text == (
        "bearing.ball_diameter_mm = 0.022225 mm: is too small\n"
        "    allowed: 0.05 to 1000 mm\n"
        "    Given in metres? 0.022225 metres = 22.225 mm"
    )


def test_a_bad_value_does_not_hide_that_its_channel_is_doubled(load: Any) -> None:
    with pytest.raises(qs.SceneFileError) as caught:
        load(scene_text(operation={"axial_load_N": "nan", "axial_displacement_um": "3"}))
    problems = [f"{error.problem}: {error.detail}" for error in caught.value.errors]
    assert len(problems) == 2
    assert "finite" in problems[0]
    assert "never both" in problems[1]


@pytest.mark.parametrize(
    ("effects", "words"),
    [
        ({"raceway_control": '"per_ball"'}, "raceway_control = 'per_ball'"),
        ({"orbit_radius": '"displaced"'}, "orbit_radius = 'displaced'"),
        ({"ball": "[]", "raceway_control": None}, "no ball effect"),
    ],
)
def test_a_common_motion_is_read_and_refused_by_its_key(load: Any, effects: dict[str, str | None], words: str) -> None:
    asked = {"ball_motion": '"common"'}
    assert load(scene_text(effects=asked)).ball_motion == "common"
    assert load(scene_text()).ball_motion == "own"
    with pytest.raises(qs.SceneError, match=f"effects.ball_motion = 'common': .*{re.escape(words)}"):
        load(scene_text(effects=asked | effects))
