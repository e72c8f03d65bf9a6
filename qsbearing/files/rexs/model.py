"""A REXS model as its file states it: components with attributes, what relates them, load cases; and where each stands
in the text, for edits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

from qsbearing.files.file_errors import FileErrorDetail
from qsbearing.files.rexs.names import version_of
from qsbearing.files.table_checks import Errors
from qsbearing.model.validation import printable, whole_number

Span = tuple[int, int]


class ListExtent(NamedTuple):
    """Of something in the text that has items: its own extent, and that of its last item."""

    span: Span
    last: Span | None


@dataclass
class Attribute:
    """One attribute and its value as the file has it: a text of XML, any value of JSON, or base64 with its code."""

    name: str
    unit: str
    value: Any
    span: Span | None = None


@dataclass
class Component:
    """One component, or what a load case changes of it."""

    number: int
    kind: str
    name: str
    attributes: dict[str, Attribute] = field(default_factory=dict)
    place: ListExtent | None = None

    def __str__(self) -> str:
        return printable(f"component {self.number} ({self.kind}{f', {self.name}' if self.name else ''})")


@dataclass
class Relation:
    """What relates components, by their roles."""

    number: int
    kind: str
    order: int
    parts: list[tuple[str, int]]

    def of(self, role: str) -> int | None:
        """The number of the component in this role."""
        return next((number for name, number in self.parts if name == role), None)


@dataclass
class LoadCase:
    """What a load case changes, by component."""

    number: int
    components: dict[int, Component]
    place: ListExtent | None = None


@dataclass
class Model:
    """A whole model."""

    version_text: str
    components: dict[int, Component]
    relations: list[Relation]
    load_cases: list[LoadCase]
    places: dict[str, ListExtent]
    """Of the lists `components` and `relations`; `accumulation`: where one may be put after the load cases."""
    accumulation: LoadCase | None = None
    """What all load cases do together; number 0."""
    read: set[tuple[int, str]] = field(default_factory=set)
    """The attributes that somebody has read so far, by component and by their name in the file."""

    @property
    def version(self) -> tuple[int, ...]:
        return version_of(self.version_text)

    @cached_property
    def _by_component(self) -> dict[int, list[Relation]]:
        by_component: dict[int, list[Relation]] = {}
        for relation in self.relations:
            for number in {number for _, number in relation.parts}:
                by_component.setdefault(number, []).append(relation)
        return by_component

    def relations_of(self, number: int) -> list[Relation]:
        """All relations of a component."""
        return self._by_component.get(number, [])

    def related(self, kind: str, role: str, number: int) -> list[Relation]:
        """Relations of a kind in which a component has a role, in their order."""
        relations = [each for each in self.relations_of(number) if each.kind == kind and (role, number) in each.parts]
        return sorted(relations, key=lambda each: each.order)

    def parts(self, number: int, kind: str) -> list[Component]:
        """The components of a type that a component is assembled of, in order."""
        assemblies = [
            each for name in ("ordered_assembly", "assembly") for each in self.related(name, "assembly", number)
        ]
        numbers = [each.of("part") for each in assemblies]
        return [
            self.components[each] for each in numbers if each in self.components and self.components[each].kind == kind
        ]

    def referenced(self, number: int, kind: str) -> Component | None:
        """The component of a type, such as a material, that a component refers to."""
        for each in self.related("reference", "origin", number):
            component = self.components.get(each.of("referenced") or -1)
            if component is not None and component.kind == kind:
                return component
        return None


def model_of(root: dict[str, Any], spans: dict[int, Span]) -> tuple[Model, Errors]:
    """The model of the tables of a file, and what is wrong with its structure: ids, references, the version.

    Args:
        spans: where lists and tables stand in the text, by their id in Python; empty where that is not known.
    """
    errors: Errors = []

    def listed(table: Any, name: str, what: str) -> list[dict[str, Any]]:
        value = table.get(name) if isinstance(table, dict) else None
        if value is not None and not (isinstance(value, list) and all(isinstance(each, dict) for each in value)):
            errors.append(FileErrorDetail(f"{what}: {name}", "is not a list of tables"))
            return []
        return value or []

    def place(table: dict[str, Any], name: str) -> ListExtent | None:
        items = table.get(name)
        return ListExtent(spans[id(items)], spans.get(id(items[-1])) if items else None) if id(items) in spans else None

    def numbered(items: list[dict[str, Any]], what: str) -> Iterator[tuple[int, dict[str, Any]]]:
        seen = set()
        for each in items:
            number = _whole(each.get("id"), f"{what}: id", errors)
            if number in seen:
                errors.append(FileErrorDetail(f"{what} {number}", "stands twice: which one is meant is not told"))
            elif number is not None:
                seen.add(number)
                yield number, each

    def components(table: dict[str, Any], what: str) -> dict[int, Component]:
        by_number = {}
        for number, each in numbered(
            listed(table, "components", what), "component" if table is root else f"{what}: component"
        ):
            one = Component(number, _text(each.get("type")), _text(each.get("name")), {}, place(each, "attributes"))
            for given in listed(each, "attributes", str(one)):
                name = _text(given.get("id"))
                if name in one.attributes:
                    errors.append(FileErrorDetail(f"{one}: {name}", "stands twice in the component"))
                values = [value for key, value in given.items() if key not in ("id", "unit")]
                one.attributes[name] = Attribute(
                    name, _text(given.get("unit")), values[0] if values else None, spans.get(id(given))
                )
            by_number[number] = one
        return by_number

    relations, cases = [], []
    for number, each in numbered(listed(root, "relations", "model"), "relation"):
        what = f"relation {number}"
        order = 0 if each.get("order") is None else _whole(each["order"], f"{what}: order", errors)
        refs = [(_text(ref.get("role")), _whole(ref.get("id"), f"{what}: ref", errors))
                for ref in listed(each, "refs", what)]  # fmt: skip
        parts = [(role, at) for role, at in refs if at is not None]
        relations.append(Relation(number, _text(each.get("type")), order or 0, parts))
    spectra = root.get("load_spectrum") or []
    listed_cases = [
        each for spectrum in (spectra if isinstance(spectra, list) else [spectra])
        for each in listed(spectrum, "load_cases", "load_spectrum")
    ]  # fmt: skip
    for number, each in numbered(listed_cases, "load_case"):
        cases.append(LoadCase(number, components(each, f"load_case {number}"), place(each, "components")))
    places = {name: at for name in ("components", "relations") if (at := place(root, name)) is not None}
    whole = next((each for each in spectra if isinstance(each, dict)), {}) if isinstance(spectra, list) else spectra
    together = whole.get("accumulation") if isinstance(whole, dict) else None
    if isinstance(together, dict):
        together = LoadCase(0, components(together, "accumulation"), place(together, "components"))
    elif (after := place(whole, "load_cases") if isinstance(whole, dict) else None) is not None:
        places["accumulation"] = after
    model = Model(_text(root.get("version")), components(root, "model"), relations, cases, places, together)
    return model, errors + _reference_errors(model)


def _reference_errors(model: Model) -> Errors:
    errors: Errors = []
    if not model.version:
        errors.append(FileErrorDetail("model: version", "is no version, such as 1.4", model.version_text))
    used = [
        (f"relation {each.number} ({each.kind}): {role}", at) for each in model.relations for role, at in each.parts
    ]
    used += [(f"load_case {case.number}: component", at) for case in model.load_cases for at in case.components]
    used += [("accumulation: component", at) for at in (model.accumulation.components if model.accumulation else ())]
    for path, number in used:
        if number not in model.components:
            errors.append(FileErrorDetail(path, "refers to a component that there is not", number))
    return errors


def _text(value: Any) -> str:
    return value if isinstance(value, str) else "" if value is None else str(value)


def _whole(value: Any, path: str, errors: Errors) -> int | None:
    """An id or an order; None, and an error, where it is no whole number."""
    text = str(value).strip() if isinstance(value, str | int) and not isinstance(value, bool) else ""
    if (number := whole_number(text)) is not None:
        return number
    errors.append(FileErrorDetail(path, "missing" if value is None else "is not a whole number", value))
    return None
