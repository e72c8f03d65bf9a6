"""Sets whose rows have elastic rings, each its own: every row is its bearing alone, where the set puts it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import qsbearing as qs

PAIR = """
[bearing]
name = "7210C"
[[rows]]
position_mm = 0
carries = "+x"
{of_first}
[[rows]]
position_mm = 20
carries = "-x"
[operation]
speed_rpm = {speed}
axial_load_N = 200
radial_load_y_N = {radial}
moment_z_Nm = 0
[preload]
rigid_N = 720
[effects]
{effects}
"""
AT_SPEED = 'ball = ["centrifugal_force", "gyroscopic_moment"]\nraceway_control = "outer"\n'
RING = '{outside_diameter_mm = 90, width_mm = 20, housing = "free"}'


@pytest.mark.parametrize("radial", [0, 500])
@pytest.mark.parametrize("speed", [0, 10000])
@pytest.mark.parametrize("where", ["all", "first"])
def test_rows_alone(where: str, speed: int, radial: int, tmp_path: Path) -> None:
    of_first = f"[rows.elastic_rings]\nouter = {RING}" if where == "first" else ""
    effects = AT_SPEED if speed else ""
    effects += f"[effects.elastic_rings]\nouter = {RING}\n" if where == "all" else ""
    path = tmp_path / "pair.toml"
    path.write_text(PAIR.format(of_first=of_first, speed=speed, radial=radial, effects=effects))
    found = qs.solve_set(qs.load_set(path))
    assert found.converged
    total = np.zeros(2)
    for number, row in enumerate(found.rows):
        assert (row.scene.elastic_rings is not None) == (where == "all" or number == 0)
        alone = qs.solve(row.scene)
        np.testing.assert_allclose(alone.inner.load, row.inner.load, rtol=1e-7, atol=1e-6)
        if row.groove_deflection is not None:
            assert alone.groove_deflection is not None
            assert np.nanmax(row.groove_deflection) > 0.1 * qs.um
            np.testing.assert_allclose(row.groove_deflection, alone.groove_deflection, rtol=1e-7, atol=1e-13)
        total += (1.0 if number == 0 else -1.0) * alone.load[0], alone.load[1]
    assert total == pytest.approx([200.0, radial], abs=1e-4)
