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


def sections(solution: SolutionOfCases) -> list[Section]:
    """Of a single case; none without a heat balance."""
    state: ThermalState | None = solution.thermal
    if state is None:
        return []
    speeds, whole = speeds_record(state), whole_bearing_record(state)
    blocks = thermal_tables(thermal_record(solution))
    if speeds["states"]:
        drawn = picture(
            over_speed(speeds, float(state.speed) / rpm, whole=whole),
            "Temperatures and axial loads of the steady states over speed; the speed of the scene is marked.",
            "Temperatures and axial load of the steady states over speed",
        )
        blocks += [drawn, speeds_table(speeds)]
    said = [speeds["message"], *([] if whole is None else [whole["message"]])]
    return [Section("Heat balance", [*blocks, *map(Paragraph, said)])]
