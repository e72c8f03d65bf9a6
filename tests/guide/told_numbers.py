"""Numbers in the sentences beside an example: each is what the example prints, or what stands in it."""

from __future__ import annotations

import re
from collections.abc import Iterator

FROM_ELSEWHERE = {
    "ball_axis.md": {"1051 N": "of another model, with one arc a ring"},
    "cage_and_grease.md": {
        **dict.fromkeys(("52,000 rpm", "76,400 rpm"), "published"),
        **dict.fromkeys(("203 GPa", "52,040 rpm", "76,000 rpm"), "of other materials than the example's"),
    },
    "design.md": dict.fromkeys(("81,859.7 N", "21.4256 mm"), "the case bearing_design of the validation book"),
    "elastic_rings.md": {"3495 N": "of the same scene with rigid rings"},
    "finite_elements.md": {"50.8 mm": "a ball of another contact"},
    "how_to.md": {
        **dict.fromkeys(("250 °C", "−253 °C", "250 mm"), "ends of a range"),
        "130 N": "of a scene with another load",
    },
    "rotor_dynamics.md": {
        **dict.fromkeys(("32.2 N/µm", "39.6 N/µm"), "in the file written, and at each azimuth"),
        **dict.fromkeys(
            ("300 mm", "116 %", "1.65 kN", "5,000 rpm", "10,000 %"),
            "of test_springs.py",
        ),
    },
    "spindle.md": {
        "210 mm": "between points of the sweep",
        **dict.fromkeys(("25,443 rpm", "25,304 rpm", "24,672 rpm"), "printed where ROSS is installed"),
    },
}
"""Numbers beside an example that it does not give, by page, with where they are from."""
_NUMBER = r"(?<![\w.,/^])[−-]?\d[\d,]*(?:\.\d+)?(?![\d,]*\d)"
_UNIT = r"(?:µm|mm|N/µm|N m|kN|N|MPa|GPa|°C|°|degrees|rpm|mrad|kW|W|%|K|million revolutions)(?![\w/])"
_TOLD = re.compile(rf"({_NUMBER})(?:(?: to | and |, | or )({_NUMBER}))*\s?({_UNIT})")
_SCALES = {"kN": 1e3, "kW": 1e3, "%": 1e-2, "million revolutions": 1e6}
"""By which a printed number may be larger."""


def told(sentences: str) -> Iterator[tuple[str, str]]:
    """Numbers of three digits and more with their units; before one unit there may be several."""
    plain = re.sub(r"<!-- (.+?): made by .*?<!-- end of \1 -->|`[^`]*`|\$[^$]*\$", "", sentences, flags=re.DOTALL)
    for found in _TOLD.finditer(re.sub(r"\s+", " ", plain)):
        for text in re.findall(_NUMBER, found[0]):
            if len(re.sub(r"\D", "", text).lstrip("0")) >= 3:
                yield text, found[3]


def numbers(text: str) -> set[float]:
    """All that a text has, without their signs."""
    found = re.findall(r"(?<![\w.])[−-]?(\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?)", text)
    return {float(each.replace(",", "")) for each in found}


def unfounded(sentences: str, example: str) -> list[str]:
    """Numbers that the example neither prints nor has, rounded as they are told."""
    known = numbers(example)
    return [
        f"{text} {unit}"
        for text, unit in told(sentences)
        if not any(_is_rounded(text, each / scale) for each in known for scale in {1.0, _SCALES.get(unit, 1.0)})
    ]


def _is_rounded(text: str, value: float) -> bool:
    """To the last digit that is told; of whole numbers with more than four digits, zeros at the end may be none."""
    number = text.lstrip("−-").replace(",", "")
    decimals = len(number.partition(".")[2])
    if not decimals:
        decimals = -min(len(number) - len(number.rstrip("0")), max(0, len(number) - 4))
    return abs(float(number) - value) <= 0.5 * 10.0**-decimals * (1.0 + 1e-9)
