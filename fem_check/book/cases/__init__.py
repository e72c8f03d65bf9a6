"""All cases, in the order of the book: one a file, its texts beside it."""

from __future__ import annotations

from fem_check.book.case import Case
from fem_check.book.cases import (
    axisforge_tilts,
    b218_textbook,
    bearing_design,
    boresi_contacts,
    code_aster_spheres,
    contacts_of_programs,
    endurance_1956,
    gmn_dynamic_ratings,
    gmn_hybrid_ratings,
    gmn_rigidities,
    half_loaded_ring,
    hamrock_209_film,
    iso_76_factors,
    iso_281_ratings,
    iso_16281_seven_balls,
    loaded_rings,
    mfpt_rig,
    motor_bearings,
    multiple_sets,
    nsk_6208,
    ntn_rigidities,
    pinion_on_motor,
    radial_over_axial,
    rings_with_fits,
    skf_examples,
    snfa_veb_rigidities,
    tpi_7014c,
    triple_set_factor,
    unloading_loads,
)

_ORDER = (
    motor_bearings,
    endurance_1956,
    mfpt_rig,
    gmn_rigidities,
    gmn_dynamic_ratings,
    gmn_hybrid_ratings,
    ntn_rigidities,
    tpi_7014c,
    radial_over_axial,
    unloading_loads,
    multiple_sets,
    snfa_veb_rigidities,
    triple_set_factor,
    iso_76_factors,
    iso_281_ratings,
    b218_textbook,
    half_loaded_ring,
    boresi_contacts,
    loaded_rings,
    code_aster_spheres,
    skf_examples,
    nsk_6208,
    pinion_on_motor,
    hamrock_209_film,
    iso_16281_seven_balls,
    axisforge_tilts,
    rings_with_fits,
    contacts_of_programs,
    bearing_design,
)
"""Measurements, then catalogues, standards and textbooks, then other programs."""

ALL: dict[str, Case] = {
    name: Case(name, module.run, getattr(module, "NEEDS", ()))
    for module in _ORDER
    for name in [module.__name__.rpartition(".")[2]]
}
