"""The ball between its rings, cut open: the stress in the steel, and the pressure on the ball beside Hertz's ellipse.

`python -m fem_check.cutaway OUT.png` makes the picture of the guide from the record of `bearing_sector` and its meshes;
it needs PyVista (extra `render`), which draws without a screen.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from fem_check import records_store, sector_comparison
from fem_check.contact_problem import Array
from fem_check.linear_solver import factorise
from fem_check.references import hertz
from fem_check.solids.bearing_sector import OuterSupport, ring_support
from fem_check.solids.condensation import free_support
from fem_check.solids.sector_geometry import SectorGeometry
from fem_check.solids.tetrahedral_body import CURVED_TETRAHEDRA, TetrahedralBody

RACES = ("inner", "outer")
SCENE = "b218"
LEAST, MOST = 0.005, 0.6
"""Stresses shown, over the largest pressure; below a contact von Mises' stress is largest at about 0.6 of it."""


@dataclass(frozen=True)
class Shown:
    """A body: nodes (3, node) [mm], the ten of each element, and at each node von Mises' stress and pressure [MPa]."""

    nodes: Array
    elements: Array
    stress: Array
    pressure: Array


def geometry_of(record: dict[str, Any]) -> SectorGeometry:
    """The bodies of a record's picture: its point, with the outside diameter rigid, on its finest mesh."""
    load, speed = (float(each.split()[-2]) for each in record["pictures"]["sector"]["label"].split(","))
    point = sector_comparison.OperatingPoint(load, speed * np.pi / 30.0)
    place = sector_comparison.place(SCENE, point, OuterSupport.RIGID)
    return SectorGeometry(sector_comparison.sector_bearing(SCENE), place, record["mesh"]["elements_per_semi_axis"])


def hertz_ellipse(record: dict[str, Any], geometry: SectorGeometry) -> list[Array]:
    """Hertz's ellipse at the inner raceway under the record's load: the ball's centre, the ellipse's, and its semi-axes
    as vectors [mm]."""
    frame = geometry.frames[0]
    angle = float(np.arctan2(-frame.normal[0], -frame.normal[1]))
    load = record["pictures"]["sector"]["contacts"]["inner"]["load_N"]
    exact = hertz(geometry.bearing.drawing.groove("inner", angle).problem(load))
    major = np.array([*frame.tangent, 0.0]) * exact.semi_major_axis
    minor = np.array([0.0, 0.0, exact.semi_minor_axis])
    places = (np.array([*frame.ball.centre, 0.0]), np.array([*frame.origin, 0.0]), major, minor)
    return [1e3 * each for each in places]


def bodies(record: dict[str, Any], geometry: SectorGeometry) -> dict[str, Shown]:
    """The three bodies under the pressures of a record.

    Args:
        record: of `bearing_sector`, with the pressures of one point.
        geometry: the bodies whose contacts the pressures belong to.
    """
    sector = record["pictures"]["sector"]
    frames = dict(zip(RACES, geometry.frames, strict=True))
    pressures = {race: 1e6 * np.array(sector["contacts"][race]["p"]) for race in RACES}
    drawing = geometry.bearing.drawing
    found = {}
    for name in ("ball", *RACES):
        body = TetrahedralBody(geometry.mesh(name), drawing.ball if name == "ball" else drawing.ring)
        own = RACES if name == "ball" else (name,)
        force = sum(frames[race].loads(body, on_ball=name == "ball") @ pressures[race] for race in own)
        if name == "ball":
            fixed, _, carried, share = free_support(body, force)
            moved = _moved(body, force - carried @ share, fixed)
        else:
            moved = _moved(body, force, *ring_support(body, geometry, name, OuterSupport.RIGID))
        pressure = np.zeros(body.space.count)
        for race in own:
            frame = frames[race]
            xi, eta, zeta = frame.coordinates(body.nodes)
            near = (np.abs(xi) < frame.patch.half_length) & (eta < frame.patch.half_width)
            height = (frame.ball_height if name == "ball" else frame.groove_height)(xi[near], eta[near])[0]
            near[near] = np.abs(zeta[near] - height) < 1e-5 * frame.ball.radius
            pressure[near] = frame.basis.values(xi[near], eta[near]) @ pressures[race]
        found[name] = Shown(1e3 * body.nodes, body.space.element_nodes, 1e-6 * von_mises(body, moved), 1e-6 * pressure)
    return found


def _moved(body: TetrahedralBody, force: Array, fixed: Array, turn: sp.csr_matrix | None = None) -> Array:
    """Displacement (node, 3) under a force."""
    turn = sp.identity(3 * body.space.count, format="csr") if turn is None else turn
    free = np.flatnonzero(~fixed.ravel())
    matrix = sp.csr_matrix(turn.T @ body.stiffness @ turn)
    moved = np.zeros(3 * body.space.count)
    moved[free] = factorise(sp.csc_matrix(matrix[free][:, free])).solve((turn.T @ force)[free, None])[:, 0]
    return (turn @ moved).reshape(-1, 3)


def von_mises(body: TetrahedralBody, moved: Array) -> Array:
    """Von Mises' stress at the nodes [Pa], the mean of the elements around each."""
    from skfem import CellBasis

    family = CURVED_TETRAHEDRA.element()
    basis = CellBasis(body.mesh, family, quadrature=(family.doflocs.T, np.ones(10)))
    gradient = np.stack([np.asarray(basis.interpolate(moved[:, axis]).grad) for axis in range(3)])
    strain = 0.5 * (gradient + gradient.transpose(1, 0, 2, 3))
    modulus, ratio = body.material.elastic_modulus, body.material.poisson_ratio
    deviator = strain - np.einsum("iiep,jk->jkep", strain, np.identity(3)) / 3.0
    stress = np.sqrt(1.5 * np.einsum("ijep,ijep->ep", deviator, deviator)) * modulus / (1.0 + ratio)
    nodes, count = basis.element_dofs.ravel(), basis.N
    return np.bincount(nodes, stress.T.ravel(), count) / np.bincount(nodes, minlength=count)


def draw(found: dict[str, Shown], ellipse: Sequence[Array], path: Path, size: tuple[int, int]) -> None:
    """The picture: left the bodies cut open, right the ball from its inner contact, with Hertz's ellipse.

    Args:
        found: the bodies.
        ellipse: as `hertz_ellipse` has it.
        path: where to.
        size: in pixels.
    """
    import pyvista as pv
    from matplotlib.colors import LinearSegmentedColormap
    from PIL import Image

    plotter = pv.Plotter(off_screen=True, shape=(1, 2), border=False, window_size=list(size))
    plotter.set_background("white")
    most = max(body.pressure.max() for body in found.values())
    bar = {
        "vertical": False, "width": 0.56, "height": 0.08, "position_x": 0.22, "position_y": 0.06, "color": "black",
        "fmt": "%.0f", "label_font_size": 15,
    }  # fmt: skip
    # Titles of its own a bar writes over its numbers; a different blank each keeps the two bars apart.
    words = {"position": "lower_edge", "color": "black", "font_size": 8}
    look = {
        "cmap": LinearSegmentedColormap.from_list("steel", COLOURS),
        "ambient": 0.4,
        "diffuse": 0.72,
        "smooth_shading": True,
    }
    surfaces = {name: _surface(pv, body) for name, body in found.items()}
    centre, contact, major, minor = map(np.asarray, ellipse)
    plotter.subplot(0, 0)
    for name, surface in surfaces.items():
        # The field falls off as the square of the distance: in logarithms all of it is seen.
        plotter.add_mesh(
            surface, scalars="stress", clim=(LEAST * most, MOST * most), log_scale=True, split_sharp_edges=True,
            show_scalar_bar=name == "ball", scalar_bar_args=bar | {"title": "", "n_labels": 3},
            **look,
        )  # fmt: skip
    plotter.add_text("von Mises stress, MPa", **words)
    plotter.camera_position = [centre + SIDE, centre + DOWN, (0.0, 1.0, 0.0)]
    plotter.subplot(0, 1)
    half = surfaces["ball"]
    for surface in (half, half.reflect((0.0, 0.0, 1.0), point=(0.0, 0.0, 0.0))):
        plotter.add_mesh(
            surface, scalars="pressure", clim=(0.0, most), split_sharp_edges=True, show_scalar_bar=surface is half,
            scalar_bar_args=bar | {"title": " ", "n_labels": 4}, **look,
        )  # fmt: skip
    angle = np.linspace(0.0, 2.0 * np.pi, 181)[:, None]
    line = contact - centre + np.cos(angle) * major + np.sin(angle) * minor
    line *= 1.003 * np.linalg.norm(contact - centre) / np.linalg.norm(line, axis=1)[:, None]
    plotter.add_text("contact pressure, MPa. Line: Hertz's ellipse", **words)
    plotter.add_mesh(pv.lines_from_points(centre + line), color="black", line_width=3)
    away = (contact - centre) / np.linalg.norm(contact - centre)
    plotter.camera_position = [contact + 13.0 * away + ASIDE, contact, (0.0, 0.0, 1.0)]
    seen = Image.fromarray(plotter.screenshot(return_img=True))
    plotter.close()
    # Colours off by 7 of 255 at most, in a quarter of the bytes: the picture travels in the wheel.
    seen.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=6, dither=Image.Dither.NONE).save(path, optimize=True)


SIDE, DOWN, ASIDE = np.array([[-14.0, 9.0, -60.0], [0.0, -1.2, 0.0], [0.0, 0.0, 5.0]])
"""Where the eye is from the ball's centre, where it looks, and how far it stands beside the contact [mm]."""
COLOURS = ["#dde2e5", "#a9c4d3", "#0072b2", "#d55e00", "#7a1f00"]


def _surface(pv: Any, body: Shown) -> Any:
    """Its curved surface, each facet in sixteen."""
    cells = np.column_stack([np.full(body.elements.shape[1], 10), body.elements.T]).ravel()
    grid = pv.UnstructuredGrid(cells, np.full(body.elements.shape[1], pv.CellType.QUADRATIC_TETRA), body.nodes.T)
    grid.point_data["stress"], grid.point_data["pressure"] = np.maximum(body.stress, 1e-3), body.pressure
    return grid.extract_surface(nonlinear_subdivision=2, algorithm="dataset_surface")


def main(path: Path, level: str = "quick", size: tuple[int, int] = (1120, 570)) -> None:
    """Make the picture of a level's record."""
    record = json.loads((records_store.FOLDER / level / "bearing_sector.json").read_text(encoding="utf-8"))
    geometry = geometry_of(record)
    draw(bodies(record, geometry), hertz_ellipse(record, geometry), path, size)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
