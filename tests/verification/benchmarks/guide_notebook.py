"""The guide's notebook with its outputs: `python -m tests.verification.benchmarks.guide_notebook`, some ten seconds."""

from __future__ import annotations

import base64
import io
import tempfile
from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient
from PIL import Image

import qsbearing as qs

TUTORIAL = Path(qs.__file__).parent / "guide" / "tutorial.ipynb"
COLOURS = 64
"""Of a picture: it travels with the package."""


def executed() -> Any:
    """The notebook, run from its first cell to its last, without what differs from run to run."""
    notebook = nbformat.read(TUTORIAL, 4)
    with tempfile.TemporaryDirectory() as folder:
        NotebookClient(notebook, timeout=600, resources={"metadata": {"path": folder}}).execute()
    for cell in notebook.cells:
        cell.metadata = {}
        if cell.cell_type == "code":
            cell.outputs = [each for each in cell.outputs if each.output_type != "stream"]
            for output in cell.outputs:
                output.metadata = {}
                if "image/png" in output.data:
                    output.data["image/png"] = light(output.data["image/png"])
    notebook.metadata["language_info"] = {"name": "python"}
    return notebook


def light(encoded: str) -> str:
    """A PNG in base64 with few colours."""
    picture = Image.open(io.BytesIO(base64.b64decode(encoded))).convert("RGB")
    found = io.BytesIO()
    picture.quantize(COLOURS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(found, "png", optimize=True)
    return base64.b64encode(found.getvalue()).decode("ascii")


if __name__ == "__main__":
    nbformat.write(executed(), TUTORIAL)
