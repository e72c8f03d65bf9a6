"""What scenes, solutions, sets and studies show in a notebook: tables and pictures, which lie far above."""

from __future__ import annotations

from importlib import import_module
from typing import Any


class InNotebooks:
    """Shown as tables, drawn by `plot`. Whatever draws or typesets is loaded by name when it is asked for: those who
    compute do not know it."""

    def _repr_html_(self) -> str | None:
        """For notebooks; None, so that they show the text, where jinja2 is not installed."""
        found: str | None = import_module("qsbearing.app.notebook").html_of(self)
        return found


class Plotted(InNotebooks):
    """With a picture."""

    def plot(self, *chosen: Any, **named: Any) -> Any:
        """Draw it, as a figure of matplotlib.

        Of a solution: `plot(name="overview", index=None)`, one of the pictures of `qsbearing.pictures` of one case. Of
        a study, which is solved for it: the arguments of `qsbearing.pictures.study.picture`, such as y=["inner_load"].

        Raises:
            ValueError: there is no such picture.
        """
        return import_module("qsbearing.app.notebook").plot(self, *chosen, **named)
