"""Designations: what their parts say, by maker, and what they are never taken for."""

from __future__ import annotations

import re
import tomllib
import warnings
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from qsbearing.files import catalogue
from qsbearing.files.bearing_table import bearing_of
from qsbearing.files.designations import Designation, designation, read
from qsbearing.files.scene_file import document_of, scene_of
from qsbearing.files.sheet_by_name import sheets_by_name
from qsbearing.inference import iso15
from qsbearing.model.effects.ring_dimensions import ring_dimensions
from qsbearing.model.units import deg, mm
from qsbearing.model.validation import SceneError


def told(text: str) -> Designation:
    found = read(text)
    assert found is not None, text
    return found


@pytest.mark.parametrize(
    ("text", "size", "angle"),
    [
        ("7014C", (70, 110, 20), 15),
        ("SKF 7014 CD/P4ADBA", (70, 110, 20), 15),
        ("7210 ACD", (50, 90, 20), 25),
        ("7210 BEP", (50, 90, 20), 40),
        ("7210-B-TVP", (50, 90, 20), 40),
        ("FAG B7014-E-T-P4S-UL", (70, 110, 20), 25),
        ("7910A5TYNSULP4", (50, 72, 12), 25),
        ("NSK 7210", (50, 90, 20), 30),
        ("NTN 7014UCG", (70, 110, 20), 15),
        ("GMN S 61914 C TA", (70, 100, 16), 15),
        ("KH 6014 C TA", (70, 110, 20), 17),
        ("SEA 60 7CE1 DDL", (60, 78, 10), 15),
        ("E 2 40 CE3", (40, 80, 18), 25),
        ("727C", (7, 22, 7), 15),
        ("719-5C", (5, 13, 4), 15),
        ("6205-2RS/C3", (25, 52, 15), None),
        ("62/22", (22, 50, 14), None),
        ("608-2Z", (8, 22, 7), None),
        ("16005", (25, 47, 8), None),
        ("6804", (20, 32, 7), None),
    ],
)
def test_series_bore_and_suffix(text: str, size: tuple[float, ...], angle: float | None) -> None:
    found = told(text)
    assert (found.bore, found.outside, found.width) == size
    assert found.angle == angle
    assert found.kind == ("deep_groove" if angle is None else "angular_contact")


def test_a_suffix_on_which_makers_differ_is_asked_about() -> None:
    assert told("7014E").angle is None and set(told("7014E").angles) == {("FAG", 25), ("GMN", 25)}
    assert told("SKF 7014 E").angle is None and told("FAG 7014E").angle == 25
    assert told("7210A").angle is None and told("NSK 7210A").angle == 30
    assert "Suffix A means 30° at NSK, 25° at AKE; write the maker first (NSK 7210A)" in catalogue.nearest("7210A")
    assert told("7210").angle is None
    for text in ("7210", "7210-2RS", "7014 TYN"):
        assert "Suffix" not in catalogue.nearest(text), text
    advice = "Without a suffix the angle is 30° at NSK and NTN; write the maker first (NSK 7014) or give free_contact"
    assert advice in catalogue.nearest("7014")


PREFIXES = tomllib.loads((Path(designation.__file__).parent / "designations.toml").read_text("utf-8"))["prefixes"]
NUMBERS = (
    "71914", "7014", "7210", "7014C", "7014-C-T-P4S", "7014 CTYNSULP4", "7210 BEP", "7308 BECBP", "7910UCG", "6205",
    "6206-C3", "6308", "6804", "71914-E-T-P4S",
)  # fmt: skip
"""As makers write them, without the maker."""


@pytest.mark.parametrize("number", NUMBERS)
def test_a_prefix_is_a_makers_or_is_said_to_be_unknown(number: str) -> None:
    """Every prefix that is known, and all of one to three letters that are not, before every number."""
    bare, known = told(number), {each for names in PREFIXES.values() for each in names}
    letters = [a + b + c for a in "ABCHSWXZ" for b in ("", *"BCSZ") for c in ("", *"BSZ")]
    for prefix in dict.fromkeys([*known, *letters]):
        found = read(f"{prefix}{number}")
        if found is None or found.is_refused or found.series != bare.series:  # another designation, or SNFA's letters
            continue
        said = catalogue.nearest(f"{prefix}{number}")
        assert (found.bore, found.outside, found.width) == (bare.bore, bare.outside, bare.width)
        assert f"uffix {prefix}" not in said, (prefix, said)
        owners = {maker for maker, names in PREFIXES.items() if prefix in names}
        spindle = found.kind == "angular_contact" and bool(owners)
        is_known = "ceramic" in owners or (found.maker in owners if found.maker else spindle)
        assert found.is_prefix_known == is_known
        assert (f"Its prefix {prefix} is not known of such bearings" in said) == (not is_known), (prefix, said)
        assert prefix not in found.ignored.split()


def test_a_prefix_of_one_maker_tells_whose_suffixes_count() -> None:
    for prefix in PREFIXES["FAG"]:
        assert told(f"{prefix}71914").maker == "FAG"
        said = catalogue.nearest(f"{prefix}71914")
        assert f"Prefix {prefix} is of FAG, whose suffixes for the angle are C (15°), E (25°) and B (40°)" in said
        assert told(f"{prefix}71914E").angle == 25


def test_classes_sets_and_balls_are_read() -> None:
    found = told("7014CTYNDBLP4")
    assert (found.arrangement, found.preload, found.tolerance_class, found.ignored) == ("DB", "light", "P4", "TYN")
    assert told("SKF 7014 CD/P4ADBB").preload == "medium"
    for text in ("HCB71914-C-T-P4S", "7014 CE/HC", "HY S 61914 C TA"):
        assert told(text).ball_material == "silicon nitride"


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("QJ 210", "four-point"),
        ("NU 2210 ECP", "cylindrical"),
        ("N210", "cylindrical"),
        ("30205", "tapered"),
        ("22215", "spherical roller"),
        ("2215", "self-aligning"),
        ("1205", "self-aligning"),
        ("51105", "thrust"),
        ("234410", "double-direction"),
        ("7602050", "screws"),
        ("30TAC62B", "screws"),
        ("70BNR10STYNDBLP4", "18 (BNR)"),
        ("3210", "double-row angular"),
        ("4205", "double-row deep-groove"),
        ("62205-2RS", "wide"),
    ],
)
def test_other_kinds_are_refused_by_name(text: str, what: str) -> None:
    assert what in told(text).what
    assert catalogue.find(text) is None
    advice = catalogue.nearest(text)
    assert what in advice and "Did you mean" not in advice


def test_a_double_row_is_printed_as_the_set_that_it_is() -> None:
    rows = 'rows = [{ position_mm = 0, carries = "+x" }, { position_mm = s, carries = "-x" }]'
    assert rows in catalogue.nearest("3210")


def test_advice_crosses_neither_angle_nor_series_nor_kind() -> None:
    for text in ("7210A", "7210BE", "7014C", "QJ210", "NU210", "3210", "7014E", "6210", "KH7210C", "7010C"):
        assert "Did you mean" not in catalogue.nearest(text), text
        assert "KH7014" not in catalogue.nearest(text)
    assert catalogue.nearest("71914").endswith("Did you mean 71914C or 71914E?")


def test_a_designation_that_means_an_entry_is_that_entry() -> None:
    for text, name in (
        ("GMN S 61914 C TA", "71914C"),
        ("HY S 61914 E", "71914E_hybrid"),
        ("KH 6014 C", "KH7014C"),
        ("7210 C", "7210C"),
        ("S 619/5 C TA", "719-5C"),
    ):
        entry = catalogue.find(text)
        assert entry is not None and entry.name == name
    # Another maker's balls are others; the entry is named, not taken.
    for text in ("SKF 71914 CD", "7914C", "7910CTYNDBLP4"):
        assert catalogue.find(text) is None
    assert "name = '71910C'" in catalogue.nearest("7910CTYNDBLP4")
    with pytest.warns(UserWarning, match="7210C-P4: read as 7210C; not used: P4, except for fits by name"):
        document_of("7210C-P4")


def test_every_entry_of_the_catalogue_is_read_as_itself() -> None:
    for each in catalogue.chosen():
        found = told(each.name)
        assert found.bore == each.dimensions["bore_diameter_mm"], each.name
        assert (found.outside, found.width) == tuple(
            each.dimensions[f"{key}_mm"] for key in ("outside_diameter", "width")
        )


def test_names_that_are_no_designations() -> None:
    for text in ("B218", "turbopump25", "my bearing", "", "x" * 200, "721OC", "-", "7/", "00000", "60/"):
        assert read(text) is None or text == "60/", text


OWN = {
    "ball_count": 9, "ball_diameter_mm": 7.938, "pitch_diameter_mm": 38.5, "groove_radius_coefficient": 0.52,
    "diametral_clearance_mm": 0.01, "ball_material": "steel", "ring_material": "steel",
}  # fmt: skip


def scene(**bearing: Any) -> Any:
    return scene_of({"bearing": bearing, "operation": {"axial_load_N": 100.0}}, "a file")


def test_what_a_designation_lacks_is_asked_for_once() -> None:
    errors: list[Any] = []
    assert bearing_of({"bearing": {"name": "SKF 7014CE"}}, "", errors) is None
    (error,) = errors
    assert "70 x 110 x 20 mm" in error.cause and "15 deg" in error.cause and "dynamic_load_rating_N" in error.cause
    assert "light balls" in error.cause, "whose proportions are others"


EACH = {
    "ball_count": 9, "ball_diameter_mm": 7.938, "pitch_diameter_mm": 38.5, "inner_groove_radius_mm": 4.1,
    "outer_groove_radius_mm": 4.15, "diametral_clearance_mm": 0.01,
}  # fmt: skip


@pytest.mark.parametrize("name", ["6205", "SKF 6205", "7210 BE", "HSS71914C", "7210"])
def test_what_is_given_is_not_asked_for(name: str) -> None:
    """Of every selection of what a bearing needs: what is missing is named, and nothing else. Where nothing of a ball
    set but its count is given, it follows from the name."""
    for taken in (each for size in range(len(EACH)) for each in combinations(EACH, size)):
        given = {key: EACH[key] for key in taken}
        if sheets_by_name({"name": name, **given}):
            assert given.keys() <= {"ball_count", "diametral_clearance_mm"}
            continue
        errors: list[Any] = []
        made = bearing_of({"bearing": {"name": name, **given}}, "", errors)
        lacking = EACH.keys() - given.keys()
        if told(name).angle is not None:
            lacking -= {"diametral_clearance_mm"}
        assert (made is None) == bool(lacking)
        if not lacking:
            continue
        (error,) = errors
        asked = error.cause.partition("; GMN's")[0]
        assert not [key for key in given if key in asked], (taken, asked)
        for key in lacking:
            forms = {key}
            if "radius" in key:
                forms |= {"groove_radius_coefficient"}
            if key == "diametral_clearance_mm" and told(name).kind == "angular_contact":
                forms = {"free_contact_angle_deg"}
            assert any(each in asked for each in forms), (taken, asked)


def test_a_name_that_tells_the_maker_tells_how_its_ratings_are_read() -> None:
    ratings = {"dynamic_load_rating_N": 14800, "static_load_rating_N": 7800, "diametral_clearance_mm": 0.01}

    def read_of(**bearing: Any) -> Any:
        tables = {"bearing": ratings | bearing, "operation": {"axial_load_N": 100.0}}
        return scene_of(tables, "a file", may_infer=True).bearing.inferred

    by_name, by_key = read_of(name="SKF 6205"), read_of(name="6205", maker="SKF")
    assert by_name.sheet.maker == by_key.sheet.maker == "SKF"
    assert np.array_equal(by_name.bearing.ball_diameter, by_key.bearing.ball_diameter)
    assert (
        read_of(name="SKF 6205", maker="NTN", dynamic_load_rating_N=14000, static_load_rating_N=7850).sheet.maker
        == "NTN"
    )
    for given, said in (
        ({"name": "6205"}, 'Whose ratings are these? Add maker = "SKF" (or GMN, NSK, NTN, SNFA)'),
        ({"name": "FAG 6205"}, "No practice of FAG is known; known are SKF, GMN, NSK, NTN and SNFA"),
    ):
        with pytest.raises(SceneError, match=re.escape(said)):
            read_of(**given)


def test_a_designation_gives_its_dimensions_and_what_is_left_out() -> None:
    lengths = ("ball_count", "ball_diameter_mm", "pitch_diameter_mm", "groove_radius_coefficient")
    numbers = {key: OWN[key] for key in lengths}
    given = scene(**numbers, name="SKF 7205 CD/HC").bearing
    assert given.free_contact_angle == pytest.approx(15 * deg)
    assert (given.ball_material.name, given.ring_material.name) == ("silicon nitride", "steel")
    size = (given.outline.bore_diameter, given.outline.outside_diameter, given.outline.width)
    assert size == pytest.approx((25 * mm, 52 * mm, 15 * mm))
    own = scene(**numbers, name="SKF 7205 CD/HC", ball_material="M50", free_contact_angle_deg=14.5).bearing
    assert own.ball_material.name == "M50" and own.free_contact_angle == pytest.approx(14.5 * deg)
    deep = scene(**numbers, name="6205-2RS", diametral_clearance_mm=0.01).bearing
    assert deep.kind == "deep_groove" and deep.ball_material.name == "steel"


def test_a_complete_bearing_may_have_any_name() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = scene(**OWN, name="6205").bearing
        assert found.kind == "angular_contact" and found.outline.width == pytest.approx(15 * mm)
        assert scene(**OWN, name="NU210").bearing.outline is None


def test_the_width_follows_from_the_diameters() -> None:
    found = scene(**OWN, bore_diameter_mm=25, outside_diameter_mm=52).bearing.outline
    assert found.width == pytest.approx(15 * mm)
    assert scene(**OWN, bore_diameter_mm=25, outside_diameter_mm=53).bearing.outline.width is None
    assert iso15.width(30.0, 55.0) == 13.0, "series 10 before 00"


def test_the_table_of_boundary_dimensions() -> None:
    sizes = iso15.table()
    assert len(sizes) == 230
    for (series, bore), (outside, width) in sizes.items():
        assert bore < outside <= 4 * bore and 0.1 < width / (outside - bore) < 1.0, (series, bore)
    for series in ("18", "19", "00", "10", "02", "03", "04"):
        outsides = [size[0] for (each, _), size in sizes.items() if each == series]
        assert outsides == sorted(outsides)


@pytest.mark.filterwarnings("ignore:.*read as 71914C")
def test_the_class_of_a_designation_is_that_of_its_fits() -> None:
    expansion = {"shaft_fit": "k5"}
    tables = {"bearing": {"name": "71914C-P4"}, "operation": {"axial_load_N": 100.0}, "effects": {}}
    for given, tolerance in (({}, "P4"), ({"tolerance_class": "P5"}, "P5")):
        tables["effects"] = {"ring_expansion": expansion | given}
        assert scene_of(tables, "a file").ring_expansion.shaft_fit.tolerance_class == tolerance
    tables["effects"] = {"ring_expansion": {"shaft_interference_um": 5.0}}
    assert scene_of(tables, "a file").ring_expansion.shaft_fit is None


def test_rings_of_a_designation_have_its_dimensions() -> None:
    """Where elastic or expanding rings are assumed, in place of usual proportions."""
    rings = ring_dimensions(scene(**OWN, name="6205").bearing)
    assert rings.origin == "the bearing's own dimensions"
    assert (rings.bore, rings.outside, rings.width) == pytest.approx((25 * mm, 52 * mm, 15 * mm))
    assert ring_dimensions(scene(**OWN).bearing).origin == "usual proportions"


@pytest.mark.parametrize("maker", designation._facts()["other"]["makers"])
def test_a_maker_whose_letters_are_not_known_is_a_maker_and_no_prefix(maker: str) -> None:
    """Its deep-groove bearings are of their series, as those of makers whose ratings are in no table."""
    found = told(f"{maker.title()} 6208-2RS/C3")
    assert (found.maker, found.prefix, found.clearance_class) == (maker, "", "C3")
    assert [list(each) for each in sheets_by_name({"name": f"{maker} 6208"})] == [["rating_practice"]]
    assert told(f"{maker} 7208 WN").angle is None
    assert "for the angle is not known here: give free_contact_angle_deg" in catalogue.nearest(f"{maker} 7208 WN")


def test_letters_before_the_number_that_begin_with_a_digit() -> None:
    """NTN's 5S: ceramic balls. SKF's E2: other balls than those of the rating tables, so that only the size is told."""
    found = told("NTN 5S-7012UCDB/GNP42")
    assert (found.ball_material, found.angle, found.arrangement, found.bore) == ("silicon nitride", 15, "DB", 60)
    found = told("SKF E2.6208-2Z")
    assert (found.bore, found.outside, found.width, found.prefix) == (40, 80, 18, "E2")
    assert sheets_by_name({"name": "SKF E2.6208-2Z"}) == []
    assert "40 x 80 x 18" in catalogue.nearest("SKF E2.6208-2Z")
