"""All operating points of one support of a ball between both rings: what they resolve, and what is said of them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from fem_check.rows import row_text
from fem_check.rows.agreement import AgreementRow, MeshLevel
from fem_check.solids.bearing_sector import OuterSupport
from fem_check.solids.sector_comparison import QUANTITIES
from fem_check.solids.sector_study import MOMENT_STEP, WITH_RINGS, Studied, quantity_kind

BOUNDS = {
    "axial_displacement": 0.2,
    "load": 0.05,
    "angle": 0.02,
    "semi_major_axis": 0.2,
    "semi_minor_axis": 0.5,
}
"""Largest uncertainty allowed at the release level, outside diameter fixed, centrifugal force alone; in per cent, of
angles in degrees."""
WITH_MOMENT = f"{OuterSupport.RIGID}{MOMENT_STEP}"
"""Names the series with the gyroscopic moment."""


def largest_uncertainty(states: dict[str, Any]) -> dict[str, float]:
    """Of any case of one series, per kind of quantity; per cent or degrees."""
    largest = dict.fromkeys(BOUNDS, 0.0)
    for curve in states.values():
        for name in QUANTITIES:
            kind = quantity_kind(name)
            if kind in BOUNDS:
                largest[kind] = max(largest[kind], *curve[name]["uncertainty"])
    return largest


def uncertainty_rows(series: dict[str, Any]) -> list[AgreementRow]:
    """What the comparison with the model resolves where the outside diameter is fixed.

    It has a tolerance where centrifugal force acts alone. With the gyroscopic moment it is a finding: none was set
    before that series was first run.
    """
    alone = "outside diameter rigid, centrifugal force alone, all loads and speeds: largest uncertainty"
    with_moment = "outside diameter rigid, gyroscopic moment, all loads at speed: largest uncertainty"
    return [
        *_uncertainties(
            alone,
            series[str(OuterSupport.RIGID)],
            "what the comparison must resolve: a twentieth to a fifth of the largest difference in these cases",
            BOUNDS,
        ),
        *(
            _uncertainties(with_moment, series[WITH_MOMENT], "a finding: see the notes")
            if WITH_MOMENT in series
            else ()
        ),
    ]


def _uncertainties(
    case: str, states: dict[str, Any], why: str, bounds: Mapping[str, float] = MappingProxyType({})
) -> list[AgreementRow]:
    """Rows of the largest uncertainties of one series; without a bound a finding."""
    return [
        AgreementRow(
            case,
            kind,
            "deg" if kind == "angle" else "1",
            0.0,
            "four meshes, and sixteen positions of the contact's edge",
            value if kind == "angle" else value / 100.0,
            None,
            (100.0 if kind == "angle" else 1.0) * bounds[kind] if kind in bounds else None,
            why,
        )
        for kind, value in largest_uncertainty(states).items()
    ]


def keep(series: dict[str, Any], studied: Studied) -> None:
    """Add a point to the series from which the report draws."""
    state = "at speed" if studied.point.speed else "at rest"
    curve = series.setdefault(studied.series, {}).setdefault(state, {"load_N": []})
    curve["load_N"].append(studied.point.axial_load)
    # At speed the displacement passes through zero as the load falls: per cents of it would mislead.
    difference = studied.compared.elements["axial_displacement"] - studied.compared.model["axial_displacement"]
    curve.setdefault("grown_um", []).append(1e6 * difference)
    for name in QUANTITIES:
        entry = curve.setdefault(name, {"deviation": [], "uncertainty": []})
        entry["deviation"].append(studied.deviation(name))
        entry["uncertainty"].append(studied.uncertain(name))


def _spans(states: dict[str, Any]) -> str:
    """Of one series: the differences from the model."""

    def span(name: str, unit: str) -> str:
        values = [value for curve in states.values() for value in curve[name]["deviation"]]
        return f"{min(values):+.2g} to {max(values):+.2g}{unit}"

    moved = ", ".join(
        f"{min(curve['grown_um']):+.1f} to {max(curve['grown_um']):+.1f} µm {state}" for state, curve in states.items()
    )
    return (
        f"axial displacement {moved}; inner contact load {span('inner load', ' %')}, inner contact angle "
        f"{span('inner angle', '°')}."
    )


def support_note(series: dict[str, Any]) -> str:
    """What a free outside diameter changes against rigid rings; empty without that series."""
    if str(OuterSupport.FREE) not in series:
        return ""
    return (
        f"With the outside diameter free, against the model's rigid rings: {_spans(series[str(OuterSupport.FREE)])} "
        "The designer must decide which seat applies: a tight fit in a stiff housing is near the rigid case, where the "
        "model holds within the rows above; a loose or thin housing lets the outer ring grow. That softens the bearing "
        "axially and takes preload away, far more than anything that Hertz leaves out, and it turns the contact angle."
    )


def rings_note(series: dict[str, Any]) -> str:
    """What is left of that with elastic rings in the model; empty without that series."""
    with_rings = series.get(f"{OuterSupport.FREE}{WITH_RINGS}")
    if with_rings is None:
        return ""
    return (
        f"Against the model with the effect elastic_rings, its outer ring free: {_spans(with_rings)} The section is "
        "a rectangle there, evenly loaded over its width; here it has its groove and shoulders, the load is where the "
        "contact is, and one face is held."
    )


def uncertainty_note(series: dict[str, Any], key: str, level: MeshLevel) -> str:
    """What the cases of one series resolve."""
    parts = [
        f"{row_text.in_words(name)} {value:.2g}{'°' if name == 'angle' else ' %'}"
        for name, value in largest_uncertainty(series[key]).items()
    ]
    return (
        f"Largest uncertainty of any case with the outside diameter {key} at the {level} level, meshes and positions "
        f"of the contact's edge together: {'; '.join(parts)}."
    )


def moment_note(series: dict[str, Any]) -> str:
    """Whether the series with gyroscopic moment would meet the tolerances of that without."""
    if WITH_MOMENT not in series:
        return ""
    largest = largest_uncertainty(series[WITH_MOMENT])
    more = [
        f"{row_text.in_words(kind)} {largest[kind]:.2g}{'°' if kind == 'angle' else ' %'} where {bound:g} are allowed"
        for kind, bound in BOUNDS.items()
        if largest[kind] > bound
    ]
    return (
        "The tolerances on the uncertainty are those of centrifugal force alone. No tolerance was set for the series "
        "with gyroscopic moment before its first run, so its uncertainties are findings; by the tolerances of "
        f"centrifugal force alone {'it would fail: ' + ', '.join(more) if more else 'it would pass'}."
    )
