"""The door, fuzzed: whatever comes in, the answer is faults with exit code 2, or an outcome; quickly, and in numbers.

Three doors: the Python objects, scene files as text, and the arguments of `solve`. Every number that passes any of
them is looked at once more where the solver takes over: what is not finite must not get there. Each example is given a
limit; the compiled kernel cannot be interrupted, so if one never came back the whole run would be ended with a trace.
"""

from __future__ import annotations

import contextlib
import faulthandler
import json
import math
import tempfile
import time
from collections.abc import Callable, Iterator
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing import solving
from qsbearing.cli import cli
from qsbearing.compiled import COMPILED
from qsbearing.newton import STALLED
from qsbearing.operation import CHANNELS
from qsbearing.outcome import message, warnings
from qsbearing.scene_keys import SECTIONS

LIMIT = 10.0 if COMPILED else 120.0
"""Seconds for one example: a solve takes a thousandth of one, the slowest refusals some tenths."""

HANGING = 300.0
"""Seconds after which an example that has not come back ends everything."""

few = settings(max_examples=80 if COMPILED else 3, suppress_health_check=[HealthCheck.too_slow])
many = settings(parent=few, max_examples=3000 if COMPILED else 10)


@contextlib.contextmanager
def bounded() -> Iterator[None]:
    """No hang: an example has its time."""
    faulthandler.dump_traceback_later(HANGING, exit=True)
    began = time.monotonic()
    try:
        yield
    finally:
        faulthandler.cancel_dump_traceback_later()
    assert time.monotonic() - began < LIMIT


@pytest.fixture(autouse=True, scope="module")
def nothing_but_numbers() -> Iterator[list[int]]:
    """Look at every case record on its way into the solver."""
    solve_cases, passed = solving.solve_cases, [0]

    def watched(cases: NDArray, *rest: Any) -> None:
        for name in cases.dtype.names or ():
            field = cases[name]
            if field.dtype.kind == "f":
                assert np.isfinite(field).all(), f"the solver is handed {name} = {field}"
        passed[0] += cases.size
        solve_cases(cases, *rest)

    # Compiling, or loading, the kernel takes its own time.
    assert_outcome(qs.solve(qs.load_scene("b218")))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(solving, "solve_cases", watched)
        yield passed


# What comes in ------------------------------------------------------------------------------------------------------

JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.text(max_size=5),
    st.binary(max_size=3),
    st.floats(),  # NaN, infinities and subnormals among them
    st.integers(),
    st.sampled_from(
        [
            10**400,
            -(10**400),
            1j,
            Decimal("NaN"),
            Decimal("1e-3"),
            Fraction(1, 3),
            object(),
            [],
            {},
            {"a": 1},
            set(),
            range(3),
        ]
    ),
    st.sampled_from(
        [
            np.array([]),
            np.array([1.0, np.nan]),
            np.array([np.inf]),
            np.array([1 + 2j]),
            np.array(["x"]),
            np.array([None]),
            np.array([[1.0, 2.0], [3.0, 4.0]]),
            np.float32(0.01),
            np.int8(7),
            np.ma.masked_array([1.0, 2.0], mask=[0, 1]),
            [1.0, [2.0]],
            [1.0, None],
            (0.01, 0.02),
        ]
    ),
)


def spread(low: float, high: float) -> st.SearchStrategy[float]:
    """Positive numbers over many decades, the ends included."""
    inner = st.floats(math.log10(low), math.log10(high)).map(lambda power: min(max(10.0**power, low), high))
    return st.one_of(inner, st.sampled_from([low, high]))


def signed(most: float, least: float = 1e-12) -> st.SearchStrategy[float]:
    """Of either sign, zero included."""
    return st.one_of(
        st.just(0.0), st.just(-0.0), st.builds(math.copysign, spread(least, most), st.sampled_from([1.0, -1.0]))
    )


@st.composite
def bearings(draw: Any) -> dict[str, Any]:
    """Fields of a bearing that the door lets in, to its very ends."""
    diameter = draw(spread(6e-5, 0.9))
    count = draw(st.one_of(st.integers(1, 40), st.sampled_from([1, 2, 1000]))) if COMPILED else draw(st.integers(1, 4))
    least = diameter / math.sin(math.pi / count) if count > 1 else diameter
    material = st.builds(qs.Material, spread(1e9, 2e12), st.floats(0.0, 0.499), spread(100.0, 25000.0))
    return {
        "ball_count": count,
        "ball_diameter": diameter,
        "pitch_diameter": min(least * draw(spread(1.0 + 1e-9, 100.0)), 20.0),
        "inner_groove_radius": diameter
        * draw(st.one_of(st.floats(0.5, 1.0), spread(1e-15, 0.5).map(lambda f: 0.5 + f))),
        "outer_groove_radius": diameter
        * draw(st.one_of(st.floats(0.5, 1.0), spread(1e-15, 0.5).map(lambda f: 0.5 + f))),
        "free_contact_angle": draw(st.one_of(st.floats(0.0, 85.0 * qs.deg), st.sampled_from([0.0, 1e-300, 1e-9]))),
        "ball_material": draw(material),
        "ring_material": draw(material),
        "kind": draw(st.sampled_from(list(qs.BearingKind))),
    }


@st.composite
def operations(draw: Any) -> dict[str, Any]:
    """Fields of an operation that the door lets in."""
    fields: dict[str, Any] = {
        "speed": draw(signed(1e5)),
        "outer_speed": draw(st.one_of(st.none(), signed(1e5))),
        "first_ball_azimuth": draw(st.floats(-6.28, 6.28)),
    }
    for channel in CHANNELS:
        if draw(st.booleans()):
            fields[channel.load] = draw(signed(1e8))
        else:
            fields[channel.displacement] = draw(signed(0.2 if channel.is_rotation else 0.1))
    return fields


CHOICES = st.fixed_dictionaries(
    {
        "raceway_control": st.one_of(st.none(), st.sampled_from(list(qs.RacewayControl))),
        "hertz_angle": st.sampled_from(list(qs.HertzAngle)),
        "hertz_form": st.sampled_from(list(qs.HertzForm)),
        "tilt_lever": st.sampled_from(list(qs.TiltLever)),
        "ball_effects": st.sets(
            st.sampled_from([qs.CentrifugalForce(), qs.GyroscopicMoment(), qs.GyroscopicMoment("harris")]), max_size=2
        ).map(tuple),
    }
)


# What comes out -----------------------------------------------------------------------------------------------------


def made(build: Callable[[], qs.Scene]) -> qs.Scene | None:
    """The scene; None if it is refused, which it must be with faults that say so."""
    try:
        return build()
    except qs.SceneError as error:
        assert error.faults
        for fault in error.faults:
            assert fault.field
            assert fault.problem
        assert str(error)
        return None


def assert_outcome(solution: qs.Solution) -> None:
    """One of the three, with a sentence; numbers where it is solved, and nowhere else."""
    for index in np.ndindex(solution.shape):
        status = str(np.asarray(solution.status)[index])
        assert status in list(qs.Status)
        assert message(solution, index)
        is_solved = status == "converged"
        for sentence in warnings(solution, index):
            assert "nan" not in sentence.split()
        assert np.isfinite(solution.displacement[index]).all() == is_solved
        assert np.isfinite(solution.load[index]).all() == is_solved
        there = np.isfinite(solution.azimuth[index])
        for contacts in (solution.inner, solution.outer):
            load, pressure, angle = (
                getattr(contacts, name)[index][there] for name in ("load", "max_pressure", "angle")
            )
            assert np.isfinite(load).all() == is_solved
            assert np.isfinite(pressure).all() == is_solved
            if is_solved:
                assert (load >= 0.0).all()
                assert np.isfinite(angle[load > 0.0]).all()
        for array in (solution.centrifugal_force, solution.gyroscopic_moment, solution.orbital_speed):
            if array is not None and is_solved:
                assert np.isfinite(array[index][there]).all()
        if is_solved:
            assert np.asarray(solution.residual)[index] <= STALLED
            assert np.isfinite(qs.stiffness(solution.scene, solution)[index]).all()


def solve_or_refuse(bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any]) -> None:
    """Through the first door, and if it opens to the outcome."""
    with bounded():
        scene = made(lambda: qs.Scene(qs.BallBearing(**bearing), qs.Operation(**operation), **choices))
        if scene is None:
            return
        try:
            solution = qs.solve(scene)
        except ValueError as error:
            assert "broadcast" in str(error)
            return
        assert_outcome(solution)


@few
@given(bearings(), operations(), CHOICES)
def test_whatever_the_door_lets_in_has_an_outcome(
    bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any]
) -> None:
    """Numbers out to the ends of every allowed range."""
    solve_or_refuse(bearing, operation, choices)


SOUND_BEARING: dict[str, Any] = {
    "ball_count": 16,
    "ball_diameter": 22.225e-3,
    "pitch_diameter": 125.26e-3,
    "inner_groove_radius": 11.6281e-3,
    "outer_groove_radius": 11.6281e-3,
    "free_contact_angle": 0.7,
}
SOUND_OPERATION: dict[str, Any] = {"speed": 500.0, "axial_load": 8e3, "radial_load_y": 1e3, "moment_z": 0.0}
SOUND_CHOICES: dict[str, Any] = {"ball_effects": (qs.CentrifugalForce(),), "raceway_control": "outer"}

FIELDS = {
    "bearing": [*SOUND_BEARING, "ball_material", "ring_material", "kind", "name"],
    "operation": [
        *("speed", "outer_speed", "first_ball_azimuth"),
        *(name for channel in CHANNELS for name in (channel.load, channel.displacement)),
    ],
    "choices": ["ball_effects", "raceway_control", "hertz_angle", "hertz_form", "tilt_lever"],
    "material": ["elastic_modulus", "poisson_ratio", "density"],
}


def junk_in_one_field(part: str, field: str, value: Any) -> None:
    """One field of a sound scene replaced by anything."""
    parts = {"bearing": dict(SOUND_BEARING), "operation": dict(SOUND_OPERATION), "choices": dict(SOUND_CHOICES)}
    if part == "material":
        steel = {"elastic_modulus": 208e9, "poisson_ratio": 0.3, "density": 7800.0}
        parts["bearing"]["ball_material"] = qs.Material(**{**steel, field: value})
    else:
        parts[part][field] = value
    solve_or_refuse(**parts)


ANY_FIELD = st.sampled_from([(part, field) for part, fields in FIELDS.items() for field in fields])


@few
@given(ANY_FIELD, JUNK)
def test_anything_in_any_field(place: tuple[str, str], value: Any) -> None:
    junk_in_one_field(*place, value)


NO_NUMBERS = {
    "nan": math.nan,
    "infinity": math.inf,
    "minus infinity": -math.inf,
    "beyond floats": 10**400,
    "text": "1",
    "true": True,
    "none": None,
    "complex": 1j,
    "complex array": np.array([1.0 + 2.0j]),
    "nan in an array": np.array([1.0, np.nan]),
}


@pytest.mark.parametrize("value", list(NO_NUMBERS.values()), ids=list(NO_NUMBERS))
@pytest.mark.parametrize(
    "place", [(part, field) for part, fields in FIELDS.items() for field in fields], ids=lambda place: place[1]
)
def test_what_is_no_number_in_every_field(place: tuple[str, str], value: Any) -> None:
    """Each of the usual non-numbers, in each field."""
    if place[1] == "name":
        return
    junk_in_one_field(*place, value)


@few
@given(st.sampled_from(["start", "threads", "tolerance"]), JUNK)
def test_anything_as_an_argument_of_solve(name: str, value: Any) -> None:
    """An outcome, or an error that says what is wrong with the value, not one from deep inside."""
    scene = qs.Scene(qs.BallBearing(**SOUND_BEARING), qs.Operation(**SOUND_OPERATION), **SOUND_CHOICES)
    with bounded():
        try:
            solution = qs.solve(scene, **{name: value})
        except (ValueError, TypeError, ArithmeticError) as error:
            assert str(error)
            return
        assert solution.status in list(qs.Status)


# Files --------------------------------------------------------------------------------------------------------------

TOML_VALUE = st.one_of(
    st.floats().map(lambda value: repr(value).replace("inf", "inf") if value == value else "nan"),
    st.integers(-(10**30), 10**30).map(str),
    st.sampled_from(
        ["1e400", "-1e400", "1e-400", "9" * 5000, "0x10", "1_000", "+1", "-0.0", "0b1", "1.", ".5", "01", "1e5_0"]
    ),
    st.sampled_from(
        ["true", "[]", "[1]", "[[[[1]]]]", "{}", "{a = 1}", "1979-05-27", "07:32:00", '""', "''", '"""\n"""', '"1"']
    ),
    st.text(max_size=8).map(json.dumps),
)
SECTION = st.sampled_from(
    ["bearing", "operation", "effects", "bearing.ball_material", "bearing.ring_material", "nothing", "Bearing"]
)
KEY = st.one_of(
    st.sampled_from([key for keys in SECTIONS.values() for key in keys]),
    st.sampled_from(["elastic_modulus_GPa", "poisson_ratio", "density_kg_m3", "speed", "axial_load", '"quoted key"']),
    st.text("abcdefghijklmnopqrstuvwxyz_", min_size=1, max_size=12),
)
GOOD = {
    "bearing": {
        "ball_count": "9",
        "ball_diameter_mm": "7.9375",
        "pitch_diameter_mm": "46.0",
        "inner_groove_radius_mm": "4.1",
        "outer_groove_radius_mm": "4.15",
        "free_contact_angle_deg": "15.0",
        "ball_material": '"steel"',
        "ring_material": '"steel"',
    },
    "operation": {"speed_rpm": "12000", "axial_load_N": "150", "radial_load_y_N": "40", "moment_z_Nm": "0"},
    "effects": {"ball": '["centrifugal_force", "gyroscopic_moment"]', "raceway_control": '"outer"'},
}


def as_text(tables: dict[str, dict[str, str]]) -> str:
    """Tables of written values as a file."""
    return "\n".join(
        f"[{name}]\n" + "".join(f"{key} = {value}\n" for key, value in keys.items()) for name, keys in tables.items()
    )


def run_file(content: bytes) -> None:
    """Through the command line: exit code 2 and a message, or 0 or 1 and an outcome in strict JSON."""
    with bounded(), tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_bytes(content)
        result = CliRunner().invoke(cli, ["run", str(path), "--json"])
        assert result.exception is None or isinstance(result.exception, SystemExit), content
        assert "Traceback" not in result.stderr
        assert result.exit_code in (0, 1, 2)
        if result.exit_code == 2:
            assert not result.stdout
            assert result.stderr.startswith("qsbearing: ")
            return

        def refuse(word: str) -> None:
            raise AssertionError(f"{word} in the JSON of {content!r}")

        found = json.loads(result.stdout, parse_constant=refuse)
        assert found["status"] in (["converged"] if result.exit_code == 0 else ["no_equilibrium", "not_converged"])
        assert found["message"]
        if result.exit_code == 0:
            numbers = [*found["displacement"].values(), *found["load"].values()]
            numbers += [ball[race]["load_N"] for ball in found["balls"] for race in ("inner", "outer")]
            numbers += [value for row in found["stiffness_SI"] for value in row]
            assert None not in numbers


@few
@given(st.lists(st.tuples(SECTION, KEY, TOML_VALUE), min_size=1, max_size=5))
def test_any_value_under_any_key(changes: list[tuple[str, str, str]]) -> None:
    tables = {name: dict(keys) for name, keys in GOOD.items()}
    for section, key, value in changes:
        tables.setdefault(section, {})[key] = value
    run_file(as_text(tables).encode("utf-8", "surrogatepass"))


@few
@given(bearings(), operations(), CHOICES)
def test_any_scene_through_a_file(bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any]) -> None:
    """What the objects let in, written as a file: the file lets it in as well, or says what is wrong."""
    run_file(scene_text(bearing, operation, choices).encode())


def scene_text(bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any]) -> str:
    """Fields of the Python objects under the keys of a file."""
    from qsbearing.scene_keys import BEARING, MATERIAL, OPERATION

    tables: dict[str, dict[str, str]] = {"bearing": {"kind": f'"{bearing["kind"]}"'}, "operation": {}, "effects": {}}
    for key in BEARING:
        if key.field in bearing:
            tables["bearing"][key.name] = repr(float(bearing[key.field]) / key.size)
    for side in ("ball_material", "ring_material"):
        parts = [f"{key.name} = {float(getattr(bearing[side], key.field)) / key.size!r}" for key in MATERIAL[:3]]
        tables["bearing"][side] = "{" + ", ".join(parts) + "}"
    for key in OPERATION:
        if operation.get(key.field) is not None:
            tables["operation"][key.name] = repr(float(operation[key.field]) / key.size)
    tables["effects"]["ball"] = json.dumps([effect.name for effect in choices["ball_effects"]])
    for name in ("raceway_control", "hertz_angle", "hertz_form", "tilt_lever"):
        if choices[name] is not None:
            tables["effects"][name] = f'"{choices[name]}"'
    return as_text(tables)


@few
@given(st.data())
def test_a_good_file_cut_doubled_and_shuffled(data: st.DataObject) -> None:
    """Lines left out, repeated and in another order: still faults or an outcome."""
    lines = as_text(GOOD).splitlines()
    picked = data.draw(st.lists(st.integers(0, len(lines) - 1), max_size=2 * len(lines)))
    run_file("\n".join(lines[k] for k in picked).encode())


def test_a_good_file_is_good(nothing_but_numbers: list[int]) -> None:
    """What the fuzzing starts from is solved, and is seen on its way in."""
    before = nothing_but_numbers[0]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(as_text(GOOD), encoding="utf-8")
        assert CliRunner().invoke(cli, ["run", str(path), "--json"]).exit_code == 0
    assert nothing_but_numbers[0] == before + 1


# More of the same ---------------------------------------------------------------------------------------------------


@pytest.mark.heavy
@many
@given(bearings(), operations(), CHOICES)
def test_many_outcomes(bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any]) -> None:
    solve_or_refuse(bearing, operation, choices)


@pytest.mark.heavy
@many
@given(ANY_FIELD, JUNK)
def test_much_junk(place: tuple[str, str], value: Any) -> None:
    junk_in_one_field(*place, value)


@pytest.mark.heavy
@many
@given(bearings(), operations(), CHOICES)
def test_many_files(bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any]) -> None:
    run_file(scene_text(bearing, operation, choices).encode())
