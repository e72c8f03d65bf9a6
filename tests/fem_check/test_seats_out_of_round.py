"""Seats out of round against the equilibrium that the reference finds from the drawing alone, with lobes of its own."""

from dataclasses import replace

import pytest

import qsbearing as qs
from fem_check.checks import product_scenes
from fem_check.product import problems, scenes, solution_equilibrium
from fem_check.product.scenes import SolvedPoint
from tests.fem_check.test_solution_contacts import BALANCE, CONTACT, INERTIA, MOTION, failing, judged, passing
from tests.qsbearing.scenes import lobes

SEATS = lobes(2e-6)
LABELS = (
    "loads turned by 217 degrees, free to tilt, at rest",
    "loads turned by 217 degrees, free to tilt, 8000 rpm",
    "both rings turn, 5000 and -3000 rpm",
    "unequal balls, 6000 rpm",
    "minimum dissipation, 8000 rpm",
    "displaced orbit, 10000 rpm",
    "deep groove with 10 µm of clearance, at rest",
)


def with_seats(label: str) -> qs.Scene:
    """One of the product's scenes, and lobes in it."""
    scene = product_scenes.scenes()[label]
    return replace(scene, ring_effects=(*scene.ring_effects, SEATS))


@pytest.mark.parametrize("label", LABELS)
def test_lobes_are_judged_and_right(label):
    scene = with_seats(label)
    rows = judged((SolvedPoint(label, scenes.solve("", label, scene)),))
    assert failing(rows) == set()
    assert passing(rows) >= CONTACT | BALANCE | {"load, moments over the lever", "stiffness, tilts at the lever"}
    if scene.ball_effects:
        assert passing(rows) >= MOTION | INERTIA


@pytest.mark.parametrize(
    "wrong",
    [
        {"outer_two_lobe_amplitude": 1.001 * SEATS.outer_two_lobe_amplitude},
        {"inner_three_lobe_phase": SEATS.inner_three_lobe_phase + 1e-3},
        {"outer_three_lobe_amplitude": None, "outer_three_lobe_phase": None},
    ],
    ids=["amplitude by a thousandth", "phase by a milliradian", "one form left out"],
)
def test_other_lobes_are_seen(wrong):
    """Judged by the solution of lobes that are a little other ones, each is red."""
    label = LABELS[1]
    scene = with_seats(label)
    solution = scenes.solve("", label, scene)
    other = replace(scene, ring_effects=(replace(SEATS, **wrong),))
    rows = list(
        solution_equilibrium.equilibrium_rows(
            label, lambda: problems.of_scene(other, label), (solution,), solution, solution.displacement
        )
    )
    assert failing(rows) & {"contact load", "approach and gap"}
