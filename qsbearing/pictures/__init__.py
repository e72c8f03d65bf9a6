"""Pictures of a solved case, one function each; matplotlib is imported where it draws.

Each takes a solution of a bearing (all but `contact_ellipses`, `section` and `ball_advance` one of a set as well) and,
where it has case axes, the index of one case; and returns a figure of matplotlib. `stiffness_map` and
`preload_over_temperature` take a scene, which they solve around its operating point; `campbell` takes the solution of a
set, which it solves over the speed, and needs ROSS.
"""

from qsbearing.pictures.campbell import campbell
from qsbearing.pictures.operating_maps import preload_over_temperature, stiffness_map
from qsbearing.pictures.sheet import (
    ball_advance,
    contact_angles,
    contact_ellipses,
    deformed_shaft,
    ellipse_on_groove,
    load_distribution,
    overview,
    ring_shape,
    section,
)
from qsbearing.pictures.under_load import under_load

__all__ = [
    "ball_advance",
    "campbell",
    "contact_angles",
    "contact_ellipses",
    "deformed_shaft",
    "ellipse_on_groove",
    "load_distribution",
    "overview",
    "preload_over_temperature",
    "ring_shape",
    "section",
    "stiffness_map",
    "under_load",
]
