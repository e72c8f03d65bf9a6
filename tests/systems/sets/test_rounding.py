"""What is rounding is neither said, decided upon nor written: sets with no load, or next to none."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files import stiffness_files
from qsbearing.results.set_record import set_record
from tests.systems.sets.arrangements import S6210C, S6210E, rows, solved

LEAST = 1e-8
"""Of a newton, and of whatever else a remark or a state speaks of: no design knows less."""
SHAFT = qs.Shaft((qs.ShaftSection(0.4, 0.04), qs.ShaftSection(0.2, 0.05)), -0.2)


def drawn(seed: int) -> qs.BearingSet:
    """Rows any way round on a shaft, some in a sleeve, some with offsets or fits, under one small load or none."""
    generator = np.random.default_rng(seed)
    placed = list(rows(str(generator.choice(["DB", "DF", "TBT", "QBC"])), S6210C, S6210E))
    floating: tuple[qs.FloatingGroup, ...] = ()
    if generator.random() < 0.6:
        placed.append(qs.Row(S6210C, 0.2, str(generator.choice(["+x", "-x"]))))
        floating = (qs.FloatingGroup((len(placed),)),)
    if generator.random() < 0.3:
        placed[0] = replace(placed[0], offset=float(generator.choice([-2e-6, 3e-6])))
    load = float(generator.choice([0.0, 0.0, 1e-15, 1e-6, 50.0]))
    channel = str(generator.choice(["axial_load", "radial_load_y"]))
    shaft = SHAFT if generator.random() < 0.7 else None
    tilts = {"moment_z": 0.0} if channel == "radial_load_y" else {}
    return qs.BearingSet(tuple(placed), qs.Operation(**{channel: load}, **tilts), shaft=shaft, floating=floating)


def numbers_of(value: Any) -> list[float]:
    """All in a record's remark."""
    if isinstance(value, dict):
        return [each for one in value.values() for each in numbers_of(one)]
    if isinstance(value, list | tuple):
        return [each for one in value for each in numbers_of(one)]
    return [float(value)] if isinstance(value, int | float) and not isinstance(value, bool) else []


@pytest.mark.parametrize("seed", range(24))
def test_no_remark_nor_preload_speaks_of_rounding(seed: int) -> None:
    """Numbers in remarks, of preloads and their shares are zero or worth the name; the states agree with them."""
    solution = solved(drawn(seed))
    found = set_record(solution, [{}] * len(solution.rows))
    for said in found["remarks"]:
        assert all(each == 0.0 or abs(each) > LEAST for each in numbers_of(said["values"])), said["text"]
    for row in found["rows"]:
        loads = [row[key] for key in row if key.startswith("preload_") and key.endswith("_N")]
        assert all(each is None or each == 0.0 or abs(each) > LEAST for each in loads)
        assert (row["preload_state"] is None) == (row["preload_share"] is None)
    for said in solution.warnings():
        assert not re.search(r"\de-(0[89]|[1-9]\d)", said), said


def as_written(units: str, solution: Any) -> str:
    """All formats, one after the other."""
    seats = stiffness_files.seats_of(solution, units)
    decks = ("calculix_deck", "abaqus_deck", "ansys_deck", "nastran_deck")
    texts = [getattr(stiffness_files, name)(seats, units) for name in decks]
    return "\n".join([*texts, stiffness_files.json_text(seats, units), stiffness_files.ross_module(seats)])


@pytest.mark.parametrize("seed", range(8))
def test_written_stiffnesses_hold_no_rounding(seed: int) -> None:
    """Beside stiffnesses of 1e4 to 1e9 in any unit no number is below 1e-6, but for zeros."""
    generator = np.random.default_rng(seed)
    loads = {"axial_load": 400.0, "radial_load_y": float(generator.choice([0.0, 200.0]))}
    preload = qs.Preload(rigid=float(generator.uniform(100.0, 900.0)))
    solution = solved(qs.BearingSet(rows("DB", S6210C, S6210E), qs.Operation(**loads, moment_z=0.0), preload))
    for units in stiffness_files.UNITS:
        for number in re.findall(r"(?<![\w.])-?\d+\.\d*(?:[eE]?[-+]\d+)?(?![\w.])", as_written(units, solution)):
            text = re.sub(r"(?<=\d)([-+]\d+)$", r"e\1", number) if "e" not in number.lower() else number
            assert float(text) == 0.0 or abs(float(text)) > 1e-9, number
