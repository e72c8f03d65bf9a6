"""One contact as true bodies, on its coarsest mesh, and planted errors that must not pass."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import qsbearing
from fem_check import meshing
from fem_check.checks import half_spaces_beside, surface_normals, true_geometry
from fem_check.independent import references
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.independent.groove import BallInGroove
from fem_check.mechanics import boundary_element
from fem_check.mechanics.contact import ContactError
from fem_check.product.scenes import groove_contact
from fem_check.rows.agreement import MeshLevel
from fem_check.solids import bodies, contact_block, true_contact, true_maps, true_statics
from fem_check.solids.tetrahedral_body import TetrahedralBody
from fem_check.solids.true_contact import TrueContact, loaded_angle
from fem_check.solids.true_study import TrueContactStudy, contacts

needs_gmsh = pytest.mark.skipif(meshing.gmsh_problem() is not None, reason=str(meshing.gmsh_problem()))
STEEL = ElasticConstants(208e9, 0.3)
LOAD = 2000.0


@pytest.fixture(scope="module")
def contact() -> TrueContact:
    return contacts("b218", "inner", LOAD, (3,))[0]


@pytest.fixture(scope="module")
def condensed(contact):
    return contact.condensed()


def gap_misses(condensed, times=1.0) -> list[str]:
    """Quantities whose ratio to the parabola's is farther from the boundary elements' than so many tolerances."""
    reference = boundary_element.over_hertz(condensed.contact.groove, LOAD, inclined=True).ratio
    exact = condensed.over_hertz(LOAD, follows_surface=False)
    parabola = condensed.over_hertz(LOAD, follows_surface=False, parabola=True)
    return [
        name
        for name, tolerance in true_geometry.GAP_TOLERANCES.items()
        if not 100.0 * abs(exact[name] / parabola[name] / reference[name] - 1.0) <= times * tolerance
    ]


def test_gap_of_the_true_bodies_is_the_boundary_elements(condensed):
    assert gap_misses(condensed) == []


@pytest.mark.parametrize("bodies", [-0.02, 0.0, 0.05])
def test_what_the_bodies_add_to_both_approaches_is_no_part_of_the_gap_s(bodies):
    half_spaces = {"approach": 1.008, "semi_major_axis": 0.98}
    parabola = [{"approach": 1.0 + bodies, "semi_major_axis": 1.0}] * 3
    exact_gap = [half_spaces | {"approach": half_spaces["approach"] + bodies}] * 3
    solved = TrueContactStudy(groove_contact("b218", "inner"), LOAD, parabola, exact_gap, [], [], [], 0, "")
    for name, expected in half_spaces.items():
        assert solved.ratio("exact_gap", "parabola", name)[0] == pytest.approx(expected, rel=1e-12)


def test_ball_moves_out_at_its_equator_like_an_elastic_sphere(condensed):
    ball, exact = condensed.bulges(LOAD)
    assert ball == pytest.approx(exact, rel=0.01 * true_geometry.BULGE_TOLERANCE)


def test_angle_is_that_of_the_model_at_rest():
    scene = replace(qsbearing.load_scene("b218"), operation=qsbearing.Operation(speed=0.0, axial_load=20_000.0))
    inner = qsbearing.solve(scene).inner
    load, angle = float(inner.load.ravel()[0]), float(inner.angle.ravel()[0])
    # Rounded to 1e-6 rad; the rest is rounding.
    assert loaded_angle(*(groove_contact("b218", race) for race in ("inner", "outer")), load) == pytest.approx(
        angle, abs=1e-6
    )


def test_sphere_under_pressure_all_round():
    # Each force stands for two: p = 2F/(4 pi R^2), and the sphere shrinks by (1 - 2 nu) p R/E.
    cosines, forces = np.linspace(-0.9999, 0.9999, 10_000), np.full(10_000, 0.5)
    pressure = 2.0 * forces.sum() / (4.0 * np.pi * 0.01**2)
    displacement = references.pressed_sphere(cosines, forces, 0.01, STEEL)
    assert displacement == pytest.approx(-0.4 * pressure * 0.01 / 208e9, rel=1e-4)


def test_a_sphere_s_equator_changes_smoothly_with_the_patch_that_presses_it():
    """Far from a patch only its moments count, so per force the displacement is a polynomial in its size squared."""
    across = np.linspace(-1.0, 1.0, 2001)[1:-1]
    forces = np.sqrt(1.0 - across**2) / np.sqrt(1.0 - across**2).sum()
    sizes = np.linspace(0.1, 0.2, 41)
    moved = [references.pressed_sphere(size * across, forces, 0.01, STEEL) for size in sizes]
    smooth = np.polyval(np.polyfit(sizes**2, moved, 2), sizes**2)
    np.testing.assert_allclose(moved, smooth, rtol=1e-4)


def test_scatter_of_the_approach_is_pooled_over_the_loads():
    # Meshes of one load that chance has brought together say nothing of their scatter.
    def solved(*parts):
        exact_gap = [{"approach": 1.0 + part} for part in parts]
        return TrueContactStudy(
            groove_contact("b218", "inner"), LOAD, [{"approach": 1.0}] * 3, exact_gap, [], [], [], 0, ""
        )

    together, apart = solved(0.01, 0.01, 0.01), solved(0.0198, 0.0202, 0.02)
    pooled = replace(together, alike=(together, apart)).ratio("exact_gap", "parabola", "approach")[1]
    assert together.ratio("exact_gap", "parabola", "approach")[1] == pytest.approx(0.0, abs=1e-15)
    # Variances 0 and (1 %)^2, each of two degrees of freedom; Student's t of four is 2.776.
    assert pooled == pytest.approx(0.01 * 2.776 * 0.01 / np.sqrt(2.0), rel=1e-3)


def test_the_equator_s_uncertainty_holds_the_direction_of_the_forces():
    # The series' forces are radial; on the bodies they act along the shared normal, which leans less.
    groove = groove_contact("b218", "inner")
    assert true_geometry.lean(groove, 5000.0) == pytest.approx(3.1e-4, rel=0.05)
    # It grows as the square of the ellipse.
    small = true_geometry.lean(groove, 158.1139)
    assert true_geometry.lean(groove, 5000.0) == pytest.approx(10.0 * small, rel=1e-4)
    parabola, exact = ([dict.fromkeys(true_contact.READ, value)] * 3 for value in (1.0, 1.01))
    solved = TrueContactStudy(groove, 5000.0, parabola, exact, exact, [(1.0003, 1.0)] * 3, [], 0, "")
    equator = next(row for row in true_geometry.gap_rows(solved) if row.quantity == "equator moves out")
    assert equator.uncertainty_percent > 0.03 > equator.deviation_percent - 1e-9


def test_hertz_s_gap_on_the_true_bodies_gives_his_ellipse_but_for_the_mesh(condensed):
    # With three elements per semi-axis a is 0.2, b 1.0 and p0 1.8 % off; the ratios of the checks keep that out.
    over_hertz = condensed.over_hertz(LOAD, follows_surface=False, parabola=True)
    for name, within in (("semi_major_axis", 0.005), ("semi_minor_axis", 0.02), ("max_pressure", 0.03)):
        assert over_hertz[name] == pytest.approx(1.0, abs=within)


def test_normals_that_follow_the_surface_matter(condensed):
    surface = condensed.over_hertz(LOAD, follows_surface=True)
    axis = condensed.over_hertz(LOAD, follows_surface=False)
    # A slope of a/R = 0.2 at the edge: of the order of its square over ten, and towards a shorter, wider contact.
    assert 1.001 < surface["semi_minor_axis"] / axis["semi_minor_axis"] < 1.005
    assert 0.995 < surface["semi_major_axis"] / axis["semi_major_axis"] < 0.999


def test_load_beyond_the_mesh_is_said(condensed):
    # The load that was asked for, not one of those over which the result is averaged.
    said = "the contact at 6000 N fills the patch of the mesh that is made for 2000 N .*along rolling, with 3 elements"
    with pytest.raises(ContactError, match=said):
        condensed.over_hertz(3.0 * LOAD, follows_surface=True)


def test_a_map_has_the_contact_s_pressure_over_hertz_s(condensed):
    told = true_maps.pressure_map(condensed, LOAD)
    x, y, p = (np.array(told[name]) for name in "xyp")
    assert (told["race"], told["load_N"], told["elements"]) == ("inner", LOAD, 3)
    exact = references.ellipse(condensed.contact.groove.problem(LOAD))
    # Of Hertz's pressure <p> = 2 p0/3 over pi a b; the map is half of it, over a, b and p0. x grows with the angle.
    basis = condensed.contact.frame.basis
    force = 2.0 * basis.forces / (exact.semi_major_axis * exact.semi_minor_axis) @ p
    assert force == pytest.approx(2.0 * np.pi / 3.0, rel=1e-3)
    assert x[0] == pytest.approx(max(condensed.contact.frame.patch.lengths) / exact.semi_major_axis, rel=0.02)
    assert (y >= 0.0).all() and p[np.hypot(x, y) > 1.25].max() == 0.0
    # The inner contact's normal is -(sin, cos); with a larger angle it moves along -(cos, -sin).
    moved = condensed.contact.frame.in_space(np.array([[-1.0], [0.0], [0.0]]))[:2, 0]
    angle = condensed.contact.groove.contact_angle
    assert moved == pytest.approx([-np.cos(angle), np.sin(angle)])


def test_half_spaces_beside_are_each_contact_s_own(monkeypatch):
    asked = []

    def study(problem, counts, progress, proportions):
        asked.append((problem.load, proportions.load, counts))
        exact = references.hertz(problem)
        return SimpleNamespace(
            value=lambda name: 1.001 * getattr(exact, name), uncertainty=lambda name: 0.0005 * getattr(exact, name)
        )

    monkeypatch.setattr(half_spaces_beside.half_space_contact, "mesh_study", study)
    groove = groove_contact("b218", "inner")
    solved = [
        TrueContactStudy(replace(groove, contact_angle=angle), load, [], [], [], [], [], 0, "")
        for angle, load in ((0.71, 500.0), (0.75, 5000.0))
    ]
    rows = half_spaces_beside.rows(solved, lambda stage, part: None)
    assert asked == [(500.0, 500.0, (6, 8, 12)), (5000.0, 500.0, (6, 8, 12))]
    assert [row.case for row in rows[::4]] == [f"{each.case}: half-spaces" for each in solved]
    for row in rows:
        assert row.deviation_percent == pytest.approx(0.1) and row.uncertainty_percent == pytest.approx(0.05)
        assert row.verdict == ("fail" if row.tolerance_percent < 0.15 else "pass")


# --- planted errors ---------------------------------------------------------------------------------------------------


def normals_missed(condensed, follows=True):
    exact, surface = (condensed.over_hertz(LOAD, follows_surface=each) for each in (False, follows))
    solved = TrueContactStudy(condensed.contact.groove, LOAD, [], [exact, exact], [surface, surface], [], [], 0, "")
    return [row.quantity for row in surface_normals.rows(solved) if row.verdict == "fail"]


def test_pressure_along_the_normals_is_the_half_spaces_but_for_the_bodies_strain(condensed):
    assert normals_missed(condensed) == []
    # Twice the strain over the difference of curvature: Q 2 (1 - nu^2)/(E D^2) (1 - R/r), all by hand.
    strain = LOAD * 2.0 * (1.0 - 0.3**2) / 208e9 / 0.022225**2
    assert surface_normals.limit(condensed.contact.groove, LOAD) == pytest.approx(
        100.0 * 2.0 * strain / (1.0 - 11.1125 / 11.6281), rel=1e-9
    )


def test_planted_pressure_along_the_axis_is_seen(condensed):
    assert "max_pressure over Hertz" in normals_missed(condensed, follows=False)


def test_planted_upright_torus_is_seen_in_the_slant(condensed):
    """The inclined torus slants the pressure: boundary elements have its largest value over that in the middle."""
    exact, parabola = (condensed.over_hertz(LOAD, follows_surface=False, parabola=each) for each in (False, True))
    upright, inclined = (
        boundary_element.over_hertz(condensed.contact.groove, LOAD, inclined=each).ratio["max_pressure"]
        for each in (False, True)
    )
    # The vertex of 1 + s x - x^2/2 is s^2/2 high; three elements per semi-axis have the slant within a fifth.
    slant = np.sqrt(2.0 * (inclined / upright - 1.0))
    assert abs(exact["slant"] - parabola["slant"]) == pytest.approx(slant, rel=0.25)


def test_planted_parabola(condensed):
    planted = replace(condensed, contact=_with_gap(condensed.contact))
    assert "semi_major_axis" in gap_misses(planted)


def _with_gap(contact):
    planted = replace(contact)
    parabola = contact.groove.problem(LOAD).parabolic_gap

    class Frame(type(contact.frame)):
        def gap(self, xi, eta, ball=None, groove=None):
            return parabola(xi, eta)

    frame = contact.frame
    vars(planted)["frame"] = Frame(**{name: getattr(frame, name) for name in frame.__dataclass_fields__})
    return planted


def test_planted_groove_without_the_contact_angle(condensed, monkeypatch):
    def without(self):
        reach = self.ball_diameter / self.pitch_diameter
        return self.ball_radius * (1.0 + self._sign * reach) / reach

    boundary_element.over_hertz.cache_clear()
    monkeypatch.setattr(BallInGroove, "rolling_radius", property(without))
    try:
        assert gap_misses(condensed)
    finally:
        boundary_element.over_hertz.cache_clear()


def test_planted_largest_pressure_from_the_formula(condensed, monkeypatch):
    def formula(x, y, area, pressure):
        # x/a and y/b come in: the area is over a b too.
        scale = area.sum() / ((x.max() - x.min()) * (y.max() - y.min()))
        return 1.5 * float(pressure @ area) / scale / (0.5 * np.pi), 0.0, 0.0

    monkeypatch.setattr(true_contact, "central_shape", formula)
    assert gap_misses(condensed) == ["max_pressure"]


def test_planted_ball_clamped_at_its_equator(contact, monkeypatch):
    right = TrueContact._equator

    def clamped(self, ball):
        fixed, axes = right(self, ball)
        fixed[fixed[:, 0]] = True
        return fixed, axes

    monkeypatch.setattr(TrueContact, "_equator", clamped)
    equator, exact = contact.condensed().bulges(LOAD)
    assert abs(equator / exact - 1.0) > 0.01 * true_geometry.BULGE_TOLERANCE


def test_another_scene_is_checked_at_its_own_loads(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(
        '[bearing]\nname = "7210c"\n[operation]\naxial_load_N = 1500\nradial_load_y_N = 800\nmoment_z_Nm = 0\n'
    )
    inner = qsbearing.solve(qsbearing.load_scene(str(file))).inner.load
    ((race, mesh_load, loads),) = true_geometry.loads_of(str(file), MeshLevel.QUICK)
    # Four digits, so that every machine takes the same mesh.
    assert race == "inner" and loads == (mesh_load,) and mesh_load == pytest.approx(inner.max(), rel=1e-3)
    release = true_geometry.loads_of(str(file), MeshLevel.RELEASE)
    assert {race for race, _, _ in release} == {"inner", "outer"}
    assert len({load for race, load, _ in release if race == "inner"}) == 3


def test_ball_and_ring_are_each_of_their_own_material(contact, monkeypatch):
    """Where both are alike, one in place of the other changes nothing."""
    ceramic, meshes = ElasticConstants(315e9, 0.26), {body: contact.mesh(body) for body in ("ball", "ring")}
    hybrid = replace(contact, groove=replace(contact.groove, ball=ceramic))
    monkeypatch.setattr(TrueContact, "mesh", lambda self, body: meshes[body])
    assert (hybrid.ball().material, hybrid.ring().material) == (ceramic, contact.groove.race)
    compliances = [(1.0 - each.poisson_ratio**2) / each.elastic_modulus for each in (ceramic, contact.groove.race)]
    assert hybrid.frame.ball_share == pytest.approx(compliances[0] / sum(compliances), rel=1e-12)


def studied(contact, parabola, gaps, load=LOAD):
    """A contact of so many meshes, by the semi-axes and pressures of the parabola and the exact gap."""
    below, above = ([dict.fromkeys(true_contact.READ, value) for value in values] for values in (parabola, gaps))
    count = len(gaps)
    return TrueContactStudy(
        contact.groove, load, below, above, above, [(1.0, 1.0)] * count, [(0.0, 0.0)] * count, 0, ""
    )


@pytest.mark.parametrize("count", [2, 3])
def test_of_two_meshes_only_the_gap_s_part_of_the_approach_is_no_judgement(contact, count):
    """Its uncertainty is a scatter, and Student's t of one degree of freedom is 12.7."""
    solved = studied(contact, [1.0] * count, [0.999, 1.001, 1.0][:count])
    judged = {row.quantity.removesuffix(" over Hertz"): row.tolerance_percent for row in true_geometry.gap_rows(solved)}
    limits = {name: judged[name] for name in true_contact.READ}
    assert limits == true_geometry.GAP_TOLERANCES | ({"approach": None} if count == 2 else {})
    assert all(len(true_geometry.MESHES[level]) >= (3 if level is MeshLevel.RELEASE else 2) for level in MeshLevel)


def test_the_gap_s_reference_has_the_bodies_strain(contact):
    """A shorter parabola is curved more, and then the exact gap is shortened less; a mesh's own error tells nothing."""

    def reference(parabola):
        rows = true_geometry.gap_rows(studied(contact, [parabola] * 2, [1.0] * 2))
        return next(row.reference for row in rows if row.quantity.startswith("semi_major"))

    usual = reference(1.0)
    assert 1e-5 < reference(0.998) - usual < reference(0.996) - usual < 1e-3
    assert reference(1.002) == usual


def test_several_contacts_have_one_scatter_of_their_ratios(contact):
    """Where chance has all meshes of one contact alike, the others tell."""
    spread, alike = studied(contact, [1.0] * 3, [0.98, 0.984, 0.982]), studied(contact, [1.0] * 3, [0.99] * 3)
    both = [replace(each, alike=(spread, alike)) for each in (spread, alike)]
    doubts = [each.ratio("exact_gap", "parabola", "semi_major_axis")[1] for each in both]
    assert doubts[1] == pytest.approx(0.5 * doubts[0] * 0.01 / 0.009, rel=1e-9) and doubts[1] > 1e-4
    assert alike.ratio("exact_gap", "parabola", "semi_major_axis")[1] == 0.0


def test_the_whole_seat_is_held(contact):
    ring = TetrahedralBody(contact.mesh("ring"), contact.groove.race)
    fixed, _ = contact._segment(ring)
    _, y, z = ring.nodes
    # A bore of its own radius, to a hundredth of the smallest element; its meshes are kept in single precision.
    seat = np.abs(np.hypot(y, z) - contact.section.back_radius) < 1e-6
    assert seat.sum() > 100 and fixed[seat].all()


def rows_of_the_bodies(condensed, factor=1.0):
    added = [(factor * each, 0.0) for each in condensed.added_compliances(LOAD)]
    approach = condensed.over_hertz(LOAD, follows_surface=True)["approach"]
    return [
        *true_statics.rows("a case", condensed, LOAD),
        *true_statics.approach_rows("a case", condensed, LOAD, added, (approach, 0.0), MeshLevel.QUICK),
    ]


def failed(rows):
    return [row.quantity for row in rows if row.verdict == "fail"]


def test_bodies_hold_statics_and_their_approach_is_the_independent_one(condensed):
    assert failed(rows_of_the_bodies(condensed)) == []


def test_planted_doubled_compliances_are_seen(condensed):
    assert failed(rows_of_the_bodies(condensed, 2.0)) == [
        "Hertz plus what the ball adds",
        "Hertz plus what the ring adds",
    ]


def test_planted_ring_twice_as_wide_is_seen(condensed):
    planted = replace(condensed, contact=replace(condensed.contact, ball_count=condensed.contact.ball_count // 2))
    assert set(failed(true_statics.rows("a case", planted, LOAD))) == {
        "work of a uniform dilation, ring",
        "mass over density, ring",
    }


def with_shoulder(contact, semi_axes):
    """The contact where the groove ends so many semi-axes from its middle."""
    tip = contact.frame.patch.semi_major_axis / contact.groove.groove_radius
    shoulder = contact.groove.contact_angle + semi_axes * tip
    return replace(contact, profile=replace(contact.ring_profile, high_shoulder=shoulder))


def test_a_patch_near_the_shoulder_ends_at_the_groove_s_edge(contact):
    assert contact.frame.patch.reach == (contact_block.PATCH, contact_block.PATCH)
    for semi_axes, expected in ((1.45, 1.3), (1.35, 1.35), (1.02, 1.02)):
        frame = with_shoulder(contact, semi_axes).frame
        assert frame.patch.reach == pytest.approx((expected, contact_block.PATCH))
    # The edge itself, over the tangent plane; on the other side pressure has as much room as ever.
    across = contact.groove.groove_radius * np.sin(1.02 * frame.patch.semi_major_axis / contact.groove.groove_radius)
    assert frame.basis.lines_x[[0, -1]] == pytest.approx([-across, contact.frame.basis.lines_x[-1]])
    assert np.ptp(frame.basis.points[1][frame.basis.points[0] == frame.basis.lines_x[0]]) > 0.0
    assert with_shoulder(contact, 1.27).mesh_file("ring") != with_shoulder(contact, 1.26).mesh_file("ring")


@needs_gmsh
def test_an_uncut_contact_is_solved_up_to_the_groove_s_edge(contact, tmp_path, monkeypatch):
    monkeypatch.setattr(meshing, "cache_folder", lambda: tmp_path)
    near = with_shoulder(contact, 1.001).condensed()
    # Hardly moved over the mesh, which would cut it, one contact in place of the mean: a tells the cell, 0.3 semi-axes.
    assert gap_misses(near, times=4.0) == []
    with pytest.raises(meshing.MeshError, match=r"its ellipse ends 0\.2° .* beyond the groove's edge.* overrun"):
        with_shoulder(contact, 0.98).mesh("ring")


def test_elements_that_do_not_fit_a_groove_are_told_where_it_ends(contact):
    near = with_shoulder(contact, 1.1)
    with pytest.raises(meshing.MeshError, match=r"1\.1° .* from the groove's edge, .* need 3\.2°: one contact"):
        bodies.ring(near.section, contact.frame.patch, near.half_pitch, 3)
