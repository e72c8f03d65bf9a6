"""Results into a REXS model, by edits of its text: attributes are added or replaced, and no other line changes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.files.file_keys import ORIGIN
from qsbearing.files.rexs.axes import turned
from qsbearing.files.rexs.bearing_mapping import elements_of, is_ours
from qsbearing.files.rexs.model import Component, ListExtent, LoadCase, Span
from qsbearing.files.rexs.names import current
from qsbearing.files.rexs.reader import AttributeReader
from qsbearing.files.rexs.results import RowResult, Values, bearing_values, contact_values, shaft_values
from qsbearing.files.rexs.shaft_mapping import sides
from qsbearing.files.rexs.source import model_in, opened
from qsbearing.files.rexs.units import unit_named
from qsbearing.files.table_checks import Errors
from qsbearing.systems.sets.system_life import system_life

CONTACT = "rolling_element_contact"
SINCE_CONTACTS = (1, 3)


class WriteBack:
    """A model that takes the results of one scene or set.

    Raises:
        SceneFileError: the model cannot be read, or is not the one that the scene was made of.
    """

    def __init__(self, path: Path, document: dict[str, Any]) -> None:
        self.source = opened(path)
        self.model = model_in(self.source, with_places=True)
        self.errors: Errors = []
        origin = document.get(ORIGIN)
        self._origin: dict[str, Any] = origin if isinstance(origin, dict) else {}
        cause = f"`qsbearing import {path.name}` writes scene files with it" if not self._origin else ""
        numbers = self._origin.get("bearings")
        self.bearings: list[Component] = []
        if not isinstance(numbers, list) or not numbers:
            self._refuse("bearings", "missing", cause or "The ids of the bearings in the model, one for each row")
        for number in numbers if isinstance(numbers, list) else ():
            self.bearings += self._component("bearings", number)
        self.shaft = (
            next(iter(self._component("shaft", self._origin["shaft"])), None) if "shaft" in self._origin else None
        )
        self.case = self._load_case()
        self.reader = AttributeReader(self.model, self.case, self.errors)
        for each in self.bearings:
            if not is_ours(self.reader, each):
                self._refuse("bearings", f"{each} is no ball bearing that is solved here", value=each.number)
        rows = document.get("rows")
        count = len(rows) if isinstance(rows, list) else 1
        if self.bearings and len(self.bearings) != count:
            self._refuse("bearings", f"names {len(self.bearings)} bearings for {count} rows")
        self._along = self._origin.get("x_along", "+u")
        if self._along not in ("+u", "-u"):
            self._refuse("x_along", 'is neither "+u" nor "-u"', value=self._along)
        if self.errors:
            raise SceneFileError(str(path), self.errors)
        self._text: Any = self.source.text.decode("utf-8") if self.source.is_json else self.source.text
        self._edits: list[tuple[Span, Any]] = []
        self._added: dict[str, list[str]] = {"components": [], "relations": []}
        self._of_case: list[str] = []
        self.notes: list[str] = []
        self.count = 0

    def _refuse(self, key: str, problem: str, cause: str = "", value: Any = None) -> None:
        self.errors.append(FileErrorDetail(f"{ORIGIN}.{key}", problem, value, cause=cause))

    def _component(self, key: str, number: Any) -> list[Component]:
        component = self.model.components.get(number) if type(number) is int else None
        if component is None:
            self._refuse(key, "is no component of this model", "Is it the model that the scene was made of?", number)
        return [] if component is None else [component]

    def _load_case(self) -> LoadCase | None:
        number = self._origin.get("load_case")
        case = next((each for each in self.model.load_cases if each.number == number), None)
        if number is not None and case is None:
            self._refuse("load_case", "is no load case of this model", value=number)
        return case

    def put(self, solution: Any, readings: Any) -> bytes:
        """The file with the results of a solved case in it.

        Args:
            readings: of a scene its readings, of a set those of each row.
        """
        is_set = hasattr(solution, "rows")
        solved = solution.rows if is_set else [solution]
        read = readings if is_set else [readings]
        signs = [row.sign for row in solution.set.rows] if is_set else [1.0 if self._along == "+u" else -1.0]
        by_middle = solution.set.is_two_sided if is_set else (False,)
        by_bearing: dict[int, list[int]] = {}
        for number, each in enumerate(self.bearings):
            by_bearing.setdefault(each.number, []).append(number)
        for numbers in by_bearing.values():
            bearing = self.bearings[numbers[0]]
            at = [float(solution.set.rows[each].position) if is_set else 0.0 for each in numbers]
            middle = sum(at) / len(at)
            rows = [RowResult(solved[each], read[each], signs[each], place - middle, by_middle[each])
                    for each, place in zip(numbers, at, strict=True)]  # fmt: skip
            moved = solution.deflection([middle])[0] if is_set else None
            self._values(bearing, bearing_values(self.reader, bearing, rows, moved))
            parts = self.model.parts(bearing.number, "rolling_bearing_row")
            turn = turned(self.reader, bearing, sides(self.reader, bearing).get("inner_part"))
            for part, row in zip(parts, rows, strict=False):
                self._contacts(part, turn, row)
        if self.shaft is not None and is_set and solution.set.shaft is not None and solution.set.shaft.sections:
            self._values(self.shaft, shaft_values(self.reader, self.shaft, solution))
        return self._edited()

    def put_life(self, readings: Any) -> bytes:
        """The file with the life of each bearing under all load cases together, as what they accumulate to.

        Args:
            readings: of a scene over a spectrum, or of each row of a set.
        """
        self.case = self.model.accumulation or LoadCase(0, {})
        rows = readings if isinstance(readings, list) else [readings]
        for bearing in {each.number: each for each in self.bearings}.values():
            own = [row for row, each in zip(rows, self.bearings, strict=True) if each is bearing]
            is_nominal = any(row["life"].modified_reference_rating_life is None for row in own)
            name = f"{'nominal' if is_nominal else 'modified'}_reference_rating_life_time_iso_16281_2008"
            self._values(bearing, {name: float(system_life([row["spectrum"].duration for row in own]))})
        return self._edited()

    def _contacts(self, part: Component, turn: Any, row: RowResult) -> None:
        if not elements_of(self.reader, part) or self.model.version < SINCE_CONTACTS:
            self.notes.append(f"{part}: has no rolling elements that contacts could be put to")
            return
        contacts = contact_values(self.reader, part, turn, row)
        if contacts is None:
            self.notes.append(f"{part}: its rolling elements are not the balls that were solved; contacts are left out")
        for element, by_side in contacts or ():
            known = {self.reader.word(each, "rolling_element_contact_type"): each
                     for each in self.model.parts(element.number, CONTACT)}  # fmt: skip
            for side, values in by_side.items():
                kind = f"{side}_raceway_contact"
                if kind in known:
                    self._values(known[kind], values)
                else:
                    self._new_contact(element, kind, values)

    def _new_contact(self, element: Component, kind: str, values: Values) -> None:
        """A contact that the model does not have yet, and what relates it to its rolling element."""
        number = self._next(list(self.model.components), "components")
        relation = self._next([each.number for each in self.model.relations], "relations")
        form, own = self.source.form, [("rolling_element_contact_type", "none", kind)]
        texts = self._written(values)
        one = Component(number, CONTACT, "")
        inner = [form.attribute(*each) for each in (own + ([] if self.case else texts))]
        self._added["components"].append(form.component(number, CONTACT, "", inner, self._indent("components")))
        parts = [("assembly", element.number, element.kind), ("part", number, CONTACT)]
        self._added["relations"].append(form.relation(relation, "assembly", parts, self._indent("relations")))
        if self.case:
            self._add_to_case(one, [form.attribute(*each) for each in texts])

    def _next(self, numbers: list[int], name: str) -> int:
        return max(numbers, default=0) + 1 + len(self._added[name])

    def _written(self, values: Values) -> list[tuple[str, str, Any]]:
        """Name, unit and value of each attribute that the version has."""
        attributes = []
        for name, value in values.items():
            own = current(name, self.model.version)
            if own is not None:
                attributes.append((*own, _in_unit(value, own[1])))
        self.count += len(attributes)
        return attributes

    def _values(self, component: Component, values: Values) -> None:
        """Add attributes to a component, or to what the load case says of it; replace those that are there."""
        holder = self.case.components.get(component.number) if self.case else component
        form, new = self.source.form, []
        for name, unit, value in self._written(values):
            there = holder.attributes.get(name) if holder else None
            if there is None or there.span is None:
                new.append(form.attribute(name, unit, value))
                continue
            own, usual = unit_named(there.unit), unit_named(unit)
            if own is not None and usual is not None and own.kind == usual.kind and there.unit != unit:
                si = [usual.si(each) for each in value] if isinstance(value, list) else usual.si(value)
                unit, value = there.unit, _in_unit(si, there.unit)
            text = form.attribute(name, unit, value)
            self._edits.append((there.span, text if self.source.is_json else text.encode()))
        if holder is None:
            self._add_to_case(component, new)
        elif new and holder.place is not None:
            self._insert(holder.place, new)

    def _add_to_case(self, component: Component, attributes: list[str]) -> None:
        indent = self._indent("case")
        self._of_case.append(
            self.source.form.component(component.number, component.kind, component.name, attributes, indent)
        )

    def _insert(self, place: ListExtent, items: list[str]) -> None:
        self._edits.append(self.source.form.insertion(self._text, place, items, self._indent_of(place)))

    @property
    def _after_cases(self) -> ListExtent:
        """Where the accumulation goes: in XML after the last load case, in JSON after the list of them."""
        place = self.model.places["accumulation"]
        return ListExtent(place.span, place.span) if self.source.is_json else place

    def _indent(self, name: str) -> str:
        if name == "case" and self.case is not None and self.case.place is None:
            return self._indent_of(self._after_cases) + "  "
        place = self.case.place if name == "case" and self.case else self.model.places.get(name)
        return self._indent_of(place) if place is not None else "\n"

    def _indent_of(self, place: ListExtent) -> str:
        """A line end and the blanks before an item, as the file has them."""
        text = self._text
        newline, tab = ("\n", " ") if isinstance(text, str) else (b"\n", b" ")
        at = (place.last or place.span)[0]
        line = text[text.rfind(newline, 0, at) + 1 : at]
        blanks = line[: len(line) - len(line.lstrip())]
        if place.last is None:
            blanks = blanks + tab * 2
        before = text[max(0, text.find(newline) - 1) : text.find(newline)]
        end = ("\r\n" if before in ("\r", b"\r") else "\n") if newline in text else ""
        return end + (blanks if isinstance(blanks, str) else blanks.decode())

    def _edited(self) -> bytes:
        for name, items in self._added.items():
            if items:
                self._insert(self.model.places[name], items)
        if self._of_case and self.case is not None and self.case.place is not None:
            self._insert(self.case.place, self._of_case)
        elif self._of_case:
            place = self._after_cases
            self._insert(place, [self.source.form.accumulation(self._of_case, self._indent_of(place))])
        if self.errors:
            raise SceneFileError(str(self.source.path), self.errors)
        return self.source.edited(self._edits)


def _in_unit(value: float | list[float], unit: str) -> float | list[float]:
    of = unit_named(unit)
    assert of is not None, unit
    return [of.of(each) for each in value] if isinstance(value, list) else of.of(value)
