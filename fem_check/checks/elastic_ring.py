"""Do the elastic rings of the model give way as a ring of finite elements does, and do balls share their load as there?

The ring is plane stress, a rectangle in section, as the model's is. What a section with groove and shoulders does is
told by one pitch of a ring under its ball, in three dimensions.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import radians

import numpy as np

import qsbearing
from fem_check.elements.plane_ring import Ring, RingGrid, harmonics
from fem_check.independent.contact_problem import Array, ElasticConstants
from fem_check.independent.quasi_static import BalanceProblem, at_rest
from fem_check.independent.ring_sections import RingSections
from fem_check.product import problems, scenes
from fem_check.rows import convergence
from fem_check.rows.agreement import (
    EXAMPLE,
    AgreementRow,
    Check,
    CheckKind,
    Findings,
    MeshLevel,
    Progress,
    collapsed,
    covered,
)
from fem_check.rows.record import MeshRecord
from fem_check.solids import sector_comparison
from fem_check.solids.ring_pitch import RingPitch
from fem_check.solids.sector_geometry import SectorBearing
from qsbearing.model.effects import ring_compliance
from qsbearing.model.effects.elastic_rings import grooves_of

GRIDS = {MeshLevel.QUICK: ((64, 2), (96, 3), (128, 4)), MeshLevel.RELEASE: ((128, 4), (192, 6), (256, 8))}
"""Elements round half a ring, and through it."""
ORDER = 4.0
"""Of compliances, which are energies: twice the elements' order."""
STEEL, ALUMINIUM = ElasticConstants(208e9, 0.3), ElasticConstants(70e9, 0.33)
B218, THIN = (0.073863, 0.080), (0.099, 0.101)
"""Radii [m]; of B218's outer ring from the groove's bottom on."""
HOUSING, SHAFT = 0.100, 0.035
"""Outside radius of a housing round B218's outer ring, and bore radius of a shaft in `INNER`, of aluminium [m]."""
INNER = (0.045, 0.051)
WAVES = (0, 2, 3, 4, 5, 6, 7, 8)
LOAD_GRIDS = GRIDS | {MeshLevel.QUICK: ((96, 3), (128, 4), (192, 6))}
"""Finer at the quick level: the ball that carries least, 1 % of the largest load, hangs on the ring's shape most."""
FINER = {MeshLevel.QUICK: 1.0, MeshLevel.RELEASE: 0.1}
"""Of the tolerances; the grids' uncertainty falls to a fifteenth."""
TOLERANCES = {"outer": 0.025, "thin": 0.1, "housing": 0.015, "inner": 0.045, "shaft": 0.025}
"""Of each ring's compliances [%]."""
OPPOSED_TOLERANCES = (0.1, 0.1, 0.03, 0.02)
"""Of a ring as thin as can be, and of `THICKNESSES` [%]."""
WHY = "twice the grids' uncertainty at the ring's shortest wave"
WHY_OPPOSED = "one and a half to three times the grids' uncertainty"
MODEL = "qsbearing.model.effects.ring_compliance (Lame, Michell)"
OPPOSED = 0.25 * np.pi - 2.0 / np.pi
"""Change of a thin ring's diameter by two opposed loads, over P R³/(E I)."""
THICKNESSES = (0.02, 0.04, 0.08)
"""Over the mean radius."""
THIN_RING = "bending of a thin ring (Timoshenko)"
POINT_ORDER = 2.0
"""Of what a load at a point moves: the field there is singular."""
LOAD_ORDER = 2.0
"""Of what a load spread over two elements moves: the spreading's."""
BALANCED = 1e-8
"""Of the balls' equilibrium, in micrometres and kilonewtons."""
OUTSIDE, WIDTH = 0.160, 0.030
"""Of B218's outer ring [m]."""
LOADS = {"axial_load": 17800.0, "radial_load_y": 10000.0, "tilt_y": 0.0, "tilt_z": 0.0}
LOAD_TOLERANCES = {
    MeshLevel.QUICK: {"contact load": 0.2, "largest contact load": 3e-4, "axial": 0.05, "radial": 0.1},
    MeshLevel.RELEASE: {"contact load": 0.1, "largest contact load": 2e-4, "axial": 0.03, "radial": 0.05},
}
"""[%] Of the loads, by the ball that carries least; of the displacements."""
WHY_LOADS = (
    "twice the grids' uncertainty; a half-plane's part left in would move the ring by 0.3 %, a wave more or less by "
    "1 %, 5 % of its width a ball's load by 4 %"
)


BENDING = 3
"""Balls round a ring, few enough that bending is nearly all."""
SECTIONS = {
    "B218's outer ring, shoulders 70° and 20°, contact at 40°": (
        40.0, (70.0, 20.0), {MeshLevel.QUICK: (3,), MeshLevel.RELEASE: (3, 8, 12, 16, 24)},
    ),
    "the same, contact at 3°": (3.0, (70.0, 20.0), {MeshLevel.QUICK: (), MeshLevel.RELEASE: (3, 8, 12, 16, 24)}),
    "shoulders 50°, contact at 0°": (
        0.0, (50.0, 50.0), {MeshLevel.QUICK: (3,), MeshLevel.RELEASE: (3, 8, 12, 16, 24)},
    ),
    "shoulders 17°, contact at 0°": (
        0.0, (17.0, 17.0), {MeshLevel.QUICK: (), MeshLevel.RELEASE: (3, 8, 12, 16, 24)},
    ),
}  # fmt: skip
"""Of each section its contact angle, its shoulders as angles round the groove, and numbers of balls: at the quick level
only those that have a tolerance."""
PITCH_LOAD = 1660.0
"""Of the ellipse that presses [N]; what is found hardly depends on it."""
PITCH_ELEMENTS = {MeshLevel.QUICK: (1, 2), MeshLevel.RELEASE: (2, 3)}
PITCH_TOLERANCE = 10.0
"""[%]"""
MODEL_PITCH = "qsbearing.model.effects.elastic_rings: uniform growth and n = Z, 2 Z, ..."
WHY_PITCH = (
    "set after the first run, so it tells of changes and not how right the model is: bending of a section as a whole, "
    "without its rolling and without shear across its width; without shoulders it would deflect four times as far"
)


@dataclass(frozen=True)
class GridStudy:
    """One quantity on several grids."""

    sizes: list[float]
    values: list[float]
    order: float

    @property
    def uncertainty(self) -> float:
        """Of the finest grid's value."""
        return convergence.uncertainty_at_order(self.sizes, self.values, self.order)


def studied(grids: tuple[tuple[int, int], ...], values: list[list[float]], order: float = ORDER) -> list[GridStudy]:
    """Every number of a list that is read of each grid."""
    sizes = [1.0 / around for around, _ in grids]
    return [GridStudy(sizes, [float(one) for one in each], order) for each in zip(*values, strict=True)]


def body(radii: tuple[float, float], grid: tuple[int, int], material: ElasticConstants = STEEL) -> RingGrid:
    """On a grid."""
    return RingGrid(*radii, material, *grid)


def _constants(material: ElasticConstants) -> tuple[float, float]:
    return material.elastic_modulus, material.poisson_ratio


def rings(grid: tuple[int, int]) -> dict[str, tuple[Ring, bool, ring_compliance.PressureCompliance, float]]:
    """Each ring on a grid, whether it is pressed at its bore, what the model says of it, and its tolerance."""
    around, through = grid
    thick = around, 2 * through

    def annulus(one: RingGrid) -> ring_compliance.Annulus:
        return ring_compliance.Annulus(one.bore_radius, one.outside_radius, *_constants(one.material))

    outer, thin, inner = (body(radii, grid) for radii in (B218, THIN, INNER))
    housing = body((B218[1], HOUSING), thick, ALUMINIUM)
    shaft = body((SHAFT, INNER[0]), thick, ALUMINIUM)
    return {
        "free outer ring 73.863/80 mm": (
            Ring(outer), True, ring_compliance.outer_ring_compliance(annulus(outer), None), TOLERANCES["outer"],
        ),
        "free outer ring 99/101 mm": (
            Ring(thin), True, ring_compliance.outer_ring_compliance(annulus(thin), None), TOLERANCES["thin"],
        ),
        "outer ring 73.863/80 mm, sliding in aluminium 200 mm": (
            Ring(outer, housing), True, ring_compliance.outer_ring_compliance(annulus(outer), annulus(housing)),
            TOLERANCES["housing"],
        ),
        "free inner ring 45/51 mm": (
            Ring(inner), False, ring_compliance.inner_ring_compliance(annulus(inner), None), TOLERANCES["inner"],
        ),
        "inner ring 45/51 mm, sliding on aluminium, bore 70 mm": (
            Ring(inner, shaft), False, ring_compliance.inner_ring_compliance(annulus(inner), annulus(shaft)),
            TOLERANCES["shaft"],
        ),
    }  # fmt: skip


def wave_compliance(ring: Ring, at_bore: bool, n: int) -> float:
    """u_n/p_n of the rim that is pressed, away from the pressure [m/Pa]."""
    radius = ring.ring.bore_radius if at_bore else ring.ring.outside_radius
    moved = ring.moved(radius, ring.ring.pressed(radius, lambda angle: np.cos(n * angle)))
    return float(harmonics(moved)[n]) * (1.0 if at_bore else -1.0)


def compliance_rows(level: MeshLevel) -> list[AgreementRow]:
    """Every wave of every ring."""
    rows: list[AgreementRow] = []
    on_grids = [rings(grid) for grid in GRIDS[level]]
    for name, (_, _, compliance, tolerance) in on_grids[-1].items():
        values = [[wave_compliance(*grid[name][:2], n) for n in WAVES] for grid in on_grids]
        some = []
        for n, study in zip(WAVES, studied(GRIDS[level], values), strict=True):
            reference = float(compliance.groove[n])
            some.append(
                AgreementRow(
                    f"{name}, n = {n}", "compliance of the groove", "m/Pa", reference, MODEL, study.values[-1],
                    100.0 * study.uncertainty / reference, FINER[level] * tolerance, WHY,
                )
            )  # fmt: skip
        rows += [*collapsed(some, f"{name}, n = 0, 2 to {WAVES[-1]}"), covered(name, some)]
    return rows


def opposed_change(thickness: float, grid: tuple[int, int]) -> tuple[float, float]:
    """Change of a ring's diameter by two opposed loads from inside, over P R³/(E I), with all waves and with the
    model's; mean radius and width 1."""
    one = body((1.0 - 0.5 * thickness, 1.0 + 0.5 * thickness), grid)
    load = np.zeros(2 * len(one.nodes[0]))
    load[one.rim(one.bore_radius)[[0, -1]]] = 0.5  # half of each load, by symmetry
    moved = Ring(one).moved(one.bore_radius, load)
    size = STEEL.elastic_modulus * thickness**3 / 12.0
    some = harmonics(moved)[: ring_compliance.MOST_HARMONICS + 1 : 2]
    return size * float(moved[0] + moved[-1]), size * 2.0 * float(np.sum(some))


def opposed_by_series(thickness: float) -> float:
    """The same from the model's compliances."""
    bore = 1.0 - 0.5 * thickness
    annulus = ring_compliance.Annulus(bore, 1.0 + 0.5 * thickness, *_constants(STEEL))
    waves = ring_compliance.by_load(ring_compliance.rim_compliances(annulus).bore_by_bore, bore, 1.0)
    return 4.0 * float(np.sum(waves[::2])) * STEEL.elastic_modulus * thickness**3 / 12.0


def opposed_rows(level: MeshLevel) -> list[AgreementRow]:
    """Of rings of several thicknesses, and of a ring as thin as can be."""
    by_grid = []
    for grid in GRIDS[level]:
        values = [opposed_change(thickness, grid) for thickness in THICKNESSES]
        thin, next_thin = (each**2 for each in THICKNESSES[:2])
        limit = values[0][0] - (values[1][0] - values[0][0]) * thin / (next_thin - thin)
        by_grid.append([limit, *np.ravel(values)])
    limit_study, *thick = studied(GRIDS[level], by_grid, POINT_ORDER)
    source = f"{MODEL}, waves to n = {ring_compliance.MOST_HARMONICS}"
    left_out = "shear and normal force, which a thin ring leaves out"

    def row(case: str, reference: float, by: str, study: GridStudy, tolerance: float | None, why: str) -> AgreementRow:
        name, uncertainty = "change of diameter over P R³/(E I)", 100.0 * study.uncertainty / reference
        return AgreementRow(
            f"two opposed loads, {case}", name, "1", reference, by, study.values[-1], uncertainty, tolerance, why
        )

    thinnest, *others = (FINER[level] * each for each in OPPOSED_TOLERANCES)
    rows = [row("thickness to 0", OPPOSED, THIN_RING, limit_study, thinnest, WHY_OPPOSED)]
    for thickness, tolerance, every, some in zip(THICKNESSES, others, thick[::2], thick[1::2], strict=True):
        case = f"thickness {thickness:g} mean radii"
        rows += [
            row(case, OPPOSED, THIN_RING, every, None, left_out),
            row(f"{case}, the model's waves", opposed_by_series(thickness), source, some, tolerance, WHY_OPPOSED),
        ]
    return rows


def influence(grid: tuple[int, int], count: int, one: RingGrid) -> Array:
    """Radial movement of the groove at each ball by the radial loads of all [m/N]; (ball, ball).

    The load is spread over an element to either side; what moves the ring as a body is taken from it, and a
    half-plane's part of each harmonic, 2 r/(E n), from what it moves; harmonics beyond the model's are left out, which
    make up to 0.1 % of a displacement here.
    """
    bottom, spread = one.bore_radius, np.pi / grid[0]
    load = one.pressed(bottom, lambda angle: 1.0 * (angle < spread)) / (2.0 * spread * bottom * WIDTH)
    along = np.concatenate([np.cos(one.nodes[1]), -np.sin(one.nodes[1])])
    carried = one.pressed(bottom, np.cos)
    load -= carried * (load @ along) / (carried @ along)
    moved = harmonics(Ring(one).moved(bottom, load))
    n = np.arange(2.0, len(moved))
    moved[2:] -= (
        2.0 * bottom / (one.material.elastic_modulus * n) * np.sinc(n * spread / np.pi) / (np.pi * bottom * WIDTH)
    )
    moved[1], moved[ring_compliance.MOST_HARMONICS + 1 :] = 0.0, 0.0
    angle = 2.0 * np.pi * np.arange(count) / count
    by_distance = np.cos(np.outer(angle, np.arange(len(moved)))) @ moved
    return np.asarray(by_distance[np.subtract.outer(np.arange(count), np.arange(count)) % count])


def equilibrium(problem: BalanceProblem, by_load: Array) -> tuple[Array, Array]:
    """Ball loads [N], and displacement of the inner ring, at rest between it and an outer ring that gives way.

    Each ball a spring of Hertz's contacts along the line of its groove centres; the outer one is moved outward.
    """
    from scipy.optimize import root

    placed = problem.rows[0]
    row, free = placed.row, np.flatnonzero(~problem.held)
    size = 1e-6  # lengths in micrometres

    def loads_of(unknown: Array) -> tuple[Array, Array, Array]:
        shaft = problem.shaft.copy()
        shaft[free] = size * unknown[: len(free)]
        centres = row.groove_centres(placed.moved(shaft))
        centres[:, 1] -= size * unknown[len(free) :]
        distance = np.hypot(*centres.T)
        normal = centres / distance[:, None]
        inner, outer = (row.law(race, normal)[0] for race in ("inner", "outer"))
        spring = (inner ** (-2.0 / 3.0) + outer ** (-2.0 / 3.0)) ** -1.5
        return spring * np.maximum(distance - sum(row.lengths), 0.0) ** 1.5, normal, shaft

    def left(unknown: Array, part: float) -> Array:
        load, normal, _ = loads_of(unknown)
        on_shaft = np.einsum("b,bi,bij->j", load, normal, row.by_ring @ placed.place)
        moved = part * by_load @ (load * normal[:, 1])
        return np.concatenate([(on_shaft - problem.load)[free] * 1e-3, unknown[len(free) :] - moved / size])

    unknown = np.concatenate([at_rest(problem)[0][free] / size, np.zeros(len(row.azimuth))])
    away = 100.0  # its steps are parts of each unknown: nothing for one that is 0 but for rounding
    for part in (0.0, 0.01, 0.03, 0.1, 0.3, 1.0):
        unknown = root(lambda moved, part: left(moved - away, part), unknown + away, args=(part,), tol=1e-12).x - away
    remains = float(np.abs(left(unknown, 1.0)).max())
    if remains > BALANCED:
        raise scenes.SceneProblemError(f"the balls' equilibrium in a ring that gives way leaves {remains:.1e}")
    load, _, shaft = loads_of(unknown)
    return load, shaft


def load_rows(level: MeshLevel) -> list[AgreementRow]:
    """B218 under combined load, its outer ring free: each ball's load, and the inner ring's displacement."""
    rigid = replace(scenes.load_scene(EXAMPLE), operation=qsbearing.Operation(**LOADS))
    given = qsbearing.ElasticRings(outside_diameter=OUTSIDE, outer_width=WIDTH, housing="free")
    model = scenes.solve(EXAMPLE, "elastic ring", replace(rigid, ring_effects=(given,)))
    problem = problems.of_scene(rigid, EXAMPLE)
    drawing = problem.rows[0].row.drawing
    bottom = drawing.outer_groove_centre_radius + drawing.outer_groove_radius
    names = ["axial_displacement", "radial_displacement_y"]
    balls = np.asarray(model.outer.load)
    reference = [*map(float, balls), *map(float, model.displacement[:2])]
    values = []
    for grid in LOAD_GRIDS[level]:
        one = body((bottom, 0.5 * OUTSIDE), grid, drawing.ring)
        load, shaft = equilibrium(problem, influence(grid, len(balls), one))
        values.append([*load, *shaft[:2]])
    case = "B218, outer ring free and without shoulders, 17.8 kN axial, 10 kN radial"
    some = []
    for i, study in enumerate(studied(LOAD_GRIDS[level], values, LOAD_ORDER)):
        ball, allowed = i < len(balls), LOAD_TOLERANCES[level]
        name = "contact load" if ball else names[i - len(balls)]
        some.append(
            AgreementRow(
                f"ball {i + 1}" if ball else case, name,
                "N" if ball else "m", reference[i], "qsbearing.solve", study.values[-1],
                100.0 * study.uncertainty / abs(reference[i]), allowed[name if ball else name.split("_")[0]], WHY_LOADS,
            )
        )  # fmt: skip
    largest = "largest contact load"
    heaviest = replace(
        some[int(np.argmax(balls))], case=case, quantity=largest, tolerance_percent=LOAD_TOLERANCES[level][largest]
    )
    return [heaviest, *collapsed(some[: len(balls)], case), *some[len(balls) :]]


def pitch_rows(level: MeshLevel) -> list[AgreementRow]:
    """One pitch of B218's outer ring in three dimensions, with several shoulders and numbers of balls."""
    known = sector_comparison.sector_bearing(EXAMPLE)
    drawing, rows = known.drawing, []
    for name, (angle, shoulders, counts) in SECTIONS.items():
        at_angle, high, low = (radians(each) for each in (angle, *shoulders))
        profile = replace(known.sections.profile(drawing, "outer"), high_shoulder=high, low_shoulder=low)
        ring = sector_comparison.free_ring(drawing, profile)
        diameters = {name: getattr(ring, name) for name in ("outer_shoulder_diameter", "outer_open_diameter")}
        sections = RingSections.of(("option", diameters), ("scene", known.sections.known))
        compliance = ring.compliances(grooves_of(scenes.load_scene(EXAMPLE).bearing))[1]
        assert compliance is not None
        for count in counts[level]:
            reference = count * float(np.sum(compliance.by_load[::count]))
            compliances = [
                RingPitch(SectorBearing(drawing, count, sections), at_angle, PITCH_LOAD, elements).radial_compliance
                for elements in PITCH_ELEMENTS[level]
            ]
            rows.append(
                AgreementRow(
                    f"{name}, Z = {count}", "radial deflection by a ball's radial load", "m/N", reference, MODEL_PITCH,
                    compliances[-1], 100.0 * abs(compliances[-1] - compliances[0]) / reference,
                    PITCH_TOLERANCE if count == BENDING else None, WHY_PITCH,
                )
            )  # fmt: skip
    return rows


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Rings by themselves, then with balls; always B218, whatever the scene."""
    rows = compliance_rows(level)
    progress("compliances", 0.4)
    rows += opposed_rows(level)
    progress("opposed loads", 0.6)
    rows += load_rows(level)
    progress("one pitch in three dimensions", 0.7)
    rows += pitch_rows(level)
    finest = rings(GRIDS[level][-1])
    largest = max((ring for ring, *_ in finest.values()), key=lambda ring: ring.dofs)
    mesh: MeshRecord = {"elements_per_semi_axis": None, "dofs": largest.dofs, "file": None}
    notes = [
        "Ring and model are plane stress, their section a rectangle, but for one pitch in three dimensions: there the "
        "section has its groove and shoulders, one face is held axially, and the load is where the ball touches. The "
        "model grows as a rectangle from the groove's bottom on, and bends as a section with these shoulders."
    ]
    return Findings(rows, mesh, largest.solver, {}, notes)


def largest_dofs(level: MeshLevel) -> int:
    """Of ring and seat."""
    around, through = GRIDS[level][-1]
    return 2 * (2 * around + 1) * (6 * through + 2)


CHECK = Check(
    name="elastic_ring",
    question="Do elastic rings deflect as a ring of finite elements does, "
    "and do the balls share the load in the same way?",
    kind=CheckKind.VERIFICATION,
    reference="closed forms of the model; bending of a thin ring; qsbearing.solve",
    tolerance="compliances 0.015 to 0.1 % (release a tenth); ball loads 0.2 % (0.1 %), displacements 0.05 and 0.1 % "
    "(0.03, 0.05); one pitch 10 %",
    run=run,
    largest_dofs=largest_dofs,
)
