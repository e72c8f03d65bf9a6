"""A bearing's designation read by its parts: maker, prefix, series and bore code, and what stands behind them.

A suffix means what its maker says: C is 15 degrees with all, E 25 degrees with some and an inner design with others.
Without a maker a suffix counts only where all who use it mean the same.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from qsbearing.inference.iso15 import table

LONGEST = 60
"""Letters of a text that may be a designation."""
_BORES = {"00": 10.0, "01": 12.0, "02": 15.0, "03": 17.0}
_PARTS = re.compile(
    r"(E2\.|(?:\d[A-Z]+-)*[A-Z]*(?:-[A-Z]+)*)-?(\d+)(?:([/-])(\d+(?:\.\d+)?)(?![A-Z]*\d*[RZ]))?(.*)", re.ASCII
)
_SNFA = re.compile(r"(SE[AB]|VE[BX]|EX|E-?2)(?:/[A-Z]+)*-?(\d+)(?:[-/].*?\d?(CE[13].*)?)?", re.ASCII)
_TOLERANCE = re.compile(r"P4[ASY]?|P[256](?!\d)|ABEC-?[13579]")
_CLEARANCE = re.compile(r"(?<!H)C[2-5](?!\d)|(?<![A-Z0-9])CN(?![A-Z0-9])")
_CERAMIC = re.compile(r"\bHC5?(?![A-BD-Z0-9])|SN24|\bHYBRID\b")
_PLAIN = ("", "S", "KH", "HYS", "HYKH")
"""Prefixes of the catalogue's spindle bearings."""
_SET = re.compile(r"(D[BFTGU]|[SU]U|U[AD]|T[BFTGU]T?|Q[BFTGU]C?|DD|FF|U)(EL|[A-DLMHSF])?(?![A-Z])")


@dataclass(frozen=True)
class Designation:
    """What a designation tells; lengths in mm, as in a file."""

    text: str
    what: str = ""
    """Of a bearing that is not modelled as one row of balls: what it is, with its article."""
    instead: str = ""
    """Of such a bearing: what can be done, a sentence without its end."""
    maker: str = ""
    """Empty: not said, nor told by a prefix or suffix that only one maker has."""
    prefix: str = ""
    is_prefix_known: bool = True
    """Whether the prefix is one of the maker's, or of no other's; what else it may mean, nobody here knows."""
    suffix: str = ""
    """The letters that `angles` are the meanings of."""
    series: str = ""
    """As GMN, SKF and FAG number it: 719, not 79; of SNFA its letters."""
    dimension_series: str = ""
    kind: str = ""
    bore: float = 0.0
    outside: float | None = None
    width: float | None = None
    """None, as the outside diameter: not in the table of ISO 15's boundary dimensions."""
    angle: float | None = None
    """Free contact angle [deg]; None: not told, and of a deep-groove bearing it follows from the clearance."""
    angles: tuple[tuple[str, float], ...] = ()
    """Where makers differ: what the suffix means with each."""
    ball_material: str = ""
    """Empty: not told."""
    arrangement: str = ""
    """Of a set that is sold as one: DB, DF, ..."""
    preload: str = ""
    """light, medium or heavy, of a set; empty: not told."""
    tolerance_class: str = ""
    clearance_class: str = ""
    """Of a deep-groove bearing: C2 to C5; empty: not told, which is the normal class."""
    letters: str = ""
    """Those that tell the angle: UC, ACD."""
    is_light: bool = False
    """Whether it is of a series that is known for balls smaller than the usual."""
    ignored: str = ""
    """What is left: cage, seals, lubrication, as it is written."""
    is_plain: bool = False
    """Whether it may be an entry of the catalogue, whose spindle bearings are GMN's: no other maker is told."""

    @property
    def is_refused(self) -> bool:
        return bool(self.what)

    @property
    def given(self) -> dict[str, Any]:
        """What it says in the words of a file's [bearing]; rings, and balls of which it says nothing, are of steel."""
        bearing = {
            "kind": self.kind, "bore_diameter_mm": self.bore, "outside_diameter_mm": self.outside,
            "width_mm": self.width, "free_contact_angle_deg": self.angle,
            "ball_material": self.ball_material or "steel", "ring_material": "steel",
        }  # fmt: skip
        return {key: value for key, value in bearing.items() if value is not None}

    @property
    def size(self) -> str:
        """Boundary dimensions and kind in words."""
        parts = [self.bore] if self.outside is None else [self.bore, self.outside, self.width]
        size = " x ".join(f"{each:g}" for each in parts)
        kind = {"deep_groove": "deep-groove", "angular_contact": "angular-contact"}[self.kind]
        series = f"ISO 15, dimension series {self.dimension_series}"
        bore = " bore" if self.outside is None else ""
        return f"{'a' if self.kind == 'deep_groove' else 'an'} {kind} bearing of {size} mm{bore} ({series})"

    @property
    def unused(self) -> str:
        """What of it tells nothing of one row of balls at rest in its own right, as a list in words."""
        parts = [
            "" if self.is_prefix_known else f"prefix {self.prefix}, which is not known here",
            self.arrangement and f"set {self.arrangement}: one row is described, [[rows]] makes a set",
            self.preload and f'preload class: write preload = "{self.preload}" or [preload]',
            self.tolerance_class and f"{self.tolerance_class}, except for fits by name",
            self.clearance_class and f"{self.clearance_class}, without clearance_class",
            self.ignored,
        ]
        return "; ".join(part for part in parts if part)


@cache
def _facts() -> dict[str, Any]:
    return tomllib.loads(Path(__file__).with_name("designations.toml").read_text("utf-8"))


def angles_of(maker: str) -> dict[str, float]:
    """The angle [deg] of each suffix that means one with a maker."""
    return {code: angle for code, angle in _facts()["angles"].get(maker, {}).items() if code and angle}


@lru_cache(1000)
def read(text: str) -> Designation | None:
    """What a text tells as a designation; None where it is none."""
    facts = _facts()
    words = text.upper()[:LONGEST].replace("_", " ").split()
    maker = next((each for each in (*facts["angles"], *facts["other"]["makers"]) if each in words), "")
    plain = "-".join(word for word in words if word != maker)
    if maker in ("", "SNFA") and (parts := _SNFA.fullmatch(plain)):
        letters, bore, rest = parts[1].replace("-", ""), float(parts[2]), parts[3] or ""
        return _completed(text, "SNFA", "", letters, facts["letters"][letters], "angular_contact", bore, rest)
    parts = _PARTS.fullmatch(plain)
    if parts is None:
        return None
    prefix, number, mark, own_bore, rest = parts.groups(default="")
    prefix = prefix.replace("-", "").rstrip(".")
    beginning = prefix + number + (mark + own_bore + rest)
    for each in facts["refused"]:
        if re.match(each["pattern"], beginning):
            return Designation(text, what=each["what"], instead=each["instead"], maker=maker)
    if number in facts["series"] and own_bore:
        series, bore = number, float(own_bore)
    else:
        rest = mark + own_bore + rest
        series, code = (number[:-2], number[-2:]) if len(number) > 3 else (number[:2], number[2:])
        size = _BORES.get(code, 5.0 * int(code) if 4 <= int(code or 0) <= 96 else 0.0) if len(number) > 3 else None
        bore = float(code or 0) if size is None else size
    dimension_series, kind = facts["series"].get(series, ("", ""))
    if not bore or not kind or (len(number) == 3 and not own_bore and (dimension_series, bore) not in table()):
        return None
    if prefix in facts["prefixes"]["GMN"] and re.match(r"[-/]?[CE](?!\d)", rest):
        maker, series, kind = maker or "GMN", f"7{series[1:]}", "angular_contact"
    is_own = len(series) == 2 and series[1] in "89"
    series = f"{series[0]}1{series[1]}" if is_own else series
    maker = maker or ("FAG" if prefix in facts["prefixes"]["FAG"] and kind == "angular_contact" else "")
    designation = _completed(text, maker, prefix, series, dimension_series, kind, bore, rest)
    return designation if not is_own else Designation(**{**vars(designation), "is_plain": False})


def _completed(
    text: str, maker: str, prefix: str, series: str, dimension_series: str, kind: str, bore: float, rest: str
) -> Designation:
    """With what the table of dimensions and the suffix tell."""
    facts = _facts()
    outside, width = table().get((dimension_series, bore), (None, None))
    rest = rest.lstrip("-/")
    angle: float | None = None
    angles: tuple[tuple[str, float], ...] = ()
    suffix = letters = ""
    if kind == "angular_contact":
        letters = rest
        maker, angle, angles, suffix, rest = _angle(maker, prefix, rest)
        letters = "" if angle is None else letters[: len(letters) - len(rest)].rstrip("-/")
    clearance, rest = _taken(_CLEARANCE, rest) if kind == "deep_groove" else (None, rest)
    tolerance, rest = _taken(_TOLERANCE, rest)
    as_set, rest = _taken(_SET, rest)
    arrangement, preload = (as_set[1], as_set[2] or "") if as_set else ("", "")
    classes = [facts["preload"].get(maker, {})] if maker else list(facts["preload"].values())
    meant = {each[preload] for each in classes if preload in each}
    ceramic, rest = _taken(_CERAMIC, rest)
    is_ceramic = prefix in facts["prefixes"]["ceramic"] or ceramic is not None
    owners = {each for each, names in facts["prefixes"].items() if prefix in names}
    of_maker = maker in owners if maker else bool(owners) and kind == "angular_contact"
    is_known = not prefix or "ceramic" in owners or of_maker
    ignored = " ".join(filter(None, re.split(r"[-/]+", rest)))
    return Designation(
        text, maker=maker, prefix=prefix, is_prefix_known=is_known, suffix=suffix,
        series=series, dimension_series=dimension_series, kind=kind, bore=bore,
        outside=outside, width=width, angle=angle, angles=angles, ball_material="silicon nitride" * is_ceramic,
        clearance_class=clearance[0] if clearance else "", letters=letters,
        is_light=bool({prefix, letters, series} & {*facts["light"].get(maker, ())} - {""}),
        arrangement=arrangement, preload=meant.pop() if len(meant) == 1 else "",
        tolerance_class=tolerance[0].replace("-", "") if tolerance else "", ignored=ignored,
        is_plain=maker in ("", "GMN") and prefix in _PLAIN and ignored in ("", "TA"),
    )  # fmt: skip


def _angle(maker: str, prefix: str, rest: str) -> tuple[str, float | None, tuple[tuple[str, float], ...], str, str]:
    """Maker, angle, angles by maker where these differ, the letters that mean these, and the suffix without those of
    the angle."""
    facts = _facts()
    tables = {maker: facts["angles"].get(maker, {})} if maker else facts["angles"]
    if prefix in facts["series_angles"]:
        tables = {"GMN": facts["series_angles"][prefix]}
    begun = {each: [code for code in codes if rest.startswith(code)] for each, codes in tables.items()}
    longest = max((len(code) for codes in begun.values() for code in codes), default=0)
    if not longest and rest[:1].isalpha() and not (_TOLERANCE.match(rest) or _SET.match(rest)):
        return maker, None, (), "", rest  # letters that are no maker's for an angle
    of = {each: tables[each][rest[:longest]] for each, codes in begun.items() if rest[:longest] in codes}
    meant = {angle for angle in of.values() if angle}
    is_told = len(meant) == 1 and all(of.values()) and (longest or maker)
    only = next(iter(of)) if len(of) == 1 and (longest or maker) else maker
    if is_told:
        return only, meant.pop(), (), "", rest[longest:].lstrip("-/")
    return maker, None, tuple((each, angle) for each, angle in of.items() if angle), rest[:longest], rest


def _taken(pattern: re.Pattern[str], rest: str) -> tuple[re.Match[str] | None, str]:
    """A part of the suffix, and what is left without it."""
    match = pattern.search(rest)
    return match, rest if match is None else f"{rest[: match.start()]}-{rest[match.end() :]}"
