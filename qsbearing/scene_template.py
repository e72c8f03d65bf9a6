"""A commented scene file to start from; what it says is a scene that solves."""

from __future__ import annotations

from typing import Any

from qsbearing.catalogue import Entry

_EXPLAINED = {
    "ball_count": "Z",
    "ball_diameter_mm": "D",
    "pitch_diameter_mm": "dm, of the circle of ball centres",
    "inner_groove_radius_mm": "across the groove; more than half the ball diameter",
    "outer_groove_radius_mm": "",
    "free_contact_angle_deg": "or diametral_clearance_mm = ...: either defines the other",
    "diametral_clearance_mm": "or free_contact_angle_deg = ...: either defines the other",
    "ball_material": '"steel", "silicon nitride", or a table: {elastic_modulus_GPa = 208, poisson_ratio = 0.3, '
    "density_kg_m3 = 7800}",
    "ring_material": "",
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
# z: state moment_z_Nm = 0 (free to tilt) or tilt_z_mrad = 0 (held by a stiff shaft). Along z, the same about y.
"""

_OTHER_OPERATION = """\
# outer_speed_rpm = 0
# radial_load_y_N = 1000
# tilt_z_mrad = 0
# first_ball_azimuth_deg = 0     # from +y towards +z; the other balls follow evenly
"""

_EFFECTS = """\
# Only what is named here is evaluated. Without ball effects leave raceway_control out: the scene is then static.
"""

_OTHER_EFFECTS = """\
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
    file = f"{entry.name.lower()}.toml"
    operation = entry.example["operation"]
    parts = [
        f"# {entry.description}.\n# Run it with: qsbearing run {file}\n",
        "[bearing]\n" + _bearing(entry, by_name),
        "[operation]\n" + _CHANNELS + _lines(operation) + _others(_OTHER_OPERATION, operation),
        "[effects]\n" + _EFFECTS + _effects(entry.example["effects"]),
    ]
    return "\n".join(parts)


def _bearing(entry: Entry, by_name: bool) -> str:
    lines = ""
    if by_name:
        lines += f"name = {_toml(entry.name)}\n" + _BEARING_BY_NAME.format(name=entry.name)
    for key, value in entry.bearing.items():
        if key == "kind":
            line, note = f"kind = {_toml(value)}", "angular_contact | deep_groove (shoulders on both sides)"
        else:
            line, note = f"{key} = {_toml(value)}", _EXPLAINED.get(key, "")
        if len(line) + len(note) > 115:
            note = ""
        lines += f"{'# ' if by_name else ''}{line:<33}" + (f"  # {note}\n" if note else "\n")
    return "\n".join(line.rstrip() for line in lines.splitlines()) + "\n"


def _others(comment: str, given: dict[str, Any]) -> str:
    """The commented alternatives that are not already given."""
    lines = comment.splitlines(keepends=True)
    return "".join(line for line in lines if line.removeprefix("# ").partition(" ")[0] not in given)


def _effects(effects: dict[str, Any]) -> str:
    lines = _lines({"ball": effects.get("ball", [])})
    if effects.get("ball"):
        lines += f"{'raceway_control = ' + _toml(effects['raceway_control']):<32} # outer | inner | per_ball\n"
        others = _OTHER_EFFECTS
    else:
        lines = '# ball = ["centrifugal_force", "gyroscopic_moment"]\n'
        lines += '# raceway_control = "outer"      # outer | inner | per_ball; ball effects need it\n'
        others = _OTHER_EFFECTS
    more = {key: value for key, value in effects.items() if key not in ("ball", "raceway_control")}
    return lines + _lines(more) + _others(others, more)


def _lines(table: dict[str, Any]) -> str:
    return "".join(f"{key} = {_toml(value)}\n" for key, value in table.items())


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)
