"""Meshes of bricks made by gmsh: each block transfinite, so that the same recipe gives the same mesh."""

from __future__ import annotations

import itertools
import lzma
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from fem_check.meshing.recipe import Recipe

DEBIAN_PACKAGES = "libgl1 libglu1-mesa libgomp1 libxcursor1 libxft2 libxinerama1"
TAGS = ("contact", "symmetry_x", "symmetry_y", "far")


class MeshError(Exception):
    """A mesh cannot be read or made; the message says what to do."""


def gmsh_problem() -> str | None:
    """Why gmsh does not load here, with the remedy; None if it does."""
    try:
        import gmsh  # noqa: F401
    except ImportError:
        return "gmsh is not installed: pip install gmsh"
    except OSError as problem:
        return f"gmsh does not load ({problem}); on Debian: apt-get install {DEBIAN_PACKAGES}"
    return None


def gmsh_version() -> str | None:
    """Version of gmsh, None where it does not load."""
    if gmsh_problem() is not None:
        return None
    import gmsh

    return str(gmsh.__version__)


def make(recipe: Recipe, path: Path) -> None:
    """Make the mesh with gmsh and write it, whole or not at all."""
    problem = gmsh_problem()
    if problem is not None:
        raise MeshError(f"the mesh {recipe.name} has to be made, but {problem}")
    import gmsh

    path.parent.mkdir(parents=True, exist_ok=True)
    # interruptible=False leaves Python's signal handlers alone, which gmsh would replace.
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
        gmsh.model.add(recipe.name)
        _build(recipe)
        gmsh.model.mesh.generate(3)
        handle, temporary = tempfile.mkstemp(suffix=".msh", dir=path.parent)
        os.close(handle)
        try:
            gmsh.write(temporary)
            if path.suffix == ".xz":
                Path(temporary).write_bytes(lzma.compress(Path(temporary).read_bytes(), preset=lzma.PRESET_EXTREME))
            Path(temporary).chmod(0o644)
            Path(temporary).replace(path)
        except BaseException:
            Path(temporary).unlink(missing_ok=True)
            raise
    finally:
        gmsh.finalize()


def _build(recipe: Recipe) -> None:
    import gmsh

    geo = gmsh.model.geo
    axes = (recipe.x, recipe.y, recipe.z)
    stations = [np.concatenate([[0.0], np.cumsum([s.length for s in axis])]) for axis in axes]
    counts = [len(axis) for axis in axes]
    points = {
        index: geo.addPoint(*(float(stations[d][index[d]]) for d in range(3)))
        for index in itertools.product(*(range(n + 1) for n in counts))
    }

    def shifted(index: tuple[int, ...], *directions: int) -> tuple[int, ...]:
        return tuple(i + (d in directions) for d, i in enumerate(index))

    def lattice(*along: int) -> Iterator[tuple[int, ...]]:
        """Lowest corners of all edges (one direction), faces (two) or blocks (three) that run along `along`."""
        return itertools.product(*(range(counts[d] + (d not in along)) for d in range(3)))

    edges = {}
    for d in range(3):
        for index in lattice(d):
            tag = geo.addLine(points[index], points[shifted(index, d)])
            segment = axes[d][index[d]]
            geo.mesh.setTransfiniteCurve(tag, segment.elements + 1, "Progression", segment.growth)
            edges[d, index] = tag
    faces = {}
    for d, e in ((0, 1), (0, 2), (1, 2)):
        for index in lattice(d, e):
            loop = geo.addCurveLoop(
                [edges[d, index], edges[e, shifted(index, d)], -edges[d, shifted(index, e)], -edges[e, index]]
            )
            tag = geo.addPlaneSurface([loop])
            geo.mesh.setTransfiniteSurface(tag)
            geo.mesh.setRecombine(2, tag)
            faces[d, e, index] = tag
    blocks = []
    for index in lattice(0, 1, 2):
        around = [
            faces[d, e, corner]
            for d, e, other in ((0, 1, 2), (0, 2, 1), (1, 2, 0))
            for corner in (index, shifted(index, other))
        ]
        tag = geo.addVolume([geo.addSurfaceLoop(around)])
        geo.mesh.setTransfiniteVolume(tag)
        blocks.append(tag)
    geo.synchronize()
    last = recipe.contact_segments
    groups = {
        "contact": [t for (d, e, i), t in faces.items() if (d, e) == (0, 1) and i[2] == 0 and max(i[:2]) < last],
        "symmetry_x": [t for (d, e, i), t in faces.items() if (d, e) == (1, 2) and i[0] == 0],
        "symmetry_y": [t for (d, e, i), t in faces.items() if (d, e) == (0, 2) and i[1] == 0],
        "far": [
            t for (d, e, i), t in faces.items() if any(i[normal] == counts[normal] for normal in {0, 1, 2} - {d, e})
        ],
    }
    for name in TAGS:
        gmsh.model.addPhysicalGroup(2, groups[name], name=name)
    gmsh.model.addPhysicalGroup(3, blocks, name="body")
