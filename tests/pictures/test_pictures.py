"""Pictures: what is drawn is what was solved, and nothing falls on anything else."""

from __future__ import annotations

import dataclasses
import re
import sys
import tomllib
import warnings
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs

matplotlib = pytest.importorskip("matplotlib")
from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: E402
from matplotlib.patches import Ellipse  # noqa: E402

from qsbearing import pictures  # noqa: E402
from qsbearing.files.scene_tables import input_tables  # noqa: E402
from qsbearing.files.set_file import set_of  # noqa: E402
from qsbearing.pictures.style import (  # noqa: E402
    CHANNEL_LINES,
    ROW_LINES,
    STYLE,
    circle_beyond,
    figure_of_size,
    legend,
    legend_within,
    logarithmic,
    of_results,
)
from qsbearing.studies.design.shown import picture as found_picture  # noqa: E402
from tests.guide.pages import GUIDE, blocks  # noqa: E402

EFFECTS: dict[str, Any] = {
    "ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment()),
    "raceway_control": qs.RacewayControl.OUTER,
}


def b218(**changes: Any) -> qs.BallBearing:
    return dataclasses.replace(qs.load_scene("b218").bearing, **changes)


COMBINED = qs.Operation(speed=10_000 * qs.rpm, axial_load=3000.0, radial_load_y=4000.0, tilt_z=0.0)
SCENES = {
    "thrust": qs.load_scene("b218"),
    "combined, inner contacts lost": qs.Scene(b218(), COMBINED, **EFFECTS),
    "at rest, balls unloaded": qs.Scene(b218(), qs.Operation(axial_load=1000.0, radial_load_y=4000.0, tilt_z=0.0)),
    "deep groove, negative angles": qs.Scene(
        qs.load_scene("iso16281_7ball").bearing,
        qs.Operation(axial_load=-300.0, radial_load_y=1000.0, tilt_z=2e-3),
    ),
    "three balls": qs.Scene(b218(ball_count=3), qs.Operation(axial_load=3000.0, moment_z=20.0, first_ball_azimuth=0.3)),
    "nineteen balls": qs.Scene(b218(ball_count=19, pitch_diameter=0.15), COMBINED, **EFFECTS),
    "sixty balls": qs.Scene(b218(ball_count=60, pitch_diameter=0.5), COMBINED, **EFFECTS),
}
SOLUTIONS = {name: qs.solve(scene) for name, scene in SCENES.items()}


@pytest.mark.parametrize("name", SCENES)
def test_every_scene_is_drawn_without_a_warning(name: str) -> None:
    solution = SOLUTIONS[name]
    assert solution.converged
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pictures.overview(solution).savefig(BytesIO(), dpi=40)


@pytest.mark.parametrize("picture", ["load_distribution", "contact_angles", "contact_ellipses", "section"])
def test_every_picture_alone_is_drawn_without_a_warning(picture: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        getattr(pictures, picture)(SOLUTIONS["combined, inner contacts lost"]).savefig(BytesIO(), dpi=40)


def test_no_global_state_of_matplotlib_is_used(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)  # importing it is an error now
    pictures.overview(SOLUTIONS["thrust"]).savefig(BytesIO(), format="svg")


@pytest.mark.parametrize("name", SCENES)
def test_loads_are_drawn_at_their_azimuths(name: str) -> None:
    solution = SOLUTIONS[name]
    (axes,) = pictures.load_distribution(solution).axes
    lines = {line.get_label(): line for line in axes.get_lines()}
    for side, contacts in (("inner", solution.inner), ("outer", solution.outer)):
        line = lines[f"{side} raceway"]
        np.testing.assert_allclose(line.get_xdata()[:-1], solution.azimuth)
        np.testing.assert_allclose(line.get_ydata()[:-1], contacts.load)
        assert axes.get_ylim()[1] > contacts.load.max()


@pytest.mark.parametrize("name", SCENES)
def test_angles_are_drawn_where_there_is_contact_and_only_there(name: str) -> None:
    solution = SOLUTIONS[name]
    (axes,) = pictures.contact_angles(solution).axes
    lines = {line.get_label(): line for line in axes.get_lines()}
    for side, contacts in (("inner", solution.inner), ("outer", solution.outer)):
        x, y = lines[f"{side} raceway"].get_data()
        drawn = dict(zip(np.round(x[1:-1], 6), y[1:-1], strict=True))
        for azimuth, angle, load in zip(np.degrees(solution.azimuth) % 360, contacts.angle, contacts.load, strict=True):
            value = drawn[np.round(azimuth, 6)]
            assert np.isnan(value) if load == 0 else value == pytest.approx(np.degrees(angle))
            assert load == 0 or axes.get_ylim()[0] < value < axes.get_ylim()[1]
    assert lines["free contact angle"].get_ydata()[0] == pytest.approx(
        np.degrees(float(solution.scene.bearing.free_contact_angle))
    )


@pytest.mark.parametrize("name", SCENES)
def test_lost_contacts_are_marked(name: str) -> None:
    solution = SOLUTIONS[name]
    lost_both = ((solution.inner.load == 0) & (solution.outer.load == 0)).sum()
    lost_inner = ((solution.inner.load == 0) & (solution.outer.load > 0)).sum()
    for picture in (pictures.load_distribution, pictures.contact_angles):
        marks = {line.get_label(): len(line.get_xdata()) for line in picture(solution).axes[0].get_lines()}
        assert marks.get("no load on either raceway", 0) == lost_both
        assert marks.get("inner contact lost", 0) == lost_inner
    assert {"at rest, balls unloaded": lost_both, "combined, inner contacts lost": lost_inner}.get(name, 1) > 0


@pytest.mark.parametrize("name", SCENES)
def test_ellipses_have_their_true_size_and_do_not_touch(name: str) -> None:
    solution = SOLUTIONS[name]
    (axes,) = pictures.contact_ellipses(solution).axes
    assert axes.get_aspect() == 1.0, "to scale"
    ellipses = {
        (round(patch.center[0], 9), patch.center[1] > 0): (patch.width, patch.height)
        for patch in axes.patches
        if isinstance(patch, Ellipse)
    }
    for side, contacts in ((True, solution.inner), (False, solution.outer)):
        drawn = sorted(size for (_, inner), size in ellipses.items() if inner == side)
        true = np.column_stack([contacts.semi_minor_axis, contacts.semi_major_axis])[contacts.load > 0] * 2e3
        for size in drawn:
            assert np.isclose(true, size, rtol=1e-9).all(axis=1).any()
        places = sorted(x for (x, inner) in ellipses if inner == side)
        widest = max(width for width, _ in drawn)
        assert all(right - left > widest for left, right in pairwise(places))
    if name == "thrust":
        assert len(ellipses) == 2
    elif name != "sixty balls":
        assert len(ellipses) == (solution.inner.load > 0).sum() + (solution.outer.load > 0).sum()


def test_a_large_bearing_says_that_it_shows_some_of_its_balls() -> None:
    (axes,) = pictures.contact_ellipses(SOLUTIONS["sixty balls"]).axes
    assert "every third ball" in axes.get_xlabel()


@pytest.mark.parametrize("name", SCENES)
def test_pressures_do_not_run_into_each_other(name: str) -> None:
    figure = pictures.contact_ellipses(SOLUTIONS[name])
    figure.savefig(BytesIO(), dpi=60)
    (axes,) = figure.axes
    boxes = [text.get_window_extent() for text in axes.texts] + [
        label.get_window_extent() for label in axes.get_xticklabels()
    ]
    for i, box in enumerate(boxes):
        assert not any(box.overlaps(other) for other in boxes[:i]), axes.get_title()


@pytest.mark.parametrize("name", SCENES)
def test_the_section_shows_the_most_loaded_ball_to_scale(name: str) -> None:
    """Lines of action from the groove centres, where the model has them, to the contacts, as long as these are."""
    solution = SOLUTIONS[name]
    (axes,) = pictures.section(solution).axes
    ball = int(np.nanargmax(np.fmax(solution.inner.load, solution.outer.load)))
    lines = {line.get_color(): line for line in axes.lines if line.get_linewidth() == 1.6}
    patches = {line.get_color(): line for line in axes.lines if line.get_linewidth() == 4.5}
    for side, up, contacts in (("inner", -1.0, solution.inner), ("outer", 1.0, solution.outer)):
        radius = float(getattr(solution.scene.bearing, f"{side}_groove_radius")) / qs.mm
        colour = pictures.style.STYLE[side]["color"]
        if contacts.load[ball] == 0.0:
            assert colour not in patches
            continue
        centre, contact = np.transpose(lines[colour].get_data())
        along = up * (contact - centre)
        assert np.degrees(np.arctan2(*along)) == pytest.approx(contacts.angle[ball] / qs.deg, abs=1e-9)
        assert np.hypot(*along) == pytest.approx(radius, rel=1e-12)
        # The ball, whose centre is the origin, reaches into the raceway by the approach.
        assert 0.5 * solution.scene.bearing.ball_diameter / qs.mm - np.hypot(*contact) == pytest.approx(
            contacts.approach[ball] / qs.mm, abs=1e-9
        )
        x, y = patches[colour].get_data()
        assert np.hypot(np.diff(x), np.diff(y)).sum() == pytest.approx(
            2.0 * contacts.semi_major_axis[ball] / qs.mm, rel=1e-3
        )


def axes_of(solution: qs.Solution) -> Any:
    (axes,) = pictures.section(solution).axes
    return axes


def test_the_section_of_an_unloaded_ball_says_so_and_a_given_seat_is_drawn() -> None:
    solution = SOLUTIONS["at rest, balls unloaded"]
    ball = int(np.argmin(solution.inner.load))
    texts = [text.get_text() for text in pictures.section(solution, ball=ball).axes[0].texts]
    assert "inner contact:\nno load" in texts
    colours = {line.get_color() for line in pictures.section(solution, ball=ball).axes[0].get_lines()}
    assert not colours & {style["color"] for style in STYLE.values()}, "no line of action where nothing acts"
    seats = []
    for outside in (200.0, 210.0):
        rings = qs.RingExpansion(90 * qs.mm, outside * qs.mm)
        grown = qs.solve(dataclasses.replace(solution.scene, ring_effects=(rings,)))
        _, _, outer = pictures.section(grown).axes[0].patches
        seats.append(outer.get_xy()[:, 1].max())
        assert axes_of(grown).get_ylim()[1] > seats[-1], "all of the ring is seen"
    assert seats[1] - seats[0] == pytest.approx(5.0, abs=1e-9)


def test_a_ball_at_zero_is_marked_at_both_ends_of_its_line() -> None:
    (axes,) = pictures.contact_angles(SOLUTIONS["combined, inner contacts lost"]).axes
    lines = {line.get_label(): line for line in axes.get_lines()}
    x = lines["outer raceway"].get_xdata()
    np.testing.assert_allclose(x[lines["outer raceway"].get_markevery()], np.arange(0.0, 361.0, 22.5))


def test_a_colour_and_line_means_one_thing() -> None:
    raceways = {(style["color"], style["linestyle"]) for style in STYLE.values()}
    channels = {(style["color"], style["linestyle"]) for name, style in CHANNEL_LINES.items() if name}
    assert len(channels | raceways | set(ROW_LINES)) == len(channels) + len(raceways) + len(ROW_LINES)
    assert not {colour for colour, _ in ROW_LINES} & {colour for colour, _ in raceways}


def test_a_legend_stays_within_a_narrow_sheet() -> None:
    figure = figure_of_size(4.0, 3.0)
    axes = figure.subplots()
    for label in ("free contact angle", "inner raceway", "outer raceway", "no load on either raceway"):
        axes.plot([0.0, 1.0], label=label)
    legend(figure, axes)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    box = figure.legends[0].get_window_extent(canvas.get_renderer())
    assert 0.0 <= box.x0 < box.x1 <= figure.bbox.width


def test_a_legend_within_axes_covers_no_curve() -> None:
    figure = figure_of_size(4.0, 2.5)
    axes = figure.subplots()
    for level in (0.0, 0.95, 1.0):
        axes.plot([0.0, 1.0], [level, 1.0], label=f"from {level}")
    legend_within(axes)
    FigureCanvasAgg(figure).draw()
    drawn = axes.get_legend()
    assert drawn is not None
    assert drawn.get_window_extent().y0 > axes.transData.transform((0.0, 1.0))[1]


def test_one_case_of_many() -> None:
    operation = qs.Operation(axial_load=np.array([1000.0, 9000.0]))
    many = qs.solve(qs.Scene(b218(), operation))
    (axes,) = pictures.load_distribution(many, 1).axes
    lines = {line.get_label(): line for line in axes.get_lines()}
    np.testing.assert_allclose(lines["inner raceway"].get_ydata()[:-1], many.inner.load[1])
    pictures.overview(many, 1).savefig(BytesIO(), dpi=40)


def test_which_case_of_many_must_be_said() -> None:
    many = qs.solve(qs.Scene(b218(), qs.Operation(axial_load=np.array([1000.0, 9000.0]))))
    with pytest.raises(ValueError, match="give index"):
        pictures.overview(many)


def test_the_title_says_what_was_solved() -> None:
    title = pictures.overview(SOLUTIONS["combined, inner contacts lost"]).get_suptitle()
    assert title == "B218, 10000 rpm, axial 3000 N, radial y 4000 N, tilt z 0 mrad", "imposed, not the reaction"


def test_a_title_of_two_lines_does_not_part_a_number_from_its_unit() -> None:
    title = pictures.load_distribution(SOLUTIONS["combined, inner contacts lost"]).get_suptitle()
    assert title == "B218, 10000 rpm, axial 3000 N, radial y 4000 N,\ntilt z 0 mrad"


def test_a_set_has_a_panel_for_each_row_to_one_scale() -> None:
    """Its own loads and angles in each, whose rows are named; a case of several is drawn as if alone."""
    bearing = qs.load_scene("7210c").bearing
    hybrid = dataclasses.replace(bearing, ball_material=qs.SILICON_NITRIDE, name="hybrid")
    rows = qs.Row(bearing, 0.0), qs.Row(hybrid, 0.02, "-x"), qs.Row(bearing, 0.04), qs.Row(bearing, 0.06, "-x")  # type: ignore[arg-type]
    operation = qs.Operation(10_000 * qs.rpm, axial_load=np.array([0.0, 900.0]), radial_load_y=500.0, moment_z=0.0)
    for count in (1, 3, 4):
        of = qs.BearingSet(rows[:count], operation, qs.Preload(rigid=400.0) if count > 1 else None, **EFFECTS)
        solution = qs.solve_set(of)
        assert solution.converged[1]
        drawings = {
            pictures.load_distribution: lambda contacts: contacts.load[1],
            pictures.contact_angles: lambda contacts: np.degrees(contacts.angle[1]),
        }
        for draw, value in drawings.items():
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                figure = draw(solution, 1)
                figure.savefig(BytesIO(), dpi=40)
            assert len(figure.axes) == count
            assert len({axes.get_ylim() for axes in figure.axes}) == 1
            for number, (axes, row) in enumerate(zip(figure.axes, solution.rows, strict=True), 1):
                name = of.rows[number - 1].bearing.name
                is_flat = draw is pictures.contact_angles and count > 3
                assert axes.get_title().startswith(f"Row {number}, " if is_flat else f"Row {number} ({name}, carries")
                lines = {line.get_label(): line for line in axes.get_lines()}
                for side in ("inner", "outer"):
                    drawn = np.unique(np.round(lines[f"{side} raceway"].get_ydata(), 9))
                    np.testing.assert_allclose(drawn, np.unique(np.round(value(getattr(row, side)), 9)))
        assert len(pictures.overview(solution, 1).axes) == 2 * count
    with pytest.raises(ValueError, match="names none of its cases"):
        pictures.overview(solution)
    six = qs.solve_set(
        qs.BearingSet(tuple(qs.Row(bearing, 0.02 * n) for n in range(6)), qs.Operation(axial_load=900.0))
    )  # type: ignore[arg-type]
    places = [tuple(np.round(axes.get_subplotspec().get_geometry()[2:3])) for axes in pictures.overview(six).axes]
    assert len(set(places)) == 12  # no panel on another


def test_no_label_of_a_circle_touches_a_mark(tmp_path: Path) -> None:
    """In the small panels of a set letters are a larger part of the picture."""
    gallery = (Path(qs.__file__).parent / "guide" / "gallery.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"```toml\n(# bent\.toml\n.*?)```", gallery, flags=re.DOTALL)
    (tmp_path / "bent.toml").write_text(text)
    solution = qs.solve_set(qs.load_set(tmp_path / "bent.toml"))
    for figure in (pictures.overview(solution), pictures.load_distribution(solution)):
        figure.canvas.draw()
        polar = [each for each in figure.axes if each.name == "polar"]
        assert polar[0].texts, "the scale can be read"
        for axes in polar:
            marks = np.vstack([axes.transData.transform(line.get_xydata()) for line in axes.lines])
            for label in axes.texts:
                box = label.get_window_extent()
                away = np.abs(marks - [0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)])
                clear = away - [0.5 * box.width, 0.5 * box.height]
                assert clear.max(axis=1).min() > 3.5 * figure.dpi / 72.0, label.get_text()


def test_a_spindle_s_sheet_begins_with_its_shaft_and_fits_a_screen() -> None:
    (text, *_) = (block.text for block in blocks(GUIDE / "spindle.md") if block.language == "toml")
    figure = pictures.overview(qs.solve_set(set_of(tomllib.loads(text), "spindle.toml")))
    figure.canvas.draw()
    assert figure.get_size_inches()[1] * figure.dpi <= 1400
    by_height = sorted(figure.axes, key=lambda axes: -axes.get_position().y1)
    assert [axes.get_title().split()[0] for axes in by_height] == ["Plane"] * 2 + ["Row"] * 8
    assert len({axes.get_title().partition(":")[2] for axes in by_height[:2]}) == 1, "one magnification of a figure"
    for axes in by_height[:2]:
        for words in axes.texts:
            assert axes.bbox.y0 <= words.get_window_extent().y0 and words.get_window_extent().y1 <= axes.bbox.y1


@pytest.mark.parametrize("largest", [0.0, 1.0, 11.9, 406.0, 2.2e3, 7.1e-3, 9.99e4])
def test_the_circle_of_a_polar_picture_is_a_round_number_just_beyond_its_curves(largest: float) -> None:
    circle = circle_beyond(largest)
    assert largest < circle and (circle <= 1.4 * largest or largest == 0.0)
    assert float(f"{circle:.2g}") == circle


def test_one_circle_is_labelled_on_a_sheet_of_one_scale() -> None:
    """All rows to one scale, whose value stands once."""
    rows = (qs.Row(b218(), 0.0, "+x"), qs.Row(b218(), 60 * qs.mm, "-x"))
    solution = qs.solve_set(qs.BearingSet(rows, COMBINED, preload=qs.Preload(rigid=1500.0)))
    for draw in (pictures.load_distribution, pictures.under_load):
        figure = draw(solution)
        polar = [axes for axes in figure.axes if axes.name == "polar"]
        assert len(polar) == 2 and len({axes.get_ylim() for axes in polar}) == 1
        (label,) = (text.get_text() for axes in polar for text in axes.texts)
        assert label == f"{polar[0].get_ylim()[1]:g} N"


def test_logarithmic_axes_show_numbers_not_powers() -> None:
    """As those of time and of life."""
    axes = figure_of_size(4.0, 3.0).subplots()
    axes.plot([0.5, 7200.0], [1.0, 2.0])
    logarithmic(axes.xaxis)
    axes.figure.canvas.draw()
    shown = {label.get_text() for label in axes.get_xticklabels() + axes.get_xticklabels(minor=True)}
    assert {"1", "10", "100", "1,000"} <= shown and not any("^" in each for each in shown)


# Axes -----------------------------------------------------------------------------------------------------------------

LIFE_OVER = {"short": (3000.0, 3300.0), "long": (3000.0, 60_000.0)}
"""Axial loads [N] over which the life of B218 changes by less and by more than ten times."""
WITH_LIFE = input_tables(qs.load_scene("b218")) | {"readings": {"life": {}}}


def drawn_by_find(low: float, high: float) -> Any:
    limits = ["life_duration>=1"]
    return found_picture(
        qs.find(WITH_LIFE, {"axial_load_N": (low, high)}, limits=limits, maximise="life_duration", points=64)
    )


def drawn_by_sweep(low: float, high: float) -> Any:
    return qs.Study.of(WITH_LIFE, {"axial_load_N": f"{low:g}:{high:g}:9"}).plot(y=["life_duration"])


@pytest.mark.parametrize("drawn", [drawn_by_find, drawn_by_sweep])
@pytest.mark.parametrize("which", LIFE_OVER)
def test_axes_of_lives_are_logarithmic_where_these_differ_ten_times(drawn: Any, which: str) -> None:
    """One rule for every picture; other results are drawn as they are."""
    scales = {
        axes.get_ylabel() + axes.get_title(loc="left"): axes.get_yscale() for axes in drawn(*LIFE_OVER[which]).axes
    }
    assert {"log" if which == "long" else "linear"} == {scale for name, scale in scales.items() if "life" in name}


@pytest.mark.parametrize("unit", ["h", "Mrev", "N"])
def test_the_scale_of_an_axis_follows_what_is_drawn(unit: str) -> None:
    for values in ([1.0, 9.9], [1.0, 10.1], [np.nan, 1.0, 11.0], [np.nan], [0.0, 20.0], [-1.0, 30.0]):
        axes = figure_of_size(2.0, 2.0).subplots()
        is_log = unit != "N" and values in ([1.0, 10.1], [np.nan, 1.0, 11.0])
        assert of_results(axes.yaxis, unit, values) == is_log == (axes.get_yscale() == "log")
