"""One ball between both rings, on the shipped meshes."""

import dataclasses
import hashlib
import json
from math import cos, radians
from types import SimpleNamespace

import matplotlib.pyplot
import numpy as np
import pytest

import qsbearing
from fem_check import meshing
from fem_check.checks import bearing_sector
from fem_check.product.scenes import SceneProblemError
from fem_check.rows.agreement import AgreementRow, MeshLevel
from fem_check.running import records_store
from fem_check.solids import sector_comparison, sector_judgement, sector_pictures, sector_series, sector_statics
from fem_check.solids.bearing_sector import BearingSector, OuterSupport, SectorLoad, motion
from fem_check.solids.sector_comparison import ThrustPoint
from fem_check.solids.sector_geometry import SectorGeometry
from tests.verification.benchmarks import cutaway

POINT = ThrustPoint(17800.0, 10000.0 * qsbearing.rpm)


@pytest.fixture(scope="module")
def sector():
    bearing = sector_comparison.sector_bearing("b218")
    solution = sector_comparison.model("b218", POINT, gyroscopic_moment=False)
    return BearingSector(SectorGeometry(bearing, sector_comparison.expected(bearing, solution), 2))


def test_shipped_meshes_are_what_the_manifest_says():
    folder = meshing.committed_folder()
    entries = json.loads((folder / "sector_manifest.json").read_text())
    assert set(entries) == {path.name for path in folder.glob("sector-*.npz")}
    for name, entry in entries.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == entry["sha256"]


def test_orbit_under_outer_control_is_the_closed_form():
    inner, outer, ratio = radians(48.0), radians(34.0), 22.225 / 125.26
    orbit, rotation, _ = motion(ratio, inner, outer)
    assert orbit == pytest.approx((1.0 - ratio * cos(inner)) / (1.0 + cos(inner - outer)), rel=1e-12)
    assert rotation < 0.0


def test_ball_and_ring_are_in_equilibrium_and_near_the_model(sector):
    results = sector.solve(SectorLoad(POINT.axial_load, POINT.speed))
    inner, outer = results.inner, results.outer
    # Statics written down anew: the ball's two equations, and the ring's.
    axial = inner.load * np.sin(inner.angle) - outer.load * np.sin(outer.angle)
    radial = inner.load * np.cos(inner.angle) - outer.load * np.cos(outer.angle) + results.centrifugal_force
    assert abs(axial) < 1e-5 * inner.load and abs(radial) < 1e-5 * inner.load
    assert 16 * inner.load * np.sin(inner.angle) == pytest.approx(17800.0, rel=1e-5)
    # Centrifugal force from the orbit that the elements found: m r w^2.
    orbit = motion(0.5 * 22.225e-3 / results.ball_centre[1], inner.angle, outer.angle)[0] * POINT.speed
    mass = 7800.0 * np.pi * 22.225e-3**3 / 6.0
    assert results.centrifugal_force == pytest.approx(mass * results.ball_centre[1] * orbit**2, rel=1e-9)
    model = sector_comparison.model("b218", POINT, gyroscopic_moment=False)
    # Two elements per semi-axis, one position of the edge: loads to a per cent, angles to half a degree.
    assert inner.load == pytest.approx(model.inner.load[0], rel=0.01)
    assert np.degrees(abs(outer.angle - model.outer.angle[0])) < 0.5
    assert results.penetration < 1e-9


def test_what_the_mesh_does_to_an_ellipse_is_known_from_a_parabola(sector):
    results = sector.solve(SectorLoad(POINT.axial_load, POINT.speed))
    for race in ("inner", "outer"):
        mesh = sector.parabola_over_hertz(race, getattr(results, race))
        # Two elements per semi-axis at one position of the edge: each quantity off by per cents, not by tens of them.
        assert set(mesh) == {"semi_major_axis", "semi_minor_axis", "max_pressure"}
        assert all(0.001 < abs(ratio - 1.0) < 0.1 for ratio in mesh.values())


def test_the_pictures_show_the_bodies_and_their_contacts(sector):
    results = sector.solve(SectorLoad(POINT.axial_load, POINT.speed))
    drawn = sector_pictures.of_sector(sector, results, POINT.label)
    for name, body in drawn["bodies"].items():
        corners = np.sort(np.asarray(body["triangles"]), axis=1)
        edges = np.concatenate([corners[:, [0, 1]], corners[:, [0, 2]], corners[:, [1, 2]]])
        # A closed surface: each edge belongs to two triangles.
        assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
        assert max(body["pressure"]) > 500.0, name
    for contact in drawn["contacts"].values():
        p, gap = np.asarray(contact["p"]), np.asarray(contact["gap"])
        assert (gap[p > 0.0] < 1e-3).all() and gap.max() > 0.1


def test_meshed_bodies_obey_statics(sector):
    """Supports after the solution, inertia and stiffness against the drawing: no row of these knows the mesh."""
    load = SectorLoad(POINT.axial_load, POINT.speed)
    rows = sector_statics.rows("two elements per semi-axis", sector, load, sector.solve(load))
    assert {row.verdict for row in rows} == {"pass"}
    assert {row.quantity.split(",")[-1].strip() for row in rows} >= {"ball", "inner ring", "outer ring"}
    # The rings' volumes by Green's theorem against Pappus: a section without its groove is a rectangle.
    section = sector.geometry.bearing.section(np.array([0.0, 73.0e-3]), inner=False)
    flat = dataclasses.replace(section, groove_radius=1e-9)
    inner, outer = 73.0e-3, section.back_radius
    assert sector_statics.section_moment(flat) == pytest.approx(0.5 * section.width * (outer**2 - inner**2), rel=1e-6)


def test_half_spaces_in_the_bodies_place_give_the_model():
    values, _ = sector_comparison.half_spaces("b218", ThrustPoint(2000.0, 0.0), gyroscopic_moment=False)
    rows = sector_judgement.of_half_spaces("2 kN at rest", values, sector_comparison.sector_bearing("b218"))
    assert len(rows) == 5
    assert {row.verdict for row in rows} == {"pass"}
    # A reference twice as large, and one of a tenth of a degree or 2 % off, is seen in every row.
    for row in rows:
        change = 0.15 / row.reference if row.unit == "deg" else 0.05
        assert dataclasses.replace(row, reference=row.reference * (1.0 + change)).verdict == "fail", row.quantity
        assert dataclasses.replace(row, reference=2.0 * row.reference).verdict == "fail", row.quantity


def test_every_judged_row_of_the_record_has_a_reference_of_its_own():
    """Doubled, each reference that is not zero is missed; where it is zero, so is a value as large as the scale."""
    record = json.loads((records_store.FOLDER / "quick" / "bearing_sector.json").read_text())
    judged = [row for row in record["rows"] if row["tolerance_percent"] is not None]
    assert len(judged) >= 23
    # Of the ellipses b alone is not judged on few elements, and there is at the release level.
    read = [row for row in record["rows"] if "as read" in row["case"]]
    open_here = {(row["quantity"], row["why_tolerance"]) for row in read if row["tolerance_percent"] is None}
    assert open_here == {(f"{race} semi_minor_axis", sector_judgement.WHY_FOUND) for race in ("inner", "outer")}
    release = json.loads((records_store.FOLDER / "release" / "bearing_sector.json").read_text())
    minor = [row for row in release["rows"] if "as read" in row["case"] and row["quantity"] in dict(open_here)]
    assert minor and all(row["tolerance_percent"] is not None for row in minor)
    for entry in judged:
        row = AgreementRow(**{field.name: entry[field.name] for field in dataclasses.fields(AgreementRow)})
        other = dataclasses.replace(row, reference=2.0 * row.reference, found=row.found if row.reference else 1.0)
        assert (row.verdict, other.verdict) == ("pass", "fail"), (row.case, row.quantity)


def test_the_limit_of_light_loads_can_fail():
    """On the series on record; then with 2 % more displacement, 0.1 % more load, 0.05 degrees."""
    curve = records_store.read_all()["bearing_sector"]["pictures"]["bearing_sector"]["rigid"]["at rest"]

    def studied(index, more):
        return SimpleNamespace(
            point=ThrustPoint(curve["load_N"][index], 0.0),
            deviation=lambda name: curve[name]["deviation"][index] + more.get(bearing_sector.quantity_kind(name), 0.0),
            uncertain=lambda name: curve[name]["uncertainty"][index],
        )

    def verdicts(more):
        rows = bearing_sector._light_load_limit(studied(0, more), studied(1, more))
        return {
            bearing_sector.quantity_kind(row.quantity.split(" over ")[0].split(" less ")[0]): row.verdict
            for row in rows
        }

    assert set(verdicts({})) == set(bearing_sector.LIMIT_POWERS)
    assert set(verdicts({}).values()) == {"pass"}
    wrong = {"axial_displacement": 2.0, "load": 0.1, "angle": 0.05, "semi_major_axis": 0.5, "semi_minor_axis": 0.5}
    assert set(verdicts(wrong).values()) == {"fail"}


def test_what_a_free_ring_adds_is_judged_against_elastic_rings(monkeypatch):
    """On the release record's displacements; then with a ring that grows 10 % less."""
    record = json.loads((records_store.FOLDER / "release" / "bearing_sector.json").read_text())
    name = "axial_displacement"
    by_case = {row["case"]: row for row in record["rows"] if row["quantity"] == name}

    def studied(point, support, model):
        row = by_case[f"{point.label}, outside diameter {support}"]
        uncertainty = {name: abs(row["uncertainty_percent"] / 100.0 * row["reference"])}
        compared = SimpleNamespace(model=model, elements={name: row["found"]})
        return SimpleNamespace(point=point, compared=compared, uncertainty=uncertainty)

    def rows():
        for point in bearing_sector.POINTS[MeshLevel.RELEASE]:
            rigid = {name: float(sector_comparison.model("b218", point, gyroscopic_moment=False).displacement[0])}
            grown = sector_comparison.with_free_ring("b218", point)
            yield bearing_sector.grown_row(
                *(studied(point, s, m) for s, m in (("rigid", rigid), ("free", rigid), ("free", grown)))
            )

    judged = list(rows())
    # Light loads at speed: nothing that the displacement allows would tell rings that give way from rigid ones.
    assert [row.verdict for row in judged] == ["pass", "finding", "pass", "finding", *["pass"] * 4]
    assert judged[-1].unit == "m" and judged[-1].reference > 15e-6
    real = qsbearing.ElasticRings
    monkeypatch.setattr(qsbearing, "ElasticRings", lambda **given: real(**given | {"outer_width": 0.033}))
    assert {row.verdict for row in list(rows())[4:]} == {"fail"}


def test_a_moment_without_friction_is_refused(sector):
    with pytest.raises(ValueError, match="friction"):
        sector.solve(SectorLoad(17800.0, POINT.speed, gyroscopic_moment=True))


def test_an_unknown_scene_is_a_sentence():
    with pytest.raises(SceneProblemError, match="no_such_scene"):
        sector_comparison.sector_bearing("no_such_scene")


@pytest.mark.heavy
def test_a_free_outside_diameter_softens_the_bearing():
    bearing = sector_comparison.sector_bearing("b218")
    rigid, free = (
        sector_comparison.compare(
            "b218",
            POINT,
            BearingSector(SectorGeometry(bearing, sector_comparison.place("b218", POINT, support), 2), support),
            positions=4,
        ).elements["axial_displacement"]
        for support in OuterSupport
    )
    assert 1.2 * rigid < free < 1.5 * rigid


def test_every_finding_is_uncertain_and_every_quantity_judged_at_speed():
    """In the gate's record: ellipses and pressures, loads and angles, of both raceways."""
    rows = records_store.read_all()["bearing_sector"]["rows"]
    free = [row for row in rows if row["tolerance_percent"] is None and "largest uncertainty" not in row["case"]]
    assert free and all(row["uncertainty_percent"] is not None for row in free)
    judged = {row["quantity"] for row in rows if row["tolerance_percent"] and "rpm" in row["case"]}
    assert judged >= set(sector_comparison.QUANTITIES)


def test_what_the_comparison_resolves_is_said_of_each_series_for_itself():
    """By the series on record: the tolerances are those of centrifugal force alone; the moment's row is a finding."""
    record = records_store.read_all()["bearing_sector"]
    series = record["pictures"]["bearing_sector"]
    rows = bearing_sector.uncertainty_rows(series)
    alone = {row.quantity: row for row in rows if "centrifugal force alone" in row.case}
    moment = {row.quantity: row for row in rows if "gyroscopic moment" in row.case}
    assert set(alone) == set(moment) == set(bearing_sector.BOUNDS)
    assert {row.verdict for row in alone.values()} == {"pass"}
    assert {row.verdict for row in moment.values()} == {"finding"}
    curve = series[sector_series.WITH_MOMENT]["at speed"]["axial_displacement"]
    assert moment["axial_displacement"].found == pytest.approx(max(curve["uncertainty"]) / 100.0)
    allowed = bearing_sector.BOUNDS["axial_displacement"]
    assert (max(curve["uncertainty"]) > allowed) == ("it would fail: axial" in bearing_sector.moment_note(series))
    assert len(bearing_sector.uncertainty_rows({"rigid": series["rigid"]})) == len(alone)


@pytest.fixture(scope="module")
def cut_open(sector):
    load = SectorLoad(POINT.axial_load, POINT.speed)
    record = {"pictures": {"sector": sector_pictures.of_sector(sector, sector.solve(load), POINT.label)}}
    record["mesh"] = {"elements_per_semi_axis": sector.geometry.elements}
    return record, cutaway.bodies(record, sector.geometry)


def test_stress_below_a_contact_is_hertz(sector, cut_open):
    """Von Mises' stress of a slender ellipse is largest below the surface, 0.55 to 0.63 of p0 (Johnson, section 4.3),
    and falls off: at the ball's centre it is that of a point load's far field, a small part."""
    record, bodies = cut_open
    assert cutaway.geometry_of(record) == sector.geometry
    for body in bodies.values():
        p0 = body.pressure.max()
        assert 0.5 < body.von_mises.max() / p0 < 0.7
    ball = bodies["ball"]
    centre = 1e3 * np.array([*sector.geometry.expected.ball_centre, 0.0])
    depth = np.linalg.norm(ball.nodes - centre[:, None], axis=0)
    assert ball.von_mises[depth < 2.0].max() < 0.05 * ball.pressure.max()
    worst = ball.nodes[:, ball.von_mises.argmax()]
    below = 0.5 * 22.225 - np.linalg.norm(worst - centre)
    minor = np.linalg.norm(cutaway.hertz_ellipse(record, sector.geometry)[3])
    assert 0.2 * minor < below < 1.5 * minor


def test_the_ellipse_of_the_picture_holds_the_pressure(sector, cut_open):
    record, bodies = cut_open
    _, contact, major, minor = cutaway.hertz_ellipse(record, sector.geometry)
    ball = bodies["ball"]
    offset = ball.nodes - contact[:, None]
    along = offset.T @ major / (major @ major), offset.T @ minor / (minor @ minor)
    near = np.linalg.norm(offset, axis=0) < 2.0 * np.linalg.norm(major)
    pressed = near & (ball.pressure > 0.2 * ball.pressure.max())
    assert pressed.sum() > 20
    assert np.hypot(*along)[pressed].max() < 1.15


def test_the_picture_is_drawn(sector, cut_open, tmp_path, drawn):
    pytest.importorskip("pyvista")
    record, bodies = cut_open
    files = cutaway.files(bodies, tmp_path / "cut.png")
    cutaway.draw(files, cutaway.hertz_ellipse(record, sector.geometry), tmp_path / "cut.png", (320, 160))
    assert matplotlib.pyplot.imread(tmp_path / "cut.png").std() > 0.05
