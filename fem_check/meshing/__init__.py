"""Meshes: gmsh recipes for graded bricks of hexahedra, their files, and how they are read.

Every mesh is a brick cut into blocks, each block transfinite: the points stand on given lines, so the same recipe gives
the same mesh. Bricks are dimensionless; contact with a half-space stretches one by (a, b, b). The coarse ones of the
quick level are kept in the repository; others are made when asked for and kept in the user's cache.
"""

from fem_check.meshing.bricks import COMMITTED, CUT, clamped_box, half_space, load_series
from fem_check.meshing.files import (
    MANIFEST,
    cache_folder,
    committed_folder,
    load,
    locate,
    manifest,
    origin,
    read,
    write_committed,
)
from fem_check.meshing.making import TAGS, MeshError, gmsh_problem, gmsh_version, make
from fem_check.meshing.recipe import Recipe

__all__ = [
    "COMMITTED",
    "CUT",
    "MANIFEST",
    "TAGS",
    "MeshError",
    "Recipe",
    "cache_folder",
    "clamped_box",
    "committed_folder",
    "gmsh_problem",
    "gmsh_version",
    "half_space",
    "load",
    "load_series",
    "locate",
    "make",
    "manifest",
    "origin",
    "read",
    "write_committed",
]
