"""A document as PDF: set by typst with the fonts that it brings, tagged for screen readers (PDF/UA-1)."""

from __future__ import annotations

import json
import shutil
import tempfile
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

from qsbearing.documents.data import data
from qsbearing.documents.model import Document

TEMPLATE = Path(__file__).parent / "templates" / "document.typ"


def pdf(document: Document, strict: bool = False, lacking: Callable[[], None] = lambda: None) -> bytes:
    """The file's bytes. A letter that typst's own fonts lack is set in a font of the system.

    Args:
        document: what to set.
        strict: whether a letter that typst's own fonts lack is an error; else it is a box where no other font has it.
        lacking: called where there are boxes.

    Raises:
        typst.TypstError: the document is not what the standard asks.
    """
    import typst

    with tempfile.TemporaryDirectory(prefix="qsbearing-document-") as folder:
        try:
            return _compiled(document, Path(folder), ["ua-1"])
        except typst.TypstError as error:
            if strict or "could not be displayed" not in str(error):
                raise
        try:
            return _compiled(document, Path(folder), ["ua-1"], with_system_fonts=True)
        except typst.TypstError as error:
            if "could not be displayed" not in str(error):
                raise
        lacking()
        return _compiled(document, Path(folder), with_system_fonts=True)


def _compiled(document: Document, folder: Path, standards: Any = None, with_system_fonts: bool = False) -> bytes:
    import typst

    plain = data(document)
    for number, picture in enumerate(plain.pop("pictures")):
        (folder / f"picture-{number}.{picture.form}").write_bytes(picture.data)
    (folder / "document.json").write_text(json.dumps(plain), encoding="utf-8")
    shutil.copyfile(TEMPLATE, folder / "main.typ")
    compiled, said = typst.compile_with_warnings(
        folder / "main.typ", root=folder, format="pdf", ignore_system_fonts=not with_system_fonts,
        pdf_standards=standards or [],
    )  # fmt: skip
    for each in said:
        warnings.warn(f"typst: {each}", stacklevel=3)
    return bytes(compiled)
