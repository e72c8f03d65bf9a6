"""What is nothing beside the largest displacement is printed as 0, and kept in the record."""

from __future__ import annotations

from dataclasses import replace

import pytest

import qsbearing as qs
from qsbearing.results.json_record import record
from qsbearing.results.report import channels_table


def cells(solution: qs.Solution) -> dict[str, str]:
    """What is printed of each channel's displacement."""
    return {row[0]: row[1] for row in channels_table("Ring", solution, record(solution, {})).rows}  # type: ignore[index, misc]


@pytest.mark.parametrize("thrust", [100.0, 500.0])
def test_what_three_lobes_shift_across_is_printed_as_nothing(thrust: float) -> None:
    """Of sixteen balls, by the fifth power of lobe over approach alone: up to 5e-9 and 7e-12 of the axial shift."""
    scene = qs.load_scene("b218")
    lobes = qs.SeatsOutOfRound(outer_three_lobe_amplitude=1 * qs.um, outer_three_lobe_phase=0.3)
    operation = qs.Operation(scene.operation.speed, axial_load=thrust)
    solution = qs.solve(replace(scene, operation=operation, ring_effects=(lobes,)))
    printed, kept = cells(solution), record(solution, {})["displacement"]
    assert [printed[name] for name in ("radial y", "radial z", "tilt y", "tilt z")] == ["0"] * 4
    assert abs(kept["radial_z_um"]) > 1e-9


@pytest.mark.parametrize("part", [1e-6, 0.1])
def test_what_is_small_is_printed(part: float) -> None:
    operation = qs.Operation(
        axial_load=5e3, radial_displacement_y=part * 100e-6, radial_load_z=0.0, tilt_y=0.0, tilt_z=0.0
    )
    printed = cells(qs.solve(replace(qs.load_scene("b218"), operation=operation)))
    assert float(printed["radial y"]) == pytest.approx(100.0 * part)
