"""Packs what the tolerance ladder needs of the 50-digit reference: `python -m tests.benchmarks.truth`.

The package cannot import its tests, so five of the reference's scenes and their answers are kept beside the ladder, as
`qsbearing/cost/truth.json`; the numbers are those of `tests/reference/reference.json`, to all its digits.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from mpmath import mp, mpf

import qsbearing as qs
from tests.reference.generate import load_reference

TRUTH = Path(qs.__file__).parent / "cost" / "truth.json"
SCENES = (
    "b218_thrust_10000",
    "b218_combined_free_tilt",
    "b218_five_channels",
    "b218_combined_actual_angle",
    "spindle_hybrid_free_tilt_24000",
)
CHANNELS = {
    "x": ("axial_load", "axial_displacement"),
    "y": ("radial_load_y", "radial_displacement_y"),
    "z": ("radial_load_z", "radial_displacement_z"),
    "tilt_y": ("moment_y", "tilt_y"),
    "tilt_z": ("moment_z", "tilt_z"),
}
LENGTHS = ("ball_count", "ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")


def packed(entry: dict[str, Any]) -> dict[str, Any]:
    """One scene in the fields of `qsbearing.Scene`, and its answers; all numbers as decimal strings."""
    case, result = entry["case"], entry["result"]
    operation = {CHANNELS[name][kind == "displacement"]: value for name, (kind, value) in case["channels"].items()}
    return {
        "name": case["name"],
        "bearing": {key: str(case[key]) for key in (*LENGTHS, "free_contact_angle_deg")},
        "ball_material": case["ball_material"],
        "ring_material": case["ring_material"],
        "speed_rpm": case["inner_speed_rpm"],
        "operation": operation,
        "hertz_angle": case["hertz_angle"],
        "displacement": result["displacement"],
        "inner_load": [ball["inner"]["load"] for ball in result["balls"]],
        "outer_load": [ball["outer"]["load"] for ball in result["balls"]],
        "inner_angle": [ball["inner"]["angle"] for ball in result["balls"]],
        "outer_angle": [ball["outer"]["angle"] for ball in result["balls"]],
    }


def contact(entry: dict[str, Any]) -> dict[str, Any]:
    """The inner contact of a thrust-loaded B218: the curvatures that it has at the free angle, and its ellipse."""
    mp.dps = 40
    case, inner = entry["case"], entry["result"]["balls"][0]["inner"]
    ball, pitch, groove = (mpf(case[key]) for key in ("ball_diameter", "pitch_diameter", "inner_groove_radius"))
    cosine = mp.cos(mpf(case["free_contact_angle_deg"]) * mp.pi / 180)
    modulus = 1 / (
        (1 - mpf(case["ball_material"]["poisson_ratio"]) ** 2) / mpf(case["ball_material"]["elastic_modulus"])
    )
    keys = ("load", "approach", "semi_major_axis", "semi_minor_axis", "max_pressure")
    return {
        "what": "B218, inner raceway at the free contact angle",
        "curvature_x": mp.nstr(2 / (ball * (1 - ball / pitch * cosine)), 25),
        "curvature_y": mp.nstr(2 / ball - 1 / groove, 25),
        "effective_modulus": mp.nstr(modulus, 25),
        **{key: inner[key] for key in keys},
    }


def make() -> dict[str, Any]:
    """The whole file."""
    entries = {entry["case"]["name"]: entry for entry in load_reference()}
    return {
        "made_by": "python -m tests.benchmarks.truth",
        "source": "tests/reference: the full system of Jones and Harris, solved with 50 digits by mpmath",
        "contact": contact(entries["b218_thrust_10000"]),
        "scenes": [packed(entries[name]) for name in SCENES],
    }


def text() -> str:
    """The file's text."""
    return json.dumps(make(), indent=1) + "\n"


def main() -> None:
    """Write the file."""
    TRUTH.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    main()
