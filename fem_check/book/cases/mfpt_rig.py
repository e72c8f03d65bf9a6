"""Ball-pass frequencies of a radially loaded bearing on the MFPT rig: what a model without slip cannot meet."""

from __future__ import annotations

import numpy as np

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared

SOURCE = "MFPT fault data, NICE bearing, 0 to 300 lb radial; ratios at 0 and 250 lb"
Z, D, DM = 8, 0.235 * 25.4e-3, 1.245 * 25.4e-3
POUND = 4.4482216
SHAFT = 25.0
"""Nominal shaft frequency [Hz]."""
LOADS = (0.0, 250.0)
INNER_RATIO = (4.774, 4.7636)
"""BPFI over shaft frequency."""
OUTER = (80.08, 80.68)
"""BPFO [Hz]."""
TEXTBOOK_INNER, TEXTBOOK_OUTER = 4.7550, 81.12


def ratios(loads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """BPFI and BPFO over shaft frequency of the centred bearing under radial loads [lb]."""
    bearing = qs.BallBearing.from_diametral_clearance(
        diametral_clearance=5e-6,
        ball_count=Z,
        ball_diameter=D,
        pitch_diameter=DM,
        inner_groove_radius=0.52 * D,
        outer_groove_radius=0.52 * D,
        kind=qs.BearingKind.DEEP_GROOVE,
    )
    centred = -float(bearing.groove_centre_distance * np.sin(bearing.free_contact_angle))
    operation = qs.Operation(
        speed=SHAFT * 2.0 * np.pi, radial_load_y=loads * POUND, axial_displacement=centred, tilt_y=0.0, tilt_z=0.0
    )
    frequencies = qs.readings.frequencies(qs.solve(qs.Scene(bearing, operation))).solved
    return frequencies.ball_pass_inner / SHAFT, frequencies.ball_pass_outer / SHAFT


def run() -> CaseResult:
    """The computed ratios, which no load changes, and the measured ones."""
    loads = np.array([10.0, 50.0, 100.0, 200.0, 300.0])
    inner, outer = ratios(loads)
    # A cage slower than without slip lengthens the inner ratio and shortens the outer one by as much of Z.
    slow = [(ratio - TEXTBOOK_INNER) / (Z - TEXTBOOK_INNER) for ratio in INNER_RATIO]
    slow_outer = [1.0 - value / TEXTBOOK_OUTER for value in OUTER]
    case = "radial load alone: contact angle zero"
    rows = [
        compared(
            case,
            "BPFI over shaft frequency, all loads",
            "1",
            TEXTBOOK_INNER,
            inner[np.abs(inner - TEXTBOOK_INNER).argmax()],
            "textbook ratio",
            5e-5,
            "four decimals are printed",
        ),
        compared(
            case,
            "BPFO at 25.00 Hz",
            "Hz",
            TEXTBOOK_OUTER,
            SHAFT * outer[np.abs(SHAFT * outer - TEXTBOOK_OUTER).argmax()],
            "textbook frequency",
            5e-3,
            "two decimals are printed",
        ),
    ]
    for i, load in enumerate(LOADS):
        rows += [
            compared(
                f"{load:.0f} lb",
                "BPFI over shaft frequency",
                "1",
                INNER_RATIO[i],
                inner[-1],
                SOURCE,
                None,
                "a finding: the cage slips, which the model leaves out",
            ),
            compared(
                f"{load:.0f} lb",
                "cage slower than without slip, from BPFI",
                "1",
                0.0,
                slow[i],
                SOURCE,
                None,
                "a finding: the slip that the model leaves out",
            ),
            compared(
                f"{load:.0f} lb",
                "cage slower than without slip, from BPFO at a nominal 25 Hz",
                "1",
                0.0,
                slow_outer[i],
                SOURCE,
                None,
                "a finding: the shaft's true frequency is not recorded, 0.1 Hz is 0.4 %",
            ),
        ]
    rows.append(
        compared(
            "from 0 to 250 lb",
            "slip falls with load",
            "1",
            1.0,
            float(slow[1] < slow[0] and slow_outer[1] < slow_outer[0]),
            SOURCE,
            0.0,
            "the sign that slip must have, in both records",
        )
    )
    return CaseResult(
        f"The measured cage is {100 * slow[0]:.1f} % slow without load and {100 * slow[1]:.1f} % at 250 lb: the error "
        "that a model without slip makes here.",
        rows,
        [
            Diagram(
                "radial load, lb",
                "BPFI over shaft frequency",
                [Curve("computed, no slip", "line", loads, inner), Curve("measured", "circles", LOADS, INNER_RATIO)],
            )
        ],
    )
