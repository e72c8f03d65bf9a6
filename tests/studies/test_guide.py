"""The guide's page on studies: its file solves, its code runs."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import qsbearing as qs

pytest.importorskip("xarray")
PAGE = (Path(qs.__file__).parent / "guide" / "studies.md").read_text(encoding="utf-8")


def test_the_study_file_solves(tmp_path: Path) -> None:
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, flags=re.DOTALL)
    path = tmp_path / "my.toml"
    path.write_text(text, encoding="utf-8")
    results = qs.sweep(qs.Study.of(path))
    assert dict(results.sizes) == {"speed_rpm": 15, "ball_count": 3, "sample": 64, "ball": 16}
    assert (results["status"] == 0).all()


def test_the_code_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    exec(compile(code, "studies.md", "exec"), {})
    first, second = capsys.readouterr().out.splitlines()
    assert float(first) == pytest.approx(59.92, abs=0.01)
    assert len(second.strip("[]").split()) == 2
