"""What a result is, once: its name, unit, words, symbol and source, where it is found, and what it is called.

A `Result` is one number of something that has several; a `Group` is what has them, such as the contacts with a
raceway; a `Place` is one result of one group, of a row of a set, over its balls. JSON, CSV, datasets, studies, tables
for people, pictures and the guide's page of symbols follow. `spelled` writes a place's name, `place_of` reads it: no
other function knows how one is made up.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import reduce
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.units import MPa, Nmm, deg, mm, mrad, rpm, um, zero_celsius
from qsbearing.model.validation import whole_number


class ResultUnit(NamedTuple):
    """A unit of results."""

    ending: str
    """Of the keys of what is in it."""
    size: float = 1.0
    """One of it in SI."""
    zero: float = 0.0
    """Its zero in SI."""


UNITS = {
    "1": ResultUnit(""),
    "N/um": ResultUnit("N_per_um", 1.0 / um),
    "N m/mrad": ResultUnit("Nm_per_mrad", 1.0 / mrad),
    "MPa m/s": ResultUnit("MPa_m_s", MPa),
    "m/s": ResultUnit("m_s"),
    "mm rpm": ResultUnit("mm_rpm", mm * rpm),
    "N mm": ResultUnit("Nmm", Nmm),
    "N m": ResultUnit("Nm"),
    "Mrev": ResultUnit("Mrev", 1e6),
    "h": ResultUnit("h", 3600.0),
    "C": ResultUnit("C", 1.0, zero_celsius),
    **{name: ResultUnit(name) for name in ("N", "Hz", "W", "balls")},
    **{
        name: ResultUnit(name, size)
        for name, size in (("deg", deg), ("mrad", mrad), ("rpm", rpm), ("um", um), ("mm", mm))
    },
    "MPa": ResultUnit("MPa", MPa),
}
"""Of all results, by the name that files and attributes have; "1": a ratio."""


def printed_unit(unit: str) -> str:
    """A unit as people write it: µm, °C, m³; nothing for "1". In keys and attributes it is plain ASCII."""
    plain = unit.replace("um", "µm").replace("m2", "m²").replace("m3", "m³")
    return {"1": "", "C": "°C", "Mrev": "million rev"}.get(unit, plain)


Path = str | tuple[Any, ...] | Callable[[Any], Any]
"""Where something is found: attributes, entries of a mapping and numbers of a channel, with points between or one by
one; nothing for the thing itself; or a function of it."""


def value_at(path: Path, of: Any) -> Any:
    """What is found there; None where there is none."""
    if callable(path):
        return path(of)
    parts = path if isinstance(path, tuple) else path.split(".") if path else ()
    return reduce(_part, parts, of)


def _part(of: Any, name: Any) -> Any:
    if of is None or isinstance(of, Mapping):
        return None if of is None else of.get(name)
    index = whole_number(name)
    return getattr(of, name) if index is None else of[..., index]


class Result(NamedTuple):
    """One number."""

    name: str
    """Of its key, without the unit."""
    unit: str = "1"
    """One of `UNITS`."""
    words: str = ""
    """What it is, where the name does not state it."""
    symbol: str = ""
    """In formulas, in LaTeX, without the index of a raceway."""
    source: str = ""
    """Of its equation; of a reading's result the reading states it."""
    path: Path | None = None
    """From what has it; its name, where nothing else is said."""
    size: float | None = None
    """What the number is divided by; that of the unit, where nothing else is said."""
    is_signed: bool = False
    """Whether its sign is a direction, so that the largest of several is the one of the largest size."""
    is_azimuth: bool = False
    """Whether it is a place around the bearing, of which none is more than another."""
    is_usual: bool = True
    """Whether a study keeps it unasked: not what takes a further solve, nor what follows from others."""
    is_column: bool = True
    """Whether a table has it; else it follows from what that has."""
    of_rows: tuple[str, ...] = ()
    """Of the balls of each row of a set, what a study keeps unasked: some of `OVER`."""
    entry: str = ""
    """In the record of `run --json`; its key, where nothing else is said."""
    aliases: tuple[str, ...] = ()
    """Other names that stay."""
    heading: str = ""
    """Of a narrow column, where its words are long."""
    raceway: str = ""
    """Inner or outer, where it is of one and its group is of none."""
    direction: str = ""
    """Of one of several channels: `radial y`."""

    @property
    def key(self) -> str:
        """Its name with its unit."""
        return "_".join(filter(None, (self.name, UNITS[self.unit].ending)))

    @property
    def in_record(self) -> str:
        """Under what it is in the record of `run --json`."""
        return self.entry or self.key

    def of(self, holder: Any, index: Any = ...) -> NDArray | None:
        """The number in its unit; None where the holder has none, or there is no holder.

        Args:
            index: of some cases, where there may be several.
        """
        values = value_at(self.name if self.path is None else self.path, holder)
        if values is None:
            return None
        zero, values = UNITS[self.unit].zero, np.asarray(values, float)[index]
        return np.asarray((values - zero if zero else values) / self.unit_size)

    @property
    def unit_size(self) -> float:
        """One of its unit in SI."""
        return UNITS[self.unit].size if self.size is None else self.size

    @property
    def plain_name(self) -> str:
        """For people."""
        return " ".join(filter(None, (self.raceway, self.own_words)))

    @property
    def own_words(self) -> str:
        """For people, without its raceway."""
        return self.words or self.name.replace("_", " ")

    @property
    def plain_symbol(self) -> str:
        """For tables of plain text: p0 for p_0, δ for \\delta."""
        plain = self.symbol.replace(r"\delta", "δ").replace(r"\mu", "µ")
        return plain.translate({ord(each): None for each in r"\{}_"})


BALL, ROW = "ball", "row"
"""Axes that the numbers of a group may have beyond the cases."""
RING = "ring"
"""What stands before the names of the inner ring's channels; labels leave it out."""


class Group(NamedTuple):
    """Results of one thing."""

    results: tuple[Result, ...]
    before: str = ""
    """What their names begin with, and what people may leave out: `ring`."""
    raceway: str = ""
    """Inner or outer, where it is of one."""
    prefix: str = ""
    """Before each one's own name."""
    holder: Path = ""
    """Of what has them, from the solution; of a reading from all readings by name."""
    axis: str = ""
    """`BALL` or `ROW`."""
    table: tuple[str, ...] | None = None
    """In the record of `run --json`, where each is under its key; None: that has them not."""
    reading: str = ""
    """That gives them, whose name is their prefix, which people may leave out."""
    source: str = ""
    """Of all of a reading."""
    by_words: bool = False
    """Whether each one's words alone state what it is."""
    is_requested: Callable[[Any], bool] | None = None
    """Whether a scene or set calls for them, so that nothing is read to know it; None: they are read."""

    def values(self, solution: Any, readings: Mapping[str, Any] | None = None) -> Iterator[tuple[Result, Any]]:
        """Each with its numbers; None where there are none."""
        holder = value_at(self.holder, (readings or {}) if self.reading else solution)
        return ((each, each.of(holder)) for each in self.results)


def _largest_size(values: NDArray, axis: int) -> NDArray:
    return np.asarray(np.fmax.reduce(np.abs(values), axis=axis))


def _least_size(values: NDArray, axis: int) -> NDArray:
    return np.asarray(np.fmin.reduce(np.abs(values), axis=axis))


MAX, MIN, SIZE, LEAST_SIZE = "max", "min", "size", "least_size"
OVER: dict[str, Callable[..., Any]] = {
    MAX: np.fmax.reduce,
    MIN: np.fmin.reduce,
    SIZE: _largest_size,
    LEAST_SIZE: _least_size,
}
"""With these after its name, the maximum or minimum over the balls of a result that each ball has; of one whose sign is
a direction also the largest and the smallest size."""
SAID = {MAX: "maximum", MIN: "minimum", SIZE: "largest size", LEAST_SIZE: "smallest size"}
SIZES = SIZE, LEAST_SIZE


def reduced(over: str, values: NDArray, is_per_ball: bool) -> NDArray:
    """Over the balls, where each has its own; one number for all has its size, and is its own maximum and minimum."""
    if is_per_ball:
        return np.asarray(OVER[over](values, axis=-1))
    return np.abs(values) if over in SIZES else values


class Place(NamedTuple):
    """Which result of what."""

    group: Group
    result: Result
    row: int = 0
    """Of a set, from 1; 0: of the whole."""
    over: str = ""
    """One of `OVER`; empty: each ball has its own, or there is one for all."""

    @property
    def name(self) -> str:
        """As `spelled`."""
        return spelled(self)

    @property
    def column(self) -> str:
        """In a table: its name with the unit."""
        return spelled(self, with_unit=True)

    @property
    def unit(self) -> str:
        """Of its result."""
        return self.result.unit

    @property
    def is_per_ball(self) -> bool:
        """Whether each ball has its own."""
        return self.group.axis == BALL and not self.over

    @property
    def is_usual(self) -> bool:
        """Whether a study keeps it unasked."""
        if self.row and self.group.axis == BALL:
            return self.over in self.result.of_rows
        return self.result.is_usual and (not self.row or self.group.axis == ROW or bool(self.group.reading))

    @property
    def overs(self) -> tuple[Place, ...]:
        """The places of one number of all balls, where each ball has its own."""
        ends = (end for end in (MAX, MIN, SIZE) if self.is_per_ball and (self.result.is_signed or end != SIZE))
        return tuple(self._replace(over=end) for end in ends)

    @property
    def endings(self) -> tuple[Place, ...]:
        """Likewise, and all others that a name may state: of one number for all whose sign is a direction its size."""
        if not self.result.is_signed:
            return self.overs
        return tuple(self._replace(over=end) for end in OVER) if not self.over else ()

    @property
    def raceway(self) -> str:
        """Inner or outer, where it is of one."""
        return self.group.raceway or self.result.raceway

    @property
    def label(self) -> str:
        """What it is, as pictures have it: without row, raceway, direction and what is taken of the balls."""
        group, result = self.group, self.result
        own = "" if result.direction else result.own_words
        before = (
            () if group.by_words else ("" if group.before == RING else group.before, group.prefix.replace("_", " "))
        )
        return " ".join(filter(None, (*before, own)))

    @property
    def attributes(self) -> dict[str, Any]:
        """What a dataset says of it; what it has not is left out."""
        group, result = self.group, self.result
        words = spelled(Place(group, result, self.row)).replace("_", " ")
        if group.by_words and not self.row:
            words = ", ".join(filter(None, (result.plain_name, group.raceway)))
        words = ", ".join(filter(None, (words, SAID.get(self.over))))
        about: dict[str, Any] = {"units": result.unit, "long_name": words, "symbol": result.symbol}
        about |= {"source": result.source or group.source, "label": self.label, "row": self.row}
        about |= {"raceway": self.raceway, "direction": result.direction, "over": self.over}
        return {name: value for name, value in about.items() if value}

    def of(self, solution: Any, readings: Any = None) -> NDArray | None:
        """Its numbers in its unit, shape (*cases) or (*cases, ball); None where there are none.

        Args:
            readings: by name, where it is of one; of a row of a set those of each row.
        """
        group, whole = self.group, solution
        if self.row and group.axis != ROW:
            whole, readings = solution.rows[self.row - 1], readings and readings[self.row - 1]
        values = self.result.of(value_at(group.holder, (readings or {}) if group.reading else whole))
        if values is None:
            return None
        if group.axis == ROW:
            values = np.asarray(values[..., self.row - 1])
        if self.over:
            values = reduced(self.over, values, group.axis == BALL)
        return values if self.is_per_ball else np.broadcast_to(values, whole.shape)


IN_FULL, WITHOUT_BEFORE, WITHOUT_READING = range(3)
"""How much of a name is left out."""


def in_name(words: str) -> str:
    """As part of a result's name."""
    return words.replace(" ", "_")


def spelled(place: Place, with_unit: bool = False, left_out: int = IN_FULL) -> str:
    """The name of a place: `inner_load`, `row_2_inner_load_max`, with its unit `row_2_inner_load_max_N`."""
    group = place.group
    parts = (
        f"{ROW}_{place.row}" if place.row else "",
        group.before if left_out == IN_FULL else "",
        group.raceway,
        "" if group.reading and left_out == WITHOUT_READING else group.prefix,
        place.result.name,
        place.over,
        UNITS[place.unit].ending if with_unit else "",
    )
    return "_".join(filter(None, parts))


def place_of(text: str, groups: Iterable[Group], of_rows: Iterable[Group] = ()) -> Place | None:
    """The place of a name as people write it: with or without its unit, with points as in `life.duration_h`, without
    what may be left out: the words ring, shaft or system before it, or its reading. None where there is none, or more
    than one reading may be meant.

    Args:
        groups: what there is.
        of_rows: of each row of a set.
    """
    name = text.replace(".", "_")
    first, _, rest = name.partition("_")
    number = rest.partition("_")[0]
    row = (whole_number(number) or 0) if first == ROW else 0
    whole = [Place(group, each, row) for group in (of_rows if row else groups) for each in group.results]
    near = [each for each in whole if each.result.name in name]
    near += [ending for each in near for ending in each.endings]
    for left_out in (IN_FULL, WITHOUT_BEFORE):
        for each in near:
            if name in (spelled(each, False, left_out), spelled(each, True, left_out)):
                return each
    short = {
        each for each in near if name in (spelled(each, False, WITHOUT_READING), spelled(each, True, WITHOUT_READING))
    }
    short |= {each for each in whole if name in each.result.aliases}
    return short.pop() if len(short) == 1 else None


_STRAIGHT, _TILTS = ("axial", "radial_y", "radial_z"), ("tilt_y", "tilt_z")


def _channels(
    straight: str, turning: str, tilts: tuple[str, str] = _TILTS, is_signed: bool = False
) -> tuple[Result, ...]:
    named = *((name, straight) for name in _STRAIGHT), *((name, turning) for name in tilts)
    return tuple(
        Result(name, unit, path=str(number), direction=name.replace("_", " "), is_signed=is_signed)
        for number, (name, unit) in enumerate(named)
    )


DISPLACEMENT = _channels("um", "mrad", is_signed=True)
LOAD = _channels("N", "N m", ("moment_y", "moment_z"), is_signed=True)
STIFFNESS = _channels("N/um", "N m/mrad")
"""Of the five channels: numbers along the last axis of an array."""

OF_EACH_ROW = ("inner_ring", "balls", "outer_ring")
NODES = (*OF_EACH_ROW, "oil", "shaft", "housing", "ambient")
"""Of a heat balance; a set has the first three once for each row."""
