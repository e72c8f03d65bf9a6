"""Methods of scenes and solutions that are done above the model: shown in notebooks, drawn, handed to rotor codes.

The model does not know by whom. The package says so when it is imported (`DONE_BY`); in a copy of the model alone
nobody does them.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

DONE_BY: dict[str, str] = {}
"""The module that has the function of this name."""


def above(name: str) -> Any:
    """The function that does it.

    Raises:
        NotImplementedError: this is the model alone.
    """
    if name not in DONE_BY:
        raise NotImplementedError(f"{name} is not part of the model alone: it needs the whole package qsbearing")
    return getattr(import_module(DONE_BY[name]), name)


class InNotebooks:
    """Shown as tables in a notebook."""

    def _repr_html_(self) -> str | None:
        """For notebooks; None, so that they show the text, where jinja2 is not installed or this is the model alone."""
        found: str | None = above("html_of")(self) if "html_of" in DONE_BY else None
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
        return above("plot")(self, *chosen, **named)
