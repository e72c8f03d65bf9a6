"""What is committed was made from the source as it is; the release gate and CI make it again and compare the bytes."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec

import pytest

from qsbearing.model.compiler.library import FOLDER, OWN, ROOT
from tests.verification.kernel_library import build, inputs


def test_it_is_of_this_source() -> None:
    """While the kernel is worked on, one's own library is instead; CI asks for the committed ones."""
    faults = build.faults()
    if faults and build.is_current(OWN):
        pytest.skip(faults[0])
    assert faults == []


def test_numbers_that_the_kernel_takes_from_other_files_count() -> None:
    """A constant of `passes.py`, which marks nothing, is in a reading's machine code."""
    assert {"qsbearing/readings/passes.py", "qsbearing/model/kernel/case.py"} <= set(inputs.sources())
    assert all((ROOT / name).exists() for name in inputs.sources())


@pytest.mark.heavy
@pytest.mark.skipif(find_spec("ziglang") is None, reason="needs the extra `kernel`")
def test_made_again_it_has_the_same_bytes() -> None:
    command = [sys.executable, "-m", "tests.verification.kernel_library", "compare"]
    subprocess.run(command, check=True, cwd=ROOT)


def test_there_is_one_for_every_platform_that_is_named() -> None:
    page = (ROOT / "qsbearing" / "guide" / "timing.md").read_text(encoding="utf-8")
    for name in ("Linux, x86-64", "Linux, aarch64", "macOS, arm64 and x86-64", "Windows, x86-64"):
        assert f"| {name} |" in page
    if not build.faults():
        assert len(list(FOLDER.glob("kernel-*"))) == 5
