"""Names that an example may use: keys of files, results, and whatever else has one."""

from __future__ import annotations

import inspect
import re
import tomllib
from collections.abc import Iterator
from functools import cache
from typing import Any

from qsbearing import pictures
from qsbearing.files.require_table import SPARE, PossibleResults, known_of
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.remarks.kinds import Severity
from qsbearing.studies.schema import file_schema
from tests.guide import interface
from tests.guide.pages import GUIDE, ROOT, blocks

OWN_WORDS = {"require", "shaft.points", "thermal", "vary"}
"""Tables with words of the reader's own as keys: names of results, points, nodes, paths."""
OF_OTHERS = {
    **dict.fromkeys(("run_campbell", "run_critical_speed"), "of ROSS"),
    **dict.fromkeys(("k_x_x_SI", "k_x_y_SI"), "columns of a table of force"),
    **dict.fromkeys(("k_radial_0Hz_N_per_m", "k_radial_1x_N_per_m"), "columns of a table of stiffness"),
    "axial_growth_um": "in the JSON of a shaft's points",
    "ball_diameter_deviation_um_3": "of one ball, in a study",
    "depth_um": "the key that the walk-through adds",
}
"""Names that none of the lists below has, with whose they are."""


@cache
def keys() -> frozenset[str]:
    """Of files, tables among them."""

    def below(node: Any) -> Iterator[str]:
        if isinstance(node, dict):
            yield from node.get("properties", ())
        for each in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
            yield from below(each)

    return frozenset(below(file_schema()))


def is_key(path: str) -> bool:
    """Whether `--set` and `--vary` take it: a key alone, or its path in a file."""
    parts = [part for part in path.replace('"', "").split(".") if not part.isdigit()]
    own = next((end for end in range(1, len(parts)) if ".".join(parts[:end]) in OWN_WORDS), len(parts))
    return all(part in keys() for part in parts[:own])


@cache
def possible() -> list[PossibleResults]:
    """Results of a spindle and of a heated bearing of the guide: of points, supports, nodes, rows and all readings."""
    found = []
    for page, file in {"spindle.md": "spindle.toml", "heat.md": "tight.toml"}.items():
        text = next(each.text for each in blocks(GUIDE / page) if each.text.startswith(f"# {file}\n"))
        found.append(known_of(scene_or_set_of(tomllib.loads(text), file)))
    return found


@cache
def is_result(name: str) -> bool:
    """Whether studies, limits or tables of results have it."""
    return any(each.places(name) for each in possible()) or name in {each.name for each in SPARE.results}


@cache
def words() -> frozenset[str]:
    """Whatever stays and has a name, with the arguments of public functions."""
    groups = [each for kind in interface.kept().values() for each in kind.items()]
    found = {name for group, names in groups for name in (*group.split("."), *names)} | set(pictures.__all__)
    for holder in (*interface.HOLDERS.values(), pictures):
        functions = filter(inspect.isfunction, (getattr(holder, name) for name in holder.__all__))
        found |= {name for each in functions for name in inspect.signature(each).parameters}
    return keys() | found | {each.name.lower() for each in Severity}


@cache
def of_the_code() -> frozenset[str]:
    """Words of two parts and more: names, codes of remarks, words of other formats."""
    texts = (
        path.read_text(encoding="utf-8") for of in ("qsbearing", "fem_check") for path in (ROOT / of).rglob("*.py")
    )
    return frozenset(word for text in texts for word in re.findall(r"\b[a-z]\w*_\w+\b", text))


_ENDS_WITH_UNIT = re.compile(
    r"_(?:N|Nm|mm|um|MPa|GPa|deg|mrad|rpm|rad_s|W|kW|h|mm2_s|N_per_um|N_per_m|kNm_per_rad|kg_m3|C|K|m_s|SI|Hz|J_per_K)$"
)


def is_known(name: str) -> bool:
    """Whether a name in a sentence means anything. One that ends with a unit is a key or a result: it is not enough
    that the code has it, which also keeps old keys to say what replaces them."""
    if name in words() or name in OF_OTHERS or is_result(name):
        return True
    return not _ENDS_WITH_UNIT.search(name) and name in of_the_code()
