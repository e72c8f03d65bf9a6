"""Ball sets from catalogue rows, against sets that are known; and what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from fem_check.book.published import columns_of, gmn_rows
from qsbearing.inference.narrowing import shares_removed
from qsbearing.inference.rigidity import pair_rigidity
from tests.inference.data_sheets import Known, deep_groove, gmn, sheet

INCH = 25.4 * qs.mm


def sets(found: qs.InferredBearing) -> list[tuple[int, float]]:
    """Ball counts with diameters in mm, best first."""
    pairs = zip(found.bearing.ball_count[::3], found.bearing.ball_diameter[::3], strict=True)  # type: ignore[index]
    return [(int(count), round(float(diameter / qs.mm), 2)) for count, diameter in pairs]


# 6203 and 6205 are published as measured, the others common knowledge of the size.
ANCHORS = [
    ("6203", (17, 40, 9550, 4800), (8, 6.75)),
    ("6204", (20, 47, 12800, 6600), (8, 7.94)),
    ("6205", (25, 52, 14000, 7850), (9, 7.94)),
    ("6206", (30, 62, 19500, 11300), (9, 9.52)),
    ("6207", (35, 72, 25700, 15300), (9, 11.11)),
    ("6006", (30, 55, 13200, 8300), (11, 7.14)),
    ("6308", (40, 90, 40500, 24000), (8, 15.08)),
]


@pytest.mark.parametrize(("name", "printed", "known"), ANCHORS, ids=[each[0] for each in ANCHORS])
def test_known_deep_groove_bearings_are_found_first(name: str, printed: Any, known: tuple[int, float]) -> None:
    assert sets(qs.infer_bearing(**deep_groove(*printed), rating_practice="iso"))[0] == known


def test_the_designation_does_not_fix_the_set() -> None:
    """6305: NSK has 8 balls of 13/32 inch, SKF 7 of 11.5 mm, which 29/64 inch (11.509) stands for."""
    assert sets(qs.infer_bearing(**deep_groove(25, 62, 20600, 11200), maker="NSK"))[0] == (8, 10.32)
    assert sets(qs.infer_bearing(**deep_groove(25, 62, 23400, 11600), maker="SKF"))[0] == (7, 11.51)


def test_sets_that_the_ratings_do_not_tell_apart_are_both_listed() -> None:
    """7211 BEP and 7210 BEP, SKF: 15 of 14.288; 14 of 13.097 or 15 of 12.7."""
    assert sets(qs.infer_bearing(**sheet(55, 100, 40, 46200, 36000), rating_practice="iso"))[0] == (15, 14.29)
    both = sets(qs.infer_bearing(**sheet(50, 90, 40, 37700, 28500), rating_practice="iso"))
    assert {(14, 13.1), (15, 12.7)} <= set(both)


SOME = gmn(gmn_rows(), "S ", maker="GMN")[::6]
"""The heavy test takes all."""


@pytest.fixture(scope="module")
def found() -> list[tuple[Known, qs.InferredBearing]]:
    """What is inferred of them."""
    return [(known, qs.infer_bearing(**known.sheet)) for known in SOME]


def test_own_grooves_have_the_printed_set_in_the_list(found: list[tuple[Known, qs.InferredBearing]]) -> None:
    """GMN, series S: set and diameter printed. All 85: 84 and 84."""
    assert sum(known.place(each) >= 0 for known, each in found) >= 0.9 * len(SOME)
    assert sum(bool(known.has_diameter(each).any()) for known, each in found) >= 0.95 * len(SOME)
    assert np.median([each.set_number[-1] + 1 for _, each in found]) <= 10, "a list of everything is no answer"


def test_the_true_stiffness_is_within_the_range(found: list[tuple[Known, qs.InferredBearing]]) -> None:
    """Of a pair at medium preload; true: of the printed set with the groove radius fitted to the row's rigidities."""
    rows = {row["name"]: row for row in gmn_rows()}
    inside, widths = 0, []
    for known, listed in found:
        row, diameter = rows[known.name], known.ball_diameter
        groove = row["inferred_f"] * diameter
        angle = known.sheet["free_contact_angle"]
        printed = qs.BallBearing(known.ball_count, diameter, row["dm_mm"] * qs.mm, groove, groove, angle)
        between = listed.range_of(pair_rigidity(listed.bearing, row["FvM"]))
        true = float(pair_rigidity(printed, row["FvM"]))
        inside += between.least <= true <= between.most
        widths.append(between.width / true)
    assert inside >= len(SOME) - 2, "two of these are of 5 and 7 mm bore, with rigidities of two digits"
    assert np.median(widths) < 0.15, "a range of everything is no answer"


def test_light_balls_without_a_practice_cannot_be_known() -> None:
    """GMN, series KH: whether nothing is stated, or the practice of the maker's other series."""
    for maker, key in (("", "dynamic_load_rating"), ("GMN", "static_load_rating")):
        for known in gmn(gmn_rows(), "KH", maker=maker)[::12]:
            with pytest.raises(qs.SceneError, match="series_factors") as caught:
                qs.infer_bearing(**known.sheet)
            assert [error.field for error in caught.value.errors] == [f"bearing.{key}"]
    factors = {"dynamic_rating_factor": 0.702, "static_rating_factor": 0.506}
    some = gmn(gmn_rows(), "KH", **factors)[::6]
    assert sum(known.place(qs.infer_bearing(**known.sheet)) == 0 for known in some) >= 6  # all 60: 42, 7 in the list


def test_a_printed_rigidity_tells_the_groove() -> None:
    """NTN, whose ratings are ISO's: the rigidity at 15 degrees gives f, with which that at 25 degrees follows."""
    sizes = columns_of("ntn_ultage_rigidities")
    for i in range(0, len(sizes["name"]), 9):
        numbers = {key: float(each[i]) for key, each in sizes.items() if key != "name"}
        printed = {angle: numbers[f"axial_{angle}_N_um"] * qs.N / qs.um for angle in (15, 25)}
        fields = sheet(
            numbers["bore_mm"], numbers["outside_mm"], 15, 1e3 * numbers["C"], 1e3 * numbers["C0"], maker="NTN"
        )
        wide = qs.infer_bearing(**fields)
        told = qs.infer_bearing(**fields, pair_rigidity=printed[15], pair_preload=numbers["preload_15_N"])
        operation = qs.Operation(axial_load=numbers["preload_15_N"])
        ranges = [
            each.range_of(2.0 * qs.solve(qs.Scene(each.bearing, operation)).stiffness[..., 0, 0])
            for each in (wide, told)
        ]
        assert all(each.least <= printed[15] <= each.most for each in ranges)
        assert ranges[1].width < 0.03 * printed[15] < 0.15 * printed[15] < ranges[0].width


def test_what_one_more_number_would_remove() -> None:
    known = SOME[7]
    found = qs.infer_bearing(**known.sheet)
    solution = qs.solve(
        qs.Scene(found.bearing, qs.Operation(axial_load=100.0, radial_load_y=50.0, tilt_y=0.0, tilt_z=0.0))
    )
    stiffness, load = solution.stiffness[:, 0, 0], np.nanmax(solution.inner.load, axis=-1)
    assert found.shares_removed(stiffness)["pair_rigidity"] > 0.7, "it is a rigidity"
    assert found.shares_removed(load)["ball_count"] > 0.8, "the heaviest ball depends on the count alone"
    counted = qs.infer_bearing(**known.sheet, ball_count=known.ball_count)
    assert set(counted.bearing.ball_count) == {known.ball_count}  # type: ignore[arg-type]
    assert "ball_count" not in counted.shares_removed(np.arange(counted.misfit.size))
    sized = qs.infer_bearing(**known.sheet, ball_count=known.ball_count, ball_diameter=known.ball_diameter)
    assert sized.misfit.size == 3 and sized.at(0).ball_diameter == known.ball_diameter


@pytest.mark.parametrize(
    ("stiffer", "left"),
    [(0.0, 10.0), (20.0, 8.0 / 3.0), (100.0, 0.0)],
    ids=["as stiff", "as stiff at one end", "stiffer"],
)
def test_a_known_rigidity_leaves_what_the_ball_sets_that_have_it_differ_by(stiffer: float, left: float) -> None:
    """Two sets of three groove radii, whose results are 10 apart: alike in rigidity, sharing one end, or not at all."""
    values, groove = np.array([0.0, 1.0, 2.0, 10.0, 11.0, 12.0]), np.tile([100.0, 110.0, 120.0], 2)
    number = np.repeat([0, 1], 3)
    shares = shares_removed(values, number, {"groove": groove, "set": number}, groove + stiffer * number)
    assert shares["pair_rigidity"] == pytest.approx(1.0 - left / 12.0)
    assert (shares["groove"], shares["set"]) == pytest.approx((1.0 - 10.0 / 12.0, 1.0 - 2.0 / 12.0))


def test_what_nobody_states_is_said() -> None:
    fields = deep_groove(25, 52, 14000, 7850)
    assert ["nothing states" in each for each in qs.infer_bearing(**fields).remarks] == [True, False]
    assert ["nothing states" in each for each in qs.infer_bearing(**fields, maker="NSK").remarks] == [False]
    with_f = qs.infer_bearing(**fields, maker="NSK", groove_radius_coefficient=0.516)
    assert with_f.remarks == () and np.ptp(with_f.bearing.inner_groove_radius / with_f.bearing.ball_diameter) == 0.0


def test_a_printed_f0_tells_the_diameter() -> None:
    """6316, NSK. Of 6816 it prints 17.4, above the largest that ISO 76 has, which tells nothing."""
    fields = deep_groove(80, 170, 123000, 86500, maker="NSK")
    assert sets(qs.infer_bearing(**fields)) == [(8, 28.57), (7, 30.96)]
    assert sets(qs.infer_bearing(**fields, f0=13.3)) == [(8, 28.57)]
    assert sets(qs.infer_bearing(**fields, f0=17.4)) == [(8, 28.57), (7, 30.96)]


def test_ceramic_balls_are_read_both_ways() -> None:
    """GMN prints C0 of its hybrid rows for their own balls, others as that of steel ones."""
    row = next(each for each in gmn_rows() if each["name"] == "S 6210 C TA")
    for static in (row["C0"], row["C0_HY"]):
        fields = sheet(row["d_mm"], row["D_mm"], 15, row["C"], static, maker="GMN", ball_material=qs.SILICON_NITRIDE)
        assert (int(row["Z"]), round(row["Dw_mm"], 2)) in sets(qs.infer_bearing(**fields))


def test_all_mistakes_are_said_at_once() -> None:
    fields = sheet(50, 50.5, 15, 27, float("nan"), maker="SNFA", pair_rigidity=60 * qs.N / qs.um, ball_count=[3, 4])
    del fields["free_contact_angle"]
    with pytest.raises(qs.SceneError) as caught:
        qs.infer_bearing(**fields)
    assert sorted(error.field.removeprefix("bearing.") for error in caught.value.errors) == [
        "ball_count", "dynamic_rating_factor", "free_contact_angle", "pair_preload", "static_load_rating",
        "static_rating_factor",
    ]  # fmt: skip
    for wrong, key in (
        ({"rating_practice": "din"}, "rating_practice"),
        ({"rating_practice": "iso", "dynamic_rating_factor": 1.0, "static_rating_factor": 1.2}, "rating_practice"),
        ({"diametral_clearance": 1e-5}, "diametral_clearance"),
        ({"outside_diameter": 0.05}, "outside_diameter"),
        ({"ball_count": 20.5}, "ball_count"),
        ({"pair_rigidity": 900 * qs.N / qs.um, "pair_preload": 50.0}, "pair_rigidity"),
    ):
        with pytest.raises(qs.SceneError) as caught:
            qs.infer_bearing(**(sheet(50, 80, 15, 26900, 23100, maker="NTN") | wrong))
        assert [error.field for error in caught.value.errors] == [f"bearing.{key}"], wrong
