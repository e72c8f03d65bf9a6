"""The option that chooses what --plot draws, and the picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from qsbearing.cli.files import check_installed, picture_bytes
from qsbearing.cli.output import refuse

if TYPE_CHECKING:
    from qsbearing.model.scene.scene import Scene
    from qsbearing.systems.sets.bearing_set import BearingSet

OF_BEARING = ("overview", "under_load", "section", "ellipse_on_groove", "contact_ellipses")
"""Functions of `qsbearing.pictures`, and what they are called on the command line."""
OF_SET = ("overview", "under_load", "ellipse_on_groove", "deformed_shaft", "campbell")
USUAL = "overview"

picture_option = click.option(
    "--picture",
    metavar="NAME",
    type=click.Choice(list(dict.fromkeys(OF_BEARING + OF_SET))),
    help="What --plot draws: overview (the default), under_load, ellipse_on_groove (the most loaded contact ellipses, "
    "with the shoulders' edges); of a bearing also section and contact_ellipses; of a set also deformed_shaft, and "
    "campbell (natural frequencies over the speed and critical speeds; needs ROSS).",
)


def check_picture(name: str | None, target: str | None, of: Scene | BearingSet) -> None:
    """End with exit code 2 where it cannot be drawn of this scene or set."""
    from qsbearing.model.scene.scene import Scene

    if name is None:
        return
    if target is None:
        refuse("--picture says what --plot draws: give --plot FILE")
    is_set = not isinstance(of, Scene)
    known = OF_SET if is_set else OF_BEARING
    if name not in known:
        refuse(f"--picture {name}: is none of a {'set' if is_set else 'bearing'}; {', '.join(known)} are")
    shaft: Any = getattr(of, "shaft", None)
    if name in ("deformed_shaft", "campbell") and (shaft is None or not shaft.sections):
        refuse(f"--picture {name}: this set's shaft is rigid: give its [[shaft.sections]]")
    if name == "campbell":
        check_installed("--picture campbell needs", ("ross",), "ross")


def drawn(solution: Any, name: str | None, target: str) -> bytes:
    """The picture in the form that the name of its file says."""
    from qsbearing import pictures

    try:
        figure = getattr(pictures, name or USUAL)(solution)
    except ValueError as error:  # a shaft that stands still
        refuse(f"--picture {name}: {error}")
    return picture_bytes(figure, target)
