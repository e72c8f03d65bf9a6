"""The ball between its rings, cut open: the stress in the steel, and the pressure on the ball beside Hertz's ellipse.

`python -m tests.verification.benchmarks.cutaway OUT.png` makes the picture of the guide from the record of
`bearing_sector` and its meshes; it needs PyVista (extra `render`), which draws without a screen. Beside it stand the
three bodies as VTU files, which ParaView opens, and from which it is drawn.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from fem_check.elements import fields
from fem_check.elements.fields import NodalFields
from fem_check.independent.contact_problem import Array
from fem_check.independent.references import hertz
from fem_check.running import records_store
from fem_check.solids import sector_comparison
from fem_check.solids.bearing_sector import OuterSupport, ring_support
from fem_check.solids.condensation import free_support, moved
from fem_check.solids.sector_geometry import SectorGeometry
from fem_check.solids.tetrahedral_body import TetrahedralBody

RACES = ("inner", "outer")
SCENE = "b218"
LEAST, MOST = 0.005, 0.6
"""Stresses shown, over the largest pressure; below a contact von Mises' stress is largest at about 0.6 of it."""
STRESS, PRESSURE = "von_mises_MPa", "pressure_MPa"


def geometry_of(record: dict[str, Any]) -> SectorGeometry:
    """The bodies of a record's picture: its point, with the outside diameter rigid, on its finest mesh."""
    load, speed = (float(each.split()[-2]) for each in record["pictures"]["sector"]["label"].split(","))
    point = sector_comparison.ThrustPoint(load, speed * np.pi / 30.0)
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


def bodies(record: dict[str, Any], geometry: SectorGeometry) -> dict[str, NodalFields]:
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
        on_ball = name == "ball"
        body = TetrahedralBody(geometry.mesh(name), drawing.ball if on_ball else drawing.ring)
        own = RACES if on_ball else (name,)
        force = sum(frames[race].loads(body, on_ball=on_ball) @ pressures[race] for race in own)
        if on_ball:
            fixed, _, carried, share = free_support(body, force)
            displaced = moved(body, force - carried @ share, fixed)
        else:
            displaced = moved(body, force, *ring_support(body, geometry, name, OuterSupport.RIGID))
        pressure = sum(frames[race].pressure_on(body.nodes, pressures[race], on_ball=on_ball) for race in own)
        found[name] = fields.of_body(body.space, displaced, np.asarray(pressure), body.material)
    return found


def files(found: dict[str, NodalFields], picture: Path) -> dict[str, Path]:
    """Write the bodies as VTU files beside the picture; returns the files."""
    paths = {name: picture.with_name(f"{picture.stem}_{name}.vtu") for name in found}
    for name, path in paths.items():
        found[name].write(path)
    return paths


def draw(found: dict[str, Path], ellipse: Sequence[Array], path: Path, size: tuple[int, int]) -> None:
    """The picture: left the bodies cut open, right the ball from its inner contact, with Hertz's ellipse.

    Args:
        found: the files of the bodies.
        ellipse: as `hertz_ellipse` has it.
        path: where to.
        size: in pixels.
    """
    import pyvista as pv
    from matplotlib.colors import LinearSegmentedColormap
    from PIL import Image

    plotter = pv.Plotter(off_screen=True, shape=(1, 2), border=False, window_size=list(size))
    plotter.set_background("white")
    grids = {name: pv.read(file) for name, file in found.items()}
    most = max(grid.point_data[PRESSURE].max() for grid in grids.values())
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
    surfaces = {name: _surface(grid) for name, grid in grids.items()}
    centre, contact, major, minor = map(np.asarray, ellipse)
    plotter.subplot(0, 0)
    for name, surface in surfaces.items():
        # The field falls off as the square of the distance: in logarithms all of it is seen.
        plotter.add_mesh(
            surface, scalars=STRESS, clim=(LEAST * most, MOST * most), log_scale=True, split_sharp_edges=True,
            show_scalar_bar=name == "ball", scalar_bar_args=bar | {"title": "", "n_labels": 3},
            **look,
        )  # fmt: skip
    plotter.add_text("von Mises stress, MPa", **words)
    plotter.camera_position = [centre + SIDE, centre + DOWN, (0.0, 1.0, 0.0)]
    plotter.subplot(0, 1)
    half = surfaces["ball"]
    for surface in (half, half.reflect((0.0, 0.0, 1.0), point=(0.0, 0.0, 0.0))):
        plotter.add_mesh(
            surface, scalars=PRESSURE, clim=(0.0, most), split_sharp_edges=True, show_scalar_bar=surface is half,
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


def _surface(grid: Any) -> Any:
    """Its curved surface, each facet in sixteen."""
    grid.point_data[STRESS] = np.maximum(grid.point_data[STRESS], 1e-3)  # for its logarithm
    return grid.extract_surface(nonlinear_subdivision=2, algorithm="dataset_surface")


def main(path: Path, level: str = "quick", size: tuple[int, int] = (1120, 570)) -> None:
    """Make the picture of a level's record, and beside it the files of the bodies that it is drawn from."""
    record = json.loads((records_store.FOLDER / level / "bearing_sector.json").read_text(encoding="utf-8"))
    geometry = geometry_of(record)
    draw(files(bodies(record, geometry), path), hertz_ellipse(record, geometry), path, size)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
