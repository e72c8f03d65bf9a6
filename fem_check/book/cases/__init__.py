"""All cases, in the order of the book: one a file, its texts beside it."""

from __future__ import annotations

from fem_check.book.case import Case
from fem_check.book.cases import endurance_1956, gmn_rigidities, iso_76_factors, motor_bearings

ALL: dict[str, Case] = {
    name: Case(name, module.run)
    for module in (gmn_rigidities, iso_76_factors, endurance_1956, motor_bearings)
    for name in [module.__name__.rpartition(".")[2]]
}
