"""What is read in blocks, because it is too large for memory, gives the same tables and pictures."""

from __future__ import annotations

import subprocess
import sys
from io import BytesIO
from pathlib import Path

import pandas
import pytest
from click.testing import CliRunner

from qsbearing.cli import cli
from qsbearing.documents.terminal import text_of
from qsbearing.files import block_statistics
from qsbearing.pictures.study import lines, picture
from qsbearing.studies import summary
from qsbearing.studies.store import open_results
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep
from qsbearing.studies.tables import frame_of, parts_of

xarray = pytest.importorskip("xarray")

RANDOM = {"ball_diameter_mm": "normal(22.225,0.002)", "free_contact_angle_deg": "normal(40,0.3)"}
STUDIES = {
    "samples": RANDOM,
    "curves": RANDOM | {"speed_rpm": "0:9000:2", "ball_count": [14, 18]},
    "map": RANDOM | {"speed_rpm": "0:9000:2", "axial_load_N": [-10, 4000]},
}
PICTURES = [("samples", "distribution"), ("samples", "sensitivity"), ("curves", "lines"), ("map", "map")]
PICTURES += [("curves", "sensitivity"), ("curves", "distribution")]


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> dict[str, object]:
    folder = tmp_path_factory.mktemp("large")
    for name, vary in STUDIES.items():
        sweep(Study.of("b218", vary, samples=50 if name == "samples" else 20), out=folder / f"{name}.nc").close()
    return {name: open_results(folder / f"{name}.nc") for name in STUDIES}


def pixels(data: object, kind: str) -> bytes:
    """Of a picture whose layout, which takes half of the time, is left as it is made."""
    out, figure = BytesIO(), picture(data, kind=kind)  # type: ignore[arg-type]
    figure.set_layout_engine("none")
    figure.savefig(out, format="png")
    return out.getvalue()


@pytest.mark.parametrize(("name", "kind"), PICTURES)
def test_pictures_are_the_same(
    results: dict, name: str, kind: str, monkeypatch: pytest.MonkeyPatch, drawn: None
) -> None:
    pytest.importorskip("matplotlib")
    whole = pixels(results[name].load(), kind)
    for module in (block_statistics, lines):
        monkeypatch.setattr(module, "MOST", 40)
    assert pixels(results[name], kind) == whole


@pytest.mark.parametrize("name", STUDIES)
def test_tables_are_the_same(results: dict, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = text_of(summary.table(results[name].load()))
    monkeypatch.setattr(block_statistics, "MOST", 40)
    assert text_of(summary.table(results[name])) == whole
    frames = [frame_of(part) for part in parts_of(results[name], 256)]
    assert len(frames) > 1
    assert max(map(len, frames)) <= 256
    pandas.testing.assert_frame_equal(
        pandas.concat(frames, ignore_index=True), frame_of(results[name]).reset_index(drop=True)
    )


def test_more_than_memory_is_to_hold_goes_through_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    given = ["sweep", "b218", "--vary", "speed_rpm=0:9000:20", "-y", "inner_load_max", "--out"]
    small = CliRunner().invoke(cli, [*given, str(tmp_path / "a.csv")])
    monkeypatch.setattr(sys.modules["qsbearing.cli.sweep"], "IN_MEMORY", 10)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    large = CliRunner().invoke(cli, [*given, str(tmp_path / "b.csv")])
    assert large.exit_code == small.exit_code == 0
    assert large.output == small.output
    assert (tmp_path / "b.csv").read_bytes() == (tmp_path / "a.csv").read_bytes()
    assert sorted(file.name for file in tmp_path.iterdir()) == ["a.csv", "b.csv"]


@pytest.mark.heavy
def test_four_times_the_points_take_the_same_memory(tmp_path: Path) -> None:
    """Peak of the whole command; the small one too has more points than are ever in memory."""

    def peak(count: int) -> float:
        given = [sys.executable, "-m", "qsbearing", "sweep", "b218", "--samples", str(count)]
        given += [f"--vary={key}={values}" for key, values in RANDOM.items()]
        given += ["--out", str(tmp_path / f"{count}.nc"), "--plot", str(tmp_path / f"{count}.png")]
        code = f"import resource, subprocess as s; s.run({given!r}, check=True, stdout=s.DEVNULL); "
        code += "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
        return float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)

    assert peak(6_000_000) < 1.15 * peak(1_500_000)
