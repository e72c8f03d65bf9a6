"""Evidence in the design report: each condition that a statement names is asked, and its numbers are the records'."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest

import qsbearing as qs
from qsbearing.documents.model import Badge
from qsbearing.reports.conditions import facts_of
from qsbearing.reports.evidence import statements
from tests.reports import evidence_numbers

B218 = qs.load_scene("B218")
OUTER = {"ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment()), "raceway_control": "outer"}
THRUST: dict[str, Any] = {"speed": 10_000 * qs.rpm, "axial_load": 17_800.0}


def scene(bearing: Any = B218.bearing, operation: dict[str, Any] | None = None, **other: Any) -> qs.Scene:
    return qs.Scene(bearing, qs.Operation(**(THRUST | (operation or {}))), **(OUTER | other))


def judged(of: qs.Scene, command: str) -> tuple[str, str]:
    """What the row of a command says of a scene: the word, and why."""
    solution = qs.solve(of)
    assert solution.converged
    (row,) = [row for row in statements([solution]) if f"{command}`" in row[0]]
    assert isinstance(row[2], Badge)
    return row[2].word, str(row[3])


def bearing(**lengths: float) -> qs.BallBearing:
    return B218.bearing.with_changed_lengths(**lengths)


LARGE_BALL = qs.BallDiameterDeviations([5 * qs.um] + 15 * [0.0])
GROWTH = qs.RingExpansion(90 * qs.mm, 160 * qs.mm)
SECTOR = "fem-check run bearing_sector"
CONTACTS = "fem-check run solution_contacts --scene SCENE"
GAP = "fem-check run conformity"
BODIES = "fem-check run true_geometry"
REFERENCE = "python -m tests.verification.reference.table"


def test_a_ring_that_nothing_loads_has_no_contact_to_judge() -> None:
    """And no warning of Python: those are errors here."""
    facts = facts_of(qs.solve(qs.Scene(B218.bearing, qs.Operation(axial_load=0.0))))
    assert (facts.ellipticity, facts.pressure, facts.loads["inner"]) == ((0.0, 0.0), 0.0, (0.0, 0.0))


def test_the_scenes_that_were_checked_are_covered() -> None:
    for command in (
        SECTOR,
        CONTACTS,
        GAP,
        "python -m tests.verification.reference.table",
        "pytest tests/fem_check/test_references.py",
    ):
        assert judged(scene(), command) == ("covered", "")
    at_rest = qs.Scene(B218.bearing, qs.Operation(axial_load=17_800.0))
    assert judged(at_rest, BODIES) == ("covered", "")
    hybrid = replace(B218.bearing, ball_material=qs.SILICON_NITRIDE)
    assert judged(scene(hybrid), CONTACTS) == ("covered", "")


@pytest.mark.parametrize(
    ("of", "command", "word", "why"),
    [
        (scene(operation={"speed": 18_000 * qs.rpm}), SECTOR, "similar", "18000 rpm, checked up to 10000 rpm"),
        (scene(operation={"outer_speed": -50.0}), SECTOR, "similar", "the outer ring turns"),
        (scene(operation={"axial_load": 60_000.0}), SECTOR, "similar", "axial load 60000 N, checked 500 to 44500 N"),
        (
            scene(operation={"radial_load_y": 3000.0, "tilt_y": 0.0, "tilt_z": 0.0}),
            SECTOR, "similar", "radial load 3000 N, checked thrust alone; moment or tilt, checked thrust alone",
        ),
        (scene(operation={"tilt_y": 0.0, "tilt_z": 3e-4}), SECTOR, "similar", "moment or tilt"),
        (scene(bearing(inner_groove_radius=1e-5)), SECTOR, "similar", "another bearing than B218"),
        (scene(replace(B218.bearing, ball_material=qs.SILICON_NITRIDE)), SECTOR, "similar", "another ball material"),
        (scene(ring_effects=(LARGE_BALL,)), SECTOR, "not covered", "no unequal balls in the check"),
        (scene(ring_effects=(GROWTH,)), SECTOR, "not covered", "no ring expansion in the check"),
        (scene(raceway_control="inner"), SECTOR, "not covered", "raceway control: inner, checked outer"),
        (scene(hertz_angle="actual"), SECTOR, "not covered", "each contact's own angle"),
        (scene(orbit_radius="displaced"), SECTOR, "not covered", "no balls on orbits of their own"),
        (scene(operation={"axial_load": 70_000.0}), CONTACTS, "similar", "inner contact load"),
        (scene(bearing(inner_groove_radius=2e-3)), GAP, "similar", "inner groove radius over D 0.6132, checked 0.505"),
        (scene(operation={"axial_load": 150_000.0, "speed": 0.0}), GAP, "similar", "inner Q/D² up to"),
        (
            scene(operation={"radial_load_y": 12_000.0, "tilt_y": 0.0, "tilt_z": 0.0}),
            GAP, "similar", "deg, checked at 40 deg",
        ),
        (qs.load_scene("7210C"), GAP, "similar", "another bearing than B218"),
        (scene(), BODIES, "similar", "outer contact angle 31.34 deg, checked 40.68 to 42.97 deg"),
        (scene(operation={"axial_load": 200_000.0}), "qsbearing run SCENE", "similar", "above 2742 MPa"),
        (scene(operation={"axial_load": 900_000.0}), "qsbearing run SCENE", "not covered", "above 4200 MPa"),
        (scene(hertz_form="hamrock_brewe_1983"), REFERENCE, "not covered", "the exact form"),
        (scene(ring_effects=(GROWTH,)), REFERENCE, "not covered", "no ring expansion"),
        (scene(readings={"life": {}}), "fem-check book endurance_1956", "not covered", "not a deep-groove bearing"),
        (scene(readings={"frequencies": {}}), "fem-check book motor_bearings", "similar", "checked up to 1800 rpm"),
        (qs.load_scene("7210C"), "fem-check book gmn_rigidities", "not covered", "no centrifugal force or gyroscopic"),
    ],
)  # fmt: skip
def test_each_condition_is_asked(of: qs.Scene, command: str, word: str, why: str) -> None:
    found, reason = judged(of, command)
    assert found == word, reason
    assert why in reason


def test_rings_that_do_not_grow_have_no_evidence_of_growth() -> None:
    """A ring effect that is not expansion was taken for one."""
    texts = [str(row[0]) for row in statements([qs.solve(scene(ring_effects=(LARGE_BALL,)))])]
    assert not any("Expansion of the rings" in text for text in texts)
    assert any("Unequal balls" in text for text in texts)


def test_the_numbers_are_those_of_the_records() -> None:
    """After new records: python -m tests.reports.evidence_numbers."""
    assert json.loads(evidence_numbers.NUMBERS.read_text(encoding="utf-8")) == evidence_numbers.numbers()


def test_a_result_stands_in_every_row() -> None:
    rows = statements([qs.solve(scene(readings={"life": {}, "frequencies": {}}))])
    results = {str(row[0]): str(row[1]) for row in rows}
    assert all(results.values())
    (sector,) = [text for says, text in results.items() if "bearing_sector" in says]
    assert "+1.5 to +32 %" in sector
    assert "loads within 0.73 %" in sector


def test_guide_and_readme_say_what_the_records_say() -> None:
    """Of a free outer ring against `solve`, and of predicted rigidities."""
    numbers = json.loads(evidence_numbers.NUMBERS.read_text(encoding="utf-8"))
    free, rigidities = numbers["bearing_sector"]["free"], numbers["gmn_rigidities"]
    page = " ".join((evidence_numbers.ROOT / "qsbearing/guide/elastic_rings.md").read_text(encoding="utf-8").split())
    low, high = free["displacement_percent"]
    assert f"{low:.1f} to {high:.0f} % larger than that of `solve`" in page
    assert f"the loads differ by up to {max(map(abs, free['load_percent'])):.1f} %" in page
    assert f"the angles are up to {free['angle_deg'][1]:.1f}° larger" in page
    readme = (evidence_numbers.ROOT / "README.md").read_text(encoding="utf-8")
    told = (
        f"{rigidities['values']} axial stiffnesses of a catalogue at 25° agree to {100.0 * rigidities['rms']:.1f} % rms"
    )
    assert f"{told} (grooves fitted at 15°)" in readme
