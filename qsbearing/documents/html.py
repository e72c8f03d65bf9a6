"""A document as one HTML file: styles, script and pictures within, nothing from the network."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

from qsbearing.documents.data import data
from qsbearing.documents.drawing import inlined
from qsbearing.documents.model import Document, Picture

TEMPLATES = Path(__file__).parent / "templates"


def html(document: Document) -> str:
    """The page as text."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    from markupsafe import Markup

    found = data(document)
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip
    environment.filters |= {"markup": Markup, "highlighted": lambda code: Markup(_highlighted(**code))}
    pictures = [Markup(_picture(picture, number)) for number, picture in enumerate(found["pictures"])]
    style, script = (Markup((TEMPLATES / name).read_text(encoding="utf-8")) for name in ("page.css", "tables.js"))
    page: Any = environment.get_template("page.html")
    text: str = page.render(document=found | {"pictures": pictures}, style=style, script=script)
    return text


def _highlighted(text: str, language: str, **_: Any) -> str:
    """Code as HTML, its words in classes of their kind."""
    from pygments import highlight
    from pygments.formatters import HtmlFormatter
    from pygments.lexers import get_lexer_by_name

    return str(highlight(text, get_lexer_by_name(language or "text"), HtmlFormatter(nowrap=True))).rstrip("\n")


def _picture(picture: Picture, number: int) -> str:
    if picture.form == "svg":
        return inlined(picture.data, f"p{number}-")
    encoded = base64.b64encode(picture.data).decode("ascii")
    return f'<img alt="" src="data:image/{picture.form};base64,{encoded}">'
