"""The heat balance: temperatures, heat and its paths, and the steady states over speed."""

from __future__ import annotations

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Paragraph, Section
from qsbearing.model.solution.of_cases import SolutionOfCases
from qsbearing.model.units import rpm
from qsbearing.pictures.heat import over_speed
from qsbearing.results.thermal_report import (
    speeds_record,
    speeds_table,
    thermal_record,
    thermal_tables,
    whole_bearing_record,
)
from qsbearing.systems.heat.state import ThermalState


def glance(state: ThermalState | None) -> Section | None:
    """Of page 1: the temperatures over the speed, with where they run away; None without a heat balance or a curve."""
    if state is None:
        return None
    speeds = speeds_record(state)
    if not speeds["states"]:
        return None
    figure = over_speed(speeds, float(state.speed) / rpm, whole=whole_bearing_record(state), height=LOW)
    alt = "Temperatures and axial loads of the steady states over speed; the speed of the scene and runaway are marked."
    caption = "Temperatures and axial load of the steady states over speed"
    return Section("Temperatures over the speed", [picture(figure, alt, caption)], "temperatures")


LOW = 3.4
"""Height of that picture [inches]."""


def sections(solution: SolutionOfCases) -> list[Section]:
    """Of a single case; none without a heat balance."""
    state: ThermalState | None = solution.thermal
    if state is None:
        return []
    speeds, whole = speeds_record(state), whole_bearing_record(state)
    blocks = thermal_tables(thermal_record(solution))
    if speeds["states"]:
        blocks.append(speeds_table(speeds))
    said = [speeds["message"], *([] if whole is None else [whole["message"]])]
    return [Section("Heat balance", [*blocks, *map(Paragraph, said)])]
