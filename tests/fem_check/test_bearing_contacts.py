"""Any bearing's contacts: ring sections given or assumed, refusals row by row, the table, twenty bearings."""

import io
import json
from dataclasses import replace
from math import acos, cos, degrees, radians

import numpy as np
import pytest
from click.testing import CliRunner
from rich.console import Console

import qsbearing as qs
from fem_check import meshing
from fem_check.checks import bearing_contacts, true_geometry
from fem_check.checks.bearing_contacts import HALF_SPACES, TRUE_BODIES
from fem_check.cli import cli
from fem_check.cli.contact_table import contact_tables
from fem_check.elements.elastic_body import silent
from fem_check.independent import references
from fem_check.independent.ring_sections import RingProfile, RingSections, SectionError
from fem_check.mechanics import half_space_contact
from fem_check.product import scenes
from fem_check.product.scenes import RING_OPTIONS, drawing_at_rest, ring_sections
from fem_check.rows.agreement import AgreementRow, Findings, MeshLevel
from fem_check.solids import tetrahedra
from fem_check.solids.true_contact import TrueContact
from fem_check.solids.true_study import contacts

# Name, kind, balls, D, dm [mm], groove radii over D, free angle [deg], balls, bore, outside diameter, width [mm].
# Dimensions of their kind and size; grooves where no catalogue prints them are usual ones.
BEARINGS = (
    ("S 619/5", "angular_contact", 8, 2.381, 9.0, 0.52, 0.52, 15, "steel", 5, 13, 4),
    ("S 626", "angular_contact", 10, 3.175, 12.5, 0.52, 0.52, 15, "steel", 6, 19, 6),
    ("3 mm hybrid", "angular_contact", 11, 3.0, 13.0, 0.52, 0.52, 15, "silicon nitride", 8, 18, 5),
    ("71900 hybrid", "angular_contact", 13, 3.175, 16.0, 0.54, 0.54, 15, "silicon nitride", 10, 22, 6),
    ("608", "deep_groove", 7, 3.969, 15.0, 0.515, 0.53, 0, "steel", 8, 22, 7),
    ("6203", "deep_groove", 8, 6.746, 28.5, 0.515, 0.525, 0, "steel", 17, 40, 12),
    ("6205", "deep_groove", 9, 7.94, 39.04, 0.515, 0.525, 0, "steel", 25, 52, 15),
    ("6310", "deep_groove", 8, 19.05, 80.0, 0.515, 0.525, 0, "steel", 50, 110, 27),
    ("6022 hybrid", "deep_groove", 14, 20.638, 140.0, 0.515, 0.525, 0, "silicon nitride", 110, 170, 28),
    ("7014C hybrid", "angular_contact", 20, 12.7, 90.0, 0.52, 0.52, 15, "silicon nitride", 70, 110, 20),
    ("7014E", "angular_contact", 20, 12.7, 90.0, 0.52, 0.52, 25, "steel", 70, 110, 20),
    ("7205B", "angular_contact", 13, 7.94, 39.0, 0.52, 0.53, 40, "steel", 25, 52, 15),
    ("7210C", "angular_contact", 15, 12.7, 70.0, 0.518, 0.518, 15, "steel", 50, 90, 20),
    ("7218B", "angular_contact", 16, 22.225, 125.26, 0.5232, 0.5232, 40, "steel", 90, 160, 30),
    ("7320B", "angular_contact", 12, 36.5, 157.5, 0.52, 0.53, 40, "steel", 100, 215, 47),
    ("7334B", "angular_contact", 14, 50.8, 265.0, 0.52, 0.53, 40, "steel", 170, 360, 72),
    ("60 mm", "angular_contact", 13, 60.0, 290.0, 0.52, 0.53, 40, "steel", 180, 380, 75),
    ("QJ212", "angular_contact", 14, 15.875, 85.0, 0.52, 0.52, 35, "steel", 60, 110, 22),
    ("ball screw support", "angular_contact", 16, 7.938, 45.0, 0.52, 0.52, 60, "steel", 30, 62, 15),
    ("turbopump", "angular_contact", 10, 7.938, 38.5, 0.56, 0.52, 20, "steel", 25, 52, 15),
)


def scene_text(bearing, pressure: float = 1800e6) -> str:
    """A scene file that presses the inner raceway about so hard; deep grooves carry a radial load too."""
    _, kind, balls, d, dm, f_i, f_o, angle, material, *_ = bearing
    clearance = "diametral_clearance_mm = 0.012" if kind == "deep_groove" else f"free_contact_angle_deg = {angle}"
    elastic = scenes.ElasticConstants(315e9, 0.26), scenes.ElasticConstants(208e9, 0.3)
    groove = scenes.BallInGroove(
        "", "inner", 1e-3 * d, 1e-3 * f_i * d, 1e-3 * dm, radians(angle or 10), elastic[material == "steel"], elastic[1]
    )
    load = (pressure / references.ellipse(groove.problem(1.0)).max_pressure) ** 3
    axial = f"{balls * load * np.sin(radians(angle or 10)):.4g}"
    beside = f"radial_load_y_N = {load:.4g}\ntilt_y_mrad = 0\ntilt_z_mrad = 0" if kind == "deep_groove" else ""
    return f"""[bearing]
kind = "{kind}"
ball_count = {balls}
ball_diameter_mm = {d}
pitch_diameter_mm = {dm}
inner_groove_radius_mm = {f_i * d:.6g}
outer_groove_radius_mm = {f_o * d:.6g}
{clearance}
ball_material = "{material}"
ring_material = "steel"
[operation]
axial_load_N = {axial}
{beside}
"""


@pytest.fixture
def rings():
    """Sets ring dimensions as the command line does, in millimetres."""
    tokens = []

    def given(**dimensions):
        tokens.append(RING_OPTIONS.set({name: 1e-3 * value for name, value in dimensions.items()}))

    yield given
    for token in reversed(tokens):
        RING_OPTIONS.reset(token)


def heaviest(source: str, race: str = "inner"):
    return bearing_contacts.heaviest(bearing_contacts.operated(source), source, race)


# Ring sections --------------------------------------------------------------------------------------------------------


def test_an_option_goes_before_the_catalogue_and_what_nobody_gives_is_assumed(rings):
    scene = qs.load_scene("7210c")
    rings(width=24.0)
    sections = ring_sections(scene, "7210c")
    drawing = drawing_at_rest(scene, "7210c")
    inner, outer = (sections.profile(drawing, race) for race in ("inner", "outer"))
    assert (inner.back_radius, outer.back_radius, inner.width) == pytest.approx((0.025, 0.045, 0.024), rel=1e-12)
    # GMN's d1 62.5 mm: that far round the groove from its bottom, by the circle's height.
    centre = 35.0 + (6.58 - 6.35) * cos(radians(15.0))
    assert inner.high_shoulder == pytest.approx(acos((centre - 31.25) / 6.58), rel=1e-12)
    told = sections.told(drawing, {"inner": inner, "outer": outer})
    assert "bore 50, outside diameter 90" in told and "from the catalogue" in told
    assert "width 24 mm from the option" in told
    assert "assumed: inner open side" in told


def test_ring_expansion_and_readings_of_a_scene_give_dimensions():
    fitted = qs.RingExpansion(85 * qs.mm, 165 * qs.mm, shaft_interference=10 * qs.um)
    overrun = {"inner_shoulder_diameter": 112 * qs.mm}
    scene = replace(qs.load_scene("b218"), ring_effects=(fitted,), readings={"overrun": overrun})
    sections = ring_sections(scene, "b218")
    assert sections.known["bore_diameter"] == 85 * qs.mm and sections.sources["bore_diameter"] == "scene"
    assert sections.known["inner_shoulder_diameter"] == 112 * qs.mm
    assert sections.sources["width"] == "catalogue"


def test_a_designation_gives_boundary_dimensions(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(
        '[bearing]\nname = "6205"\nkind = "deep_groove"\nball_count = 9\nball_diameter_mm = 7.938\n'
        "pitch_diameter_mm = 39\ninner_groove_radius_mm = 4.088\nouter_groove_radius_mm = 4.088\n"
        'diametral_clearance_mm = 0.01\nball_material = "steel"\nring_material = "steel"\n'
        "[operation]\naxial_load_N = 500\n"
    )
    known = ring_sections(qs.load_scene(file), "mine").known
    assert known == pytest.approx({"bore_diameter": 0.025, "outside_diameter": 0.052, "width": 0.015})


def test_a_bearing_of_other_size_is_not_the_catalogues():
    scene = qs.load_scene("b218")
    larger = replace(scene, bearing=replace(scene.bearing, pitch_diameter=130 * qs.mm, name="B218, modified"))
    sections = ring_sections(larger, "my")
    assert not sections.known
    assert "assumed: bore 94.74, outside diameter 164.7, width 30" in sections.told(
        drawing_at_rest(larger, "my"),
        {race: sections.profile(drawing_at_rest(larger, "my"), race) for race in scenes.RACES},
    )


def test_faults_of_ring_sections_come_all_at_once():
    drawing = drawing_at_rest(qs.load_scene("b218"), "b218")
    wrong = {"bore_diameter": 0.11, "outside_diameter": 0.14, "width": 0.01, "inner_shoulder_diameter": 0.2}
    with pytest.raises(SectionError) as raised:
        RingSections.of(("option", wrong)).checked(drawing)
    assert all(name in str(raised.value) for name in ("bore 110", "outside diameter 140", "width 10", "shoulder 200"))


def test_an_assumed_shoulder_is_as_high_as_the_contact_asks_and_a_given_one_is_not():
    drawing = drawing_at_rest(qs.load_scene("b218"), "b218")
    contact = radians(60.0), radians(15.0)
    assert degrees(RingSections().profile(drawing, "inner", contact).high_shoulder) == pytest.approx(79.0)
    given = RingSections.of(("option", {"inner_shoulder_diameter": 0.11}))
    high = given.profile(drawing, "inner", contact).high_shoulder
    assert drawing.inner_groove_centre_radius - drawing.inner_groove_radius * cos(high) == pytest.approx(0.055)


# Refusals -------------------------------------------------------------------------------------------------------------


def test_a_contact_over_its_shoulder_is_refused_and_the_other_column_stays(rings):
    rings(inner_shoulder_diameter=108.0)
    contact = heaviest("b218")
    reason = bearing_contacts.true_bodies(contact, (3,), silent)
    assert isinstance(reason, str) and "does not fit a groove" in reason
    refused = bearing_contacts.true_rows(contact, reason)
    assert {row.verdict for row in refused} == {"refused"}
    assert all(row.found is None and row.as_dict()["deviation_percent"] is None for row in refused)
    contacts = {"inner": contact}
    held = bearing_contacts.equilibrium_rows(contacts, TRUE_BODIES, "no approach", MeshLevel.QUICK)["inner"]
    assert [(row.quantity, row.verdict, row.why_tolerance) for row in held] == [
        ("load", "refused", "no approach"), ("angle", "refused", "no approach"),
    ]  # fmt: skip
    # JSON has null, and a check with refusals alone does not fail.
    assert json.loads(json.dumps(refused[0].as_dict(), allow_nan=False))["found"] is None
    assert Findings(refused).verdict == "pass"


def test_true_geometry_refuses_a_contact_by_its_rows(rings):
    rows = true_geometry.refused_rows(scenes.groove_contact("b218", "inner"), 2000.0, meshing.MeshError("no mesh"))
    assert {row.verdict for row in rows} == {"refused"} and {row.why_tolerance for row in rows} == {"no mesh"}
    # Where no contact is left the check was not run.
    rings(inner_shoulder_diameter=58.0)
    with pytest.raises(meshing.MeshError, match=r"no contact was solved: a contact at .* does not fit a groove"):
        true_geometry.run(MeshLevel.QUICK, silent, "7210c")


def test_slender_elements_over_a_curved_groove_are_not_folded(tmp_path, monkeypatch):
    # A 6205 whose heaviest ball carries 745 N: the groove sags between two nodes by half an element's thickness.
    steel = scenes.ElasticConstants(208e9, 0.3)
    groove = scenes.BallInGroove("6205", "inner", 7.94e-3, 4.0891e-3, 39.04e-3, radians(9.3341), steel, steel)
    contact = TrueContact(groove, 9, 744.75, 4, RingProfile(12.5e-3, 15e-3, radians(50.0), radians(50.0)))
    monkeypatch.setattr(meshing, "cache_folder", lambda: tmp_path / "meshes")
    assert contact.mesh("ring").tetrahedra.shape[1] > 6000
    monkeypatch.setattr(tetrahedra, "REMEDIES", tetrahedra.REMEDIES[:1])
    monkeypatch.setattr(meshing, "cache_folder", lambda: tmp_path / "others")
    with pytest.raises(meshing.MeshError, match="folded over"):
        contact.mesh("ring")


def test_where_gmsh_fails_the_next_remedy_is_tried(tmp_path, monkeypatch):
    generated, tried = tetrahedra._generate, []

    def fails_first(model):
        tried.append(model)
        if len(tried) == 1:
            raise Exception("Incompatible surface 12 in transfinite volume 2")
        generated(model)

    monkeypatch.setattr(tetrahedra, "_generate", fails_first)
    contact = contacts("b218", "inner", 2000.0, (2,))[0]
    monkeypatch.setattr(meshing, "cache_folder", lambda: tmp_path)
    assert contact.mesh("ring").tetrahedra.shape[1] > 1000 and len(tried) == 2
    monkeypatch.setattr(tetrahedra, "REMEDIES", tetrahedra.REMEDIES[:1])
    tried.clear()
    with pytest.raises(meshing.MeshError, match=r"with 2 elements .* Incompatible surface 12 .* another number"):
        replace(contact, load=2100.0).mesh("ring")


# Equilibrium with other approaches ------------------------------------------------------------------------------------


def test_angle_follows_from_the_approaches(tmp_path):
    path = tmp_path / "thrust.toml"
    path.write_text(scene_text(BEARINGS[13]))
    source = str(path)
    contacts = {race: heaviest(source, race) for race in scenes.RACES}
    same = bearing_contacts.equilibrium_rows(
        contacts, HALF_SPACES, {"inner": (1.0, 0.0), "outer": (1.0, 0.0)}, MeshLevel.QUICK
    )
    assert all(row.verdict == "pass" and row.reach_percent < 1e-5 for row in same["inner"] + same["outer"])
    ratios = {"inner": (1.05, 0.0), "outer": (0.9, 0.0)}
    rows = bearing_contacts.equilibrium_rows(contacts, TRUE_BODIES, ratios, MeshLevel.QUICK)["inner"]
    load, angle = (row.found for row in rows)
    # At rest, under thrust: the groove centres' distance across the bearing stays (Harris & Kotzalas).
    drawing = contacts["inner"].drawing
    distance = drawing.groove_centre_distance
    stretched = distance + sum(
        ratios[race][0] * references.ellipse(drawing.groove(race).problem(load)).approach for race in scenes.RACES
    )
    assert angle == pytest.approx(degrees(acos(distance * cos(drawing.free_contact_angle) / stretched)), abs=1e-7)
    assert load * np.sin(radians(angle)) == pytest.approx(contacts["inner"].solution.load[0] / 16, rel=1e-9)
    # An approach that is off by its uncertainty turns the contact by the angle's.
    doubtful = bearing_contacts.equilibrium_rows(
        contacts, TRUE_BODIES, {"inner": (1.05, 0.01), "outer": (0.9, 0.0)}, MeshLevel.QUICK
    )["inner"][1]
    moved = bearing_contacts.equilibrium_rows(
        contacts, TRUE_BODIES, {"inner": (1.06, 0.0), "outer": (0.9, 0.0)}, MeshLevel.QUICK
    )["inner"][1]
    assert doubtful.uncertainty_percent == pytest.approx(100.0 * abs(moved.found - angle) / moved.reference, rel=1e-6)


def test_a_set_is_judged_by_its_own_equilibrium(tmp_path):
    path = tmp_path / "pair.toml"
    path.write_text("""
[bearing]
name = "B218"
[[rows]]
position_mm = 0
carries = "+x"
[[rows]]
position_mm = 60
carries = "-x"
[operation]
axial_load_N = 6000
radial_load_y_N = 3000
moment_z_Nm = 0
[preload]
rigid_N = 3000
""")
    source = str(path)
    contacts = {race: heaviest(source, race) for race in scenes.RACES}
    # The load presses the row that carries in its direction.
    assert contacts["inner"].point.label == "row 1" and "row 1, ball 1" in contacts["inner"].case
    ratios = dict.fromkeys(scenes.RACES, (1.0, 0.0))
    by_race = bearing_contacts.equilibrium_rows(contacts, HALF_SPACES, ratios, MeshLevel.QUICK)
    assert all(row.reach_percent < 1e-5 for rows in by_race.values() for row in rows)
    softer = bearing_contacts.equilibrium_rows(contacts, HALF_SPACES, {**ratios, "outer": (1.2, 0.0)}, MeshLevel.QUICK)
    assert "fail" in {row.verdict for rows in softer.values() for row in rows}


# The table ------------------------------------------------------------------------------------------------------------


def printed(rows) -> str:
    entry = {"scene": "my.toml", "level": "quick", "seconds": 1.0, "peak_memory_MB": 100, "notes": ["Rings: known."]}
    console = Console(width=80, record=True, file=io.StringIO())
    console.print(contact_tables(entry | {"rows": [row.as_dict() for row in rows]}))
    return console.export_text()


def rows_of(true: float | None, half_space: float = 3.0001e-6) -> list[AgreementRow]:
    made = []
    for method, approach, tolerance in ((HALF_SPACES, half_space, 0.3), (TRUE_BODIES, true, None)):
        doubt, why = (0.05, "why") if approach else (None, "a contact at 61 deg does not fit a groove to 55 deg")
        made.append(
            AgreementRow(f"B1 inner: ball 1; {method}", "approach", "m", 3e-6, "solve", approach, doubt, tolerance, why)
        )
        made.append(AgreementRow(f"B1 inner: ball 1; {method}", "angle", "deg", 40.0, "solve", 40.01, 0.01, 1.0, why))
    return made


def test_each_verdict_is_said_once_for_the_contact_and_beside_its_number():
    text = printed(rows_of(2.7e-6))
    assert max(map(len, text.splitlines())) <= 80 and "…" not in text
    assert "3.0001 0.05% verified    2.7000 -10.00 ± 0.05% finding" in text
    assert "verified  half-spaces agree with Hertz: approach +0.00 ± 0.05%, tolerance 0.3%" in text
    assert text.splitlines()[1].strip() == "3 verified, 1 finding"
    assert "finding   the true bodies' difference" in text and "refused" not in text


def test_a_refusal_and_a_failure_are_said():
    text = printed(rows_of(None))
    assert "– " in text and "refused   approach (true bodies): a contact at 61 deg" in text
    wrong = printed(rows_of(2.7e-6, half_space=3.1e-6))
    assert "FAILED    half-spaces DISAGREE with Hertz" in wrong
    assert wrong.splitlines()[1].strip() == "1 FAILED, 2 verified, 1 finding"


# The command ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--bore-diameter-mm", "25"], "options for dimensions of the rings need --scene"),
        (
            ["--scene", "b218", "--bore-diameter-mm", "110", "--width-mm", "3"],
            "bore 110 mm (option): above 0 and below",
        ),
        (["--scene", "b218", "--bore-diameter-mm", "110", "--width-mm", "3"], "width 3 mm (option): above 11.11 mm"),
    ],
)
def test_wrong_ring_dimensions_are_exit_2_with_a_sentence(arguments, said, tmp_path):
    result = CliRunner().invoke(cli, ["run", *arguments, "--out", str(tmp_path)])
    assert result.exit_code == 2 and said in result.stderr


def test_what_a_sector_leaves_out_is_named(tmp_path):
    path = tmp_path / "6205.toml"
    path.write_text(scene_text(BEARINGS[6]))
    solution = scenes.solved(str(path))[0].solution
    assert scenes.beyond_thrust(solution)[0].startswith("radial load y ")
    assert scenes.beyond_thrust(scenes.solved("7210c")[0].solution) == []


@pytest.mark.heavy
@pytest.mark.parametrize("bearing", BEARINGS, ids=lambda bearing: bearing[0])
def test_any_bearing_is_verified_and_its_true_bodies_solved_or_refused(bearing, tmp_path, monkeypatch, rings):
    """Small meshes; from 3 mm to 60 mm balls, deep grooves and hybrids."""
    path = tmp_path / "bearing.toml"
    path.write_text(scene_text(bearing))
    rings(bore_diameter=bearing[-3], outside_diameter=bearing[-2], width=bearing[-1])
    monkeypatch.setitem(bearing_contacts.ELEMENTS, MeshLevel.QUICK, (3, 4))
    monkeypatch.setitem(half_space_contact.SEQUENCES, MeshLevel.QUICK, (4, 6))
    findings = bearing_contacts.run(MeshLevel.QUICK, silent, str(path))
    assert len(findings.rows) == 24 and findings.verdict != ""
    ideal = [row for row in findings.rows if row.case.endswith(HALF_SPACES)]
    true = [row for row in findings.rows if row.case.endswith(TRUE_BODIES)]
    # Two coarse meshes: half a per cent.
    assert all(row.reach_percent < 1.0 and abs(row.deviation_percent) < 0.5 for row in ideal)
    for row in true:
        if row.found is None:
            assert len(row.why_tolerance) > 20
        else:
            # Bodies of bearings stay within a tenth of Hertz, their approach within a fifth.
            assert abs(row.deviation_percent) < (20.0 if row.quantity in ("approach", "angle", "load") else 10.0)
    print(bearing[0], sorted({row.why_tolerance for row in true if row.found is None}))
