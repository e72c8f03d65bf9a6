"""Load distribution and oil film of Hamrock's 209 deep-groove bearing, computed a second time."""

from __future__ import annotations

from math import sqrt

import numpy as np

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.book.film_reference import (
    BALL_ROUGHNESS,
    CLEARANCE,
    DM,
    LOAD,
    MODULUS,
    POISSON,
    PRESSURE_VISCOSITY,
    RACEWAY_ROUGHNESS,
    SPEED,
    VISCOSITY,
    D,
    R,
    Z,
    contact,
    entrainment_speed,
    film,
    largest_load,
)
from qsbearing.readings import OilState

SECOND = "the same inputs and equations, evaluated a second time without code of qsbearing"


def solved() -> qs.Solution:
    """The bearing under its radial load, both rings parallel and centred."""
    steel = qs.Material(MODULUS, POISSON, 7800.0)
    bearing = qs.BallBearing.from_diametral_clearance(
        diametral_clearance=CLEARANCE,
        ball_count=Z,
        ball_diameter=D,
        pitch_diameter=DM,
        inner_groove_radius=R,
        outer_groove_radius=R,
        ball_material=steel,
        ring_material=steel,
        kind=qs.BearingKind.DEEP_GROOVE,
    )
    centred = -float(bearing.groove_centre_distance * np.sin(bearing.free_contact_angle))
    operation = qs.Operation(speed=SPEED, radial_load_y=LOAD, axial_displacement=centred, tilt_y=0.0, tilt_z=0.0)
    return qs.solve(qs.Scene(bearing, operation, hertz_angle=qs.HertzAngle.ZERO))


def run() -> CaseResult:
    """Largest ball load and films of both raceways."""
    solution = solved()
    oil = OilState(VISCOSITY, PRESSURE_VISCOSITY)
    films = qs.readings.film(solution, oil, ball_roughness=BALL_ROUGHNESS, raceway_roughness=RACEWAY_ROUGHNESS)
    exact = {"inner": contact(-1.0, True), "outer": contact(1.0, True)}
    simple = {"inner": contact(-1.0, False), "outer": contact(1.0, False)}
    load, simple_load = largest_load(*exact.values()), largest_load(*simple.values())
    Q = float(solution.inner.load[0])
    rounding = "rounding of two evaluations; the solver's ball also moves a little axially and in angle"
    forms = "the textbook's simple ellipse is up to 3 % off, which changes film and load by less than 1 %"
    rows = [
        compared("heaviest ball", "load", "N", load, Q, SECOND, 1e-6 * load, rounding),
        compared(
            "heaviest ball",
            "load, by the textbook's simple ellipses",
            "N",
            simple_load,
            Q,
            SECOND,
            0.01 * simple_load,
            forms,
        ),
    ]
    for name, raceway in (("inner", films.inner), ("outer", films.outer)):
        least, central = (1e6 * each for each in film(exact[name], load))
        by_simple, _ = (1e6 * each for each in film(simple[name], simple_load))
        here = 1e6 * raceway.minimum_thickness[0], 1e6 * raceway.central_thickness[0]
        case = f"{name} raceway, heaviest ball"
        rows += [
            compared(case, "minimum film", "µm", least, here[0], SECOND, 1e-6 * least, rounding),
            compared(case, "central film", "µm", central, here[1], SECOND, 1e-6 * central, rounding),
            compared(
                case,
                "minimum film, by the textbook's simple ellipses",
                "µm",
                by_simple,
                here[0],
                SECOND,
                0.01 * by_simple,
                forms,
            ),
        ]
    motion = qs.readings.kinematics(solution)
    entrainment = entrainment_speed()
    Lambda = film(exact["inner"], load)[0] / sqrt(BALL_ROUGHNESS**2 + RACEWAY_ROUGHNESS**2)
    parameter = float(np.asarray(films.inner.film_parameter)[0])
    rows += [
        compared(
            "inner raceway, heaviest ball",
            "entrainment speed",
            "m/s",
            entrainment,
            motion.inner.entrainment_speed[0],
            SECOND,
            1e-6 * entrainment,
            rounding,
        ),
        compared(
            "inner raceway, heaviest ball", "film parameter", "1", Lambda, parameter, SECOND, 1e-6 * Lambda, rounding
        ),
    ]
    azimuth = np.degrees(solution.azimuth)
    shown = np.where(azimuth > 180.0, azimuth - 360.0, azimuth)
    order = np.argsort(shown)
    pressed = order[solution.inner.load[order] > 0.0]
    return CaseResult(
        f"Heaviest ball {Q:.1f} N; minimum film {1e6 * films.inner.minimum_thickness[0]:.4f} µm inside and "
        f"{1e6 * films.outer.minimum_thickness[0]:.4f} µm outside, the same as in a second evaluation.",
        rows,
        [
            Diagram(
                "azimuth from the load line, degrees",
                "ball load, N",
                [
                    Curve("solved", "dots", shown[order], solution.inner.load[order]),
                    Curve("second evaluation, heaviest ball", "circles", [0.0], [load]),
                ],
                title="load distribution",
            ),
            Diagram(
                "azimuth from the load line, degrees",
                "minimum film, µm",
                [
                    Curve("inner raceway", "dots", shown[pressed], 1e6 * films.inner.minimum_thickness[pressed]),
                    Curve("outer raceway", "squares", shown[pressed], 1e6 * films.outer.minimum_thickness[pressed]),
                ],
                title="films of loaded balls",
            ),
        ],
    )
