"""Files of meshes: those of the repository, those made on demand in the user's cache, and how they are read."""

from __future__ import annotations

import contextlib
import hashlib
import json
import logging
import lzma
import os
import tempfile
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import platformdirs

from fem_check.independent.contact_problem import Array
from fem_check.meshing.bricks import COMMITTED, DEPTH_GROWTH, SIDE_GROWTH
from fem_check.meshing.making import TAGS, MeshError, gmsh_version, make
from fem_check.meshing.recipe import Recipe

if TYPE_CHECKING:
    from skfem import MeshHex

MANIFEST = "manifest.json"


def committed_folder() -> Path:
    """Where the repository keeps its meshes (an installed package carries them inside)."""
    package = Path(__file__).parents[1]
    inside = package / "meshes"
    return inside if inside.is_dir() else package.parent / "meshes"


def cache_folder() -> Path:
    """Where meshes made on demand are kept; FEM_CHECK_CACHE overrides."""
    named = os.environ.get("FEM_CHECK_CACHE")
    return Path(named) if named else Path(platformdirs.user_cache_dir("fem_check")) / "meshes"


def manifest() -> dict[str, dict[str, object]]:
    """What the repository says of each committed mesh, by file name; empty where there is none."""
    path = committed_folder() / MANIFEST
    return json.loads(path.read_text()) if path.is_file() else {}


def write_committed(folder: Path) -> None:
    """Make the committed bricks and their manifest anew; what it says of the curved bodies stays."""
    entries: dict[str, dict[str, object]] = {
        name: entry for name, entry in manifest().items() if not name.endswith(".msh")
    }
    for recipe in COMMITTED:
        path = packed(folder, recipe)
        make(recipe, path)
        entries[recipe.file_name] = {
            "recipe": asdict(recipe),
            "elements_per_semi_axis": recipe.elements_per_semi_axis,
            "grading": f"sideways {SIDE_GROWTH}, in depth {DEPTH_GROWTH}",
            "elements": recipe.elements,
            "nodes": int(read(path).p.shape[1]),
            "sha256": hashlib.sha256(lzma.decompress(path.read_bytes())).hexdigest(),
            "gmsh": gmsh_version(),
        }
    (folder / MANIFEST).write_text(json.dumps(entries, indent=1) + "\n")


def packed(folder: Path, recipe: Recipe) -> Path:
    """The recipe's file among the committed ones."""
    return folder / f"{recipe.file_name}.xz"


def locate(recipe: Recipe) -> Path:
    """The recipe's file: committed, cached, or made now."""
    if recipe.file_name in manifest():
        path = packed(committed_folder(), recipe)
        if not path.is_file():
            raise MeshError(
                f"{path} is missing: bring it back from the repository, or make it again with "
                "`python -m fem_check.meshing`"
            )
        return path
    path = cache_folder() / f"{recipe.name}-{recipe.digest}.msh"
    if not path.is_file():
        make(recipe, path)
    return path


def load(recipe: Recipe) -> MeshHex:
    """The recipe's mesh."""
    path = locate(recipe)
    mesh = read(path)
    if mesh.t.shape[1] != recipe.elements:
        raise MeshError(
            f"{path} holds {mesh.t.shape[1]} hexahedra, its recipe gives {recipe.elements}: damaged or from another "
            "version; delete it and it is made again"
        )
    return mesh


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    # scikit-fem remarks that it cannot orient boundaries; nothing here uses their orientation.
    logger = logging.getLogger("skfem")
    before = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(before)


@contextlib.contextmanager
def _unpacked(path: Path) -> Iterator[Path]:
    """The file as meshio reads it: the committed ones are packed."""
    if path.suffix != ".xz":
        yield path
        return
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / path.stem
        file.write_bytes(lzma.decompress(path.read_bytes()))
        yield file


def read(path: Path) -> MeshHex:
    """Read a mesh file, and check that its tagged faces lie where their tags belong."""
    import meshio
    from skfem import MeshHex
    from skfem.io.meshio import from_meshio

    if not path.is_file():
        raise MeshError(f"{path}: no such mesh file")
    try:
        with _quiet(), contextlib.redirect_stdout(None), _unpacked(path) as file:
            mesh = from_meshio(meshio.read(file))
    except Exception as problem:  # meshio raises whatever its parser trips over
        raise MeshError(f"{path} is not a whole gmsh mesh ({type(problem).__name__}: {problem})") from problem
    if not isinstance(mesh, MeshHex):
        raise MeshError(f"{path} holds no hexahedra")
    tagged = set(mesh.boundaries or {})
    if not set(TAGS) <= tagged:
        missing = ", ".join(sorted(set(TAGS) - tagged))
        raise MeshError(f"{path} lacks the tagged surface(s) {missing}; it has {', '.join(sorted(tagged)) or 'none'}")
    high = mesh.p.max(axis=1)
    for tag, axes, values in (
        ("contact", (2,), (0.0,)),
        ("symmetry_x", (0,), (0.0,)),
        ("symmetry_y", (1,), (0.0,)),
        ("far", (0, 1, 2), tuple(high)),
    ):
        corners: Array = mesh.p[:, mesh.facets[:, mesh.boundaries[tag]]]
        on_plane = [
            np.abs(corners[axis] - value).max(axis=0) < 1e-9 * high.max()
            for axis, value in zip(axes, values, strict=True)
        ]
        if not np.any(on_plane, axis=0).all():
            raise MeshError(f"{path}: faces tagged {tag} do not lie where that tag belongs")
    return mesh


def origin(recipe: Recipe) -> str:
    """Where a recipe's mesh is from: shipped with the package, or made by gmsh on this machine."""
    return "shipped" if recipe.file_name in manifest() else "made by gmsh"
