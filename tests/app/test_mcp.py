"""What a language model is told, asked through the SDK's own client: the numbers of the commands, errors with their
fields, and no file of elsewhere."""

from __future__ import annotations

import asyncio
import json
import os
import sys
import time
import tomllib
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

pytest.importorskip("mcp")

from mcp import Client
from mcp.client.stdio import StdioServerParameters
from mcp.types import CallToolResult

import qsbearing as qs
from qsbearing.app import work
from qsbearing.app.mcp import server as of_server
from qsbearing.app.mcp.folder import Folder
from qsbearing.app.mcp.server import server
from qsbearing.app.mcp.tools import Tools
from qsbearing.cli import cli
from qsbearing.documents.model import Document
from qsbearing.files import output_file
from qsbearing.files.file_errors import SceneFileError
from qsbearing.reports.guide_lists import every_kind
from tests.guide.pages import GUIDE, blocks, commands

Calls = list[tuple[str, dict[str, Any]]]
B218 = {"bearing": {"name": "b218"}, "operation": {"axial_load_N": 1000}}


@pytest.fixture(autouse=True)
def here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Answers without a process of their own, which each test would start; over standard input they have one."""

    async def answered(question: Any, given: dict[str, Any]) -> Any:
        return question(**given)

    monkeypatch.setattr(of_server, "answered", answered)


async def _asked(of: Any, calls: Calls) -> list[CallToolResult]:
    async with Client(of) as client:
        return [await client.call_tool(name, given) for name, given in calls]


def asked(folder: Path, *calls: tuple[str, dict[str, Any]]) -> list[Any]:
    """The data of each answer, which must be none of errors."""
    found = asyncio.run(_asked(server(folder), list(calls)))
    assert [json.loads(each.content[0].text) for each in found if each.is_error] == []
    return [each.structured_content for each in found]


def refused(folder: Path, tool: str, /, **given: Any) -> list[dict[str, Any]]:
    [found] = asyncio.run(_asked(server(folder), [(tool, given)]))
    assert found.is_error
    assert found.structured_content is not None
    assert json.loads(found.content[0].text) == found.structured_content
    errors: list[dict[str, Any]] = found.structured_content["errors"]
    return errors


def question_of_the_guide() -> tuple[str, dict[str, Any]]:
    """The scene of the page on design, and what `find` is asked there, as the tool takes it."""
    scene, command = blocks(GUIDE / "design.md")[:2]
    [words] = commands(command.text)
    pairs = list(zip(words[3::2], words[4::2], strict=True))
    asked: dict[str, Any] = {"goals": [], "limits": []}
    for option, value in pairs:
        if option == "--vary":
            asked["vary"] = dict([value.split("=")])
        elif option != "--plot":
            asked[f"{option[2:]}s"].append(value)
    return scene.text, asked


def test_the_question_of_the_guide_over_standard_input(tmp_path: Path) -> None:
    """As a program asks that speaks to a model: the scene's file, what is wanted, and the scene found solved again."""
    text, wanted = question_of_the_guide()
    reference = qs.find(tomllib.loads(text), **wanted)  # first: it may have to compile, for which a tool has no time
    (tmp_path / "spindle.toml").write_text(text, encoding="utf-8")
    program = StdioServerParameters(
        command=sys.executable, args=["-m", "qsbearing", "mcp", "--folder", str(tmp_path)], env=dict(os.environ)
    )

    async def ask() -> tuple[Any, Any, list[str]]:
        async with Client(program) as client:
            found = await client.call_tool("find", {"scene": "spindle.toml", **wanted})
            again = await client.call_tool("solve", {"scene": found.structured_content["input"]})  # type: ignore[index]
            return (
                found.structured_content,
                again.structured_content,
                [t.name for t in (await client.list_tools()).tools],
            )

    found, again, names = asyncio.run(ask())
    assert names == ["describe", "solve", "explain", "find", "sweep", "report"]
    assert found["status"] == "feasible"
    assert found["values"] == reference.values
    assert found["units"]["rigid_N"] == "N"
    assert found["units"]["ring_effective_stiffness_radial_y"] == "N/um"
    assert abs(again["effective_stiffness"]["radial_y_N_per_um"] - 200.0) < 0.01  # the search: goals within 1e-6
    for answer in (found, again):
        assert {each["code"] for each in answer["remarks"]} >= {"effect_data_missing"}
        assert all(every_kind()[each["code"]].severity.name.lower() == each["severity"] for each in answer["remarks"])


def test_the_numbers_are_those_of_run(tmp_path: Path) -> None:
    (tmp_path / "set.toml").write_text(CliRunner().invoke(cli, ["init", "--set"]).stdout, encoding="utf-8")
    sets = str(tmp_path / "set.toml")
    printed = [json.loads(CliRunner().invoke(cli, ["run", each, "--json"]).stdout) for each in ("b218", sets)]
    whole = asked(tmp_path, *(("solve", {"scene": each, "balls": True}) for each in ("b218", "set.toml")))
    short = asked(tmp_path, *(("solve", {"scene": each}) for each in ("b218", "set.toml")))
    for of in (*printed, *whole):
        of.pop("seconds", None)
    for run, told, less in zip(printed, whole, short, strict=True):
        run.pop("warnings")
        for row in run.get("rows", ()):
            row.pop("warnings", None)
        assert told == run
        assert less.pop("requirements") == run["requirements"] and less.pop("not_checked")
        assert '"contact' not in json.dumps(less)
        assert less["remarks"] == run["remarks"]
    assert "balls" not in short[0]
    assert short[1]["rows"][0].keys() == printed[1]["rows"][0].keys() - {"balls"}


@pytest.mark.parametrize("form", ["tables", "text", "json"])
def test_a_scene_is_tables_or_the_text_of_a_file(tmp_path: Path, form: str) -> None:
    text = '[bearing]\nname = "b218"\n[operation]\naxial_load_N = 1000\n'
    given: Any = {"tables": B218, "text": text, "json": json.dumps(B218)}[form]
    [found] = asked(tmp_path, ("solve", {"scene": given}))
    assert found["input"]["operation"]["axial_load_N"] == 1000.0


def test_errors_arrive_with_their_fields(tmp_path: Path) -> None:
    wrong = {"bearing": {"name": "b218"}, "operation": {"axial_lod_N": 3, "speed_rpm": 3e9}}
    unknown, large = refused(tmp_path, "solve", scene=wrong)
    assert unknown == {"key": "operation.axial_lod_N", "problem": "unknown key", "cause": "Did you mean axial_load_N?"}
    assert (large["key"], large["value"], large["unit"]) == ("operation.speed_rpm", 3e9, "rpm")
    assert large["allowed"][1] < 3e9
    [named] = refused(tmp_path, "find", scene="b218", vary={"axial_load_N": "1:2"}, minimise="life.basic_duration_hh")
    assert named["key"] == "life.basic_duration_hh"


def test_an_argument_that_a_tool_does_not_have_is_refused(tmp_path: Path) -> None:
    """`goal` for `goals` would be a search without a goal. Of every tool, in our words, all at once."""

    async def tools() -> dict[str, list[str]]:
        async with Client(server(tmp_path)) as client:
            return {each.name: list(each.input_schema["properties"]) for each in (await client.list_tools()).tools}

    known = asyncio.run(tools())
    assert list(known) == ["describe", "solve", "explain", "find", "sweep", "report"]
    for tool, names in known.items():
        for name in names:
            wrong = {f"{name}x": 1, "zzz": 2}
            found = {each["key"]: each for each in refused(tmp_path, tool, **wrong)}
            assert {found[each]["problem"] for each in wrong} == {"is no argument of this tool"}
            assert found[f"{name}x"]["cause"] == f"Did you mean {name}?"
            assert found["zzz"]["cause"] == f"It takes {', '.join(names)}"
            assert "pydantic" not in json.dumps(found)
    lacking, odd = refused(tmp_path, "find", scene="b218", points="many")
    assert (lacking["key"], lacking["problem"]) == ("vary", "missing")
    assert (odd["key"], odd["problem"], odd["value"]) == ("points", "is not what this tool takes", "'many'")


LONG = "x" * 100_000


def test_what_is_long_is_not_repeated(tmp_path: Path) -> None:
    for tool, given in (
        ("describe", {"topic": LONG}),
        ("solve", {"scene": LONG}),
        ("solve", {"scene": {"bearing": {"name": LONG}, "operation": {"axial_load_N": 1}, LONG: {LONG: 1}}}),
        ("solve", {"scene": {"bearing": {LONG: LONG}, "operation": {LONG: 1}}}),
        ("find", {"scene": "b218", "vary": {LONG: "1:2"}, "minimise": LONG, "goals": [LONG], "limits": [f"{LONG}<=1"]}),
        ("sweep", {"scene": "b218", "vary": {"axial_load_N": LONG}, "quantities": [LONG], "out": f"{LONG}.csv"}),
        ("report", {"scene": "b218", "name": LONG}),
        ("solve", {LONG: LONG, "scene": "b218", "balls": LONG}),
    ):
        [found] = asyncio.run(_asked(server(tmp_path), [(tool, given)]))
        assert found.is_error
        assert len(found.content[0].text) < 12_000, tool  # type: ignore[union-attr]


@pytest.fixture
def enclosed(tmp_path: Path) -> Path:
    """A folder with ways out of it, beside a scene and a table that nobody may read."""
    inside = tmp_path / "inside"
    inside.mkdir()
    (tmp_path / "secret.toml").write_text('[bearing]\nname = "b218"\n[operation]\naxial_load_N = 1\n', encoding="utf-8")
    (tmp_path / "secret.csv").write_text("share,axial_load_N\n1,1000\n", encoding="utf-8")
    (inside / "link.toml").symlink_to(tmp_path / "secret.toml")
    (inside / "out").symlink_to(tmp_path)
    (inside / "loop.toml").symlink_to(inside / "loop.toml")
    (inside / "there.toml").symlink_to(inside / "back.toml")
    (inside / "back.toml").symlink_to(inside / "there.toml")
    (inside / "round").symlink_to(inside / "round")
    spectrum = (
        '[bearing]\nname = "b218"\n[operation]\nspeed_rpm = 1\n[readings.life]\n[spectrum]\nfile = "../secret.csv"\n'
    )
    (inside / "spectrum.toml").write_text(spectrum, encoding="utf-8")
    return inside


AROUND = ["../secret.toml", "{outside}/secret.toml", "/dev/stdin"]
LINKED = ["link.toml", "out/secret.toml", "loop.toml", "spectrum.toml"]
LOOPS = ["loop.toml", "there.toml", "round/a.toml", "round/../loop.toml"]


@pytest.mark.parametrize("raises", [True, False])
@pytest.mark.parametrize("way", LOOPS)
def test_a_circle_of_links_leads_nowhere(
    enclosed: Path, way: str, raises: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whether `Path.resolve` raises for one, as up to Python 3.12, or gives it back, as from 3.13 on."""
    folder = Folder(enclosed)

    def resolved(path: Path, strict: bool = False) -> Path:
        found = Path(os.path.realpath(path))
        if raises and found.is_symlink():
            raise RuntimeError("Symlink loop")
        return found

    monkeypatch.setattr(Path, "resolve", resolved)
    for place in (folder.place, folder.new):
        with pytest.raises(SceneFileError, match="is not below the folder"):
            place(way)


@pytest.mark.parametrize("way", [*AROUND, *LINKED, "a\0.toml"])
def test_no_file_of_elsewhere_is_read(enclosed: Path, way: str) -> None:
    name = way.format(outside=enclosed.parent)
    varied = {"axial_load_N": "1:2:2"}
    for tool, more in (("solve", {}), ("explain", {}), ("sweep", {"vary": varied}), ("find", {"vary": varied})):
        [error] = refused(enclosed, tool, scene=name, **more)
        assert error["problem"] == "is not below the folder of this server"
    [error] = refused(enclosed, "report", scene=name, name="new")
    assert error["problem"] == "is not below the folder of this server"


def test_standard_input_is_no_file(enclosed: Path) -> None:
    """It is the client's."""
    [error] = refused(enclosed, "solve", scene="-")
    assert error["problem"] == "neither a file nor a bearing of the catalogue"


@pytest.mark.parametrize("way", ["../new", "{outside}/new", "out/new", "a\0"])
def test_nothing_is_written_elsewhere(enclosed: Path, way: str) -> None:
    before = sorted(enclosed.parent.rglob("*"))
    name = way.format(outside=enclosed.parent)
    [error] = refused(enclosed, "sweep", scene="b218", vary={"axial_load_N": "1:2:2"}, out=f"{name}.csv")
    assert error["problem"] == "is not below the folder of this server"
    [error] = refused(enclosed, "report", scene="b218", name=name)
    assert error["problem"] == "is not below the folder of this server"
    assert sorted(enclosed.parent.rglob("*")) == before


NO_NAMES = [
    "",
    " ",
    ".",
    "sub/",
    "con",
    "CON",
    "nul",
    "LPT1",
    "com9",
    "Aux.b",
    "a:b",
    "a?",
    "a*b",
    'a"b',
    "a|b",
    "a\tb",
    "<a>",
]


@pytest.mark.parametrize("name", NO_NAMES)
def test_a_name_that_not_every_system_has_is_refused(tmp_path: Path, name: str) -> None:
    (tmp_path / "sub").mkdir()
    [error] = refused(tmp_path, "report", scene="b218", name=name)
    assert error["problem"] in ("is no name for a file", "is in a folder that does not exist")
    if name:
        [error] = refused(tmp_path, "sweep", scene="b218", vary={"axial_load_N": "1:2:2"}, out=f"{name}.csv")
        assert error["problem"] == "is no name for a file"
    assert [each.name for each in tmp_path.rglob("*")] == ["sub"]


def test_a_report_is_written_whole_or_not_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Wherever the disk is full, or the second form fails, nothing is left, not even a part."""
    filled = output_file.Writer.fill
    for allowed in (0, 1):
        done: list[Path] = []

        def fill(writer: Any, data: bytes, allowed: int = allowed, done: list[Path] = done) -> None:
            if len(done) == allowed:
                raise OSError(28, "No space left on device")
            done.append(writer.place)
            filled(writer, data)

        monkeypatch.setattr(output_file.Writer, "fill", fill)
        [error] = refused(tmp_path, "report", scene="b218", name="new")
        assert "No space left" in error["problem"]
        assert list(tmp_path.iterdir()) == []


def test_nothing_is_written_over(tmp_path: Path) -> None:
    (tmp_path / "kept.csv").write_text("mine", encoding="utf-8")
    [error] = refused(tmp_path, "sweep", scene="b218", vary={"axial_load_N": "1:2:2"}, out="kept.csv")
    assert error["problem"] == "exists already"
    assert (tmp_path / "kept.csv").read_text(encoding="utf-8") == "mine"


def test_a_sweep_has_a_summary_a_small_table_and_a_file(tmp_path: Path) -> None:
    given = {"scene": "b218", "vary": {"axial_load_N": "1000:3000:3"}, "quantities": ["inner_max_pressure_max"]}
    one, kept = asked(tmp_path, ("sweep", given), ("sweep", given | {"out": "all.csv"}))
    assert kept["file"] == "all.csv"
    table = kept["table"]
    assert table["axial_load_N"] == [1000.0, 2000.0, 3000.0]
    column = table["inner_max_pressure_max_MPa"]
    spread = one["results"]["inner_max_pressure_max"]
    assert (spread["smallest"], spread["largest"], spread["unit"]) == (min(column), max(column), "MPa")
    lines = (tmp_path / "all.csv").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 4
    assert one["points"][0]["points"] == 3


def test_work_is_bounded_before_it_begins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    [error] = refused(tmp_path, "sweep", scene="b218", vary={"axial_load_N": "1:2:1000", "speed_rpm": "0:1:101"})
    assert error["problem"] == "are 101,000 points; at most 100,000 are solved"
    [error] = refused(tmp_path, "solve", scene=B218 | {"report": {"title": "x" * 1_000_001}})
    assert error["problem"] == "is longer than 1 MB"
    monkeypatch.setattr(of_server, "LONGEST_ANSWER", 1000)
    [error] = refused(tmp_path, "solve", scene="b218")
    assert error["problem"].endswith("at most 1,000 are sent: ask for less, or for a file")


class Endless(Tools):
    """With a tool that is never done."""

    def describe(self, topic: str = "") -> dict[str, Any]:
        """Until it is ended."""
        while True:
            with (self.folder.path / "beats").open("a", encoding="utf-8") as file:
                file.write(".")
            time.sleep(0.01)


def ready() -> None:
    """A process is there, and has loaded what this file does."""


@pytest.mark.parametrize("ended_by", ["its time", "whoever asked"])
def test_work_ends(ended_by: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(of_server, "answered", work.answered)
    monkeypatch.setattr(of_server, "Tools", Endless)
    beats = tmp_path / "beats"

    async def ask() -> CallToolResult | None:
        await work.answered(ready, {})
        monkeypatch.setattr(work, "LONGEST", 3.0 if ended_by == "its time" else 60.0)
        async with Client(server(tmp_path)) as client:
            call = asyncio.ensure_future(client.call_tool("describe", {}))
            if ended_by == "its time":
                found = await call
            else:
                until = time.monotonic() + 30.0
                while not beats.exists() and time.monotonic() < until:
                    await asyncio.sleep(0.05)
                call.cancel()
                await asyncio.wait([call])
                found = None
            until = time.monotonic() + 20.0
            while time.monotonic() < until:
                size = beats.stat().st_size
                await asyncio.sleep(0.5)
                if beats.stat().st_size == size:
                    return found
            raise AssertionError("goes on")

    found = asyncio.run(ask())
    assert found is None or (found.is_error and "was stopped" in found.content[0].text)


def test_all_topics_are_described(tmp_path: Path) -> None:
    [overview] = asked(tmp_path, ("describe", {}))
    names = [
        *overview["bearings"],
        *overview["tables_of_a_scene"],
        *overview["remarks"],
        *overview["guide"],
        "results",
        "skill",
    ]
    found = asked(tmp_path, *(("describe", {"topic": each}) for each in names))
    told = dict(zip(names, found, strict=True))
    speed = told["operation"]["schema"]["properties"]["speed_rpm"]
    assert "rpm" in speed["description"]
    assert speed["maximum"] > 1e4
    assert "rigid_N" in told["preload"]["definitions"]["preload"]["properties"]
    assert told["results"]["ring_effective_stiffness_radial_y"].endswith("[N/µm]")
    assert told["7210C_hybrid"]["provenance"]["ball_count"]
    assert told["effect_data_missing"]["severity"] == "incomplete_model"
    assert told["remarks"]["text"].count("`effect_data_missing`") == 1
    [error] = refused(tmp_path, "describe", topic="preloads")
    assert error["cause"] == "Did you mean preload?"


def test_a_report_names_its_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from qsbearing.reports import of_any

    sources = []

    def made(solution: Any, of: Any, source: str, command: str, changes: Any) -> Document:
        sources.append(source)
        return Document("B218", "Design report", [])

    monkeypatch.setattr(of_any, "document_of_any", made)
    one, _ = asked(tmp_path, ("report", {"scene": "b218", "name": "one"}), ("report", {"scene": B218, "name": "two"}))
    assert one["files"] == ["one.html", "one.pdf"]
    assert (tmp_path / "two.pdf").read_bytes().startswith(b"%PDF")
    assert sources[0] == ""
    assert tomllib.loads(sources[1]) == B218


def test_the_command_says_what_is_wrong(tmp_path: Path) -> None:
    done = CliRunner().invoke(cli, ["mcp", "--folder", str(tmp_path / "none")])
    assert done.exit_code == 2
    assert "No such file or directory" in done.stderr
