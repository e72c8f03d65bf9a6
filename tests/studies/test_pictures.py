"""Pictures of studies: what suits the results is drawn, nothing is clipped, and what cannot be drawn is said."""

from __future__ import annotations

import dataclasses
import tomllib
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.scene_file import document_of, scene_of
from qsbearing.pictures.study import PictureError, PictureKind, picture, select
from qsbearing.pictures.study.contours import contour_lines
from qsbearing.pictures.study.labels import Label, head, label_curves, label_of, place_named, title_panel
from qsbearing.pictures.study.maps import extended_below_zero
from qsbearing.pictures.study.spread import rank_correlation
from qsbearing.pictures.style import CHANNEL_LINES, STYLE, figure_of_size, logarithmic_levels
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep
from tests.guide.pages import GUIDE, blocks

pytest.importorskip("xarray")
QuadContourSet = pytest.importorskip("matplotlib.contour").QuadContourSet
from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: E402 - only where matplotlib is there

VARIED = {
    "speed": {"speed_rpm": "0:12000:9", "axial_load_N": [2000, 17800]},
    "balls": {"ball_count": "14:20:7"},
    "radial": {"radial_load_y_N": "0:8000:5", "tilt_z_mrad": 0},
    "map": {"speed_rpm": "0:12000:10", "axial_load_N": "1000:9000:9"},
    "random": {"ball_diameter_mm": "normal(22.225,0.002)", "pitch_diameter_mm": "normal(125.26,0.02)"},
    "curve": {"speed_rpm": "0:12000:9", "ball_diameter_mm": "normal(22.225,0.01)"},
}


@pytest.fixture(scope="module")
def results() -> dict[str, object]:
    return {name: sweep(Study.of("b218", vary, samples=64)) for name, vary in VARIED.items()}


KINDS = {
    "speed": "lines",
    "balls": "lines",
    "radial": "lines",
    "map": "map",
    "random": "distribution",
    "curve": "lines",
}


@pytest.mark.parametrize(("name", "kind"), [*KINDS.items(), ("radial", "rose"), ("random", "sensitivity")])
def test_nothing_is_clipped(results: dict, name: str, kind: str) -> None:
    assert select(results[name]).kind == KINDS[name]
    figure = picture(results[name], kind=kind)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    box = figure.get_tightbbox(canvas.get_renderer())
    width, height = figure.get_size_inches()
    assert box.x0 > -0.01, "left"
    assert box.y0 > -0.01, "below"
    assert box.x1 < width + 0.01, "right"
    assert box.y1 < height + 0.01, "above"


def test_curves_are_the_results(results: dict) -> None:
    figure = picture(results["speed"], y=["outer_load"])
    (axes,) = figure.axes
    found = results["speed"]["outer_load"].isel(ball=0)
    for number, line in enumerate(axes.lines[:2]):
        np.testing.assert_array_equal(line.get_xdata(), found["speed_rpm"])
        np.testing.assert_array_equal(line.get_ydata(), found[:, number])
    labels = {text.get_text() for text in axes.texts}
    assert labels == {"2000 N", "17800 N"}
    assert axes.get_title(loc="left").endswith(", N")
    assert "curves: axial load" in figure.get_suptitle()


def test_a_band_spans_all_balls_and_the_line_is_the_most_loaded(results: dict) -> None:
    (axes,) = picture(results["radial"], y=["inner_load"]).axes
    load = results["radial"]["inner_load"]
    np.testing.assert_allclose(axes.lines[0].get_ydata(), load.max("ball"))
    (band,) = axes.collections
    heights = band.get_paths()[0].vertices[:, 1]
    assert heights.min() == pytest.approx(float(load.min()))


FIELDS = {
    "saddle": lambda x, y: (x - 0.4) * (y - 0.6),
    "hill": lambda x, y: np.exp(-8 * ((x - 0.1) ** 2 + (y - 0.9) ** 2)),
    "valley": lambda x, y: np.hypot(3 * (x - y), 0.3 * y),
    "corner": lambda x, y: (x + 0.02) / (y + 0.05),
}


@pytest.mark.parametrize("name", FIELDS)
@pytest.mark.parametrize("said", ["%.4g", "a long label"])
def test_labels_of_contours_stay_within_the_panel_and_apart(name: str, said: str) -> None:
    figure = figure_of_size(4.2, 3.5)
    axes = figure.subplots()
    x, y = np.linspace(0.0, 15000.0, 61), np.linspace(0.0, 8.0, 41)
    z = FIELDS[name](*np.meshgrid(x / 15000.0, y / 8.0))
    levels = np.quantile(z, np.linspace(0.05, 0.95, 12))
    contour_lines(axes, x, y, z, levels, said if "%" in said else dict.fromkeys(levels, said))
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    frame = axes.get_window_extent()
    boxes = [text.get_window_extent(canvas.get_renderer()) for text in axes.texts]
    assert len(boxes) >= 3
    for box in boxes:
        assert frame.x0 <= box.x0 < box.x1 <= frame.x1
        assert frame.y0 <= box.y0 < box.y1 <= frame.y1
    middles = np.array([(box.x0 + box.x1, box.y0 + box.y1) for box in boxes]) / 2.0
    gaps = np.hypot(*(middles[:, None] - middles[None, :]).T) + 1e9 * np.eye(len(boxes))
    assert gaps.min() > 0.1 * frame.height


def test_the_onset_of_slip_is_drawn_where_it_is(results: dict) -> None:
    (axes,) = picture(results["map"], y=["outer_required_friction"]).axes
    assert any(text.get_text() == "0.06: slip begins" for text in axes.texts)
    lines = axes.collections[1]
    assert isinstance(lines, QuadContourSet)
    widths = dict(zip(lines.levels, lines.get_linewidth(), strict=True))
    assert [level for level, width in widths.items() if width == max(widths.values())] == [0.06]
    speed, load = np.concatenate(lines.allsegs[list(lines.levels).index(0.06)]).T
    for at in (0, speed.size // 2):
        scene = dataclasses.replace(
            qs.load_scene("b218"), operation=qs.Operation(speed=speed[at] * qs.rpm, axial_load=load[at])
        )
        # Between the points of a coarse grid: a fortieth is what straight lines between them are off.
        assert qs.solve(scene).outer.required_friction[0] == pytest.approx(0.06, rel=1 / 40)


def test_a_line_is_drawn_where_the_first_ball_unloads() -> None:
    vary = {"speed_rpm": "2000:12000:9", "radial_load_y_N": "0:16000:33"}
    document = document_of("b218")[0]
    document["operation"] = {"axial_load_N": 8000.0, "tilt_z_mrad": 0, "tilt_y_mrad": 0}
    found = sweep(Study.of(document, vary))
    (axes,) = picture(found, x="speed_rpm", y=["balls_off_inner"]).axes
    assert any(text.get_text() == "first ball unloads" for text in axes.texts)
    (line,) = (each for each in axes.collections if isinstance(each, QuadContourSet))
    speed, load = np.concatenate(line.allsegs[0]).T
    order = np.argsort(speed)
    for given in (3000.0, 9500.0):  # between the points of the grid
        radial = np.linspace(0.9, 1.1, 401) * np.interp(given, speed[order], load[order])
        document["operation"] |= {"speed_rpm": given, "radial_load_y_N": 0.0}
        scene = scene_of(document, "")
        many = dataclasses.replace(scene, operation=dataclasses.replace(scene.operation, radial_load_y=radial))
        first = radial[np.argmax((qs.solve(many).inner.load == 0.0).any(axis=-1))]
        assert np.interp(given, speed[order], load[order]) == pytest.approx(first, rel=0.01)


def test_numbers_that_end_at_zero_are_continued_straight() -> None:
    x, y = np.meshgrid(np.arange(12.0), np.arange(9.0))
    plane = 7.35 - 0.9 * x - 0.4 * y
    found = extended_below_zero(np.maximum(plane, 0.0))
    np.testing.assert_array_equal(found[plane > 0.0], plane[plane > 0.0])
    assert (found[plane <= 0.0] < 0.0).all()
    beside = (plane <= 0.0) & (np.roll(plane, 1, 1) > 0.0) & (x >= 2)
    np.testing.assert_allclose(found[beside], plane[beside], atol=1e-12)


def test_where_nothing_is_solved_the_reason_stands(results: dict) -> None:
    (axes,) = picture(results["balls"], y=["inner_load"]).axes
    assert any("do not fit" in text.get_text() for text in axes.texts)


@pytest.mark.parametrize(
    ("name", "chosen", "said"),
    [
        ("speed", {"x": "speed"}, "Did you mean speed_rpm"),
        ("speed", {"y": ["inner_lod"]}, "Did you mean inner_load"),
        ("speed", {"kind": "pie"}, "not a kind of picture"),
        ("speed", {"kind": "distribution"}, "vary at random"),
        ("balls", {"kind": "map"}, "two axes"),
        ("random", {"kind": "lines"}, "need an axis"),
        ("speed", {"at": {"axial_load_N": 3000}}, "not among its values"),
        ("radial", {"kind": "azimuth", "y": ["inner_load", "ring_displacement_axial"]}, "not ring_displacement_axial"),
    ],
)
def test_what_cannot_be_drawn_is_said(results: dict, name: str, chosen: dict, said: str) -> None:
    with pytest.raises(PictureError, match=said):
        picture(results[name], **chosen)


def test_axes_are_chosen() -> None:
    study = Study.of("b218", {"speed_rpm": "0:1:3", "axial_load_N": [1, 2, 3, 4], "ball_count": [9, 10]})
    chosen = select(sweep(study, None), at={"axial_load_N": 2})
    assert (chosen.x, chosen.other, chosen.fixed) == ("speed_rpm", "ball_count", {"axial_load_N": 2.0})
    chosen = select(sweep(study, None), x="ball_count", kind=PictureKind.MAP)
    assert (chosen.x, chosen.other, chosen.fixed) == ("ball_count", "axial_load_N", {"speed_rpm": 0.0})


def test_rank_correlation_knows_only_the_order() -> None:
    x = np.random.default_rng(0).normal(size=50)
    assert rank_correlation(x, np.exp(3.0 * x)) == pytest.approx(1.0)
    assert rank_correlation(x, -(x**3)) == pytest.approx(-1.0)
    assert np.isnan(rank_correlation(x, np.ones(50)))


def test_one_command_draws_a_bearing_against_speed(tmp_path: Path, drawn: None) -> None:
    arguments = [
        "sweep",
        "b218",
        "--vary",
        "speed_rpm=0:9000:4",
        "--out",
        tmp_path / "r.nc",
        "--plot",
        tmp_path / "a.png",
    ]
    runner = CliRunner()
    assert runner.invoke(cli, arguments).exit_code == 0
    assert runner.invoke(cli, ["plot", str(tmp_path / "r.nc")]).exit_code == 0
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "r.png").read_bytes()
    for wrong, said in (
        (["r.nc", "--out", "r.txt"], "end in"),
        (["none.nc"], "no such file"),
        (["r.nc", "-x", "y"], "axis"),
    ):
        done = runner.invoke(cli, ["plot", str(tmp_path / wrong[0]), *wrong[1:]])
        assert done.exit_code == 2
        assert said in done.stderr
    assert qs.open_results(tmp_path / "r.nc").close() is None


def test_labels_of_curves_do_not_cover_each_other_or_other_curves() -> None:
    """Steep curves close to each other: a label beside the next curve would say of neither which it is."""
    figure = figure_of_size(3.7, 3.3)
    axes = figure.subplots()
    x = np.linspace(0.51, 0.54, 31)
    labels = []
    for number, size in enumerate((1.0, 0.8, 0.6)):
        y = size * (0.51 / x) ** 30
        axes.plot(x, y)
        labels.append((x, y, f"{5000 * (number + 1)} rpm", "0.1"))
    label_curves(axes, labels)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    assert [text.get_text() for text in axes.texts] == ["5000 rpm", "10000 rpm", "15000 rpm"]
    boxes = [text.get_window_extent(canvas.get_renderer()) for text in axes.texts]
    for number, box in enumerate(boxes):
        assert not any(box.overlaps(other) for other in boxes[number + 1 :])
        middle = np.array([box.x0 + box.x1, box.y0 + box.y1]) / 2.0
        away = [np.hypot(*(axes.transData.transform(each.get_xydata()) - middle).T).min() for each in axes.lines]
        assert int(np.argmin(away)) == number, "each is nearest to its own curve"


def test_a_label_leaves_the_beginning_of_its_curve_free() -> None:
    """The stiffness for the middle load is flat only near the axis."""
    study = qs.Study.of("b218", {"speed_rpm": "0:15000:61", "axial_load_N": "2000,8000,20000"})
    figure = study.plot()
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    for axes in figure.axes:
        left = axes.get_window_extent(canvas.get_renderer()).x0
        assert axes.texts
        assert min(text.get_window_extent(canvas.get_renderer()).x0 for text in axes.texts) > left + 10.0


@pytest.mark.parametrize("count", [9, 61])
def test_a_label_hides_neither_a_marked_point_nor_the_minimum(count: int) -> None:
    figure = figure_of_size(3.7, 3.3)
    axes = figure.subplots()
    x = np.linspace(0.0, 15000.0, count)
    y = (x / 15000.0 - 0.5) ** 2  # the free middle, which a label would like best, is the minimum
    (line,) = axes.plot(x, y)
    label_curves(axes, [(x, y, "10000 rpm", "0.1")])
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    (box,) = (text.get_window_extent(canvas.get_renderer()) for text in axes.texts)
    shown = axes.transData.transform(line.get_xydata())[:: 1 if count == 9 else count // 2]
    assert not any(box.contains(*point) for point in shown)


def test_a_result_that_is_zero_but_for_rounding_is_drawn_as_zero(results: dict) -> None:
    angle = results["radial"]["inner_angle"]
    found = results["radial"].assign(inner_angle=1e-14 * angle)
    assert "inner_angle" not in [name for panel in select(found).panels for name in panel]
    (axes,) = picture(found, y=["inner_angle"]).axes
    assert axes.get_ylim() == (-1.0, 1.0)


def test_labels_by_azimuth_cover_no_point(results: dict) -> None:
    figure = picture(results["radial"], kind="azimuth", y=["inner_angle", "outer_angle"])
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    (axes,) = figure.axes
    assert len(axes.texts) == 2 * results["radial"].sizes["radial_load_y_N"], "each curve has its label"
    assert all(text.xyann[0] > 1.0 for text in axes.texts), "right of the panel, where no point is"
    heights = sorted(text.xyann[1] for text in axes.texts)
    assert min(np.diff(heights)) > 0.04, "each on a line of its own"


def test_a_rose_says_what_it_shows_and_in_which_unit(results: dict) -> None:
    figure = picture(results["radial"], kind="rose")
    assert figure.get_supylabel() == "contact load, N"
    assert [axes.get_title() for axes in figure.axes][1] == "radial load y 2000 N"


def test_a_preload_is_named_in_the_title() -> None:
    study = Study.of("b218", {"preload.rigid_N": [500, 1000], "speed_rpm": "0:8000:3"})
    assert picture(sweep(study)).get_suptitle().endswith("curves: rigid preload")


def test_lives_of_raceways_share_a_panel_and_lives_have_axes_of_powers_of_ten() -> None:
    results = sweep(Study.of("b218", {"axial_load_N": "2000:20000:3"}, quantities=["inner_load_max"]))
    load = results["axial_load_N"].values
    of = {"inner_life": 1e13 / load**3, "outer_life": 2e13 / load**3, "duration": 1e9 / load**2}
    lives = {f"life_{name}": ("axial_load_N", values, {"units": "h"}) for name, values in of.items()}
    axes = picture(results.assign(lives), y=list(lives)).axes
    assert [each.get_yscale() for each in axes] == ["log", "log"]
    assert [line.get_color() for line in axes[0].lines] == [STYLE[side]["color"] for side in ("inner", "outer")]


def test_contours_of_lives_that_span_decades_are_evenly_spread_over_powers_of_ten() -> None:
    results = sweep(Study.of("b218", {"axial_load_N": "1000:40000:9", "speed_rpm": "1000:9000:9"}))
    load = results["axial_load_N"].values[:, None] * np.ones(9)
    lives = results.assign(life_duration=(("axial_load_N", "speed_rpm"), 1e17 / load**3, {"units": "h"}))
    (axes,) = picture(lives, kind="map", y=["life_duration"]).axes
    _, lines = (each for each in axes.collections if isinstance(each, QuadContourSet))
    steps = np.diff(np.log10(lines.levels))
    assert 4 <= len(steps) <= 8 and steps.max() < 2.0 * steps.min()
    assert all(f"{level:.3e}".startswith(("1.000", "2.000", "3.000", "5.000")) for level in lines.levels)
    narrow = results.assign(life_duration=(("axial_load_N", "speed_rpm"), 1e4 + 1.01 * load, {"units": "h"}))
    (axes,) = picture(narrow, kind="map", y=["life_duration"]).axes
    *_, lines = (each for each in axes.collections if isinstance(each, QuadContourSet))
    steps = np.diff(lines.levels)
    assert np.allclose(steps, steps[0]), "within a decade as others"


@pytest.mark.parametrize(("low", "high"), [(1e3, 2e4), (7.0, 3e9), (1e-3, 1e40), (2.0, 50.0)])
def test_levels_of_powers_of_ten_enclose_all_values(low: float, high: float) -> None:
    levels = logarithmic_levels(low, high, 9)
    assert levels[0] <= low and 3 <= len(levels) <= 11
    assert levels[-1] >= high or levels[-1] * (levels[-1] / levels[-2]) > high


def test_a_dataset_says_what_pictures_tell_results_by() -> None:
    swept = sweep(Study.of(document_of("b218")[0], {"speed_rpm": [0, 3000]}))
    about = {name: swept[name].attrs for name in ("outer_load", "ring_displacement_radial_y", "balls_off_inner")}
    assert about["outer_load"] | {"label": "contact load", "raceway": "outer"} == about["outer_load"]
    channel = {"label": "displacement", "direction": "radial y"}
    assert about["ring_displacement_radial_y"] | channel == about["ring_displacement_radial_y"]
    told = {"row", "raceway", "direction", "over"}
    assert told & {*about["balls_off_inner"]} == set()
    place = place_named("row_2_outer_load_max")
    assert place is not None
    assert {name: place.attributes[name] for name in told & {*place.attributes}} == {
        "row": 2, "raceway": "outer", "over": "max",
    }  # fmt: skip


def test_a_picture_reads_what_the_dataset_says_and_names_only_where_it_says_nothing() -> None:
    place = place_named("row_2_outer_load_max")
    assert place is not None
    own = Label("outer contact load, maximum", "row 2", 2)
    assert label_of("x", place.attributes) == label_of("row_2_outer_load_max") == own
    assert label_of("row_2_outer_load_max", {"label": "mine", "direction": "tilt y"}) == Label("mine", "tilt y")
    assert label_of("a_name_of_mine") == Label("a name of mine")
    assert label_of("ring_load_moment_y").which in CHANNEL_LINES


def test_the_contacts_loads_and_the_ring_s_have_panels_of_their_own(results: dict) -> None:
    chosen = select(results["radial"], y=["inner_load", "ring_load_axial", "outer_load", "ring_load_radial_y"])
    assert chosen.panels == (("inner_load", "outer_load"), ("ring_load_axial", "ring_load_radial_y"))


def test_a_panel_s_title_does_not_reach_the_next_one() -> None:
    figure = figure_of_size(7.4, 3.0)
    for axes in figure.subplots(1, 2):
        title_panel(axes, "modified reference rating life of all rows of the set together, million revolutions", 3.7)
    FigureCanvasAgg(figure).draw()
    one, other = ([text for text in axes.get_children() if text.__class__.__name__ == "Text"] for axes in figure.axes)
    assert max(text.get_window_extent().x1 for text in one) < min(text.get_window_extent().x0 for text in other)


def test_a_long_title_has_more_lines() -> None:
    figure = figure_of_size(4.0, 3.0)
    figure.subplots()
    head(figure, "axial load 17800 N, " * 8)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    assert figure.get_tightbbox(canvas.get_renderer()).x1 <= 4.0
    assert figure.get_suptitle().count("\n") >= 2


@pytest.mark.parametrize(
    "vary", [{"axial_load_N": "1000:9000:4"}, VARIED["map"], {"ball_diameter_mm": "normal(22.225,0.002)"}]
)
def test_every_result_that_a_study_names_is_drawn(vary: dict[str, str]) -> None:
    """Zero everywhere or of another kind than most readers want."""
    named = [
        "inner_angle_max", "outer_load_max", "inner_max_pressure_max", "ring_displacement_axial",
        "ring_displacement_radial_y", "outer_semi_major_axis_max",
    ]  # fmt: skip
    results = sweep(Study.of("b218", vary, samples=64, quantities=named))
    shown = [name for panel in select(results).panels for name in panel]
    assert sorted(shown) == sorted(named)
    drawn = picture(results)
    FigureCanvasAgg(drawn).draw()
    assert len(drawn.axes) == len(select(results).panels)


def test_a_spindle_s_sweep_shows_its_tool_first() -> None:
    """Stiffness and deflection there before what the rows carry; of a set without points the rows."""
    texts = [each.text for each in blocks(GUIDE / "spindle.md") if each.language == "toml"]
    spindle = tomllib.loads(next(text for text in texts if text.startswith("# spindle.toml")))
    kept = select(sweep(Study.of(spindle, {"speed_rpm": "4000:8000:3"}))).panels
    assert [name.partition("_radial")[0] for name, *_ in kept[:2]] == ["tool_effective_stiffness", "tool_displacement"]
    assert kept[2][0] == "row_1_axial_load"
    without = {key: value for key, value in spindle["shaft"].items() if key != "points"}
    kept = select(sweep(Study.of(spindle | {"shaft": without}, {"speed_rpm": "4000:8000:3"}))).panels
    assert kept[0][0] == "row_1_axial_load"
