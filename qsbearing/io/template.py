"""A commented scene file to start from; what it says is a scene that solves."""

from __future__ import annotations

from typing import Any

from qsbearing.io.catalogue import Entry

_EXPLAINED = {
    "kind": "angular_contact | deep_groove (shoulders on both sides)",
    "ball_count": "Z",
    "ball_diameter_mm": "D",
    "pitch_diameter_mm": "dm, of the circle of ball centres",
    "inner_groove_radius_mm": "across the groove; more than half the ball diameter",
    "free_contact_angle_deg": "or diametral_clearance_mm = ...: either defines the other",
    "diametral_clearance_mm": "or free_contact_angle_deg = ...: either defines the other",
    "ball_material": 'or "silicon nitride", {elastic_modulus_GPa = 208, poisson_ratio = 0.3, density_kg_m3 = 7800}',
}

_BEARING_BY_NAME = """\
# The catalogue's values; `qsbearing catalogue {name}` tells where they come from. Take away a # and change the
# number to replace one.
"""

_CHANNELS = """\
# Five channels; each has its load or its displacement, never both. One left out carries no load and is free.
#   axial_load_N      or  axial_displacement_um
#   radial_load_y_N   or  radial_displacement_y_um       likewise _z
#   moment_z_Nm       or  tilt_z_mrad                    likewise _y
# x is the axis, y and z are radial, tilts are right-handed about y and z. A radial load along y tilts the ring about
# z: state moment_z_Nm = 0 (free to tilt) or tilt_z_mrad = 0 (fixed by a stiff shaft). Along z, the same about y.
"""

_EFFECTS = """\
# Only what is named here is evaluated. Without ball effects leave raceway_control out: the scene is then static.
"""

_POSSIBLE_OPERATION = """\
# outer_speed_rpm = 0
# radial_load_y_N = 1000
# tilt_z_mrad = 0
# first_ball_azimuth_deg = 0     # from +y towards +z; the other balls follow evenly
"""

_POSSIBLE_EFFECTS = """\
# ball = ["centrifugal_force", "gyroscopic_moment"]
# raceway_control = "outer"      # outer | inner | per_ball; ball effects need it
# moment_shares = "controlling"  # of the gyroscopic moment: controlling (all on the controlling raceway) | harris
# hertz_angle = "free"           # contact angle of the rolling curvature: free | actual | zero
# hertz_form = "exact"           # or the closed forms brewe_hamrock_1977 | hamrock_brewe_1983
# tilt_lever = "groove_centre"   # lever of a tilt: groove_centre | pitch_circle
"""


def scene_template(entry: Entry, by_name: bool) -> str:
    """The text of a scene file around a catalogue entry.

    Args:
        by_name: name the entry and leave its values as comments; else spell them all out, ready to be changed.
    """
    operation, effects = entry.example["operation"], entry.example["effects"]
    file = f"{entry.name.lower()}.toml"
    return "\n".join(
        [
            f"# {entry.description}.\n# Run it with: qsbearing run {file}\n",
            "[bearing]\n" + _bearing(entry, by_name),
            "[operation]\n" + _CHANNELS + _given_and_possible(operation, _POSSIBLE_OPERATION),
            "[effects]\n" + _EFFECTS + _given_and_possible(effects, _POSSIBLE_EFFECTS),
        ]
    )


def _bearing(entry: Entry, by_name: bool) -> str:
    head = f"name = {_toml(entry.name)}\n{_BEARING_BY_NAME.format(name=entry.name)}" if by_name else ""
    mark = "# " if by_name else ""
    lines = []
    for key, value in entry.bearing.items():
        line, note = f"{mark}{key} = {_toml(value)}", _EXPLAINED.get(key, "")
        width = 35 if len(note) < 80 else 0
        lines.append(f"{line:<{width}}  # {note}\n" if note and len(line) + len(note) <= 120 else f"{line}\n")
    return head + "".join(lines)


def _given_and_possible(given: dict[str, Any], possible: str) -> str:
    """The keys that are given, with the comment of the possible ones; and those not given, as comments."""
    notes = {line[2:].partition(" = ")[0]: line for line in possible.splitlines(keepends=True)}
    text = ""
    for key, value in given.items():
        note = notes.pop(key, "").partition("  #")[2].rstrip()
        text += f"{key} = {_toml(value)}".ljust(31 if note else 0) + (f"  #{note}\n" if note else "\n")
    return text + "".join(notes.values())


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)
