"""What numbers a class of inputs takes, stated at its fields: the unit in which each is given, and its range.

    length: float = field(metadata=given_in("mm"))
    temperature: ArrayLike | None = field(default=None, metadata=given_in("C"))

The objects hold SI; the unit is that of drawings, catalogues and tables. A field without a default is required. Keys of
files, schemas, tables of reports and columns of results follow from this.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, Field, dataclass, fields
from enum import StrEnum
from functools import cache
from types import MappingProxyType
from typing import Any

from qsbearing.model.units import GPa, MPa, N, Nm, deg, kg_m3, mm, mrad, rpm, um, zero_celsius
from qsbearing.model.validation import (
    ANGLE,
    DENSITY,
    FORCE,
    LENGTH,
    MODULUS,
    MOMENT,
    POWER,
    PRESSURE,
    SPEED,
    TEMPERATURE,
    VELOCITY,
    Quantity,
)


@dataclass(frozen=True)
class Unit:
    """A unit in which numbers are given."""

    symbol: str
    ending: str = ""
    """Of names that tell it; empty where a name needs none."""
    size: float = 1.0
    """In SI."""
    quantity: Quantity | None = None
    """What other units the number is given in; None where there are none."""
    zero: float = 0.0
    """The unit's zero in SI."""


UNITS = {
    unit.symbol: unit
    for unit in (
        Unit(""),
        Unit("balls"),
        Unit("h"),
        Unit("mm", "mm", mm, LENGTH),
        Unit("um", "um", um, LENGTH),
        Unit("deg", "deg", deg, ANGLE),
        Unit("mrad", "mrad", mrad, ANGLE),
        Unit("rpm", "rpm", rpm, SPEED),
        Unit("m/s", "m_s", 1.0, VELOCITY),
        Unit("N", "N", N, FORCE),
        Unit("N m", "Nm", Nm, MOMENT),
        Unit("GPa", "GPa", GPa, MODULUS),
        Unit("MPa", "MPa", MPa, PRESSURE),
        Unit("kg", "kg"),
        Unit("kg m2", "kg_m2"),
        Unit("kg/m3", "kg_m3", kg_m3, DENSITY),
        Unit("N/um", "N_per_um", N / um),
        Unit("um/N", "um_per_N", um),
        Unit("kN m/rad", "kNm_per_rad", 1e3),
        Unit("C", "C", 1.0, TEMPERATURE, zero_celsius),
        Unit("1/K", "per_K"),
        Unit("1/GPa", "per_GPa", 1.0 / GPa),
        Unit("mm2/s", "mm2_s", mm**2),
        Unit("cm3/min", "cm3_min", 1e-6 / 60.0),
        Unit("J/(kg K)", "J_kgK"),
        Unit("J/K", "J_per_K"),
        Unit("W", "W"),
        Unit("kW", "kW", 1e3, POWER),
        Unit("W/K", "W_per_K"),
        Unit("m/s2", "m_s2"),
        Unit("SI", "SI"),
    )
}
"""Every unit that an input is given in, by its symbol."""


@dataclass(frozen=True)
class Input:
    """One number that a class of inputs takes, or a list of them."""

    name: str
    """Of the field."""
    unit: Unit
    range: tuple[float, float] | None = None
    """Which values are accepted at all, in SI; None where that depends on others."""
    part: tuple[str, ...] = ()
    """What of the whole it belongs to, from the outside inwards: ("outer", "housing")."""
    printed: str = ""
    """Which number that catalogues print of a bearing, in this unit, stands in for it; empty: none does."""
    is_list: bool = False
    is_required: bool = False
    goes_last: bool = False
    """Whether it is listed after those that do not."""
    words: str = ""
    """What it is, where the name does not state it."""

    @property
    def own_name(self) -> str:
        """Without what `part` says already: `width` of `outer_width`."""
        for whole in self.part:
            if self.name.startswith(f"{whole}_"):
                return self.name.removeprefix(f"{whole}_")
        return self.name

    @property
    def column(self) -> str:
        """What a column of results is called that tells part and unit."""
        return "_".join(filter(None, (*self.part, self.own_name, self.unit.ending)))

    def in_unit(self, value: float) -> float:
        """An SI value in the unit, without the rounding of its way there and back."""
        return float(f"{(value - self.unit.zero) / self.unit.size:.12g}")


_GIVEN, _MADE_OF, _ONE_OF, _TABLES_OF = "given", "made of", "one of", "tables of"
A_MATERIAL: Mapping[str, Any] = MappingProxyType({_MADE_OF: True})
"""The metadata of a field that is a material, of its name or its numbers."""


def given_in(
    unit: str = "",
    range: tuple[float, float] | None = None,
    *,
    part: tuple[str, ...] = (),
    printed: str | bool = "",
    is_list: bool = False,
    goes_last: bool = False,
    words: str = "",
) -> Mapping[str, Any]:
    """The metadata of a field that is given in this unit; empty: it has none. The others: see `Input`.

    Args:
        printed: True: the number of the field's name.
    """
    said = {"unit": UNITS[unit], "range": range, "part": part, "printed": printed}
    said |= {"is_list": is_list, "goes_last": goes_last, "words": words}
    return MappingProxyType({_GIVEN: said})


def number(name: str, unit: str = "", range: tuple[float, float] | None = None, words: str = "") -> Input:
    """A number that is given beside the fields of a class: a property, or an argument that no record holds."""
    return Input(name, UNITS[unit], range, words=words)


def one_of(kind: type[StrEnum] | type[bool]) -> Mapping[str, Any]:
    """The metadata of a field that is a word of these, or true or false."""
    return MappingProxyType({_ONE_OF: kind})


def made_of(kind: Any) -> Mapping[str, Any]:
    """The metadata of a field that is an object of this class, or several: a table of a file, or a list of tables; of
    `int`: numbers of rows."""
    return MappingProxyType({_TABLES_OF: kind})


@cache
def inputs_of(of: Any) -> tuple[Input, ...]:
    """Every number that a class of inputs takes, in the order in which they are listed.

    The class's fields first, then what it names in `also_given`.
    """
    own = fields(of) if hasattr(of, "__dataclass_fields__") else ()
    inputs = [_input(each) for each in own if _GIVEN in each.metadata]
    return (*sorted(inputs, key=lambda each: each.goes_last), *getattr(of, "also_given", ()))


def _input(of: Field[Any]) -> Input:
    said = dict(of.metadata[_GIVEN])
    said["printed"] = of.name if said["printed"] is True else said["printed"]
    return Input(of.name, **said, is_required=of.default is MISSING is of.default_factory)


def numbers_of(of: Any) -> tuple[Input, ...]:
    """Those that are single numbers."""
    return tuple(each for each in inputs_of(of) if not each.is_list)


def lists_of(of: Any) -> tuple[Input, ...]:
    """Those that are lists."""
    return tuple(each for each in inputs_of(of) if each.is_list)


def materials_of(of: Any) -> tuple[str, ...]:
    """The fields that are materials."""
    return tuple(_stated(of, _MADE_OF))


def choices_of(of: Any) -> dict[str, type[StrEnum] | type[bool]]:
    """The fields that are a word of several, or true or false; and which."""
    return _stated(of, _ONE_OF)


def words_of(of: Any) -> dict[str, str | bool]:
    """The words, or true or false, that an object has; those that it has not are left out."""
    chosen = {name: getattr(of, name) for name in choices_of(type(of))}
    return {name: own if isinstance(own, bool) else str(own) for name, own in chosen.items() if own is not None}


def parts_of(of: Any) -> dict[str, Any]:
    """The fields that are objects of another class of inputs, and the class; `int`: numbers of rows."""
    return _stated(of, _TABLES_OF)


def _stated(of: Any, what: str) -> dict[str, Any]:
    own = fields(of) if hasattr(of, "__dataclass_fields__") else ()
    return {each.name: each.metadata[what] for each in own if what in each.metadata}
