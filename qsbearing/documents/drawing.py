"""A figure of matplotlib as a picture of a document: vectors, the same bytes every time."""

from __future__ import annotations

import re
import warnings
from io import BytesIO
from typing import Any

from qsbearing.documents.model import Picture

REFERENCE = re.compile(r'(\bid="|xlink:href="#|\bhref="#|url\(#)')
RASTER_DPI = 160
"""Of what a figure itself asks to have drawn as dots, where vectors would be thousands."""


FULL_WIDTH = 9.0
"""Of a figure that fills the width of the text [inches]: letters have one size in all pictures of a document."""


def picture(figure: Any, alt: str, caption: str = "", width: float | None = None) -> Picture:
    """A figure as part of a document; letters are outlines, so that they look the same everywhere.

    Args:
        width: part of the text's width; None: by the size of the figure.
    """
    import matplotlib

    buffer = BytesIO()
    with matplotlib.rc_context({"svg.fonttype": "path", "svg.hashsalt": "document"}), warnings.catch_warnings():
        # A letter that its font lacks is a box; the words around the picture have it.
        warnings.filterwarnings("ignore", "Glyph .* missing from font")
        figure.savefig(buffer, format="svg", dpi=RASTER_DPI, metadata={"Date": None, "Creator": None})
    if width is None:
        width = width_of(buffer.getvalue())
    return Picture(_lean(buffer.getvalue()), alt, caption, "svg", width)


def width_of(svg: bytes, full: float = FULL_WIDTH) -> float:
    """Width of a drawing by matplotlib, as part of the text's; more than 1 where letters would become too small.

    Args:
        full: width of a figure that fills the text's [inches].
    """
    match = re.search(rb'<svg[^>]* width="([\d.]+)pt"', svg)
    return float(match[1]) / 72.0 / full if match else 1.0


def _lean(svg: bytes) -> bytes:
    """Paths to a hundredth of a point: finer than any screen or printer; hollow ones without a filling, since
    Ghostscript, when it smooths lines, draws nothing of what has a transparent filling."""
    svg = svg.replace(b"fill-opacity: 0;", b"fill: none;")
    return re.sub(rb' d="[^"]*"', lambda path: re.sub(rb"(\.\d\d)\d+", rb"\1", path[0]).replace(b"\n", b" "), svg)


def inlined(svg: bytes, prefix: str) -> str:
    """An SVG file as it stands within a page: without its head, and with names of its own, which every file repeats."""
    text = svg.decode("utf-8")
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    head, rest = text.split(">", 1)
    head = re.sub(r' (?:width|height)="[^"]*"', "", head)
    head = f'{head} focusable="false" aria-hidden="true"'
    return REFERENCE.sub(lambda match: match.group() + prefix, f"{head}>{rest}")
