"""The shaft of a set as it bends: far further than it does, by a factor that is stated; its rows, loads and points."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.units import mm, um
from qsbearing.pictures.style import GREY, STYLE, round_length
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.weight import mass_loads

SHOWN = 0.3
"""Of the shaft's largest diameter: what the picture makes of the largest deflection."""
LOAD = "#009e73"
"""Colour of the loads."""
FINE = 25
"""Positions along each section."""
NEGLIGIBLE = 1e-3
"""Of the largest deflection: a plane with less is not shown, nor a load with less of the largest."""
XY, XZ = 0.0, 0.5 * np.pi
"""Planes by the direction of their deflection, from y towards z [rad]."""
BOX = 1.9
"""Side of the sketched section of both rings, over the ball diameter."""
STEEP = 0.5
"""Slope of the enlarged centre line at which cross sections turn no further."""


class ShaftPiece(NamedTuple):
    """A stretch of the shaft: what it is before it bends [m]."""

    x: NDArray
    outer: NDArray
    """Radius."""
    inner: NDArray


class Scale(NamedTuple):
    """What all planes of a figure have in common."""

    factor: float
    """By which deflections are enlarged."""
    top: float
    """From the axis to whatever is farthest from it [m]."""


def shapes_of(solution: SetSolution) -> list[ShaftPiece]:
    """Of the sections; of a rigid shaft a straight one through its rows."""
    shaft = solution.set.shaft
    if shaft is not None and shaft.sections:
        return [
            ShaftPiece(
                np.linspace(*ends, FINE),
                *(0.5 * np.linspace(*each, FINE) for each in (section.outer_diameters, section.inner_diameters)),
            )
            for ends, section in zip(pairwise(shaft.ends), shaft.sections, strict=True)
        ]
    rows = [_row(solution, number) for number in range(len(solution.set.rows))]
    seat = min(0.5 * pitch - 0.5 * BOX * ball for _, pitch, ball, _ in rows)
    beyond = 1.5 * BOX * max(ball for _, _, ball, _ in rows)
    ends = min(at for at, *_ in rows) - beyond, max(at for at, *_ in rows) + beyond
    return [ShaftPiece(np.linspace(*ends, FINE), np.full(FINE, seat), np.zeros(FINE))]


def scale_of(solution: SetSolution, place: CasePlace) -> Scale:
    """One for every plane."""
    shapes = shapes_of(solution)
    x = np.concatenate([each.x for each in shapes])
    moved = solution.deflection(x)[place][:, [1, 2]]
    widest = 2.0 * max(float(each.outer.max()) for each in shapes)
    largest = float(np.hypot(*moved.T).max())
    rows = [_row(solution, number) for number in range(len(solution.set.rows))]
    top = max(0.5 * widest, *(0.5 * (pitch + BOX * ball) for _, pitch, ball, _ in rows)) + SHOWN * widest
    return Scale(round_length(SHOWN * widest / largest) if largest > 0.0 else 1.0, top)


def length_of(solution: SetSolution) -> float:
    """Of what is drawn of the shaft [m]."""
    shapes = shapes_of(solution)
    return float(shapes[-1].x[-1] - shapes[0].x[0])


def planes_of(solution: SetSolution, place: CasePlace) -> list[float]:
    """In which of the planes xy and xz it bends enough to be seen."""
    x = np.concatenate([each.x for each in shapes_of(solution)])
    largest = np.abs(solution.deflection(x)[place][:, [1, 2]]).max(axis=0)
    planes = zip((XY, XZ), largest, strict=True)
    return [plane for plane, most in planes if most > NEGLIGIBLE * largest.max()] or [XY]


def main_plane(solution: SetSolution, place: CasePlace) -> float:
    """In which the first named point of the shaft moves, or else the place that moves most."""
    x = np.concatenate([each.x for each in shapes_of(solution)])
    if solution.points:
        x = np.array([next(iter(solution.points.values())).position])
    moved = solution.deflection(x)[place][:, [1, 2]]
    y, z = moved[np.argmax(np.hypot(*moved.T))]
    return float(np.arctan2(z, y)) if np.hypot(y, z) > 0.0 else XY


def draw_deformed_shaft(
    axes: Any,
    solution: SetSolution,
    place: CasePlace,
    plane: float = XY,
    scale: Scale | None = None,
    are_points_told: bool = True,
) -> None:
    """Args:
    plane: direction in which deflections are seen, from y towards z [rad].
    scale: of the figure; None: its own.
    are_points_told: whether named points say how far they move.
    """
    factor, top = scale or scale_of(solution, place)
    drawn = _Drawn(axes, solution, place, np.array([np.cos(plane), np.sin(plane)]), factor)
    for number, shape in enumerate(shapes_of(solution)):
        drawn.section(shape, is_first=number == 0)
    for number in range(len(solution.set.rows)):
        drawn.row(number)
    drawn.loads(top)
    drawn.supports()
    drawn.points(top, are_points_told)
    axes.set_title(f"{_plane(plane)}: deflection × {factor:,.0f}", fontsize=11, fontweight="bold")
    axes.set_xlabel("x, mm", fontsize=9)
    axes.set_ylim(-1.5 * top / mm, (1.85 if are_points_told else 1.45) * top / mm)
    axes.set_yticks([])
    axes.margins(x=0.04)
    axes.set_aspect("equal")
    axes.locator_params(axis="x", nbins=4 if length_of(solution) < 4.0 * top else 6)
    axes.tick_params(labelsize=8)
    for name in ("left", "top", "right"):
        axes.spines[name].set_visible(False)


def _plane(plane: float) -> str:
    names = {XY: "Plane xy", XZ: "Plane xz"}
    return names.get(plane, f"Plane at {np.degrees(plane) % 360.0:.0f}° from y")


def _row(solution: SetSolution, number: int) -> tuple[float, float, float, float]:
    """Position, pitch and ball diameter [m], free contact angle [rad]."""
    row = solution.set.rows[number]
    names = ("pitch_diameter", "ball_diameter", "free_contact_angle")
    pitch, ball, angle = (float(np.ravel(getattr(row.bearing, name))[0]) for name in names)
    return float(np.ravel(row.position)[0]), pitch, ball, angle


class _Drawn(NamedTuple):
    """What is drawn, and how far deflections are enlarged."""

    axes: Any
    solution: SetSolution
    place: CasePlace
    direction: NDArray
    factor: float

    def at(self, x: NDArray | Sequence[float]) -> tuple[NDArray, NDArray]:
        """Enlarged deflection [m] and slope along the shaft; tilt z is the slope of y, tilt y that of -z."""
        moved = self.solution.deflection(np.asarray(x, float))[self.place]
        bent = self.factor * (moved[:, [1, 2]] @ self.direction)
        slope = self.factor * (np.stack([moved[:, 4], -moved[:, 3]], axis=1) @ self.direction)
        return bent, np.clip(slope, -STEEP, STEEP)

    def section(self, shape: ShaftPiece, is_first: bool) -> None:
        """Both halves of its section, and its outline before it bends; cross sections are square to the centre line."""
        bent, slope = self.at(shape.x)
        for side in (1.0, -1.0):
            edges = [side * each for each in (shape.outer, shape.inner)]
            x = np.concatenate([shape.x - slope * edges[0], (shape.x - slope * edges[1])[::-1]])
            y = np.concatenate([bent + edges[0], (bent + edges[1])[::-1]])
            label = {"label": "deformed shaft"} if is_first and side > 0.0 else {}
            self.axes.fill(x / mm, y / mm, facecolor="0.87", edgecolor="0.3", linewidth=0.9, zorder=1.0, **label)
            outline = {"color": "0.6", "linewidth": 0.6, "linestyle": (0, (4, 3)), "zorder": 1.2}
            label = {"label": "undeformed shaft"} if is_first and side > 0.0 else {}
            self.axes.plot(shape.x / mm, edges[0] / mm, **outline, **label)
        line = {"color": "0.3", "lw": 0.8, "ls": "-.", "zorder": 1.3}
        self.axes.plot(shape.x / mm, bent / mm, **line, **({"label": "centre line"} if is_first else {}))

    def row(self, number: int) -> None:
        """Rings and balls above and below the shaft, with their lines of action, and the row's number."""
        from matplotlib.patches import Circle, Rectangle

        at, pitch, ball, angle = _row(self.solution, number)
        angle = 0.0 if self.solution.set.is_two_sided[number] else angle
        y = float(self.at([at])[0][0])
        for side in (1.0, -1.0):
            centre = y + side * 0.5 * pitch
            corner = (at - 0.5 * BOX * ball) / mm, (centre - 0.5 * BOX * ball) / mm
            size = BOX * ball / mm
            self.axes.add_patch(Rectangle(corner, size, size, facecolor="0.96", edgecolor="0.55", lw=0.7, zorder=1.5))
            self.axes.add_patch(
                Circle((at / mm, centre / mm), 0.5 * ball / mm, facecolor="white", edgecolor="black", lw=0.9, zorder=2)
            )
            along = 0.85 * ball * np.array([self.solution.set.rows[number].sign * np.sin(angle), side * np.cos(angle)])
            ends = np.array([-along, along])
            x, up = (at + ends[:, 0]) / mm, (centre + ends[:, 1]) / mm
            self.axes.plot(x, up, color=STYLE["inner"]["color"], lw=1.2, zorder=2.1)
        under = (y - 0.5 * pitch - 0.5 * BOX * ball) / mm
        self.axes.annotate(
            str(number + 1), (at / mm, under), (0, -4), textcoords="offset points", ha="center", va="top",
            fontsize=9, fontweight="bold",
        )  # fmt: skip

    def loads(self, top: float) -> None:
        """Arrows where loads act: those across the shaft point at it, those along it lie on its axis."""
        every = [(at, np.array([force @ self.direction, axial])) for at, axial, force in self._forces()]
        largest = max((float(np.abs(each).max()) for _, each in every), default=0.0)
        for at, (across, along) in every:
            arrow = {"arrowstyle": "-|>", "color": LOAD, "lw": 1.8, "shrinkA": 0.0, "shrinkB": 0.0}
            style: dict[str, Any] = {"fontsize": 9, "color": LOAD, "zorder": 3}
            if abs(across) > NEGLIGIBLE * largest:
                side = -np.sign(across)
                ends = (at / mm, side * 0.72 * top / mm), (at / mm, side * 1.12 * top / mm)
                self.axes.annotate("", *ends, arrowprops=arrow)
                self.axes.annotate(
                    f"{abs(across):.4g} N", ends[1], (0, 2 * side), textcoords="offset points",
                    ha="center", va="top" if side < 0.0 else "bottom", **style,
                )  # fmt: skip
            if abs(along) > NEGLIGIBLE * largest:
                self._axial(at, along, top, arrow, style)

    def _axial(self, at: float, along: float, top: float, arrow: Any, style: Any) -> None:
        """Beyond the nearer end of the shaft, which it pushes or pulls."""
        shapes = shapes_of(self.solution)
        ends = float(shapes[0].x[0]), float(shapes[-1].x[-1])
        end = min(ends, key=lambda each: abs(each - at))
        outward = -1.0 if end == ends[0] else 1.0
        y, length = float(self.at([end])[0][0]) / mm, 0.55 * top / mm
        near, far = end / mm + outward * 0.1 * length, end / mm + outward * 1.1 * length
        tip, tail = (far, near) if along * outward > 0.0 else (near, far)
        self.axes.annotate("", (tip, y), (tail, y), arrowprops=arrow)
        self.axes.annotate(
            f"{abs(along):.4g} N", (near, y), (2 * outward, 4), textcoords="offset points",
            ha="left" if outward > 0.0 else "right", **style,
        )  # fmt: skip
        self.axes.plot(end / mm + outward * 1.5 * length, y, alpha=0.0)  # room for it

    def _forces(self) -> Iterator[tuple[float, float, NDArray]]:
        """Where loads act [m], axial ones and those along y and z [N]; those of the operation at its reference
        position, where the shaft is free to follow them."""
        of, shaft = self.solution.set, self.solution.set.shaft
        values = [self.solution.load[self.place][i] if i in self.solution.free_channels else 0.0 for i in range(3)]
        yield float(np.ravel(of.reference)[0]), float(values[0]), np.array(values[1:], float)
        for load in () if shaft is None else (*of.shaft_loads, *mass_loads(shaft)):
            axial, y, z = (
                float(np.broadcast_to(np.asarray(each, float), self.solution.shape)[self.place])
                for each in load.values[:3]
            )
            yield float(load.position), axial, np.array([y, z])

    def supports(self) -> None:
        """A triangle below the shaft where something elastic holds it up."""
        shaft = self.solution.set.shaft
        of_all = () if shaft is None else shaft.supports
        held = [each for each in of_all if np.any(np.diagonal(np.asarray(each.stiffness))[[1, 2]] > 0.0)]
        shapes = shapes_of(self.solution)
        for number, each in enumerate(held):
            at = float(each.position)
            shape = next((one for one in shapes if one.x[0] <= at <= one.x[-1]), shapes[-1])
            under = float(self.at([at])[0][0]) - float(np.interp(at, shape.x, shape.outer))
            label = {"label": "elastic support"} if number == 0 else {}
            self.axes.plot(
                at / mm, under / mm, marker=(3, 0, 0), ms=11, color=GREY, mfc="white", ls="", zorder=2.2,
                transform=_below(self.axes), **label,
            )  # fmt: skip

    def points(self, top: float, are_told: bool) -> None:
        """Named ones, and how far they move in this plane."""
        shaft = self.solution.set.shaft
        for label, position in ({} if shaft is None else shaft.points).items():
            y = float(self.at([position])[0][0])
            self.axes.plot(position / mm, y / mm, marker="o", ms=4, color="black", zorder=3)
            if not are_told:
                continue
            text = f"{label}: {y / self.factor / um:.3g} µm".replace("-", "−")
            self.axes.annotate(text, (position / mm, 1.58 * top / mm), ha="center", fontsize=9)
            self.axes.plot(2 * [position / mm], [y / mm, 1.54 * top / mm], color="0.6", lw=0.6, ls=":", zorder=0.9)


def _below(axes: Any) -> Any:
    """A mark whose top is where it is drawn."""
    from matplotlib.transforms import ScaledTranslation

    return axes.transData + ScaledTranslation(0.0, -6.0 / 72.0, axes.figure.dpi_scale_trans)
