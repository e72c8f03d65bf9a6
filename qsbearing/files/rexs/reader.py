"""Numbers and words of a model's components in SI, as a load case has them; what is wrong with them, all at once."""

from __future__ import annotations

import base64
import binascii
from contextlib import suppress
from math import isfinite
from typing import Any

import numpy as np

from qsbearing.files.file_errors import FileErrorDetail
from qsbearing.files.rexs.model import Attribute, Component, LoadCase, Model
from qsbearing.files.rexs.names import spellings, unit_of
from qsbearing.files.rexs.units import NUMBER, RexsUnit, unit_named
from qsbearing.files.table_checks import Errors
from qsbearing.model.validation import comma_advice, printable

_CODES = {"float64": "<f8", "float32": "<f4", "int32": "<i4"}


class AttributeReader:
    """Reads attributes of components; None where there is none, or an error, which is added to `errors`."""

    def __init__(self, model: Model, case: LoadCase | None, errors: Errors) -> None:
        self.model, self.case, self.errors = model, case, errors

    def attribute(self, component: Component, name: str) -> Attribute | None:
        """By any name that it ever had; what the load case says comes first."""
        changed = self.case.components.get(component.number) if self.case else None
        for holder in (changed, component):
            for each in spellings(name, self.model.version) if holder else ():
                attribute = holder.attributes.get(each) if holder else None
                if attribute is not None and attribute.value is not None:
                    self.model.read.add((component.number, attribute.name))
                    return attribute
        return None

    def number(self, component: Component, name: str) -> float | None:
        """In SI, by the unit that the file states."""
        attribute = self.attribute(component, name)
        if attribute is None:
            return None
        value, unit = self._finite(component, attribute, attribute.value), self._unit(component, attribute, name)
        return None if value is None or unit is None else unit.si(value)

    def positive(self, component: Component, name: str) -> float | None:
        """A number in SI, None where there is none; 0, which programs write for what they do not know, is none."""
        return self.number(component, name) or None

    def whole(self, component: Component, name: str) -> int | None:
        """A whole number."""
        value = self.number(component, name)
        if value is None or value == int(value):
            return None if value is None else int(value)
        self._wrong(component, name, "is not a whole number", value)
        return None

    def word(self, component: Component, name: str) -> str:
        """A text or the word of a choice; empty where there is none."""
        attribute = self.attribute(component, name)
        return printable(attribute.value.strip()) if attribute is not None and isinstance(attribute.value, str) else ""

    def flag(self, component: Component, name: str) -> bool | None:
        """True or false; None where there is neither."""
        attribute = self.attribute(component, name)
        value = None if attribute is None else str(attribute.value).strip().lower()
        return {"true": True, "1": True, "false": False, "0": False}.get(value or "")

    def array(self, component: Component, name: str) -> list[float] | None:
        """Numbers in SI."""
        attribute = self.attribute(component, name)
        unit = None if attribute is None else self._unit(component, attribute, name)
        if attribute is None or unit is None:
            return None
        values = attribute.value
        if isinstance(values, dict):
            values = self._decoded(component, attribute)
        if not isinstance(values, list):
            self._wrong(component, attribute.name, "is no array", attribute.value)
            return None
        numbers = [self._finite(component, attribute, each) for each in values]
        return None if None in numbers else [unit.si(each) for each in numbers if each is not None]

    def _decoded(self, component: Component, attribute: Attribute) -> Any:
        """The numbers of base64; blanks and line ends may stand in it."""
        code, text = str(attribute.value.get("code")), str(attribute.value.get("value"))
        try:
            data = base64.b64decode("".join(text.split()), validate=True)
            return np.frombuffer(data, _CODES[code]).astype(float).tolist()
        except (binascii.Error, ValueError, KeyError):
            self._wrong(component, attribute.name, f"is no array of {', '.join(_CODES)} in base64", code)
            return []

    def _finite(self, component: Component, attribute: Attribute, value: Any) -> float | None:
        number = None
        is_text = isinstance(value, str) and "_" not in value
        if is_text or (isinstance(value, int | float) and not isinstance(value, bool)):
            with suppress(ValueError, OverflowError):
                number = float(value)
        if number is not None and isfinite(number):
            return number
        problem = "is not a number" if number is None else "is not a finite number"
        self._wrong(component, attribute.name, problem, value, comma_advice(value))
        return None

    def _unit(self, component: Component, attribute: Attribute, name: str) -> RexsUnit | None:
        usual = unit_of(name)
        expected, given = unit_named(usual), unit_named(attribute.unit)
        assert expected is not None, usual
        if given is None or given.kind != expected.kind:
            is_bare = given is not None and given.kind == NUMBER
            problem = (
                "has no unit" if is_bare else f"is in {attribute.unit!r}, which is no unit of this kind that is known"
            )
            self._wrong(component, attribute.name, problem, cause=f"The data model has it in {usual}")
            return None
        return given

    def _wrong(self, component: Component, name: str, problem: str, value: Any = None, cause: str = "") -> None:
        error = FileErrorDetail(f"{component}: {name}", problem, value, cause=cause)
        if error not in self.errors:
            self.errors.append(error)
