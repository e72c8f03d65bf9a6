"""A REXS model in XML, and edits of its text.

Documents that declare anything (DOCTYPE, entities) are refused at the declaration, before anything is expanded.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.parsers import expat
from xml.sax.saxutils import escape, quoteattr

from qsbearing.files.file_errors import SceneFileError, refused
from qsbearing.files.limits import MOST_TAGS
from qsbearing.files.rexs.model import ListExtent, Span

DEEPEST = 16
"""Elements within each other; REXS has ten."""


@dataclass
class _Node:
    tag: str
    given: dict[str, str]
    start: int
    end: int = 0
    text: str = ""
    nodes: list[_Node] = field(default_factory=list)

    @property
    def span(self) -> Span:
        return self.start, self.end

    def all(self, tag: str) -> list[_Node]:
        return [each for each in self.nodes if each.tag == tag]


def read(data: bytes, path: Path) -> tuple[dict[str, Any], dict[int, Span]]:
    """The model of a text in UTF-8, without a byte-order mark, as JSON has it; and where each part stands, in bytes.

    Raises:
        SceneFileError: it is no XML, no REXS, or declares a document type.
    """
    root = _tree(data, path)
    if root.tag.rpartition("}")[2] != "model":
        raise refused(path, f"is no REXS model: its outermost element is <{root.tag[:40]}>, not <model>")
    spans: dict[int, Span] = {}

    def kept(node: _Node, content: Any) -> Any:
        spans[id(content)] = node.span
        return content

    def component(node: _Node) -> dict[str, Any]:
        attributes = [
            kept(each, {"id": each.given.get("id"), "unit": each.given.get("unit"), "value": _value(each)})
            for each in node.all("attribute")
        ]
        return {**node.given, "attributes": kept(node, attributes)}

    def load_case(node: _Node) -> dict[str, Any]:
        items = [kept(each, component(each)) for each in node.all("component")]
        return {**node.given, "components": kept(node, items)}

    def relation(node: _Node) -> dict[str, Any]:
        return {**node.given, "refs": [ref.given for ref in node.all("ref")]}

    model: dict[str, Any] = {"version": root.given.get("version")}
    for name, make in (("component", component), ("relation", relation)):
        outer = root.all(f"{name}s")
        if len(outer) > 1:
            raise refused(path, f"has <{name}s> {len(outer)} times; a REXS model has it once")
        if outer:
            items = [kept(each, make(each)) for each in outer[0].all(name)]
            model[f"{name}s"] = kept(outer[0], items)

    def spectrum(node: _Node) -> dict[str, Any]:
        cases = kept(node, [kept(each, load_case(each)) for each in node.all("load_case")])
        together = node.all("accumulation")
        return {"load_cases": cases} | ({"accumulation": load_case(together[0])} if together else {})

    model["load_spectrum"] = [spectrum(outer) for outer in root.all("load_spectrum")]
    return model, spans


def _tree(data: bytes, path: Path) -> _Node:
    if data.count(b"<") > MOST_TAGS:
        raise refused(path, f"has more than {MOST_TAGS:,} tags")
    parser = expat.ParserCreate("UTF-8")
    parser.buffer_text = True
    top = _Node("", {}, 0)
    stack = [top]

    def begin(tag: str, given: dict[str, str]) -> None:
        if len(stack) > DEEPEST:
            raise refused(path, f"is nested deeper than {DEEPEST} elements, which no REXS model is")
        node = _Node(tag, given, parser.CurrentByteIndex)
        stack[-1].nodes.append(node)
        stack.append(node)

    def end(_: str) -> None:
        node, at = stack.pop(), parser.CurrentByteIndex
        is_empty = not node.nodes and not node.text and data[at - 2 : at] == b"/>"
        node.end = at if is_empty else data.index(b">", at) + 1

    def text(letters: str) -> None:
        stack[-1].text += letters

    def declared(*_: Any) -> None:
        raise refused(path, "declares a document type or entities, which no REXS model does", "It is not read")

    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = begin, end, text
    parser.StartDoctypeDeclHandler = parser.EntityDeclHandler = declared
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise refused(path, f"is not XML: {error}") from None
    except ValueError as error:
        if isinstance(error, SceneFileError):
            raise
        raise refused(path, f"is not XML: {error}") from None
    return top.nodes[0]


def _value(node: _Node) -> Any:
    for array in node.all("array"):
        code = array.given.get("code")
        return [each.text for each in array.all("c")] if code is None else {"code": code, "value": array.text}
    return None if node.nodes else node.text.strip() or None


def attribute(name: str, unit: str, value: Any) -> str:
    """An attribute as text."""
    inner = escape(value) if isinstance(value, str) else repr(value)
    if isinstance(value, list):
        inner = f"<array>{''.join(f'<c>{each!r}</c>' for each in value)}</array>"
    return f"<attribute id={quoteattr(name)} unit={quoteattr(unit)}>{inner}</attribute>"


def component(number: int, kind: str, name: str, attributes: list[str], indent: str) -> str:
    """A component as text; its further lines begin with the indent."""
    named = f" name={quoteattr(name)}" if name else ""
    inner = "".join(f"{indent}  {each}" for each in attributes)
    return f'<component id="{number}"{named} type={quoteattr(kind)}>{inner}{indent}</component>'


def relation(number: int, kind: str, parts: list[tuple[str, int, str]], indent: str) -> str:
    """A relation as text, of components in roles, with their types."""
    refs = "".join(f'{indent}  <ref hint={quoteattr(hint)} id="{at}" role="{role}"/>' for role, at, hint in parts)
    return f'<relation id="{number}" type="{kind}">{refs}{indent}</relation>'


def accumulation(components: list[str], indent: str) -> str:
    """What all load cases do together, as text."""
    return f"<accumulation>{''.join(f'{indent}  {each}' for each in components)}{indent}</accumulation>"


def insertion(data: bytes, place: ListExtent, items: list[str], indent: str) -> tuple[Span, bytes]:
    """The edit that adds items to an element, after those that it has."""
    text = "".join(indent + each for each in items).encode()
    if place.last is not None:
        return (place.last[1], place.last[1]), text
    start, end = place.span
    outer = indent[: indent.rindex("\n") + 1].encode() + b" " * max(0, len(indent) - indent.rindex("\n") - 3)
    if data[end - 2 : end] == b"/>":
        tag = data[start + 1 : end].split(None, 1)[0].rstrip(b"/>")
        return (end - 2, end), b">" + text + outer + b"</" + tag + b">"
    closing = data.rindex(b"</", start, end)
    return (closing, closing), text + outer
