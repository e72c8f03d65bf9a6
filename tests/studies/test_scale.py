"""Killed and resumed, on a cluster, with a worker that dies: the results are the same. Real processes; minutes long."""

from __future__ import annotations

import json
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.studies.points import Points
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep

xarray = pytest.importorskip("xarray")

VARY = {
    "ball_diameter_mm": "normal(22.225,0.001)",
    "inner_groove_radius_mm": "normal(11.6281,0.01)",
    "free_contact_angle_deg": "normal(40,0.3)",
    "axial_load_N": [2000, 8000],
}
SAMPLES = 60_000
COMMAND = [sys.executable, "-m", "qsbearing", "sweep", "b218", "--samples", str(SAMPLES)]
for _key, _values in VARY.items():
    COMMAND += ["--vary", f"{_key}={_values}".replace("[", "").replace("]", "")]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("whole") / "r.nc"
    sweep(Study.of("b218", VARY, samples=SAMPLES), out=out).close()
    return out


@pytest.mark.heavy
def test_killed_at_ten_moments_and_resumed_gives_the_identical_file(whole: Path, tmp_path: Path) -> None:
    out, parts = tmp_path / "r.nc", tmp_path / "r.nc.parts"
    moments = random.Random(1)
    chunks = Points(Study.of("b218", VARY, samples=SAMPLES)).chunk_count
    began = time.monotonic()
    subprocess.run([*COMMAND, "--out", str(tmp_path / "first.nc")], capture_output=True, check=True)
    duration = time.monotonic() - began
    (tmp_path / "first.nc").unlink()
    kept: list[int] = []
    while len(kept) < 10:
        running = subprocess.Popen(
            [*COMMAND, "--out", str(out), "--resume"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        try:
            running.wait(moments.uniform(0.4, 1.0) * duration)
        except subprocess.TimeoutExpired:
            running.send_signal(signal.SIGKILL)
            running.wait()
            kept.append(len(list(parts.glob("*.npz"))))
        else:  # it was through before it was killed: once more from the beginning
            assert out.read_bytes() == whole.read_bytes()
            out.unlink()
    assert any(0 < count < chunks for count in kept), "killed in the middle"
    done = subprocess.run([*COMMAND, "--out", str(out), "--resume"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert out.read_bytes() == whole.read_bytes()
    assert [file.name for file in tmp_path.iterdir()] == ["r.nc"]


@pytest.fixture
def scheduler(tmp_path: Path) -> Iterator[tuple[str, list[subprocess.Popen]]]:
    """A scheduler and two workers, each a process of its own."""
    pytest.importorskip("distributed")
    contact = tmp_path / "scheduler.json"
    dask = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--port", "0", "--no-dashboard"]
    worker = [sys.executable, "-m", "distributed.cli.dask_worker", "--nthreads", "1", "--no-dashboard", "--no-nanny"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": tmp_path}
    started = [subprocess.Popen([*dask, "--scheduler-file", str(contact)], **quiet)]  # type: ignore[call-overload]
    deadline = time.monotonic() + 60
    while not contact.exists() and time.monotonic() < deadline:
        time.sleep(0.1)
    for _ in range(2):
        started.append(subprocess.Popen([*worker, "--scheduler-file", str(contact)], **quiet))  # type: ignore[call-overload]
    yield json.loads(contact.read_text())["address"], started
    for process in reversed(started):
        process.kill()
        process.wait()


@pytest.mark.heavy
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_gives_the_same_although_a_worker_dies(
    whole: Path, scheduler: tuple[str, list[subprocess.Popen]], tmp_path: Path
) -> None:
    address, processes = scheduler
    out = tmp_path / "r.nc"
    given = [*COMMAND, "--out", str(out), "--scheduler", address]
    running = subprocess.Popen(given, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    parts = tmp_path / "r.nc.parts"
    deadline = time.monotonic() + 240
    while len(list(parts.glob("*.npz"))) < 2 and time.monotonic() < deadline and running.poll() is None:
        time.sleep(0.02)
    processes[1].kill()
    _, said = running.communicate(timeout=300)
    assert running.returncode == 0, said
    with qs.open_results(out) as found, qs.open_results(whole) as expected:
        assert dict(found.sizes) == dict(expected.sizes)
        for name, values in expected.data_vars.items():
            np.testing.assert_array_equal(found[name], values, err_msg=str(name))


@pytest.mark.heavy
@pytest.mark.filterwarnings("ignore")
def test_a_scheduler_that_is_lost_is_said_and_finished_points_are_kept(
    whole: Path, scheduler: tuple[str, list[subprocess.Popen]], tmp_path: Path
) -> None:
    address, processes = scheduler
    out, parts = tmp_path / "r.nc", tmp_path / "r.nc.parts"
    given = [*COMMAND, "--out", str(out), "--scheduler", address]
    running = subprocess.Popen(given, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 240
    while len(list(parts.glob("*.npz"))) < 2 and time.monotonic() < deadline and running.poll() is None:
        time.sleep(0.02)
    processes[0].kill()
    _, said = running.communicate(timeout=300)
    assert running.returncode == 2, said
    assert "the cluster was lost" in said
    assert "Traceback" not in said
    assert len(list(parts.glob("*.npz"))) >= 2
    subprocess.run([*COMMAND, "--out", str(out), "--resume"], capture_output=True, check=True)
    assert out.read_bytes() == whole.read_bytes()


@pytest.mark.heavy
@pytest.mark.filterwarnings("ignore")
def test_workers_that_are_all_lost_are_said_and_waited_for_a_minute(
    scheduler: tuple[str, list[subprocess.Popen]], tmp_path: Path
) -> None:
    address, processes = scheduler
    given = [*COMMAND, "--out", str(tmp_path / "r.nc"), "--scheduler", address]
    running = subprocess.Popen(given, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 240
    while not list(tmp_path.glob("r.nc.parts/*.npz")) and time.monotonic() < deadline and running.poll() is None:
        time.sleep(0.02)
    for process in processes[1:]:
        process.kill()
    _, said = running.communicate(timeout=300)
    assert running.returncode == 2, said
    assert "waiting 60 s for one" in said
    assert "no worker for 60 s): finished points are kept" in said
    assert list(tmp_path.glob("r.nc.parts/*.npz"))
