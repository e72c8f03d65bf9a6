"""Contact of two half-spaces, where Hertz is exact: meshes, levels, and the uncertainty of the result.

The result is the mean over `contact.POSITIONS` positions of the contact's edge within an element, on the finest mesh.
Its uncertainty: the estimate from the mesh sequence, the scatter of the positions, and that of meshes stretched out of
the contact's proportions, measured on the coarsest mesh, where it is largest and costs least.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from fem_check import meshing
from fem_check.elements import elastic_body, fields
from fem_check.elements.elastic_body import CondensedBody, Progress, Support, silent
from fem_check.elements.element_family import SERENDIPITY, ElementFamily
from fem_check.elements.pressure_basis import PressureBasis
from fem_check.independent.contact_problem import QUANTITIES, ContactProblem
from fem_check.independent.references import axis_ratio, hertz
from fem_check.mechanics import contact, measuring
from fem_check.mechanics.contact import ContactSolution
from fem_check.mechanics.measuring import Measured
from fem_check.rows import convergence
from fem_check.rows.agreement import AgreementRow, MeshLevel, covered
from fem_check.rows.record import MeshRecord

if TYPE_CHECKING:
    from skfem import MeshHex

SEQUENCES = {MeshLevel.QUICK: (4, 6, 8), MeshLevel.RELEASE: (8, 12, 16)}
"""Elements per semi-axis, coarse to fine."""
STRETCHES = ((1.0, 1.0), (1.03, 1.07), (1.07, 0.97))
"""Of the mesh along x and along y and z against the contact's own proportions: aligned first, then misaligned."""

ORDERS = {**dict.fromkeys(QUANTITIES, 2.5), "approach": 1.5, "max_shear_depth": 1.5}
"""Of convergence, from which the uncertainties follow; the check `convergence_order` holds the meshes to these. Seen
are 3.2 to 3.6, and 1.5 to 1.8 in the approach, whose errors are a tenth of the others'. The largest shear lies where a
slope of the stress vanishes, and slopes converge one order slower than the stress."""

# Tolerances: about twice the uncertainty that the meshes of a level have, the pressure's at the quick level 1.1 times;
# all tell the published Hertz fits (0.3 to 0.7 %) and any error in a formula from the exact form. The shear is flat at
# its maximum, so its depth is known to a few times less.
TOLERANCES = {
    MeshLevel.QUICK: {**dict.fromkeys(QUANTITIES, 0.3), "approach": 0.13, "max_shear_depth": 1.0},
    MeshLevel.RELEASE: {
        "approach": 0.01,
        "semi_major_axis": 0.05,
        "semi_minor_axis": 0.05,
        "max_pressure": 0.03,
        "max_shear_stress": 0.03,
        "max_shear_depth": 0.3,
    },
}
WHY = {
    MeshLevel.QUICK: "one to two times the meshes' uncertainty: below the error of any published Hertz fit (0.3 to "
    "0.7 %); depth: the maximum is flat",
    MeshLevel.RELEASE: "twice the meshes' uncertainty, ten times below the published Hertz fits; depth: a flat maximum",
}


@dataclass(frozen=True)
class Bodies:
    """The two half-spaces on one mesh."""

    ball: CondensedBody
    race: CondensedBody
    basis: PressureBasis
    recipe: meshing.Recipe
    proportions: tuple[float, float, float]
    """By which the recipe's brick is stretched along each axis."""

    @property
    def edge_element(self) -> float:
        """Size of the elements that the contact's edge falls in, over the semi-axis."""
        segment = self.recipe.x[0]
        return segment.length / segment.elements


@lru_cache(maxsize=96)
def _block(
    elements: int,
    proportions: tuple[float, float, float],
    poisson_ratio: float,
    family: ElementFamily,
) -> tuple[CondensedBody, PressureBasis]:
    mesh = stretched(meshing.load(meshing.half_space(elements)), *proportions)
    # The patch's cells are k times longer than wide: as many samples along them keep the far field exact.
    basis = elastic_body.pressure_basis_of(mesh, samples_per_cell=3 if proportions[0] < 12.0 else 5)
    return elastic_body.condense(
        mesh, basis, poisson_ratio, Support.HALF_SPACE, progress=_progress[-1], family=family
    ), basis


# A stack, not an argument: the progress reporter must not be part of the cache key.
_progress: list[Progress] = [silent]


def stretched(mesh: MeshHex, x: float, y: float, z: float) -> MeshHex:
    """The mesh, stretched along its axes."""
    from skfem import MeshHex

    points = mesh.p * np.array([[x], [y], [z]])
    return MeshHex(points, mesh.t, _boundaries=mesh.boundaries, sort_t=False)


def condensed_bodies(
    problem: ContactProblem,
    elements: int,
    stretch: tuple[float, float] = (1.0, 1.0),
    progress: Progress = silent,
    family: ElementFamily = SERENDIPITY,
) -> Bodies:
    """Both half-spaces of a problem, condensed; cached for the next contact of the same proportions."""
    # Rounded so that loads of one bearing share their bodies; the mesh need not know k to more digits.
    ellipticity = round(1.0 / axis_ratio(problem.curvature_x / problem.curvature_y), 3)
    proportions = ellipticity * stretch[0], stretch[1], stretch[1]
    _progress.append(progress)
    try:
        race, basis = _block(elements, proportions, problem.race.poisson_ratio, family)
        ball, _ = _block(elements, proportions, problem.ball.poisson_ratio, family)
    finally:
        _progress.pop()
    return Bodies(ball, race, basis, meshing.half_space(elements), proportions)


def clear_cache() -> None:
    """Empty the cache of condensed bodies and free its memory."""
    _block.cache_clear()


def solve_on(problem: ContactProblem, bodies: Bodies) -> tuple[ContactSolution, Measured]:
    """Solve and read one contact on two condensed bodies."""
    unit_lengths = contact.edge_positions(hertz(problem).semi_minor_axis, bodies.edge_element)
    solution = contact.solve(
        problem, bodies.basis, contact.total_flexibility(problem, bodies.ball, bodies.race), unit_lengths
    )
    return solution, measuring.measure(solution, bodies.ball, bodies.race)


@dataclass(frozen=True)
class MeshStudy:
    """A contact, solved on all meshes of a level."""

    problem: ContactProblem
    solution: ContactSolution
    """On the finest mesh."""
    sequence: list[Measured]
    """Coarse to fine, all in the contact's own proportions."""
    stretched: list[Measured]
    """On the coarsest mesh: in the contact's proportions, then out of them."""
    sizes: list[float]
    bodies: Bodies
    """Of the finest mesh."""

    def value(self, quantity: str) -> float:
        """Of the finest mesh, mean over all positions."""
        return float(getattr(self.sequence[-1].mean, quantity))

    def uncertainty(self, quantity: str) -> float:
        """Of the finest mesh's value: mesh sequence, position of the edge, alignment of the mesh."""
        along = [float(getattr(measured.mean, quantity)) for measured in self.sequence]
        mesh = convergence.uncertainty_at_order(self.sizes, along, ORDERS[quantity])
        aligned = [float(getattr(measured.mean, quantity)) for measured in self.stretched]
        return mesh + self.sequence[-1].position_uncertainty(quantity) + 0.5 * (max(aligned) - min(aligned))


def mesh_study(
    problem: ContactProblem,
    counts: Sequence[int],
    progress: Progress = silent,
    proportions: ContactProblem | None = None,
) -> MeshStudy:
    """Solve a contact on a sequence of meshes.

    Args:
        problem: the contact.
        counts: elements per semi-axis, coarse to fine.
        progress: progress callback.
        proportions: the contact that the meshes are stretched for; None: this one. Contacts of nearly its proportions
            then share its condensed bodies.
    """
    sequence, sizes, stretched_out = [], [], []
    for count in counts:
        for stretch in STRETCHES if count == counts[0] else STRETCHES[:1]:
            bodies = condensed_bodies(proportions or problem, count, stretch, progress=progress)
            solution, measured = solve_on(problem, bodies)
            if stretch == STRETCHES[0]:
                sequence.append(measured)
                sizes.append(bodies.edge_element)
            if count == counts[0]:
                stretched_out.append(measured)
    return MeshStudy(problem, solution, sequence, stretched_out, sizes, bodies)


def mesh_entry(bodies: Bodies) -> MeshRecord:
    """The finest mesh, as the record keeps it."""
    return {
        "elements_per_semi_axis": bodies.recipe.elements_per_semi_axis,
        "dofs": bodies.race.dofs,
        "file": bodies.recipe.file_name,
    }


def largest_dofs(level: MeshLevel) -> int:
    """Unknowns of the finest mesh of a level."""
    return meshing.half_space(SEQUENCES[level][-1]).dofs


def field(study: MeshStudy) -> fields.NodalFields:
    """Displacement, stress and pressure in the raceway's half-space: the quarter x, y >= 0 of its finest mesh.

    At one position of the contact's edge in the mesh, in the middle of those that the result is the mean of.
    """
    solution, bodies = study.solution, study.bodies
    middle = len(solution.unit_lengths) // 2
    length, pressure = float(solution.unit_lengths[middle]), solution.pressures[:, middle]
    race = study.problem.race
    mesh = stretched(meshing.load(bodies.recipe), *bodies.proportions)
    block = elastic_body.HeldBlock(mesh, bodies.basis, race.poisson_ratio, elastic_body.Support.HALF_SPACE)
    # Lengths in the mesh's unit, E = 1: a displacement of the real body is longer by the unit, and by 1/E.
    moved = block.moved(pressure[:, None]).reshape(-1, 3) / race.elastic_modulus
    space = block.space
    x, y, z = space.nodes
    on_contact = np.zeros(space.count)
    surface = np.flatnonzero(z < 1e-9 * z.max())
    on_contact[surface] = bodies.basis.values(x[surface], y[surface]) @ pressure
    return fields.of_body(space, moved, on_contact, race).scaled(length=length, stress=1.0)


def rows(
    case: str, study: MeshStudy, level: MeshLevel, source: str, quantities: tuple[str, ...] = ()
) -> list[AgreementRow]:
    """The contact compared with Hertz."""
    exact = hertz(study.problem)
    table = [
        AgreementRow(
            case,
            quantity,
            QUANTITIES[quantity],
            getattr(exact, quantity),
            source,
            study.value(quantity),
            100.0 * study.uncertainty(quantity) / abs(getattr(exact, quantity)),
            TOLERANCES[level][quantity],
            WHY[level],
        )
        for quantity in quantities or tuple(QUANTITIES)
    ]
    return [*table, covered(case, table)]


def soundness_rows(case: str, measured: list[Measured]) -> list[AgreementRow]:
    """The self-checks that no solver enforces, worst over all meshes."""
    names = ("asymmetry", "force_imbalance")
    return [
        AgreementRow(
            case,
            name,
            "1",
            0.0,
            "exact: Betti's theorem, equilibrium",
            max(float(getattr(each.soundness, name)) for each in measured),
            None,
            100.0 * float(getattr(measuring.LIMITS, name)),
            "asymmetry: far field exact, mesh not: twice that of the most slender contact; imbalance: rounding, 1e-13",
        )
        for name in names
    ]
