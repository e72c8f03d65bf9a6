"""How far is Hertz from the real sphere and groove: the gap's shape, the surfaces' normals, or the bodies' size?"""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace

import qsbearing
from fem_check import meshing
from fem_check.checks import half_spaces_beside, surface_normals
from fem_check.independent import references
from fem_check.independent.contact_problem import QUANTITIES
from fem_check.independent.groove import RACES, BallInGroove
from fem_check.independent.references import HERTZ_SOURCE, hertz
from fem_check.mechanics import boundary_element
from fem_check.mechanics.contact import ContactError
from fem_check.meshing import MeshError
from fem_check.product.scenes import groove_contact, load_scene, operating_loads
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress, covered
from fem_check.rows.record import MeshRecord
from fem_check.solids import true_maps, true_statics
from fem_check.solids.mesh_room import NoRoomError, with_room
from fem_check.solids.true_contact import READ
from fem_check.solids.true_study import TrueContactStudy, assumed_shoulders, contacts, meshed, ring_doubt, solve
from qsbearing.documents.numbers import plain

MESHES = {MeshLevel.QUICK: (3, 4), MeshLevel.RELEASE: (5, 6, 8)}
"""Elements per semi-axis, coarse to fine. Of B218's inner contact at 5 kN 4 elements have the bodies shorten the
parabola's a by 0.06 %, 5 to 7 by 0.24 to 0.26 %."""
DOFS = {MeshLevel.QUICK: 30_000, MeshLevel.RELEASE: 110_000}
"""About so many unknowns has the larger of the two bodies, which are solved one after the other."""
LOADS = {
    MeshLevel.QUICK: (("inner", 2000.0, (2000.0,)),),
    MeshLevel.RELEASE: tuple((race, load, (load,)) for race in RACES for load in (500.0, 2000.0, 5000.0)),
}
"""Of the example: raceway, load that the meshes are made for, loads solved [N]."""
# Gap: two methods whose own errors are below 0.02 % (the pressure's largest: a twentieth of a per cent is what an
# error in a formula would exceed). The rest was set before the first run too.
GAP_TOLERANCES = {"approach": 0.1, "semi_major_axis": 0.1, "semi_minor_axis": 0.2, "max_pressure": 0.05}
GAP_REASON = "set beforehand: two methods on one gap; b, over which the mesh is coarsest, twice the others"
BULGE_TOLERANCE = 1.0
BULGE_REASON = (
    "set beforehand: a smooth field; a ball that is held at its equator in another way is off by tens of per cent"
)


def gap_rows(solved: TrueContactStudy) -> list[AgreementRow]:
    """The gap's shape, on the true bodies, against boundary elements; the ball's other side against a series."""
    strain = bodies_strain(solved)
    reference = boundary_element.over_hertz(solved.groove, solved.load, inclined=True, strain=strain)
    rows = []
    for name, tolerance in GAP_TOLERANCES.items():
        effect, uncertainty = solved.ratio("exact_gap", "parabola", name)
        of_both = 100.0 * uncertainty / reference.ratio[name] + reference.uncertainty_percent[name]
        rows.append(
            AgreementRow(
                f"{solved.case}: exact gap over parabola, true bodies",
                f"{name} over Hertz",
                "1",
                reference.ratio[name],
                boundary_element.SOURCE,
                effect,
                of_both,
                *solved.tolerance_of(name, tolerance, GAP_REASON),
            )
        )
    ratio, uncertainty = solved.bulge()
    uncertainty += lean(solved.groove, solved.load)
    exact = solved.bulges[-1][1]
    rows.append(
        AgreementRow(
            f"{solved.case}: ball pressed at two opposite points",
            "equator moves out",
            "m",
            exact,
            "elastic sphere in a series of Legendre polynomials (Lur'e 1964, section 6.4)",
            ratio * exact,
            100.0 * uncertainty,
            BULGE_TOLERANCE,
            BULGE_REASON,
        )
    )
    return [*rows, covered(solved.case, rows)]


def bodies_strain(solved: TrueContactStudy) -> float:
    """Curvature that the strain of the whole bodies adds across the groove, by what it makes of the parabola [1/m].

    In a ratio on the same bodies it does not cancel: the exact gap is steeper at its ends than the parabola, and gives
    way less. In a groove of 0.505 D at 40 degrees and 30 kN the bodies shorten the parabola's ellipse by 1.28 %, the
    exact gap's by 0.99 %: by elements the ratio is 0.30 % larger than that of half-spaces (9 and 10 per semi-axis; 0.25
    % where the shoulder is 4 degrees higher), by half-spaces with this curvature 0.30 %. On B218 at 5 kN it is 0.018 %
    of a and 0.006 % of p0. Where a coarse mesh lengthens the parabola by more than the bodies shorten it, as 4 elements
    do by 0.2 % at 2 kN, the curvature is unknown and left out.
    """
    longer = solved.parabola[-1]["semi_major_axis"]
    return references.curvature_of_length(solved.groove.problem(solved.load), longer) if longer < 1.0 else 0.0


def lean(groove: BallInGroove, load: float) -> float:
    """How far the series' radial forces may be from those along the shared normals, over them.

    At x these lean less than the ball's own normal, by the ball's share of the compliance times (1 - R/r) x/R; as part
    of a force this counts x/R times. With Hertz's <x^2> = a^2/5 that is 0.03 % for B218's inner contact at 5 kN.
    """
    share = groove.ball.compliance / (groove.ball.compliance + groove.race.compliance)
    mean = 0.2 * (hertz(groove.problem(load)).semi_major_axis / groove.ball_radius) ** 2
    return share * (1.0 - groove.ball_radius / groove.groove_radius) * mean


def true_rows(solved: TrueContactStudy) -> list[AgreementRow]:
    """The true contact against Hertz, and which part of the difference is whose: findings."""
    exact = hertz(solved.groove.problem(solved.load))
    rows = []
    for name in READ:
        parts = [
            f"{label} {100.0 * (value - 1.0):+.3f} ± {100.0 * uncertainty:.3f} %"
            for label, (value, uncertainty) in (
                ("gap's shape", solved.ratio("exact_gap", "parabola", name)),
                ("surfaces' normals", solved.ratio("surface", "exact_gap", name)),
                ("finite bodies and mesh", solved.estimate([each[name] for each in solved.parabola])),
            )
        ]
        # The bodies' size moves the approach alone; of the ellipse the ratio keeps the mesh's own error out.
        ratio, uncertainty = (
            solved.estimate([each[name] for each in solved.surface])
            if name == "approach"
            else solved.ratio("surface", "parabola", name)
        )
        if name == "approach" and solved.ring_doubt:
            parts.append(f"assumed dimensions of the ring ± {plain(100.0 * solved.ring_doubt, '.2g')} %")
            uncertainty += solved.ring_doubt
        rows.append(
            AgreementRow(
                f"{solved.case}: true contact",
                name,
                QUANTITIES[name],
                getattr(exact, name),
                HERTZ_SOURCE,
                getattr(exact, name) * ratio,
                100.0 * uncertainty,
                None,
                f"a finding: {', '.join(parts)}",
            )
        )
    return rows


def body_rows(solved: TrueContactStudy, level: MeshLevel) -> list[AgreementRow]:
    """Both bodies by statics, and what they make of the approach by methods of their own."""
    if solved.finest is None:
        return []
    case = f"{solved.case}: finite bodies"
    added = [solved.estimate(list(parts)) for parts in zip(*solved.added, strict=True)]
    approach = solved.estimate([each["approach"] for each in solved.surface])
    return [
        *true_statics.rows(case, solved.finest, solved.load),
        *true_statics.approach_rows(case, solved.finest, solved.load, added, approach, level),
    ]


def refused_rows(groove: BallInGroove, load: float, problem: Exception) -> list[AgreementRow]:
    """A contact that could not be solved, and why."""
    exact = hertz(groove.problem(load))
    case = f"{groove.name} {groove.race_name}, Q = {load:.0f} N: true contact"
    return [
        AgreementRow(case, name, QUANTITIES[name], getattr(exact, name), HERTZ_SOURCE, None, None, None, str(problem))
        for name in READ
    ]


NOTES = [
    "Reference points of the approach: the ball's equator, the plane through its centre normal to the contact (a plane "
    "of symmetry, as between two equal and opposite contacts), and the ring's seat, which is rigid: its bore or its "
    "outside diameter. The ring's segment is one ball pitch wide between planes of symmetry. Another convention moves "
    "the finite bodies' part of the approach, nothing else. The ball's part is nearly linear in load; the ring's "
    "changes with the contact angle and with the distance of the shoulder, 70° from the groove's bottom.",
    "Boundary elements solve half-spaces with the exact gap, so they are the reference for the effect of the gap's "
    "shape: in them pressure and gap lie along the contact's axis. In the true contact the pressure acts along the "
    "normal of the surface that the deformed bodies share; that changes every quantity about as much as the gap's "
    "shape does. Half-spaces inclined as the surface is have it but for the strain of the whole bodies, which changes "
    "the difference of their curvatures: the two may differ by twice that.",
    "The largest pressure is read off the pressure field; it lies beside the middle, for the groove is inclined to "
    "the contact. Ratios are of results on the same mesh. Uncertainties are the largest change from the coarser meshes "
    "to the finest; of approach and semi-axes in ratios, and of the ball's equator, the meshes' scatter, pooled over "
    "all loads (GUM 4.2.4), where there are several; of the equator also what the direction of the forces may add, "
    "which are radial in the series.",
]


def single(
    bearing: qsbearing.Scene, source: str, groove: BallInGroove, load: float, elements: int, progress: Progress
) -> tuple[list[AgreementRow], list[AgreementRow], TrueContactStudy]:
    """One contact of a bearing on the meshes of `sequence`, as `fem-check contact --geometry true` shows it.

    Its rows, those of them that the meshes are too coarse to judge, and the contact.

    Args:
        bearing: with its rings' sections.
        source: where it was read from.
        groove: ball and raceway at the contact angle.
        load: [N].
        elements: per semi-axis of the finest mesh.
        progress: progress callback.

    Raises:
        MeshError: gmsh cannot mesh the bodies.
        ContactError: the contact cannot be solved.
    """
    try:
        solved = with_room(
            lambda mesh_load: solve(meshed(bearing, source, groove, mesh_load, sequence(elements)), (load,), progress)[
                0
            ],
            load,
        )
    except (NoRoomError, MeshError) as problem:
        assumed = assumed_shoulders(bearing, source, groove, load)
        raise type(problem)(f"{problem}{assumed}") from problem
    solved = replace(solved, ring_doubt=ring_doubt(bearing, source, groove, load))
    before = [
        *gap_rows(solved),
        *surface_normals.rows(solved),
        *body_rows(solved, MeshLevel.QUICK),
    ]
    rows = decided(before)
    undecided = [row for row, first in zip(rows, before, strict=True) if row is not first]
    return [*rows, *true_rows(solved)], undecided, solved


def decided(rows: list[AgreementRow]) -> list[AgreementRow]:
    """Rows of a bearing whose meshes were not chosen for it: a finding in place of "fail" where they decide nothing.

    That is where the deviation is within its own uncertainty or the tolerance, and only both together exceed this.
    """

    def of(row: AgreementRow) -> AgreementRow:
        limit, doubt = row.tolerance_percent, row.uncertainty_percent
        if limit is None or doubt is None or row.verdict != "fail":
            return row
        if not abs(row.deviation_percent) <= max(limit, doubt):
            return row
        within = "its uncertainty" if abs(row.deviation_percent) <= doubt else "the tolerance"
        why = f"a finding: within {within}; these meshes are too coarse for the tolerance of {limit:g} %"
        return replace(row, tolerance_percent=None, why_tolerance=why)

    return [of(row) for row in rows]


def sequence(finest: int) -> tuple[int, ...]:
    """Elements per semi-axis of three meshes, coarse to fine."""
    return (finest // 2, 3 * finest // 4, finest)


def mesh_entry(solved: TrueContactStudy, elements: int) -> MeshRecord:
    """The finest mesh, as the record keeps it."""
    return {"elements_per_semi_axis": elements, "dofs": solved.dofs, "file": f"true_ball_{elements:02d}, true_ring"}


def loads_of(scene: str, level: MeshLevel) -> tuple[tuple[str, float, tuple[float, ...]], ...]:
    """What is solved: the example at its loads, another scene at those that its own contacts carry."""
    if scene == EXAMPLE:
        return LOADS[level]
    races = RACES if level is MeshLevel.RELEASE else RACES[:1]
    cases = []
    for race in races:
        loads = operating_loads(scene, race)
        if loads:
            some = loads[-1:] if level is MeshLevel.QUICK else sorted({loads[0], loads[len(loads) // 2], loads[-1]})
            cases += [(race, load, (load,)) for load in (float(f"{load:.4g}") for load in some)]
    return tuple(cases)


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """A bearing's raceways over the loads."""
    solutions: list[TrueContactStudy] = []
    refused: list[AgreementRow] = []
    for race, mesh_load, loads in loads_of(scene, level):
        try:
            own = solve(contacts(scene, race, mesh_load, MESHES[level]), loads, progress)
            of = load_scene(scene)
            solutions += [replace(each, ring_doubt=ring_doubt(of, scene, each.groove, each.load)) for each in own]
        except (MeshError, ContactError) as problem:
            refused += refused_rows(groove_contact(scene, race), mesh_load, problem)
    if not solutions:
        raise MeshError(f"no contact was solved: {refused[-1].why_tolerance if refused else 'none carries load'}")
    rows: list[AgreementRow] = []
    every: dict[str, list[TrueContactStudy]] = {}
    for each in (replace(one, alike=tuple(solutions)) for one in solutions):
        every.setdefault(each.groove.race_name, []).append(each)
        judged = [*gap_rows(each), *surface_normals.rows(each), *body_rows(each, level)]
        rows += [*(judged if scene == EXAMPLE else decided(judged)), *true_rows(each)]
    last = list(every.values())[-1][-1]
    if level is MeshLevel.RELEASE:
        rows += half_spaces_beside.rows(solutions, progress)
    pictures: dict[str, object] = {"true_geometry": {race: series(solved) for race, solved in every.items()}}
    pictures["pressures"] = [true_maps.pressure_map(each.finest, each.load) for each in solutions if each.finest]
    return Findings([*rows, *refused], mesh_entry(last, MESHES[level][-1]), last.solver, pictures, NOTES)


def series(solved: list[TrueContactStudy]) -> dict[str, object]:
    """Deviations from Hertz over the load, in per cent, for the picture."""
    drawn: dict[str, object] = {"load_N": [each.load for each in solved]}
    for key, gap in (("gap_shape", "exact_gap"), ("true_contact", "surface")):
        values: dict[str, list[float]] = {}
        spread: dict[str, list[float]] = {}
        for name in READ:
            both = [each.ratio(gap, "parabola", name) for each in solved]
            values[name] = [100.0 * (value - 1.0) for value, _ in both]
            spread[name] = [100.0 * uncertainty for _, uncertainty in both]
        drawn[f"{key}_percent"], drawn[f"{key}_uncertainty"] = values, spread
    by_half_spaces = [boundary_element.over_hertz(each.groove, each.load, inclined=True).ratio for each in solved]
    drawn["boundary_elements_percent"] = {
        name: [100.0 * (each[name] - 1.0) for each in by_half_spaces] for name in READ
    }
    drawn["added_um_per_kN"] = [[1e9 * part for part in each.added[-1]] for each in solved]
    return drawn


CHECK = Check(
    name="true_geometry",
    question="How far is Hertz from a true sphere in a true groove, in true bodies; at which load, and why?",
    kind=CheckKind.MODEL_COMPARISON,
    reference="boundary elements on half-spaces with the exact gap; a pressed elastic sphere in a series",
    tolerance="gap's shape: approach and a {approach:g} %, b {semi_minor_axis:g} %, p0 {max_pressure:g} % of boundary "
    "elements; ball's equator {ball:g} %; surfaces' normals: twice the bodies' strain over their difference of "
    "curvature".format_map(GAP_TOLERANCES | {"ball": BULGE_TOLERANCE}),
    run=run,
    largest_dofs=lambda level: DOFS[level],
)


def keep_meshes() -> None:
    """Put the quick level's meshes into the repository, and what they are into its manifest."""
    folder, entries = meshing.committed_folder(), meshing.manifest()
    for race, load, _ in LOADS[MeshLevel.QUICK]:
        for contact in contacts(EXAMPLE, race, load, MESHES[MeshLevel.QUICK]):
            for body in ("ball", "ring"):
                path = folder / contact.mesh_file(body)
                mesh = contact.mesh(body)
                mesh.save(path)
                entries[path.name] = {
                    "recipe": f"{EXAMPLE} {race}, {load:g} N, {body}: fem_check.solids.true_contact",
                    "elements_per_semi_axis": contact.elements,
                    "elements": mesh.tetrahedra.shape[1],
                    "nodes": mesh.points.shape[1],
                    "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
                    "gmsh": meshing.gmsh_version(),
                }
    (folder / meshing.MANIFEST).write_text(json.dumps(entries, indent=1) + "\n")


if __name__ == "__main__":
    keep_meshes()
