"""What the guide's page states of the inference, measured on all rows."""

from __future__ import annotations

import re

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.inference.ball_sets import BallSets
from qsbearing.inference.data_sheet import DataSheet, RigidityKind
from qsbearing.inference.practice import OWN_GROOVE
from qsbearing.inference.proportions import OF_40_DEGREES, PROPORTIONS
from qsbearing.inference.ratings_fit import (
    ISO_STEEL,
    OWN_F_OFFSETS,
    OWN_F_PRIOR,
    OWN_F_SPREAD,
    WORST_ALONE,
    groove_of_static_rating,
    rated,
)
from qsbearing.readings import dynamic_load_rating
from tests.guide.pages import GUIDE
from tests.inference.measured import (
    Shares,
    by_factors,
    coverage,
    gmn_rigidities,
    inferred,
    judges,
    light,
    own_grooves,
    rigidity_table,
    table,
)
from tests.inference.measured_proportions import JUDGES, measured
from tests.inference.measured_proportions import coverage as coverage_of_guess
from tests.inference.measured_proportions import table as proportions_table


@pytest.mark.heavy
def test_the_measured_tables_are_those_of_the_guide() -> None:
    page = (GUIDE / "data_sheet.md").read_text(encoding="utf-8")
    assert "\n".join(table()) in page
    assert "\n".join(rigidity_table()) in page
    assert "\n".join(proportions_table()) in page


def test_wrong_lists_are_few_on_rows_that_judge() -> None:
    """Those of one set that are left are of EX 25, whose C is 15 % below that of its series."""
    of = Shares(judges())
    assert of.wrong <= 0.05 * of.rows
    assert of.wrong_of_one <= 0.02 * of.rows


def test_a_single_set_that_fits_badly_by_factors_is_refused() -> None:
    """A bound that GMN's KH chose: it costs none of them. What tells the balls besides makes one set no surprise."""
    alone = [each for each in map(inferred, light()) if each is not None and each.set_number[-1] == 0]
    assert len(alone) == 11 and max(each.misfit[0] for each in alone) < 0.8 * WORST_ALONE
    (known,) = (each for each in by_factors("EX") if each.name == "EX 12" and each.sheet["free_contact_angle"] < 0.3)
    with pytest.raises(qs.SceneError) as caught:
        qs.infer_bearing(**known.sheet)
    told = re.search(r"one ball set alone, (\d+) x .* and badly: its misfit is (4\.\d)", str(caught.value))
    assert told is not None, caught.value
    with_count = qs.infer_bearing(**known.sheet, ball_count=float(told[1]))
    assert with_count.misfit[0] == pytest.approx(float(told[2]), abs=0.06)


def test_the_range_holds_the_printed_rigidity_of_rows_that_judge() -> None:
    count, inside, width = coverage(own_grooves("S 62"), gmn_rigidities, RigidityKind.TANGENT, counted=True)
    assert count >= 90 and inside >= 0.93
    assert width < 0.15, "a range of everything is no answer"


def test_proportions_are_those_of_the_sets_that_they_come_from() -> None:
    """To the last digit that is stated."""
    stated = {f"{kind} {series}": of for (kind, series), of in PROPORTIONS.items()} | {"40 degrees": OF_40_DEGREES}
    found = measured()
    assert set(stated) == set(found)
    for name, of in stated.items():
        assert np.asarray(of) == pytest.approx(np.asarray(found[name]), abs=0.0006), name


def test_guessed_balls_have_the_stiffness_of_printed_ones_in_the_range() -> None:
    """Of rows that chose no proportions."""
    for name in JUDGES:
        _, inside, width, _ = coverage_of_guess(name)
        assert inside >= 0.8, name
        assert width < 0.2, "a range of everything is no answer"


def test_own_grooves_are_told_by_the_rows_that_chose_them() -> None:
    """Mean and spread of f, and what C leaves, of GMN's S 619 alone."""
    f, off = [], []
    for known in own_grooves("S 619"):
        sheet = DataSheet(**known.sheet)
        sets = BallSets(np.array([float(known.ball_count)]), np.array([known.ball_diameter]))
        own = groove_of_static_rating(sheet, sets, ISO_STEEL, 0.56)
        f.append(own[0] + OWN_F_OFFSETS[1])
        computed = dynamic_load_rating(rated(sheet, sets, own, own, ISO_STEEL))
        off.append(float(np.log(known.sheet["dynamic_load_rating"] / computed[0])))
    assert np.mean(f) == pytest.approx(OWN_F_PRIOR, abs=0.0001)
    assert np.std(f) == pytest.approx(OWN_F_SPREAD, abs=0.0001)
    assert max(map(abs, off)) < OWN_GROOVE.within
    assert np.std(off) == pytest.approx(OWN_GROOVE.spread, abs=0.001)
