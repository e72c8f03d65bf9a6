"""NSK's worked examples of a 6208: two rating lives, and the clearance that a warm inner ring takes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.published import ISO_STEEL

LIVES = "NSK, General Catalogue, section 5.7"
CLEARANCE = "NSK, General Catalogue, equation 9.6"
C, RPM, RADIAL, THRUST = 29100.0, 900.0, 2500.0, 1000.0
PRINTED = {0.0: 29000.0, THRUST: 15800.0}
"""Life [h] by the axial load [N]."""
CLEARANCES = np.array([0.0, 5e-6, 10e-6, 20e-6])
WARMER, EXPANSION, LOST = 10.0, 12.5e-6, 9.0
"""[K], [1/K], and the printed change of the clearance [µm]."""
BORE, OUTSIDE = 40e-3, 80e-3
D, PITCH = 11.906e-3, 60e-3


def bearing(clearance: float, steel: qs.Material = ISO_STEEL) -> qs.BallBearing:
    """The inferred ball set with a diametral clearance [m]."""
    return qs.BallBearing.from_diametral_clearance(
        diametral_clearance=clearance, ball_count=9, ball_diameter=D, pitch_diameter=PITCH,
        inner_groove_radius=0.52 * D, outer_groove_radius=0.53 * D, kind=qs.BearingKind.DEEP_GROOVE,
        ball_material=steel, ring_material=steel,
    )  # fmt: skip


def lives(thrust: float) -> tuple[NDArray, NDArray]:
    """Hours by ISO 281 and by ISO/TS 16281's reference life, at each clearance."""
    basic, reference = [], []
    for clearance in CLEARANCES:
        own = bearing(float(clearance))
        middle = {"axial_displacement": -float(own.groove_centre_distance * np.sin(own.free_contact_angle))}
        axial = {"axial_load": thrust} if thrust else middle
        operation = qs.Operation(speed=RPM * qs.rpm, radial_load_y=RADIAL, tilt_y=0.0, tilt_z=0.0, **axial)
        life = qs.readings.life(qs.solve(qs.Scene(own, operation)), dynamic_load_rating=C)
        basic.append(float(life.basic_rating_life) / RPM / 60.0)
        reference.append(float(life.basic_reference_rating_life) / RPM / 60.0)
    return np.array(basic), np.array(reference)


def clearance_lost() -> float:
    """By an inner ring and balls that are warmer than the outer ring [µm]."""
    cold = bearing(20e-6, replace(ISO_STEEL, thermal_expansion=EXPANSION))
    warm = 20.0 + WARMER + qs.zero_celsius
    effects = (qs.RingExpansion(BORE, OUTSIDE, inner_ring_temperature=warm), qs.BallExpansion(ball_temperature=warm))
    scene = qs.Scene(cold, qs.Operation(axial_load=1.0), ring_effects=effects)
    return 20.0 - 1e6 * float(np.asarray(scene.operating_bearing.diametral_clearance))


def run() -> CaseResult:
    """Lives as printed, the reference life beside them, and the clearance."""
    rows, curves, by_load = [], [], {}
    for thrust, printed in PRINTED.items():
        basic, reference = lives(thrust)
        by_load[thrust] = basic[0], reference
        name = f"6208: C 29.1 kN, {RPM:.0f} rpm, {RADIAL:.0f} N radial, {thrust:.0f} N axial"
        hundred = 50.0 if printed < 2e4 else 500.0
        rows.append(
            compared(name, "life by ISO 281", "h", printed, basic[0], LIVES, hundred,
                     f"printed to {'a hundred' if hundred < 100 else 'a thousand'} hours")
        )  # fmt: skip
        rows += [
            compared(f"{name}, clearance {1e6 * clearance:.0f} µm", "reference life L10r", "h", printed, hours, LIVES,
                     None, "a finding: another standard, ISO/TS 16281, in which the clearance counts")
            for clearance, hours in zip(CLEARANCES[[0, -1]], reference[[0, -1]], strict=True)
        ]  # fmt: skip
        curves.append(
            Curve(f"{thrust:.0f} N axial", "dots" if thrust else "squares", 1e6 * CLEARANCES, reference / basic[0])
        )
    lost = clearance_lost()
    rows.append(
        compared("6208: inner ring and balls 10 K warmer", "clearance lost", "µm", LOST, lost, CLEARANCE, 0.05,
                 "one decimal is printed")
    )  # fmt: skip
    both = [f"{hours:.0f} h, {reference.min():.0f} to {reference.max():.0f} h" for hours, reference in by_load.values()]
    return CaseResult(
        f"Life by ISO 281 and reference life over the clearances: {both[0]} under radial load; {both[1]} with thrust. "
        f"The warm inner ring takes {lost:.2f} µm.",
        rows,
        [Diagram("diametral clearance, µm", "reference life over ISO 281's", curves, levels=[1.0])],
    )
