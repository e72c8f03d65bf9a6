"""How much memory a run will need, how much there is, how much it took."""

from __future__ import annotations

from pathlib import Path

from qsbearing.studies.cost.measuring import peak_MB

__all__ = ["available_MB", "estimate_MB", "peak_MB", "restart_peak"]

# Measured peaks of one contact (MB): see `estimate_MB`.
BASE_MB = 260.0
PER_DOF_MB = 0.019
PER_FILL_MB = 6.0e-5
FILL_POWER = 4.0 / 3.0


def estimate_MB(dofs: int) -> float:
    """Peak memory of condensing a body with so many unknowns.

    Base plus matrix (linear) plus factor (nested dissection in space: dofs^(4/3)); the constants bound the peaks
    measured with rslab on blocks of 4 000 to 88 000 unknowns. Without it SuperLU takes up to twice as much.
    """
    return BASE_MB + PER_DOF_MB * dofs + PER_FILL_MB * dofs**FILL_POWER


def available_MB() -> float | None:
    """Memory that can still be had; None where the system does not say."""
    path = Path("/proc/meminfo")
    if not path.is_file():
        return None
    for line in path.read_text().splitlines():
        if line.startswith("MemAvailable:"):
            return float(line.split()[1]) / 1024.0
    return None


def restart_peak() -> None:
    """Count the peak from here on, where the system allows it."""
    try:
        Path("/proc/self/clear_refs").write_text("5")
    except OSError:
        return
