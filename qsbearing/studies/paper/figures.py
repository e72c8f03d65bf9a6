"""The figures of the source paper, and maps beyond them: each a study file, a picture and what is stated of it.

Wang, Yan, Zhang & Hong, "Research on the Dynamic Properties of Ball Bearings Based on the Quasi-Static Method",
Springer, chapter 19.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib.resources import files
from typing import TYPE_CHECKING

from qsbearing.files.toml import read_toml
from qsbearing.pictures.style import SLIP
from qsbearing.studies.chunk import IMPOSSIBLE
from qsbearing.studies.paper.statements import CONCLUSION, HERE, PAPER, Claim, Judged, both, falls, judge, rises
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from xarray import Dataset

SPEED, COUNT, COEFFICIENT, RADIAL = "speed_rpm", "ball_count", "groove_radius_coefficient", "radial_load_y_N"
LIVES = ("life_basic_reference_rating_life", "life_inner_life", "life_outer_life")
LITTLE = 0.05
"""A result that moves by less than this part over a whole figure hardly moves (chosen)."""


@dataclass(frozen=True)
class PaperFigure:
    """One figure."""

    name: str
    """Of its study file, and of the files that are written."""
    title: str
    results: tuple[str, ...] = ()
    """What is drawn; none: what suits the study."""
    kind: str | None = None
    x: str | None = None
    statements: tuple[Claim, ...] = ()

    @property
    def study(self) -> Study:
        """The study of its file."""
        return Study.of(read_toml(files("qsbearing.studies.paper") / f"{self.name}.toml"))  # type: ignore[arg-type]


NO_BALL_LEAVES = Claim("No ball leaves the inner raceway", HERE, lambda results: results["balls_off_inner"] == 0.0)
NO_SLIP = Claim(
    f"The friction that Mg requires stays below {SLIP[0]:g}, where gyroscopic slip begins in lubricated contacts",
    HERE,
    lambda results: results["outer_required_friction"].max("ball") < SLIP[0],
)

FIGURES = (
    PaperFigure(
        "figure_19_4",
        "Fig. 19.4: contact angles and loads against speed",
        statements=(
            Claim("With speed the outer contact angle falls", PAPER, falls("outer_angle", SPEED)),
            Claim("With speed the inner contact angle rises", PAPER, rises("inner_angle", SPEED)),
            Claim(
                "The outer contact carries more than the inner one once the bearing turns",
                PAPER,
                lambda results: (results["outer_load"] > results["inner_load"]).isel(ball=0) | (results[SPEED] == 0.0),
            ),
            Claim(
                "With speed the outer contact angle rises and the inner one falls",
                CONCLUSION,
                both(rises("outer_angle", SPEED), falls("inner_angle", SPEED)),
            ),
            Claim("With speed the axial stiffness falls", HERE, falls("ring_effective_stiffness_axial", SPEED)),
        ),
    ),
    PaperFigure(
        "figure_19_5",
        "Fig. 19.5: contact angles and loads by azimuth under radial loads",
        kind="azimuth",
        statements=(
            Claim("The ball under the radial load carries more with it", HERE, rises("inner_load", RADIAL)),
            Claim("Its inner contact angle falls with the radial load", HERE, falls("inner_angle", RADIAL)),
            NO_BALL_LEAVES,
        ),
    ),
    PaperFigure(
        "figure_19_6",
        "Fig. 19.6: contact angles and loads against the number of balls",
        statements=(
            Claim("With more balls the inner contact angle rises", PAPER, rises("inner_angle", COUNT)),
            Claim("With more balls the outer contact angle falls", PAPER, falls("outer_angle", COUNT)),
            Claim("With more balls the inner contact load falls", PAPER, falls("inner_load", COUNT)),
            Claim(
                "That many balls fit on the pitch circle", HERE, lambda results: results["status"] != IMPOSSIBLE, True
            ),
        ),
    ),
    PaperFigure(
        "figure_19_7",
        "Fig. 19.7: groove radius coefficients; pressure shows the difference",
        ("inner_angle", "outer_angle", "inner_load", "outer_load", "inner_max_pressure", "outer_max_pressure"),
        statements=(
            Claim("With wider grooves the inner contact angle falls", PAPER, falls("inner_angle", COEFFICIENT)),
            Claim("With wider grooves the inner contact load rises", PAPER, rises("inner_load", COEFFICIENT)),
            Claim(
                f"The inner contact load hardly moves, by less than {LITTLE:.0%}",
                HERE,
                lambda results: abs(results["inner_load"] / results["inner_load"].median() - 1.0).isel(ball=0) < LITTLE,
            ),
            Claim("With wider grooves the pressure rises", HERE, rises("inner_max_pressure", COEFFICIENT)),
        ),
    ),
    PaperFigure(
        "life_groove_radius",
        "Beyond the paper: rating life of the bearing and of each raceway against the groove radius coefficient",
        LIVES,
        statements=(
            Claim("With wider grooves the life falls", HERE, falls(LIVES[0], COEFFICIENT)),
            Claim(
                "The inner raceway lives longer than the outer one",
                HERE,
                lambda results: results[LIVES[1]] > results[LIVES[2]],
            ),
        ),
    ),
    PaperFigure(
        "life_ball_count",
        "Beyond the paper: rating life of the bearing and of each raceway against the number of balls",
        LIVES,
        statements=(
            Claim("With more balls the life rises", HERE, rises(LIVES[0], COUNT)),
            Claim("With more balls the inner raceway's life rises", HERE, rises(LIVES[1], COUNT)),
            Claim("With more balls the outer raceway's life rises", HERE, rises(LIVES[2], COUNT)),
        ),
    ),
    PaperFigure(
        "map_axial_load",
        "Beyond the paper: pressure, friction and stiffness over speed and axial load; where gyroscopic slip begins",
        ("inner_max_pressure", "outer_max_pressure", "outer_required_friction", "ring_effective_stiffness_axial"),
        statements=(NO_SLIP,),
    ),
    PaperFigure(
        "map_radial_load",
        "Beyond the paper: balls that leave the inner raceway, over speed and radial load",
        ("balls_off_inner", "outer_required_friction", "inner_max_pressure", "outer_max_pressure"),
        x=SPEED,
        statements=(NO_BALL_LEAVES, NO_SLIP),
    ),
    PaperFigure(
        "map_moment",
        "Beyond the paper: which ball leaves the inner raceway first, over speed and moment",
        ("least_loaded_azimuth", "balls_off_inner", "outer_required_friction", "inner_max_pressure"),
        x=SPEED,
        statements=(
            NO_BALL_LEAVES,
            Claim(
                "The ball opposite the radial load carries least",
                HERE,
                lambda results: abs(results["least_loaded_azimuth"] - 180.0) < 1e-6,
            ),
            NO_SLIP,
        ),
    ),
)


def made(figure: PaperFigure) -> tuple[Dataset, Figure, list[Judged]]:
    """The results of a figure's study, its picture, and what is stated of it, judged."""
    from qsbearing.pictures.study import picture

    results = sweep(figure.study)
    drawn = picture(results, figure.x, figure.results, figure.kind)
    return results, drawn, [judge(statement, results) for statement in figure.statements]
