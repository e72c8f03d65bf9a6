"""Meshes: gmsh recipes for graded bricks of hexahedra, their files, and how they are read.

Every mesh is a brick cut into blocks, each block transfinite: the points stand on given lines, so the same recipe gives
the same mesh. Bricks are dimensionless; contact with a half-space stretches one by (a, b, b). The coarse ones of the
quick level are kept in the repository; others are made when asked for and kept in the user's cache.
"""

from __future__ import annotations

import contextlib
import hashlib
import itertools
import json
import logging
import os
import tempfile
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import meshio
import numpy as np
import platformdirs
from skfem import MeshHex
from skfem.io.meshio import from_meshio

from fem_check.contact_problem import Array

DEBIAN_PACKAGES = "libgl1 libglu1-mesa libgomp1 libxcursor1 libxft2 libxinerama1"
TAGS = ("contact", "symmetry_x", "symmetry_y", "far")
MANIFEST = "manifest.json"


class MeshError(Exception):
    """A mesh cannot be read or made; the message says what to do."""


@dataclass(frozen=True)
class Segment:
    """A stretch of one edge of the brick."""

    length: float
    elements: int
    growth: float = 1.0
    """Length of each element over the one before it."""


@dataclass(frozen=True)
class Recipe:
    """A graded brick; the contact lies on its face z = 0, on the first `contact_segments` of x and of y."""

    name: str
    elements_per_semi_axis: int
    x: tuple[Segment, ...]
    y: tuple[Segment, ...]
    z: tuple[Segment, ...]
    contact_segments: int = 1

    @property
    def elements(self) -> int:
        """Number of hexahedra."""
        counts = [sum(segment.elements for segment in axis) for axis in (self.x, self.y, self.z)]
        return counts[0] * counts[1] * counts[2]

    @property
    def dofs(self) -> int:
        """Degrees of freedom of its 20-node elements (vertices and edges, three each)."""
        nx, ny, nz = (sum(segment.elements for segment in axis) for axis in (self.x, self.y, self.z))
        vertices = (nx + 1) * (ny + 1) * (nz + 1)
        edges = nx * (ny + 1) * (nz + 1) + (nx + 1) * ny * (nz + 1) + (nx + 1) * (ny + 1) * nz
        return 3 * (vertices + edges)

    @property
    def digest(self) -> str:
        """Short fingerprint of the recipe."""
        return hashlib.sha256(json.dumps(asdict(self), sort_keys=True).encode()).hexdigest()[:12]

    @property
    def file_name(self) -> str:
        """Its file."""
        return f"{self.name}.msh"


def growing(length: float, first: float, growth: float) -> Segment:
    """A segment whose elements grow from about `first` by about `growth` to fill `length`."""
    elements, reached, size = 0, 0.0, first
    while reached < 0.98 * length:
        size *= growth
        reached += size
        elements += 1
    return Segment(length, elements, growth)


# What the block needs, measured on B218's contacts. Beyond the candidates the pressure is smooth seen from afar: growth
# 1.3 or 1.7 sideways and 8 or 6 elements per semi-axis in depth move nothing by more than 0.002 %; the far field is
# exact, so 1.8, 2.5 or 3.5 semi-axes to the cut agree to 0.001 %. All of the error is in how finely the contact's
# surface is divided, and there the elements go.
CUT = 2.5
CANDIDATES = 1.25
SIDE_GROWTH = 1.7
DEPTH_GROWTH = 1.3
FINE_DEPTH = 0.5


def half_space(elements: int) -> Recipe:
    """A block cut out of a half-space, in semi-axes of the contact: x/a, y/b, z/b."""
    if elements < 2:
        raise ValueError(f"elements = {elements}: at least 2 per semi-axis")
    inner = Segment(CANDIDATES, max(2, round(CANDIDATES * elements)))
    outer = growing(CUT - CANDIDATES, 1.0 / elements, SIDE_GROWTH)
    layers = max(2, round(0.25 * elements) + 1)
    deep = growing(CUT - FINE_DEPTH, FINE_DEPTH / layers, DEPTH_GROWTH)
    return Recipe(
        f"half_space_{elements:02d}", elements, (inner, outer), (inner, outer), (Segment(FINE_DEPTH, layers), deep)
    )


def load_series(elements: int, span: float) -> Recipe:
    """One block for contacts from 1 to `span` times the smallest: elements grow with the distance.

    Lengths are in semi-axes of the smallest contact; `elements` counts those on the outer 1 of any semi-axis's length.
    """
    inner = Segment(1.0, elements)
    growth = 1.0 + 1.0 / elements
    middle_length = CANDIDATES * span - 1.0
    count = round(np.log(CANDIDATES * span) / np.log(growth))
    middle = Segment(middle_length, count, float((CANDIDATES * span) ** (1.0 / count)))
    outer = growing((CUT - CANDIDATES) * span, CANDIDATES * span / elements, SIDE_GROWTH)
    layers = max(2, round(0.25 * elements) + 1)
    deep = growing(CUT * span - FINE_DEPTH, FINE_DEPTH / layers, 1.4)
    name = f"load_series_{elements:02d}_{span:.2f}"
    return Recipe(
        name, elements, (inner, middle, outer), (inner, middle, outer), (Segment(FINE_DEPTH, layers), deep), 2
    )


def clamped_box(elements: int, size: float, ellipticity: float) -> Recipe:
    """A box of `size` semi-major axes in each direction round a contact's quarter; lengths in semi-axes, z in b."""
    near = half_space(elements)
    inner, fine = near.x[0], near.z[0]
    first = 1.0 / elements
    along = growing(size - inner.length, first, SIDE_GROWTH)
    across = growing(size * ellipticity - inner.length, first, SIDE_GROWTH)
    deep = growing(size * ellipticity - fine.length, fine.length / fine.elements, DEPTH_GROWTH + 0.2)
    name = f"clamped_box_{elements:02d}_{size:g}_{ellipticity:g}"
    return Recipe(name, elements, (inner, along), (inner, across), (fine, deep))


COMMITTED = (
    *(half_space(elements) for elements in (3, 4, 5, 6, 8)),
    load_series(6, 4.641589),
    *(clamped_box(4, size, 8.2) for size in (8.0, 16.0, 32.0)),
)
"""The meshes of the quick level."""


# --- making ----------------------------------------------------------------------------------------------------------


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


# --- files -----------------------------------------------------------------------------------------------------------


def committed_folder() -> Path:
    """Where the repository keeps its meshes (an installed package carries them inside)."""
    inside = Path(__file__).parent / "meshes"
    return inside if inside.is_dir() else Path(__file__).parent.parent / "meshes"


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
        path = folder / recipe.file_name
        make(recipe, path)
        entries[recipe.file_name] = {
            "recipe": asdict(recipe),
            "elements_per_semi_axis": recipe.elements_per_semi_axis,
            "grading": f"sideways {SIDE_GROWTH}, in depth {DEPTH_GROWTH}",
            "elements": recipe.elements,
            "nodes": int(read(path).p.shape[1]),
            "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
            "gmsh": gmsh_version(),
        }
    (folder / MANIFEST).write_text(json.dumps(entries, indent=1) + "\n")


def locate(recipe: Recipe) -> Path:
    """The recipe's file: committed, cached, or made now."""
    if recipe.file_name in manifest():
        path = committed_folder() / recipe.file_name
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


def read(path: Path) -> MeshHex:
    """Read a mesh file, and check that its tagged faces lie where their tags belong."""
    if not path.is_file():
        raise MeshError(f"{path}: no such mesh file")
    try:
        with _quiet(), contextlib.redirect_stdout(None):
            mesh = from_meshio(meshio.read(path))
    except Exception as problem:  # meshio raises whatever its parser trips over
        raise MeshError(f"{path} is not a whole gmsh mesh ({type(problem).__name__}: {problem})") from problem
    if not isinstance(mesh, MeshHex):
        raise MeshError(f"{path} holds no hexahedra")
    found = set(mesh.boundaries or {})
    if not set(TAGS) <= found:
        missing = ", ".join(sorted(set(TAGS) - found))
        raise MeshError(f"{path} lacks the tagged surface(s) {missing}; it has {', '.join(sorted(found)) or 'none'}")
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


if __name__ == "__main__":
    write_committed(committed_folder())
