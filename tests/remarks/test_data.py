"""Remarks stay data until they are read: nothing takes their sentences apart, each code is documented and reached, and
every way to a solution shows the same list."""

from __future__ import annotations

import ast
import json
import pickle
import re
from collections.abc import Iterator
from dataclasses import replace
from html import unescape
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.app import answers
from qsbearing.app.inputs import ON_PAGE
from qsbearing.cli import cli
from qsbearing.documents.guide import topics
from qsbearing.documents.model import Callout, Section
from qsbearing.documents.numbers import with_minus
from qsbearing.files.file_keys import IN_FILE
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_or_set import load_scene_or_set
from qsbearing.files.scene_tables import input_tables
from qsbearing.inference import infer
from qsbearing.model.effects import EFFECTS
from qsbearing.remarks.kinds import Severity
from qsbearing.remarks.missing_effects import EFFECT_DATA_MISSING
from qsbearing.remarks.remark import Of, Remark
from qsbearing.remarks.wording import PYTHON, Audience
from qsbearing.reports import document, effects, set_document
from qsbearing.reports.effects import is_right
from qsbearing.reports.guide_lists import LISTS, every_kind
from qsbearing.results.remarks import every_remark, together
from qsbearing.studies import inferred
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.studies.chooser.explain import Assessment, explain
from qsbearing.studies.chooser.explain_set import explain_set
from qsbearing.studies.design import shown
from qsbearing.studies.design.compare import compare
from qsbearing.systems.sets import preload_limits
from tests.inference.test_infer_bearing import deep_groove
from tests.model.effects.test_elastic_rings_input import FREE_RINGS, in_housing
from tests.qsbearing.scenes import (
    B218,
    BOTH,
    DEEP_GROOVE,
    INNER,
    PER_BALL,
    QJ,
    SPINDLE,
    UPRIGHT,
    grown_scenes,
    lobes,
    resting,
    rubbing,
    turning,
)
from tests.qsbearing.source_text import trees
from tests.systems.sets.arrangements import PAIR_FILE, grooved_both_ways, pair, rows

PRODUCT = Path(qs.__file__).parent
CUTS = {
    "replace",
    "split",
    "rsplit",
    "splitlines",
    "sub",
    "subn",
    "match",
    "fullmatch",
    "search",
    "findall",
    "finditer",
}
"""What takes a text apart."""
TEXTS = {"remark", "remarks", "said", "sentence", "sentences", "warning", "warnings", "warned", "line", "text"}
"""What remarks in words are called where they are handled."""


# No sentence is taken apart -------------------------------------------------------------------------------------------


def handles_remarks(tree: ast.Module) -> bool:
    """Whether a module imports from where they are made or shown."""
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    named = {f"{node.module}.{each.name}" for node in imports for each in node.names}
    return any(name.startswith(("qsbearing.remarks.", "qsbearing.results.remarks.")) for name in named)


def cuts(tree: ast.AST) -> Iterator[str]:
    """Calls that take a text apart whose name says that it is a remark's."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in CUTS:
            of = [node.func.value, *node.args]
            names = {each.id for one in of for each in ast.walk(one) if isinstance(each, ast.Name)}
            names |= {each.attr for one in of for each in ast.walk(one) if isinstance(each, ast.Attribute)}
            if names & TEXTS:
                yield ast.unparse(node)


def test_no_module_takes_the_words_of_a_remark_apart() -> None:
    count = 0
    seen = dict(trees(r"qsbearing\.(results\.)?remarks", PRODUCT)) | dict(trees("", PRODUCT / "remarks"))
    for path, tree in seen.items():
        place = path.relative_to(PRODUCT)
        if place.parts[0] == "documents" or not (place.parts[0] == "remarks" or handles_remarks(tree)):
            continue
        count += 1
        assert not list(cuts(tree)), place
        if place.parts[0] == "remarks" or place.name == "remarks.py":
            modules = {each.name for node in ast.walk(tree) if isinstance(node, ast.Import) for each in node.names}
            assert "re" not in modules, place
    assert count > 40, "or the modules are not found"


@pytest.mark.parametrize("code", ["re.sub('a', '', said)", "each.text.split(':')", "warnings[0].replace('a', 'b')"])
def test_a_cut_is_seen(code: str) -> None:
    assert list(cuts(ast.parse(code)))


# Every code -----------------------------------------------------------------------------------------------------------


def test_the_guide_lists_every_code_with_its_values() -> None:
    page = topics(lists=LISTS)["remarks"].text
    for kind in every_kind().values():
        (line,) = (each for each in page.splitlines() if each.startswith(f"| `{kind.code}` |"))
        assert kind.severity.words in line and all(f"`{name}`" in line for name in kind.values)


def described() -> list[str]:
    """The codes of all kinds in the source, as often as they are described there."""
    calls = (each for _, tree in trees(r"\bKind\(", PRODUCT) for each in ast.walk(tree) if isinstance(each, ast.Call))
    kinds = (each for each in calls if isinstance(each.func, ast.Name) and each.func.id == "Kind")
    return [ast.literal_eval(each.args[0]) for each in kinds]


def test_every_kind_that_is_described_is_listed_once() -> None:
    assert sorted(described()) == list(every_kind()) and len(every_kind()) > 70


def of_solutions() -> Iterator[Any]:
    """Solved cases that reach the remarks of bearings and sets."""
    one = replace(B218, ball_count=1)
    held = qs.Operation(axial_displacement=2e-5, radial_displacement_y=0.0, tilt_y=0.0, tilt_z=0.0)
    moment, speeds = (qs.GyroscopicMoment(),), np.array([500.0, 1000.0, 3000.0, 6000.0])
    thrusts = np.array([2e3, 2e4])
    rings = qs.RingExpansion(90 * qs.mm, 160 * qs.mm, shaft_interference=20 * qs.um, yield_strength=600e6)
    heavy, fast = qs.Operation(axial_load=np.array([40e3, 600e3])), qs.Operation(speed=60e3 * qs.rpm, axial_load=5e3)
    tight = qs.BallBearing.from_diametral_clearance(
        diametral_clearance=-20 * qs.um, ball_count=9, ball_diameter=7.94 * qs.mm, pitch_diameter=39.04 * qs.mm,
        inner_groove_radius=0.52 * 7.94 * qs.mm, outer_groove_radius=0.52 * 7.94 * qs.mm, kind="deep_groove",
    )  # fmt: skip
    thin = replace(FREE_RINGS, outside_diameter=149 * qs.mm, outer_width=5 * qs.mm)
    pressed = qs.Operation(radial_load_y=1e3, axial_load=5e3, **UPRIGHT)
    yield from map(qs.solve, (
        qs.Scene(B218, qs.Operation()),
        qs.Scene(one, held),
        resting(B218, radial_load_y=4e3, tilt_z=0.0),
        resting(DEEP_GROOVE, axial_load=1e3, tilt_y=0.0, tilt_z=0.021),
        turning(2084, control=PER_BALL, axial_load=17.8e3),
        turning(8000, axial_load=2e3, radial_load_y=4e3, **UPRIGHT),
        turning(9000, effects=(qs.GyroscopicMoment(friction_coefficient=0.02),), axial_load=2e3),
        turning(speeds, effects=moment, control=INNER, axial_load=200.0),
        replace(turning(6000, axial_load=thrusts), raceway_control="friction", traction=qs.Traction(cage_drag=14.0)),
        qs.Scene(B218, heavy, ring_effects=(rings,)),
        qs.Scene(B218, fast, ring_effects=(rings,)),
        qs.Scene(B218, qs.Operation(), ring_effects=(rings,), preload=qs.Preload(rigid=300.0)),
        qs.Scene(B218, pressed, ring_effects=(thin,)),
        qs.Scene(B218, pressed, ring_effects=(qs.RingExpansion(90 * qs.mm, 160 * qs.mm, inner_ring_temperature=20.0),)),
        next(scene for name, scene in grown_scenes().items() if name.startswith("wedged")),
        replace(turning(3000, DEEP_GROOVE, axial_load=500.0), ring_effects=(lobes(),)),
        qs.Scene(tight, qs.Operation(axial_load=0.0), ring_effects=(qs.RingExpansion(25 * qs.mm, 52 * qs.mm),)),
    ))  # fmt: skip
    shallow = replace(QJ, inner_shim=1 * qs.um, outer_shim=1 * qs.um)
    yield qs.solve(rubbing(0.0, shallow, axial_load=5e3))
    yield from (in_housing(interference, radial_load_y=10e3) for interference in (-1 * qs.um, -18 * qs.um))
    yield from map(qs.solve_set, (pair("DB", 720.0, axial_load=1300.0), pair("DB", 720.0, axial_load=3000.0)))
    across = qs.Operation(radial_load_y=1000.0, moment_z=0.0)
    located = tuple(replace(row, carries="both") for row in rows("DB", grooved_both_ways(10 * qs.um), distance=0.2))  # type: ignore[arg-type]
    yield qs.solve_set(qs.BearingSet(located, across, shaft=qs.Shaft((qs.ShaftSection(0.4, 0.03),), -0.2)))
    yield qs.solve_set(qs.BearingSet(located))
    gear = qs.Gear(0.1, 0.0, 0.06, torque=9.0, drives=True)
    yield qs.solve_set(qs.BearingSet(rows("DB", B218, distance=0.2), shaft=qs.Shaft(gears=(gear,))))
    operation = qs.Operation(
        np.array([424.2060708578242, 424.0]) * qs.rpm, axial_load=np.array([1168.8530554521644, 9000.0]),
        radial_load_y=np.array([103.73081221234129, 0.0]), moment_z=0.0,
    )  # fmt: skip
    yield qs.solve_set(qs.BearingSet(rows("DT", B218), operation, ball_effects=BOTH, raceway_control=PER_BALL))


def of_readings() -> Iterator[Any]:
    """Readings that reach their remarks."""
    read = qs.readings
    loaded = qs.solve(resting(B218, axial_load=np.array([4e3, 9e5]), moment_y=100.0))
    yield from (read.life(loaded, rating="iso_281"), read.static_safety(loaded), read.stress(loaded))  # type: ignore[arg-type]
    yield read.overrun(loaded, outer_shoulder_diameter=141e-3)
    little = qs.solve(resting(B218, axial_load=60e3))
    yield read.overrun(little, inner_shoulder_diameter=113e-3)
    hybrid = qs.solve(turning(20e3, SPINDLE, axial_load=1e3))
    yield from (read.life(hybrid), read.static_safety(hybrid), read.stress(hybrid))
    yield read.friction(hybrid, friction_coefficient=1e-4)
    steep = qs.solve(
        resting(replace(B218, free_contact_angle=50 * qs.deg), axial_load=1e3, radial_load_y=2e3, **UPRIGHT)
    )
    yield from (read.life(steep), read.static_safety(steep))
    yield read.life(qs.solve(rubbing(1e4, axial_load=5e3)))
    yield read.life(qs.solve(resting(replace(B218, pitch_diameter=2.0), axial_load=1e3)), rating="iso_281")  # type: ignore[arg-type]
    slow = qs.solve(turning(np.full(3, 300.0), axial_load=np.array([5e3, 15e3, 60e3])))
    yield from (
        read.life(slow, viscosity_ratio=2.0, contamination_factor=0.35),
        read.kinematics(qs.solve(resting(B218, axial_load=1e3))),
    )
    for ratio in (0.05, 9.0):
        yield read.life(slow, viscosity_ratio=ratio, contamination_factor=0.9)
    fast = qs.solve(turning(np.array([100.0, 12e3]), axial_load=12e3))
    oil = read.Lubricant.from_grade(68).at(343.15)
    yield read.film(fast, oil, ball_roughness=0.1e-6, raceway_roughness=0.3e-6)
    yield read.film(fast, read.OilState(oil.dynamic_viscosity, 2e-8, oil.kinematic_viscosity))
    yield read.ball_advance(
        qs.solve(turning(9e3, axial_load=14e3, radial_load_y=6e3, tilt_z=0.0)), pocket_clearance=1e-5
    )
    for speed, load, factor in ((20e3, 2e3, 1e3), (9e3, 5e3, 1.0)):
        some = qs.solve(turning(speed, axial_load=load))
        for least in (1e-6, 1.0):
            oil_shares = {"drag_coefficient": 10.0, "least_oil_share": least, "most_oil_share": 1.0}
            yield read.ball_slip(some, 0.02, minimum_load_factor=factor, **oil_shares)  # type: ignore[arg-type]
    yield read.friction(some, float(1.5 * some.outer.required_friction.max()))  # type: ignore[union-attr]
    size = {"bore_diameter": 50e-3, "outside_diameter": 90e-3, "kinematic_viscosity": 20e-6}
    yield from (read.skf_torque(fast, **size), read.skf_torque(fast, **size, speed_rating=1e3 * qs.rpm))


def of_a_data_sheet() -> tuple[Any, ...]:
    """A list of ball sets by ratings that nobody explains, cut short."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(infer, "MOST_LISTED", 2)
        sheet = deep_groove(25, 52, 14000, 7850)
        one, other = qs.infer_bearing(**sheet), qs.infer_bearing(**sheet, maker="NSK")
        size = {key: each for key, each in sheet.items() if not key.endswith("_rating")}
        guessed = qs.infer_bearing(**size, rating_practice="proportions")
        spinning = qs.infer_bearing(**size, outer_ball_pass=3.578, inner_ball_pass=5.422, ball_spin=4.677)
    by_name = scene_of({"bearing": {"name": "SKF 6205"}, "operation": {"axial_load_N": 1.0}}, "", may_infer=True)
    angular = replace(other.bearing, kind="angular_contact", inferred=other)
    unsolved = inferred.said(qs.solve(resting(angular, axial_load=-10.0)))
    lists = (one, other, guessed, spinning, by_name.bearing.inferred)
    return (*(each for found in lists for each in found.remarks), *(each.said() for each in unsolved))


@pytest.fixture(scope="module")
def reached() -> dict[str, Remark]:
    """A remark of each code."""
    said = [each for solution in of_solutions() for each in qs.warnings(solution)]
    said += [each for reading in of_readings() for each in reading.warnings]
    other = {"bearing": {"name": "B218"}, "operation": {"axial_load_N": 1.0}}
    compared = [each.said() for each in compare(["b218", other]).remarks]
    return {each.remark.code: each.remark for each in (*said, *of_a_data_sheet(), *compared)}


def test_every_code_is_reached(reached: dict[str, Remark]) -> None:
    assert sorted(set(every_kind()) - set(reached)) == []


def test_remarks_have_the_values_that_the_guide_says_and_are_plain_data(reached: dict[str, Remark]) -> None:
    for code, said in reached.items():
        optional = {"yield_strength_MPa", "first_yield_MPa", "is_estimated", "has_size", "displacements_um", "instead"}
        optional |= {
            "load_loss_percent",
            "turn_deg",
            "edge_pressure_MPa",
            "limit_MPa",
            "alternative",
        }  # of a cut ellipse, where computed
        assert set(said.values) - optional == set(every_kind()[code].values) - optional, code
        found = json.loads(json.dumps(said.record(PYTHON), allow_nan=False))
        assert set(found) == {"code", "severity", "of", "values", "text", "paste"}
        assert found["text"] == said.text == str(said.said())


# Everyone's words -----------------------------------------------------------------------------------------------------

WORDS = (IN_FILE, PYTHON, ON_PAGE)
ADDED = (
    "effects_missing", "effect_data_missing", "life_grooves_uncovered", "speed_rating_unknown",
    "sheet_ratings_unstated", "hypotheses_differ", "rows_press", "sheet_guessed",
)  # fmt: skip
"""Remarks that say what to give or to do."""


def test_what_to_give_is_named_in_the_words_of_whoever_asks(reached: dict[str, Remark]) -> None:
    bare = qs.solve(qs.Scene(B218, qs.Operation(speed=1500.0, axial_load=2e3)))
    lacks = replace(every_remark(bare)[0], of=Of())
    rating, speed = (
        of_reading(reached[code], name) for code, name in ((ADDED[2], "life"), (ADDED[3], "friction_estimate"))
    )
    said = {words.reader: [each.written(words) for each in (lacks, rating, speed)] for words in WORDS}
    for reader, (begun, *others) in {
        Audience.FILE: (
            'Add under [effects]: ball = ["centrifugal_force", "gyroscopic_moment"], raceway_control = "per_ball"',
            'rating = "lundberg_palmgren"', "(speed_rating_rpm)",
        ),
        Audience.PYTHON: (
            'Set ball_effects=(CentrifugalForce(), GyroscopicMoment()), raceway_control="per_ball"',
            'rating="lundberg_palmgren"', "(speed_rating)",
        ),
        Audience.PAGE: ("Tick what is missing in the table of effects", "rating: lundberg_palmgren", "(speed rating)"),
    }.items():  # fmt: skip
        assert said[reader][0].endswith(begun)
        assert [word in each for word, each in zip(others, said[reader][1:], strict=True)] == [True, True]
    given = eval(f"dict({said[Audience.PYTHON][0].partition('Set ')[2]})", vars(qs))
    assert not {each.remark.code for each in qs.warnings(qs.solve(replace(bare.scene, **given)))} & {"effects_missing"}


def of_reading(said: Remark, name: str) -> Remark:
    return replace(said, of=replace(said.of, readings=(name,)))


def test_only_files_hear_of_keys(reached: dict[str, Remark]) -> None:
    """Keys end in a unit; tables stand in brackets."""
    for entry in (each for each in EFFECTS if each.needs):
        of = Remark(EFFECT_DATA_MISSING, values={
            "effect": entry.name, "quantity": "load", "changes": (0.1,), "under": ("",), "is_estimated": False
        })  # fmt: skip
        assert "[effects" not in of.text and "_um" not in of.text
        reached = {**reached, entry.name: of}
        assert f"[effects.{entry.name}]" in of.written(IN_FILE) or entry.name in ("unequal_balls", "gyroscopic_slip")
    for said in reached.values():
        assert pickle.loads(pickle.dumps(said.said())) == said.text
        assert said.kind.code in ADDED or len({said.written(words) for words in WORDS}) == 1


@pytest.mark.parametrize("name", ["7210C", "b218", "7210C_hybrid"])
def test_a_file_is_not_asked_for_what_its_bearing_has(name: str, tmp_path: Path) -> None:
    """Of every effect that needs numbers: the rings' size is asked for in Python, and in a file that lacks it."""
    scene = qs.load_scene(name)
    bare = replace(scene, bearing=replace(scene.bearing, outline=None))
    asked = {"bore", "outside diameter", "widths", "diameters"}
    for given, has in ((scene, True), (bare, False)):
        said = [each.remark for each in qs.warnings(qs.solve(given)) if each.remark.kind.code == "effect_data_missing"]
        assert said
        for each in said:
            effect, texts = each.values["effect"], {words.reader: each.written(words) for words in WORDS}
            named = {reader: bool(asked & {*re.findall("|".join(asked), text)}) for reader, text in texts.items()}
            expected = effect in ("ring_expansion", "elastic_rings")
            assert named[Audience.PYTHON] == expected and named[Audience.FILE] == (expected and not has), texts


ONE = '[bearing]\nname = "7210C"\n[operation]\nspeed_rpm = 15000\naxial_load_N = 500\n'
TWO = f'{ONE}[preload]\nrigid_N = 300\n[[rows]]\nposition_mm = 0\ncarries = "+x"\n'
TWO += '[[rows]]\nposition_mm = 20\ncarries = "-x"\n'


def rows_of_explain(path: Path) -> list[Assessment]:
    of = load_scene_or_set(path)
    return explain(of, 0.01)[1] if isinstance(of, qs.Scene) else explain_set(of, 0.01)[1]


@pytest.mark.parametrize("text", [ONE, TWO], ids=["scene", "set"])
@pytest.mark.parametrize("effect", [entry.name for entry in EFFECTS if entry.needs_beside_size])
def test_the_lines_that_a_remark_explain_and_the_report_give_are_the_same_and_are_read(
    effect: str, text: str, tmp_path: Path
) -> None:
    """Such as `outer.housing = "free"` below [effects.elastic_rings]: all that a bearing of the catalogue needs."""
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    rows = rows_of_explain(path)
    (row,) = (each for each in rows if each.effect == effect)
    said = every_remark(solve_any(load_scene_or_set(path)))
    (remark,) = (each.written(IN_FILE) for each in said if each.values.get("effect") == effect)
    assert row.needs in remark and row.needs in row.why
    table, _ = is_right(rows, 0.01)
    assert f"give {row.needs}" in [line[-1] for line in table.rows]
    found = re.match(r'(\[\S+\]).*such as (\S+ = "\w+")$', row.needs)
    assert found is not None, row.needs
    path.write_text(text + "\n".join(found.groups()), encoding="utf-8")
    assert [each.name for each in load_scene_or_set(path).ring_effects] == [effect]
    assert next(each.needs for each in rows_of_explain(path) if each.effect == effect) == ""


# One list -------------------------------------------------------------------------------------------------------------

READ = "[readings.life]\n[readings.static_safety]\n[readings.kinematics]\n[readings.stress]\n"
AT = "[bearing]\nname = {}\n[operation]\nspeed_rpm = {}\naxial_load_N = {}\n"
BALLS = '[effects]\nball = ["centrifugal_force", "gyroscopic_moment"]\nraceway_control = "{}"\n'
SCENES = {
    "example": "b218",
    "hybrid": "turbopump25_hybrid",
    "static": AT.format('"B218"', 8000, 5000),
    "dents": AT.format('"B218"', 0, 600_000) + READ,
    "radial": AT.format('"7210C"', 8000, 500) + "radial_load_y_N = 4000\ntilt_z_mrad = 0\n" + READ,
    "slips": AT.format('"B218"', 4000, 2000) + BALLS.format("outer"),
    "read": AT.format('"7210C_hybrid"', 12000, 1500) + BALLS.format("per_ball") + READ,
    "friction": AT.format('"B218"', 9000, 5000) + BALLS.format("outer") + "friction_coefficient = 0.02\n",
    "pair": PAIR_FILE,
    "heavy pair": PAIR_FILE.replace("7210C", "B218").replace("= 720", "= 1_200_000") + READ,
}


def written(name: str, folder: Path) -> str:
    """The example's name, or a file of the scene."""
    if "\n" not in SCENES[name]:
        return SCENES[name]
    (folder / "scene.toml").write_text(SCENES[name], encoding="utf-8")
    return str(folder / "scene.toml")


def command(*words: str) -> str:
    """What a command prints, its lines joined."""
    return " ".join(CliRunner().invoke(cli, words).output.split())


@pytest.fixture
def drawn_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Reports and the page without pictures and the parts that are not looked at."""

    def stub(name: str) -> Any:
        return lambda *given: Section(name, [])

    monkeypatch.setattr(answers, "pictured", lambda *given: {})
    for module in (document, set_document):
        monkeypatch.setattr(module, "_results", stub("Results"))
        for part in ("inputs", "set_inputs", "effects", "evidence", "curves", "set_curves"):
            if hasattr(module, part):
                monkeypatch.setattr(getattr(module, part), "section", stub(part))
    monkeypatch.setattr(effects, "section_of_set", stub("effects of the set"))
    monkeypatch.setattr(set_document, "rows_sections", lambda *given: [Section("Rows", [])])
    monkeypatch.setattr(set_document, "limits", lambda of: ([], []))
    monkeypatch.setattr(preload_limits, "preload_summary", lambda solution: [])


@pytest.mark.usefixtures("drawn_nothing")
@pytest.mark.parametrize("name", list(SCENES))
def test_every_way_to_a_solution_shows_the_same_list(name: str, tmp_path: Path) -> None:
    """As data where it is data, else as people read it."""
    file = written(name, tmp_path)
    loaded = load_scene_or_set(file)
    solution: Any = qs.solve(loaded) if isinstance(loaded, qs.Scene) else qs.solve_set(loaded)
    said = every_remark(solution)
    assert said
    data = [json.loads(json.dumps(each.record(IN_FILE))) for each in said]
    lines, of_python, of_page = ([each.said(words).line for each in together(said)] for words in WORDS)
    found = json.loads(CliRunner().invoke(cli, ["run", file, "--json"]).output)
    assert found["remarks"] == data
    assert found["warnings"] == [each.written(IN_FILE) for each in said if not each.of.readings]
    assert qs.warnings(solution) == [each.text for each in said if not each.of.readings]
    assert json.loads(CliRunner().invoke(cli, ["explain", file, "--json"]).output)["remarks"] == data
    assert shown.found_remarks(SimpleNamespace(scene=loaded)) == said  # type: ignore[arg-type]
    for words in (command("run", file), command("explain", file)):
        begins = [
            words.index(typed(line, each.paste(IN_FILE))) for line, each in zip(lines, together(said), strict=True)
        ]
        assert begins == sorted(begins)
        assert sum(words.count(f"{each.words}: ") for each in Severity) == len(lines)
    html = solution._repr_html_()
    assert [html_text(each) for each in html.split('<p class="remark ')[1:-1]] == list(map(with_minus, of_python))
    if isinstance(loaded, qs.Scene):
        whole = document.document(solution, loaded, "", "")
        compared = compare([file, file]).remarks
        assert [replace(each, of=replace(each.of, bearings=())) for each in compared] == said * 2
        page = answers.solved(input_tables(loaded), "")["warnings"]
        assert [html_text(each) for each in page.split('<p class="remark ')[1:]] == list(map(with_minus, of_page))
    else:
        whole = set_document.document(solution, "", "")
    listed = next(section for section, _ in whole.walk() if section.title == "Remarks")
    assert [each.text for each in listed.blocks if isinstance(each, Callout)] == lines


def typed(line: str, paste: str) -> str:
    """A remark as a terminal has it, its lines joined: the command that says more stands below it, and there alone."""
    said = line.removesuffix(f" (see {paste}).").removesuffix(".") + "."
    return " ".join(f"{with_minus(said)} {paste}".split())


def html_text(paragraph: str) -> str:
    """What a browser shows of a paragraph that begins within its tag."""
    text = re.sub("</?strong>", "", paragraph.partition(">")[2].partition("</p>")[0]).replace("<wbr>", "")
    text = unescape(text)
    return text.replace("\xa0", " ").replace("\u2060", "")
