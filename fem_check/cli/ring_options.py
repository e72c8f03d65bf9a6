"""Options for the cross-sections of the rings, of the commands that solve true bodies."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import click

from fem_check.independent.ring_sections import DIMENSIONS


def ring_options(command: Any) -> Any:
    """An option for each dimension of a ring's section."""
    for name, told in reversed(DIMENSIONS.items()):
        what = f"Diameter of the {told}" if told.startswith(("inner", "outer")) else told.capitalize()
        text = f"{what} [mm]; by default from the scene or the catalogue, else assumed."
        command = click.option(f"--{name.replace('_', '-')}-mm", name, type=float, default=None, help=text)(command)
    return command


def set_ring_options(rings: Mapping[str, float | None]) -> None:
    """Use the dimensions given [mm] until the command ends."""
    from fem_check.product.scenes import RING_OPTIONS  # not at the start of every command

    given = RING_OPTIONS.set({name: None if value is None else 1e-3 * value for name, value in rings.items()})
    click.get_current_context().call_on_close(lambda: RING_OPTIONS.reset(given))
