"""Which dent stays after the pressure of ISO 76's static rating: is it a ten-thousandth of the ball?

A ball on a flat, and the middle of the scene's inner contact, a long ellipse, as a line; each body has half of the
deformation (`elastic_plastic`). Yield stresses span through-hardened bearing steels.
"""

from __future__ import annotations

import numpy as np

from fem_check.independent import references
from fem_check.mechanics.elastic_plastic import Indentation
from fem_check.product.scenes import SceneProblemError, groove_contact
from fem_check.rows import convergence
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress
from qsbearing.model.contact.hertz import STATIC_PRESSURE

ELEMENTS = {MeshLevel.QUICK: (8, 12), MeshLevel.RELEASE: (12, 16)}
YIELD_STRESSES, EXPONENT = (1.8e9, 2.0e9, 2.2e9), 0.1
WHY = "set beforehand: 1 % of a stress counts like 1 % of the yield stress, which moves the dent by 5 to 8 %"


def line_mises(poisson_ratio: float) -> float:
    """Largest von Mises stress on the axis below a line contact, over p0 (Johnson 1985, eqs 4.46), plane strain."""
    depth = np.linspace(0.3, 1.5, 2001)
    root = np.sqrt(1.0 + depth**2)
    x, z = 2.0 * depth - (1.0 + 2.0 * depth**2) / root, -1.0 / root
    y = poisson_ratio * (x + z)
    return float(np.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2)).max())


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """The elastic contact against Hertz, then the dents."""
    groove = groove_contact(scene, "inner")
    if groove.ball != groove.race:
        raise SceneProblemError(f"scene {scene}: ball and raceway of unlike materials do not share the deformation")
    nu = groove.ball.poisson_ratio
    line = 2.0 / groove.problem(1.0).curvature_y / groove.ball_diameter
    rows: list[AgreementRow] = []
    for shape, is_line, radius, mises in (
        ("ball on a flat", False, 1.0, 2.0 * references.largest_shear(1.0, nu)[0]),
        ("middle of the inner contact as a line", True, line, line_mises(nu)),
    ):
        for yield_stress in (np.inf, *YIELD_STRESSES):
            progress(f"{shape}, {yield_stress / 1e6:.0f} MPa", 0.5 * is_line)
            per_mesh: list[tuple[float, ...]] = []
            for count in ELEMENTS[level]:
                of = Indentation(groove.ball, yield_stress, EXPONENT, STATIC_PRESSURE, count, is_line)
                at = of.loaded()
                size, stress = of.contact_radius(at) / of.radius, of.largest_mises(at) / of.max_pressure
                per_mesh.append((size, stress) if yield_stress == np.inf else (2.0 * radius * of.dent(at),))
            steel = "elastic" if yield_stress == np.inf else f"yield {yield_stress / 1e6:.0f} MPa"
            compared = (("size over Hertz", 1.0), ("largest von Mises stress over p0", mises))
            for number, (name, reference) in enumerate(
                compared if yield_stress == np.inf else (("permanent deformation over D", 1e-4),)
            ):
                values = [each[number] for each in per_mesh]
                doubt, is_finding = 100.0 * convergence.largest_change(values) / reference, reference == 1e-4
                source = "ISO 76, static rating: both bodies" if is_finding else f"Hertz; {references.SHEAR_SOURCE}"
                tolerance, why = (None, "a finding: the yield stress decides") if is_finding else (1.0, WHY)
                rows.append(
                    AgreementRow(f"{shape}, {steel}", name, "1", reference, source, values[-1], doubt, tolerance, why)
                )
    return Findings(rows, notes=["Isotropic hardening, no friction, small strains, no residual stress, one load."])


CHECK = Check(
    name="permanent_dent",
    question="Which dent stays after the pressure of ISO 76's static rating, against 1e-4 of the ball's diameter?",
    kind=CheckKind.MODEL_COMPARISON,
    reference="ISO 76's rule; Hertz and the elastic stresses below him",
    tolerance="elastic contact 1 %; dents: findings",
    run=run,
    largest_dofs=lambda level: 10_000,
)
