"""The checks, one question per file. A new one: a new file with question, reference and tolerance; a line here."""

from fem_check.checks import (
    bearing_contacts,
    bearing_sector,
    body_size,
    conformity,
    contact_at_the_edge,
    convergence_order,
    elastic_ring,
    free_ball,
    half_space_contacts,
    load_power_law,
    manufactured_solution,
    patch_test,
    permanent_dent,
    solution_contacts,
    solution_parts,
    true_geometry,
)
from fem_check.rows.agreement import Check, MeshLevel

ALL = {
    check.name: check
    for check in (
        patch_test.CHECK,
        manufactured_solution.CHECK,
        half_space_contacts.CHECK,
        load_power_law.CHECK,
        body_size.CHECK,
        convergence_order.CHECK,
        solution_contacts.CHECK,
        solution_parts.CHECK,
        free_ball.CHECK,
        true_geometry.CHECK,
        conformity.CHECK,
        contact_at_the_edge.CHECK,
        bearing_sector.CHECK,
        elastic_ring.CHECK,
    )
}
"""Every check by name, in the order of the report."""

OF_BEARING = {bearing_contacts.CHECK.name: bearing_contacts.CHECK}
"""What is run of a bearing that is named, unless a check is named too. The example's contacts are those of `ALL`."""

OPTIONAL = OF_BEARING | {permanent_dent.CHECK.name: permanent_dent.CHECK}
"""Checks that no run of all has."""


def usual(level: MeshLevel) -> dict[str, Check]:
    """What a run of all has at a level; at the quick one not what sees no error that the others there do not."""
    return {name: check for name, check in ALL.items() if check.at_quick or level is not MeshLevel.QUICK}


__all__ = ["ALL", "OF_BEARING", "OPTIONAL", "usual"]
