"""A contact as `qsbearing` computes it."""

from __future__ import annotations

import qsbearing
from fem_check.independent.contact_problem import ContactProblem
from qsbearing.model.contact.hertz import effective_modulus


def of_qsbearing(problem: ContactProblem) -> dict[str, float]:
    """Its quantities, by name; SI units."""
    modulus = effective_modulus(
        problem.ball.elastic_modulus,
        problem.ball.poisson_ratio,
        problem.race.elastic_modulus,
        problem.race.poisson_ratio,
    )
    contact = qsbearing.point_contact(problem.load, problem.curvature_x, problem.curvature_y, modulus)
    shear = qsbearing.subsurface_shear(contact.ellipticity, problem.race.poisson_ratio)
    return {
        "approach": contact.approach,
        "semi_major_axis": contact.semi_major_axis,
        "semi_minor_axis": contact.semi_minor_axis,
        "max_pressure": contact.max_pressure,
        "max_shear_stress": shear.stress * contact.max_pressure,
        "max_shear_depth": shear.depth * contact.semi_minor_axis,
    }
