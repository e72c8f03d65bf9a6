"""The groove radii of bearings whose ratings are those of their own grooves: what is added to the f of C0."""

from __future__ import annotations

import numpy as np
import pytest

import qsbearing as qs
from fem_check.book.published import gmn_rows
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.independent.groove import BallInGroove
from fem_check.independent.references import hertz
from tests.inference.data_sheets import gmn

ABOVE_C0 = 0.0, 0.0013, 0.0056
"""Least, usual, largest; with the rounding of C0 over 30 beside it they hold 95 of 100 rigidities that GMN prints."""
STEEL = ElasticConstants(207e9, 0.3)


def weaker_load(f: float, ball: float, pitch: float, angle: float) -> float:
    """The ball load at which one of the raceways has 4200 MPa [N]; pressures grow with the cube root of the load."""
    loads = []
    for race in ("inner", "outer"):
        groove = BallInGroove("", race, ball, f * ball, pitch, angle, STEEL, STEEL)
        loads.append(1e3 * (4200e6 / hertz(groove.problem(1e3)).max_pressure) ** 3)
    return min(loads)


def test_f_lies_above_that_of_the_static_rating_by_what_rigidities_ask_for() -> None:
    for known in gmn(gmn_rows(), "S ", maker="GMN")[10:60:25]:
        found = qs.infer_bearing(**known.sheet)
        place = known.place(found)
        ball = float(found.bearing.ball_diameter[3 * place])  # type: ignore[index]
        usual, least, most = np.asarray(found.bearing.inner_groove_radius)[3 * place : 3 * place + 3] / ball
        static, angle = known.sheet["static_load_rating"], known.sheet["free_contact_angle"]
        trailing = len(f"{static:.0f}") - len(f"{static:.0f}".rstrip("0"))
        rounding = min(0.5 * 10.0**trailing / static, 0.01) / 30.0
        of_c0 = usual - ABOVE_C0[1]
        assert least == pytest.approx(of_c0 + ABOVE_C0[0] - rounding, abs=1e-9)
        assert most == pytest.approx(of_c0 + ABOVE_C0[2] + rounding, abs=1e-9)
        pitch = float(np.broadcast_to(found.bearing.pitch_diameter, found.set_number.shape)[3 * place])
        rating = known.ball_count * np.cos(angle) * weaker_load(of_c0, ball, pitch, angle) / 5.0
        assert rating == pytest.approx(static, rel=1e-3)
