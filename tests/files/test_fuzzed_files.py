"""Anything in a scene file or on the command line: errors with exit code 2, or a result; no control characters."""

from __future__ import annotations

import contextlib
import json
import tempfile
import unicodedata
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from hypothesis import given
from hypothesis import strategies as st

from qsbearing.cli import cli
from qsbearing.files.file_keys import reading_tables, sections
from qsbearing.files.keys import BEARING, EFFECT_SECTIONS, MATERIAL, OPERATION, SECTIONS
from tests.qsbearing.any_scene import CHOICES, bearings, bounded, few, many, operations
from tests.systems.sets.arrangements import PAIR_FILE

TOML_VALUE = st.one_of(
    st.floats().map(lambda value: repr(value).replace("inf", "inf") if value == value else "nan"),
    st.integers(-(10**30), 10**30).map(str),
    st.sampled_from(
        ["1e400", "-1e400", "0e400", "1e-400", "9" * 400, "9" * 5000, "0x10", "1_000", "+1", "-0.0", "1.", ".5", "01"]
    ),
    st.sampled_from(
        ["true", "[]", "[1]", "[[[[1]]]]", "{}", "{a = 1}", "1979-05-27", "07:32:00", '""', "''", '"""\n"""', '"1"']
    ),
    st.text(max_size=8).map(json.dumps),
)
SECTION = st.sampled_from(
    [
        *("bearing", "operation", "effects", "bearing.ball_material", "bearing.ring_material", "nothing", "Bearing"),
        *("preload", "effects.ring_expansion", "effects.ball_expansion", "effects.ring_expansion.shaft_material"),
        *(f"readings.{name}" for name in reading_tables()),
    ]
)
KEY = st.one_of(
    st.sampled_from([key for keys in (SECTIONS | EFFECT_SECTIONS | sections()).values() for key in keys]),
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
    "readings": {},
}


def as_text(tables: dict[str, dict[str, str]]) -> str:
    """Tables of written values as a file."""
    return "\n".join(
        f"[{name}]\n" + "".join(f"{key} = {value}\n" for key, value in keys.items()) for name, keys in tables.items()
    )


def run_file(content: bytes) -> None:
    """Through the command line: exit code 2 and a message, or 0 or 1 and a result in strict JSON."""
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
    """Lines left out, repeated and in another order: still errors or a result."""
    lines = as_text(GOOD).splitlines()
    picked = data.draw(st.lists(st.integers(0, len(lines) - 1), max_size=2 * len(lines)))
    run_file("\n".join(lines[k] for k in picked).encode())


@few
@given(st.one_of(st.binary(max_size=80), st.text(max_size=80).map(lambda text: text.encode("utf-8", "replace"))))
def test_any_bytes(content: bytes) -> None:
    run_file(content)


@few
@given(st.integers(0, 400), st.integers(0, 5), st.binary(max_size=4))
def test_a_good_file_with_some_bytes_changed(place: int, length: int, instead: bytes) -> None:
    text = as_text(GOOD).encode()
    place %= len(text)
    run_file(text[:place] + instead + text[place + length :])


def test_a_good_file_is_good(tmp_path: Path) -> None:
    """What the fuzzing starts from is solved."""
    path = tmp_path / "scene.toml"
    path.write_text(as_text(GOOD), encoding="utf-8")
    assert CliRunner().invoke(cli, ["run", str(path), "--json"]).exit_code == 0


HUGE = ["1e400", "-1e400", "0e400", "9" * 400, "0x" + "f" * 5000, "1e99999999999999999999"]


@pytest.mark.parametrize("value", HUGE, ids=lambda value: value[:6])
@pytest.mark.parametrize("form", ["{}", "[{}]", "{{a = {}}}"])
def test_numbers_beyond_floats_under_every_key(value: str, form: str) -> None:
    """Alone, in a list and in a table; the angle beside a clearance, which are compared."""
    good = {name: dict(keys) for name, keys in GOOD.items()}
    good["bearing"]["diametral_clearance_mm"] = "0.0214"
    tables = dict(SECTIONS)
    if form == "{}":
        tables |= {f"effects.{name}": keys for name, keys in EFFECT_SECTIONS.items()}
        tables |= {f"readings.{name}": sections()[name] for name in reading_tables()}
    for section, keys in tables.items():
        for key in [*keys, "unknown", "axial_load_kN"]:
            run_file(as_text(good | {section: good.get(section, {}) | {key: form.format(value)}}).encode())


# What a terminal would obey -------------------------------------------------------------------------------------------

MARKS = st.sampled_from(
    ["\x1b[31m", "\x1b]0;title\x07", "\x07", "\x08", "\x7f", "\x9b2J", "\r", "\u202e", "\u2066", "\u200f"]
)
MARKED = st.lists(st.one_of(MARKS, st.text(max_size=4)), min_size=1, max_size=4).map("".join)


def assert_harmless(result: Result) -> None:
    """Nothing printed steers a terminal; nothing ends in a traceback."""
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exc_info
    assert "Traceback" not in result.stderr
    for letter in set(result.stdout + result.stderr) - {"\n"}:
        assert unicodedata.category(letter) not in ("Cc", "Cf", "Cs", "Zl", "Zp"), repr(letter)


def quoted(text: str) -> str:
    """A TOML string: its escapes are those of JSON, but for what JSON leaves as it is."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


PLACES = {
    "value": "[bearing]\nname = {}\n[operation]\naxial_load_N = 1\n",
    "number": '[bearing]\nname = "B218"\n[operation]\naxial_load_N = {}\n',
    "key": '[bearing]\nname = "B218"\n[operation]\n{} = 1\n',
    "table": '[bearing]\nname = "B218"\n[{}]\n',
    "material": '[bearing]\nname = "B218"\nball_material = {}\n[operation]\naxial_load_N = 1\n',
    "material key": '[bearing]\nname = "B218"\nball_material = {{ {} = 1 }}\n[operation]\naxial_load_N = 1\n',
    "effect": '[bearing]\nname = "B218"\n[operation]\naxial_load_N = 1\n[effects]\nball = [{}]\n',
    "choice": '[bearing]\nname = "B218"\nkind = {}\n[operation]\naxial_load_N = 1\n',
}


@few
@given(st.sampled_from(list(PLACES)), MARKED, st.booleans())
def test_no_control_character_of_a_file_is_printed(place: str, text: str, raw: bool) -> None:
    """As a TOML string, and raw, where most of them are no TOML."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(PLACES[place].format(text if raw else quoted(text)), encoding="utf-8", errors="surrogatepass")
        assert_harmless(CliRunner().invoke(cli, ["run", str(path)]))


COMMANDS = [
    *(["run", "{}"], ["run", "{}.toml"], ["run", "b218", "{}"], ["run", "b218", "--{}"], ["{}"], ["--{}"]),
    *(["run", "b218", "--csv", "{}/out.csv"], ["run", "b218", "--plot", "{}"], ["run", "b218", "--accuracy", "{}"]),
    *(["catalogue", "{}"], ["init", "{}"], ["cost", "b218", "--out", "a file/{}"]),
]


@few
@given(st.sampled_from(COMMANDS), MARKED)
def test_no_control_character_of_the_command_line_is_printed(command: list[str], text: str) -> None:
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        Path("a file").touch()  # no folder can be made in it, so that nothing is measured
        assert_harmless(CliRunner().invoke(cli, [part.format(text.replace("/", "")) for part in command]))


@pytest.mark.parametrize("name", ["\x1b[31mred", "\u202eabc", "line\nbreak", "$\\frac$"])
def test_a_file_of_any_name_is_solved_and_drawn(name: str, tmp_path: Path, drawn: None) -> None:
    """The bearing is called after its file, in the table and in the picture's title."""
    path, picture = tmp_path / f"{name}.toml", tmp_path / "out.svg"
    path.write_text(as_text(GOOD), encoding="utf-8")
    result = CliRunner().invoke(cli, ["run", str(path), "--plot", str(picture)])
    assert_harmless(result)
    assert result.exit_code == 0
    assert not set("\x1b\u202e") & set(picture.read_text(encoding="utf-8"))


@pytest.mark.heavy
@many
@given(bearings(), operations(), CHOICES)
def test_many_files(bearing: dict[str, Any], operation: dict[str, Any], choices: dict[str, Any]) -> None:
    run_file(scene_text(bearing, operation, choices).encode())


@pytest.mark.heavy
@many
@given(st.lists(st.tuples(SECTION, KEY, TOML_VALUE), min_size=1, max_size=5))
def test_many_values(changes: list[tuple[str, str, str]]) -> None:
    tables = {name: dict(keys) for name, keys in GOOD.items()}
    for section, key, value in changes:
        tables.setdefault(section, {})[key] = value
    run_file(as_text(tables).encode("utf-8", "surrogatepass"))


STEP = st.one_of(
    st.sampled_from(
        ["rows", "shaft", "loads", "bearing", "readings", "effects", "ball_material", "operation", "spacers"]
    ),
    st.sampled_from(
        ["1", "2", "3", "0", "-1", "01", "1.0", "²", "٢", "２", "9" * 30, "9" * 5000, "", " ", "\u202e", "\x1b"]
    ),
    st.sampled_from([*(key for keys in SECTIONS.values() for key in keys), "offset_um", "position_mm", "axial_N"]),
    st.text(max_size=6),
)
VALUES = st.one_of(
    st.sampled_from(["0,1", "0:1:2", "٢,٣", "²", "", "1", "nan,inf", "normal(0,1)", "=", "1e400"]), st.text(max_size=6)
)


@few
@given(st.lists(STEP, min_size=1, max_size=5), VALUES)
def test_any_path_on_the_command_line(steps: list[str], values: str) -> None:
    with bounded(), tempfile.TemporaryDirectory() as folder:
        file, out = Path(folder) / "pair.toml", Path(folder) / "out.csv"
        file.write_text(PAIR_FILE, encoding="utf-8")
        call = ["sweep", str(file), "--vary", f"{'.'.join(steps)}={values}", "--samples", "2", "--out", str(out)]
        result = CliRunner().invoke(cli, call)
        assert result.exception is None or isinstance(result.exception, SystemExit), call
        assert result.exit_code in (0, 1, 2) and "Traceback" not in result.stderr, call
        assert out.exists() == (result.exit_code != 2), call
        assert not any(
            unicodedata.category(letter) in ("Cc", "Cf") and letter not in "\n\r" for letter in result.stderr
        )
