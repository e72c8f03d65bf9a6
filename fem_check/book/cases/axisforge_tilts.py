"""Imposed tilts and clearances of a deep-groove bearing: another program's results, and both causes of its differences.

It rounds the constant of Hertz's law in ISO/TS 16281, pi sqrt(2)/3 = 1.48096, to 1.48, and takes moments about half the
pitch diameter though tilts move the groove centres on their own circle. With clearance its ratings of the raceways have
the contact angle that the clearance leaves, where the standard's is the nominal one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, ValueTable, compared
from fem_check.book.published import columns_of
from fem_check.rows.row_text import scientific, short_exponents
from qsbearing.readings.dynamic_rating import rating_ratio

SOURCE = "github.com/JRaposo-m/AxisForge-Design-Studies, iso16281_rows.csv"
RADIAL = 2660.4444281502115
Z, D, PITCH, F = 9, 7e-3, 31e-3, 0.52
EXACT, ROUNDED = np.pi * np.sqrt(2.0) / 3.0, 1.48
"""The constant of the load-deflection law, and as the other program has it."""
COLUMNS = ("radial_mm", "axial_mm", "moment_Nmm", "largest_load_N", "life_Mrev")


class SolvedTilts(NamedTuple):
    """Results at every point, in the units of COLUMNS."""

    values: dict[str, NDArray]
    bearing: qs.BallBearing
    solution: qs.Solution


def solved(points: dict[str, NDArray], as_theirs: bool) -> SolvedTilts:
    """All points; with the other program's constant, lever of moments and angle of its ratings, or as here."""
    steel = qs.Material(210e9 * (ROUNDED / EXACT if as_theirs else 1.0), 0.3, 7800.0)
    bearing = qs.BallBearing.from_diametral_clearance(
        diametral_clearance=1e-3 * points["clearance_mm"], ball_count=Z, ball_diameter=D, pitch_diameter=PITCH,
        inner_groove_radius=F * D, outer_groove_radius=F * D, kind=qs.BearingKind.DEEP_GROOVE,
        ball_material=steel, ring_material=steel,
    )  # fmt: skip
    operation = qs.Operation(axial_load=0.0, radial_load_y=RADIAL, tilt_y=0.0, tilt_z=-1e-3 * points["tilt_mrad"])
    solution = qs.solve(qs.Scene(bearing, operation))
    life = qs.readings.life(solution, dynamic_load_rating=points["C_N"])
    values = {
        "radial_mm": 1e3 * solution.displacement[:, 1],
        "axial_mm": 1e3 * solution.displacement[:, 0],
        "moment_Nmm": -1e3 * solution.load[:, 4],
        "largest_load_N": solution.inner.load.max(axis=1),
        "life_Mrev": 1e-6 * np.asarray(life.basic_reference_rating_life),
    }
    if as_theirs:
        values["moment_Nmm"] *= 0.5 * PITCH / np.asarray(bearing.inner_groove_centre_radius)
        inner, outer = with_clearance_angle(bearing)
        values["life_Mrev"] = 1e-6 * (
            (np.asarray(life.inner_life) * inner) ** (-10 / 9) + (np.asarray(life.outer_life) * outer) ** (-10 / 9)
        ) ** (-9 / 10)
    return SolvedTilts(values, bearing, solution)


def with_clearance_angle(bearing: qs.BallBearing) -> tuple[NDArray, NDArray]:
    """What the clearance's contact angle makes of the lives of both raceways, in 1/cos(alpha) and in gamma."""
    cosine = np.cos(np.asarray(bearing.free_contact_angle))
    here, there = (rating_ratio(D / PITCH * each, F, F, 1.044) ** (10 / 3) for each in (1.0, cosine))
    return cosine**-3 * ((1 + there) / (1 + here)) ** 0.9, cosine**-3 * ((1 + 1 / there) / (1 + 1 / here)) ** 0.9


def run() -> CaseResult:
    """As it is, and with the other program's choices."""
    points = columns_of("axisforge_deep_groove")
    here, theirs = solved(points, False), solved(points, True)
    tight = points["clearance_mm"] == 0.0
    tilt = 1e-3 * np.abs(points["tilt_mrad"])
    turned = tilt - np.sin(tilt)  # the other program moves the groove centres by Ri sin(tilt), this one by Ri tilt
    moved = float((np.asarray(theirs.bearing.inner_groove_centre_radius) * turned).max())
    approach = float(np.nanmax(theirs.solution.inner.approach + theirs.solution.outer.approach, axis=1).min())
    of_load = 1.5 * moved / approach
    way = f"tilts of up to 5 mrad as angles here, as sines there: {1e9 * moved:.2f} nm on the groove centres' circle"
    turning = 1e3 * float((np.abs(theirs.solution.stiffness[:, 4, 4]) * turned).max())

    def worst(column: str, tilts: SolvedTilts, unit: str, some: NDArray | None = None) -> tuple[float, str]:
        """The largest difference, relative or in its unit, and where."""
        printed = points[column]
        apart = tilts.values[column] - printed
        if unit == "relative":
            apart = np.where(printed == 0.0, 0.0, apart / np.where(printed == 0.0, 1.0, printed))
        apart = np.where(True if some is None else some, apart, 0.0)
        i = int(np.abs(apart).argmax())
        place = f"{points['tilt_mrad'][i]:.4g} mrad, {1e3 * points['clearance_mm'][i]:g} µm"
        return float(apart[i]) * (1e3 if unit == "µm" else 1.0), place

    rows, off = [], {}
    first = f"as it is, {len(tilt)} tilts and clearances"
    for column, quantity, some, why in (
        ("radial_mm", "radial displacement", None, "the other program rounds 1.48096 to 1.48: 0.043 %"),
        ("moment_Nmm", "moment", None, "it takes the moment about half the pitch diameter: 0.9 %, and 1.48"),
        ("life_Mrev", "life with clearance", ~tight, "it rates the raceways at the clearance's contact angle"),
        ("life_Mrev", "life without clearance, tilted", tight, "1.48 alone"),
    ):
        off[quantity], at = worst(column, here, "relative", some)
        name = f"{quantity}, largest relative difference"
        rows.append(compared(first, name, "relative", 0.0, off[quantity], SOURCE, None, f"a finding: {why}", at))
    plain = int(np.flatnonzero(tight & (tilt == 0.0))[0])
    rows.append(
        compared("no tilt, no clearance", "reference life L10r", "10⁶ rev", points["life_Mrev"][plain],
                 here.values["life_Mrev"][plain], SOURCE, 1e-9 * points["life_Mrev"][plain],
                 "the stiffness cancels out under a radial load alone; both solve to 1e-10")
    )  # fmt: skip
    second = f"with its 1.48, its lever and its angle, {len(tilt)} tilts and clearances"
    for column, quantity, unit, limit, why in (
        ("radial_mm", "radial displacement", "µm", 1e6 * moved, way),
        ("axial_mm", "axial displacement", "µm", 1e6 * moved, way),
        ("moment_Nmm", "moment", "N mm", turning, "the same angle times the stiffness against tilting"),
        ("largest_load_N", "largest ball load", "relative", of_load, "1.5 times the same way over the approach"),
        ("life_Mrev", "life", "relative", 3.0 * of_load, "three times the loads'"),
    ):
        off[f"{quantity} as theirs"], at = worst(column, theirs, unit)
        name = f"{quantity}, largest {'relative ' if unit == 'relative' else ''}difference"
        rows.append(compared(second, name, unit, 0.0, off[f"{quantity} as theirs"], SOURCE, limit, why, at))
    names = ("radial displacement", "moment", "largest ball load", "life")
    shown = ("radial_mm", "moment_Nmm", "largest_load_N", "life_Mrev")
    ratio = points["life_Mrev"] / here.values["life_Mrev"]
    order = np.argsort(points["clearance_mm"])
    by_angle = theirs.values["life_Mrev"] / here.values["life_Mrev"]
    return CaseResult(
        f"As it is, displacements differ by up to {100 * abs(off['radial displacement']):.3f} %, moments by "
        f"{100 * abs(off['moment']):.1f} %, lives with clearance by up to {100 * abs(off['life with clearance']):.0f} "
        "%; with the other program's 1.48, lever and angle put in, displacements agree within "
        f"{scientific(max(abs(off[f'{each} displacement as theirs']) for each in ('radial', 'axial')), 1)} µm and "
        f"lives within {scientific(abs(off['life as theirs']), 1)}.",
        rows,
        [
            Diagram(
                "", "largest relative difference",
                [
                    Curve(label, style, np.arange(len(shown)), [abs(worst(each, of, "relative")[0]) for each in shown])
                    for label, style, of in (("as it is", "squares", here), ("its choices put in", "dots", theirs))
                ],
                y_scale="log", x_names=names,
            ),
            Diagram(
                "diametral clearance, µm", "its life over ours",
                [
                    Curve("life", "dots", 1e3 * points["clearance_mm"], ratio),
                    Curve("the clearance's angle", "line", 1e3 * points["clearance_mm"][order], by_angle[order]),
                ],
            ),
        ],
        ValueTable(
            "Every operating point: values of the other program, and what ours are off by with its choices put in.",
            ["clearance, µm", "tilt, mrad", "radial, µm", "off by, µm", "moment, N mm", "off by, N mm", "life, 10⁶ rev",
             "ours as it is"],
            [
                [1e3 * points["clearance_mm"][i], points["tilt_mrad"][i], 1e3 * points["radial_mm"][i],
                 short_exponents(f"{1e3 * (theirs.values['radial_mm'] - points['radial_mm'])[i]:+.0e}"),
                 points["moment_Nmm"][i],
                 short_exponents(f"{(theirs.values['moment_Nmm'] - points['moment_Nmm'])[i]:+.0e}"),
                 points["life_Mrev"][i],
                 here.values["life_Mrev"][i]]
                for i in range(len(tilt))
            ],
        ),
    )  # fmt: skip
