"""A document as one HTML file: styles, script and pictures within, nothing from the network."""

from __future__ import annotations

import base64
import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from qsbearing.documents.data import data
from qsbearing.documents.drawing import inlined
from qsbearing.documents.model import Block, Document, Picture, Section

TEMPLATES = Path(__file__).parent / "templates"
OPTION = re.compile(r"(?<![\w-])(?:--?|[a-z]+-)[a-z][\w-]*")
"""An option, or another word with a hyphen, at which browsers would end a line."""
VALUED = re.compile(r'(?<![\w-])(--?[a-z][\w-]*)( (?!-)(?:"[^"]*"|[^\s\\]+))?( \\$)?')
NARROWEST = 47
"""Letters of code on a line of a phone: so long an option stays on one line, with its value if there is room."""
LONG_NAME = re.compile(r"\w{18,}")
PATH = re.compile(r"(?:\w+/){2,}\w+")
JOINT = re.compile(r"(?<=\w{3})[._](?=\w)")
"""Where a long name may be broken."""
SHORT = 26
"""Letters of code in a sentence that stays on one line."""
QUANTITY = re.compile(
    r"(?<=\d) (?=\d{3}(?!\d)|%|[µmkMG]?[mNgsJWBK]\b|°|rpm\b|MPa\b|GPa\b|deg\b|h\b)|(?<=\bN) (?=m?m\b)|(?<=≈) "
)
"""The space within a number, before its unit, within that, and after ≈."""


POWER = re.compile(r"\b\d[\d.]*e[-−]\d+\b")
"""A number that browsers would break after its hyphen."""


EQUAL = re.compile(r"(?<=\b\w) = (?=[+\-−]?\d)|(?<=\bF[arxyz]) = (?=[+\-−]?\d)")
"""Between a symbol and its value."""


def html(document: Document) -> str:
    """The page as text."""
    from markupsafe import Markup

    style, script = (Markup((TEMPLATES / name).read_text(encoding="utf-8")) for name in ("page.css", "tables.js"))
    return _rendered("page.html", document, style=style, script=script)


def part(blocks: Sequence[Block]) -> str:
    """Pieces of a document as they stand within a page, which brings their style."""
    return _rendered("part.html", Document("", "", [Section("", blocks)])) if blocks else ""


def _rendered(template: str, document: Document, **others: Any) -> str:
    from markupsafe import Markup

    plain = data(document)
    pictures = [Markup(_picture(picture, number)) for number, picture in enumerate(plain["pictures"])]
    text: str = _templates().get_template(template).render(document=plain | {"pictures": pictures}, **others)
    return text


@cache
def _templates() -> Any:
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    from markupsafe import Markup, escape

    environment = Environment(
        loader=FileSystemLoader(TEMPLATES), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip
    environment.filters |= {
        "table_classes": lambda table: _classes(**table),
        "highlighted": lambda code: Markup(_highlighted(**code)),
        "code": lambda text: Markup(_code(str(escape(text)))),
        "unbroken": lambda text: Markup(_jointed(str(escape(_unbroken(text))))),
        "lettered": lambda text: Markup(LETTERED.sub(lambda match: _whole(match[0]), str(text))),
    }
    return environment


LETTERED = re.compile(r"\w+ \w(?=\n|<|$)")
"""A word with the letter of its raceway or axis, at the end of a line of a heading: "angle o", "radial y"."""
NARROW = 8
"""Letters of a first column of numbers or short names, which needs no room for a sentence."""


def _classes(headings: Sequence[Any], rows: Sequence[dict[str, Any]], stack: bool, **_: Any) -> str:
    """The classes of a table of a narrow first column; and of many, where it does not stack."""
    first = [headings[0], *(row["cells"][0].get("text", []) for row in rows if "cells" in row)]
    longest = max(sum(len(run.get("text", "")) for run in runs) for runs in first)
    return " ".join(["many"] * (len(headings) > 7 and not stack) + ["narrow"] * (longest <= NARROW))


def _highlighted(text: str, language: str, **_: Any) -> str:
    """Code as HTML, its words in classes of their kind."""
    from pygments import highlight
    from pygments.formatters import HtmlFormatter
    from pygments.lexers import get_lexer_by_name

    if language == "sh":
        return "".join(f'<span class="command">{_command(line)}\n</span>' for line in text.split("\n"))
    return str(highlight(text, get_lexer_by_name(language or "text"), HtmlFormatter(nowrap=True))).rstrip("\n")


def _command(line: str) -> str:
    """A command's line as HTML: no line ends within an option or its value, nor between them, if they are short.

    The backslash that continues a command stays with them.
    """
    from markupsafe import escape

    def short(text: str) -> str:
        return _whole(str(escape(text))) if len(text) <= NARROWEST else str(escape(text))

    command, mark, remark = line.partition(" # ") if not line.startswith("#") else ("", "", line)
    shown, after = "", 0
    for match in VALUED.finditer(command):
        option, value = match[1], (match[2] or "") + (match[3] or "")
        shown += str(escape(command[after : match.start()]))
        shown += short(match[0]) if len(match[0]) <= NARROWEST else f"{short(option)} {short(value[1:])}"
        after = match.end()
    shown += str(escape(command[after:]))
    return shown + (f'<span class="c1">{escape(mark + remark)}</span>' if remark else "")


def _whole(text: str) -> str:
    return f'<span class="whole">{text}</span>'


def _whole_options(code: str) -> str:
    """Code as HTML in which no line ends at the hyphen of an option or a command."""
    return OPTION.sub(lambda match: _whole(match[0]), code)


def _code(text: str) -> str:
    """Code in a sentence as HTML: whole if it is short, else broken between words and at the joints of names."""
    return _whole(text) if len(text) <= SHORT else JOINT.sub(r"\g<0><wbr>", _whole_options(text))


def _unbroken(text: str) -> str:
    """Text in which no line ends within a quantity, which browsers break before µ too, or at an equals sign."""
    joined = EQUAL.sub("\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}", QUANTITY.sub("\N{NO-BREAK SPACE}", text))
    return joined.replace("/µ", "/\N{WORD JOINER}µ")


def _jointed(text: str) -> str:
    """Text whose long names may break after an underscore, so that the column of names leaves room for the others, and
    whose numbers stay whole."""
    text = PATH.sub(lambda match: match[0].replace("/", "/<wbr>"), text)
    text = LONG_NAME.sub(lambda match: match[0].replace("_", "_<wbr>"), text)
    return POWER.sub(lambda match: _whole(match[0]), text)


def _picture(picture: Picture, number: int) -> str:
    if picture.form == "svg":
        return inlined(picture.data, f"p{number}-")
    encoded = base64.b64encode(picture.data).decode("ascii")
    return f'<img alt="" src="data:image/{picture.form};base64,{encoded}">'
