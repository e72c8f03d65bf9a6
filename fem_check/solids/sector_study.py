"""One operating point of a ball between both rings on several meshes: differences from the model, uncertainties."""

from __future__ import annotations

from dataclasses import dataclass, replace

from fem_check.mechanics.contact import ContactError
from fem_check.rows import convergence
from fem_check.rows.agreement import MeshLevel
from fem_check.solids import contact_block, sector_comparison
from fem_check.solids.bearing_sector import BearingSector, OuterSupport
from fem_check.solids.sector_comparison import QUANTITIES, ComparedSector, ThrustPoint, Values
from fem_check.solids.sector_geometry import SectorGeometry

ELEMENTS = {MeshLevel.QUICK: (2, 3), MeshLevel.RELEASE: (2, 3, 4, 6)}
"""Per semi-minor axis; six take 3 GB and 100 s. Each mesh is well apart from the next, as five and six are not, so that
every one tells of the finest's uncertainty."""
ORDER = 2.0
"""By which the errors of all else fall at least; on half-spaces those of the ellipse fall by 2.4 (`convergence_order`).
"""
FOLLOWING_APPROACH = {
    OuterSupport.RIGID: ("axial_displacement",),
    OuterSupport.FREE: ("axial_displacement", "load", "angle"),
}
"""What has the error of the contacts' approaches on a mesh. In rigid seats loads and angles hardly depend on these; a
free outer ring takes the place that they leave it."""
MOMENT_STEP = ", gyroscopic moment"
WITH_RINGS = ", elastic rings in the model"
"""Names the series against a model whose outer ring gives way as a free one."""


def quantity_kind(quantity: str) -> str:
    """Without the raceway's name."""
    return quantity.removeprefix("inner ").removeprefix("outer ")


@dataclass(frozen=True)
class Studied:
    """One operating point, from all meshes."""

    point: ThrustPoint
    compared: ComparedSector
    uncertainty: dict[str, float]
    """Of each quantity found, same unit."""
    sector: BearingSector
    """Its finest mesh."""
    as_read: Values
    """The finest mesh's, as it is, with the uncertainty of the meshes."""
    moment: bool
    with_rings: bool = False
    """Whether the model's outer ring gives way as a free one."""

    @property
    def case(self) -> str:
        """Load, speed and series."""
        return f"{self.point.label}, outside diameter {self.series}"

    @property
    def series(self) -> str:
        """Support and step."""
        return f"{self.sector.support}{MOMENT_STEP if self.moment else ''}{WITH_RINGS if self.with_rings else ''}"

    def scale(self, name: str) -> float:
        """What deviations and uncertainties count in: a hundredth of the model's value, or a degree."""
        return 1.0 if QUANTITIES[name] == "deg" else abs(self.compared.model[name]) / 100.0

    def deviation(self, name: str) -> float:
        """Elements less model, per cent or degrees."""
        return (self.compared.elements[name] - self.compared.model[name]) / self.scale(name)

    def uncertain(self, name: str) -> float:
        """The uncertainty, per cent or degrees."""
        return self.uncertainty[name] / self.scale(name)


def study(
    scene: str,
    point: ThrustPoint,
    level: MeshLevel,
    support: OuterSupport,
    *,
    gyroscopic_moment: bool = False,
) -> Studied:
    """Solve a point on all meshes: ellipse and pressure of the finest, the rest extrapolated at the release level."""
    meshes: list[ComparedSector] = []
    sizes: list[float] = []
    try:
        where = sector_comparison.place(scene, point, support, gyroscopic_moment=gyroscopic_moment)
        for elements in ELEMENTS[level]:
            try:
                geometry = SectorGeometry(sector_comparison.sector_bearing(scene), where, elements)
                sector = BearingSector(geometry, support, friction=gyroscopic_moment)
                meshes.append(sector_comparison.compare(scene, point, sector, gyroscopic_moment=gyroscopic_moment))
            except ContactError:
                # The coarsest mesh may lack room for the loads about the point; three are enough.
                if elements != ELEMENTS[level][0] or len(ELEMENTS[level]) < 4:
                    raise
                continue
            sizes.append(contact_block.PATCH / contact_block.cells(elements))
    except ContactError as problem:
        raise ContactError(f"{point.label}, outside diameter {support}: {problem}") from problem
    last = meshes[-1]
    of_elements, uncertainty = {}, {}
    for name in QUANTITIES:
        values = [mesh.elements[name] for mesh in meshes]
        if quantity_kind(name) in FOLLOWING_APPROACH[support] and level is MeshLevel.RELEASE:
            of_elements[name], of_mesh = convergence.extrapolated(sizes, values)
        else:
            of_elements[name] = values[-1]
            of_mesh = convergence.uncertainty_at_order(*convergence.well_apart(sizes, values), ORDER)
        uncertainty[name] = of_mesh + last.position_uncertainty[name]
    as_read = _finest(sizes, [mesh.as_read for mesh in meshes])
    return Studied(point, replace(last, elements=of_elements), uncertainty, sector, as_read, gyroscopic_moment)


def _finest(sizes: list[float], meshes: list[Values]) -> Values:
    """The finest mesh's values; the uncertainty from all meshes and the positions together."""
    last = meshes[-1]
    both = {
        name: convergence.uncertainty_at_order(
            *convergence.well_apart(sizes, [mesh.elements[name] for mesh in meshes]), ORDER
        )
        + last.position_uncertainty[name]
        for name in QUANTITIES
    }
    return replace(last, position_uncertainty=both)
