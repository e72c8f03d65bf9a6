"""Usual words and symbols for keys of a scene file that are called otherwise there."""

from __future__ import annotations

import re
from typing import NamedTuple

_KEYS = {
    "ball_count": "z balls n_balls nballs num_balls number_of_balls",
    "ball_diameter_mm": "dw d_w ball_dia ball_size",
    "pitch_diameter_mm": "dpw d_pw dm d_m pitch_dia pcd pitch_circle_diameter mean_diameter",
    "bore_diameter_mm": "bore bore_dia inner_diameter inside_diameter",
    "outside_diameter_mm": "od outer_diameter outside_dia",
    "free_contact_angle_deg": "alpha alpha0 alpha_0 contact_angle nominal_contact_angle",
    "diametral_clearance_mm": "pd p_d clearance",
    "inner_groove_radius_mm": "ri r_i inner_radius inner_raceway_radius",
    "outer_groove_radius_mm": "ro r_o re r_e outer_radius outer_raceway_radius",
    "speed_rpm": "rpm n shaft_speed inner_speed rotational_speed",
    "axial_load_N": "fa f_a thrust thrust_load axial_force",
    "radial_load_y_N": "fr f_r radial_load radial_force",
    "dynamic_load_rating_N": "c cr c_r dynamic_rating basic_dynamic_load_rating",
    "static_load_rating_N": "c0 c_0 c0r static_rating basic_static_load_rating",
}
_TWO_ROWS = "as a set: two [[rows]], one that carries +x and one that carries -x"
_OTHER_KINDS = {
    "four point|4 point|three point|split ring|qj": (
        'It is kind = "four_point", with inner_shim_mm and outer_shim_mm or axial_clearance_mm, moved by friction '
        "(`qsbearing guide ball_axis#four-point-bearings`). At rest, under moments and free tilts, it is described "
        f"{_TWO_ROWS}, at the same position_mm (`qsbearing guide sets#a-four-point-bearing-at-rest`)"
    ),
    "double row|two row": f"A double-row bearing is described {_TWO_ROWS}, at the distance of their ball centres",
    "self aligning|spherical|roller|taper|needle|cylindrical|thrust ball": (
        "Only rows of balls in grooved raceways are modelled: angular_contact, of contact angles up to 85 deg, and "
        "deep_groove"
    ),
}
_COEFFICIENT = "groove_radius_coefficient"
_OF_GROOVES = ("conformity", "osculation", "curvature", "curvature_ratio", "groove_curvature")
_PRELOADS = ("preload", "preload_force", "axial_preload")
_UNIT = re.compile(r"_(?:mm|um|m|deg|rad|rpm|n|kn)$")


class Usual(NamedTuple):
    """The key that a usual word stands for."""

    key: str
    definition: str = ""
    """Where the word is also used for another number."""

    def __str__(self) -> str:
        return f"{self.key}, {self.definition}" if self.definition else self.key


def _all() -> dict[str, Usual]:
    by_word = {word: Usual(key) for key, words in _KEYS.items() for word in words.split()}
    is_over = "the groove radius over the ball diameter, such as 0.52"
    by_word |= {"f": Usual(_COEFFICIENT, is_over)} | {word: Usual(_COEFFICIENT, is_over) for word in _OF_GROOVES}
    for side in ("inner", "outer"):
        of_side = Usual(f"{side}_{_COEFFICIENT}", is_over)
        by_word |= dict.fromkeys((f"f{side[0]}", f"f_{side[0]}"), of_side)
        by_word |= {each: of_side for word in _OF_GROOVES for each in (f"{side}_{word}", f"{word}_{side}")}
    by_word["radial_clearance"] = Usual("diametral_clearance_mm", "the whole play, from stop to stop")
    return by_word


WORDS = _all()


def usual(name: str) -> Usual | None:
    """What a word stands for, in capitals or not, with a unit behind it or not; None: it is none of these."""
    word = name.lower()
    return WORDS.get(word) or WORDS.get(_UNIT.sub("", word))


def is_preload(name: str) -> bool:
    """Whether it is a word for a preload, which has a table of its own."""
    return _UNIT.sub("", name.lower()) in _PRELOADS


def other_kind(value: object) -> str:
    """What can be done about a kind of bearing that is not one of the choices; empty of any other word."""
    word = value.lower().replace("_", " ").replace("-", " ") if isinstance(value, str) else ""
    return next((told for words, told in _OTHER_KINDS.items() if any(each in word for each in words.split("|"))), "")
