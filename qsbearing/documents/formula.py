r"""Formulas of the guide: written once, in LaTeX between dollars, and shown as MathML or as a line of text.

latex2mathml reads the LaTeX; the text is written from its tree. `\tag{19.3}` numbers a formula of its own line.
"""

from __future__ import annotations

import re
from functools import cache
from typing import Any
from xml.etree import ElementTree as ET

NAMESPACE = "http://www.w3.org/1998/Math/MathML"
FUNCTION_SPACE = "0.17em"
LOWERED = str.maketrans("0123456789aeioruvxhklmnpst", "₀₁₂₃₄₅₆₇₈₉ₐₑᵢₒᵣᵤᵥₓₕₖₗₘₙₚₛₜ")
RAISED = str.maketrans("0123456789+−", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻")
VULGAR = {"1/2": "½", "2/5": "⅖"}
SPACED = set("=<>≤≥≈∼→+−±∓⋅×")
TAG = re.compile(r"\s*\\tag\{([^}]*)\}\s*$")


def split(latex: str) -> tuple[str, str]:
    """A formula, and its number in brackets; empty where it has none."""
    tag = TAG.search(latex)
    return (latex[: tag.start()].strip(), f"({tag[1]})") if tag else (latex.strip(), "")


@cache
def forms(latex: str, is_block: bool = False) -> dict[str, str]:
    """The formula in its forms: {"mathml", "text"}.

    Raises:
        ValueError: an element that the text has no rule for.
    """
    from latex2mathml.converter import convert

    root = ET.fromstring(convert(latex, display="block" if is_block else "inline").replace("&</mi>", "&amp;</mi>"))
    for element in root.iter():
        element.tag = element.tag.removeprefix(f"{{{NAMESPACE}}}")
    _spaced(root)
    shown = ET.tostring(root, encoding="unicode").replace("<math", f'<math xmlns="{NAMESPACE}"', 1)
    return {"mathml": shown, "text": _tidy(_text(root[0]))}


def _spaced(element: ET.Element) -> None:
    """Put spaces around functions' names; brackets that are letters become brackets."""
    for place, child in reversed(list(enumerate(element))):
        _spaced(child)
        if child.text in ("⟨", "⟩"):
            child.tag = "mo"
        after = element[place + 1] if place + 1 < len(element) else None
        if element.tag == "mrow" and _is_function(child):
            if after is not None and after.text not in ("(", ")"):
                element.insert(place + 1, ET.Element("mspace", width=FUNCTION_SPACE))
            if place and (element[place - 1].tag not in ("mo", "mspace") or element[place - 1].text == ")"):
                element.insert(place, ET.Element("mspace", width=FUNCTION_SPACE))


def _is_function(element: ET.Element) -> bool:
    base = element[0] if element.tag in ("msup", "msub") else element
    return base.tag == "mi" and len(base.text or "") > 1


def _text(element: ET.Element) -> str:
    parts = [_text(child) for child in element]
    text = element.text or ""
    match element.tag:
        case "mrow" | "mstyle" | "mtd":
            followers = [*element[1:], None]
            return "".join(
                f"({part})" if child.tag == "mfrac" and "/" in part and _is_factor(after) else part
                for part, child, after in zip(parts, element, followers, strict=True)
            )
        case "mi" | "mo" if len(text) > 1:
            return f" {text}"
        case "mo":
            return f" {text} " if text in SPACED else f"{text} " if text in (",", ";") else text
        case "mi" | "mn" | "mtext":
            return text
        case "mspace":
            return "   " if element.get("width", "").startswith(("1em", "2em")) else " "
        case "mfrac":
            line = f"{_grouped(parts[0])}/{_grouped(parts[1], below=True)}"
            return VULGAR.get(line, line)
        case "msqrt":
            return f"√{_grouped(''.join(parts))}"
        case "msub" | "munder":
            return parts[0] + _script(parts[1], LOWERED, "_")
        case "msup":
            return parts[0] + _script(parts[1], RAISED, "^")
        case "msubsup" | "munderover":
            return parts[0] + _script(parts[1], LOWERED, "_") + _script(parts[2], RAISED, "^")
    raise ValueError(f"no rule for <{element.tag}> in a line of text")


def _tidy(text: str) -> str:
    """Without spaces after opening brackets, before closing ones, and side by side."""
    text = re.sub(r"(?<=\S)  (?=\S)", " ", text).strip()
    text = re.sub(r"(^|[(\[⟨]|[=,] +) ?− ", r"\1−", text)  # a sign is no difference
    return re.sub(r"(?<=\S) (?=[)\]⟩])|(?<=[(\[⟨]) +", "", text)


def _is_factor(element: ET.Element | None) -> bool:
    """Whether what follows a fraction would be read as part of its denominator."""
    return element is not None and (element.tag not in ("mo", "mspace") or element.text in ("(", "[", "|", "⟨"))


def _script(text: str, letters: dict[int, Any], mark: str) -> str:
    text = text.replace(" ", "")
    if text == "′":
        return text
    if all(ord(letter) in letters for letter in text):
        return text.translate(letters)
    return f"{mark}{_grouped(text)}" if mark == "^" else f"_{text}"


def _grouped(text: str, below: bool = False) -> str:
    """In brackets, unless it is one factor (below a line: one letter) already."""
    one = r"[^\W\d_](_\w|[₀-ₜ²³′])*|\d+(\.\d+)?" if below else r"[\w₀-ₜ⁰-⁹²³¹.√⅖½^ ]*"
    return text if re.fullmatch(one, text.strip()) else f"({text.strip()})"


def in_text(markdown: str) -> str:
    """A page for the terminal: its formulas as lines of text, those of their own line indented as code is."""
    parts = re.split(r"(^```.*?^```$)", markdown, flags=re.DOTALL | re.MULTILINE)
    for place in range(0, len(parts), 2):
        parts[place] = re.sub(r"^\$\$\n(.*?)\n\$\$$", _own_line, parts[place], flags=re.DOTALL | re.MULTILINE)
        parts[place] = re.sub(r"(?<![\w$])\$([^\s$][^$]*)\$(?!\w)", lambda it: forms(it[1])["text"], parts[place])
    return "".join(parts)


def _own_line(match: re.Match[str]) -> str:
    latex, number = split(match[1])
    return f"    {forms(latex, True)['text']}{'    ' if number else ''}{number}"
