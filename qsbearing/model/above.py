"""What scenes and solutions show of themselves: pictures, and tables in notebooks.

The functions that make them are in folders above the model, and are called by their public names; in a copy of the
model alone there are none.
"""

from __future__ import annotations

from typing import Any

import qsbearing as qs


class InNotebooks:
    """Shown as tables in a notebook."""

    def _repr_html_(self) -> str | None:
        """For notebooks; None, so that they show the text, where jinja2 is not installed or this is the model alone."""
        return qs.html_of(self) if hasattr(qs, "html_of") else None


class Plotted(InNotebooks):
    """With a picture."""

    def plot(self, *chosen: Any, **named: Any) -> Any:
        """Draw it, as a figure of matplotlib: `qs.plot(self, ...)`, which says what there is."""
        return qs.plot(self, *chosen, **named)  # type: ignore[arg-type]
