"""ROSS with our bearings against a rigid body that knows nothing of it: every sign and place of the axes."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.files.stiffness_files import ross_module, seats_of
from qsbearing.systems.rotor_dynamics import in_rotor_axes
from tests.systems.rotor_dynamics.rigid_rotor import MIRROR, cylinder, eigenvalues
from tests.systems.rotor_dynamics.rotor_program import load
from tests.systems.rotor_dynamics.scenes import pair, spindle_bearing

ross = load()

SPEEDS = np.linspace(0.0, 15_000.0, 6) * qs.rpm
LENGTH, DIAMETER, DENSITY, ELEMENTS = 0.4, 0.05, 7800.0, 8
STIFFER = 1e5
"""Times steel, so that the shaft hardly bends."""
TOLERANCE = 1e-5
"""Of an eigenvalue: the bending that is left moves them by 0.52/STIFFER at most; so it does from 1e2 to 1e6 times."""
FRONT, REAR = 1, 6
"""Nodes of the bearings; 0.05 m from one to the next."""


def rotor(*bearings: Any) -> Any:
    """A cylinder that hardly bends."""
    material = ross.Material("stiff", rho=DENSITY, E=208e9 * STIFFER, Poisson=0.3)
    element = {"L": LENGTH / ELEMENTS, "idl": 0.0, "odl": DIAMETER, "material": material}
    return ross.Rotor([ross.ShaftElement(**element) for _ in range(ELEMENTS)], [], list(bearings))


def place(node: int) -> float:
    """From the centre of mass."""
    return node * LENGTH / ELEMENTS - LENGTH / 2.0


def expected(speed: float, front: NDArray, rear: NDArray) -> NDArray:
    mass, polar, diametral = cylinder(DENSITY, LENGTH, DIAMETER)
    return eigenvalues(mass, polar, diametral, speed, [(place(FRONT), front), (place(REAR), rear)])


def assert_found(wanted: NDArray, rotor: Any, speed: float) -> None:
    """Every eigenvalue of the rigid body is one of the rotor's."""
    found = np.linalg.eigvals(rotor.A(speed))
    nearest = np.abs(found[:, None] - wanted).min(axis=0)
    assert (nearest < TOLERANCE * np.abs(wanted)).all(), nearest / np.abs(wanted)


@pytest.mark.parametrize("number", [0, 3, 5])
@pytest.mark.parametrize("turned", ["front", "rear"])
def test_a_rigid_shaft_on_two_bearings_vibrates_as_a_rigid_body(number: int, turned: str) -> None:
    """Whole matrices at speed, unsymmetric and full, one bearing mounted the other way round."""
    solution = spindle_bearing(SPEEDS)
    mirrored = {"front": turned == "front", "rear": turned == "rear"}
    made = rotor(
        solution.to_ross(FRONT, mirrored=mirrored["front"], tag="front"),
        solution.to_ross(REAR, mirrored=mirrored["rear"], tag="rear"),
    )
    own = solution.stiffness[number]
    turn = {name: MIRROR @ own @ MIRROR if is_mirrored else own for name, is_mirrored in mirrored.items()}
    wanted = expected(SPEEDS[number], turn["front"], turn["rear"])
    assert_found(wanted, made, SPEEDS[number])
    unturned = np.sort(np.abs(expected(SPEEDS[number], own, own)))
    assert np.abs(np.sort(np.abs(wanted)) - unturned).max() > 10.0 * TOLERANCE * unturned.max()  # that is seen


@pytest.mark.parametrize("tilt", ["held", "free"])
def test_its_own_element_holds_what_is_left_of_translations(tilt: str) -> None:
    solution = spindle_bearing(SPEEDS[4])
    made = [solution.to_ross(node, tilt=tilt, tag=str(node)) for node in (FRONT, REAR)]
    assert {type(each) for each in made} == {ross.BearingElement}
    order = [1, 2, 0]
    if tilt == "held":
        left = solution.stiffness[np.ix_(order, order)]
    else:
        left = np.linalg.inv(np.linalg.inv(solution.stiffness)[np.ix_(order, order)])
    kept = np.zeros((5, 5))  # radial block and axial stiffness: the element has no place for more
    kept[1:3, 1:3], kept[0, 0] = left[:2, :2], left[2, 2]
    assert_found(expected(SPEEDS[4], kept, kept), rotor(*made), SPEEDS[4])


def test_a_set_is_its_rows_at_their_places() -> None:
    """One element for a pair at its middle, and one element per row: the same rotor."""
    solution = pair(SPEEDS, 800.0)
    assert np.all(solution.converged)
    one = rotor(solution.to_ross(4, tag="set"))
    front, rear = solution.rows
    two = rotor(front.to_ross(3, tag="front"), rear.to_ross(5, tag="rear", mirrored=True))
    assert_found(np.linalg.eigvals(two.A(SPEEDS[3]))[lowest(two, SPEEDS[3])], one, SPEEDS[3])


def test_the_module_of_a_file_makes_the_same_elements() -> None:
    """Of a pair, each row about its balls' centres."""
    solution = pair(SPEEDS[3], 800.0)
    seats = seats_of(solution, "N-m-kg")
    names: dict[str, Any] = {}
    exec(compile(ross_module(seats), "bearings.py", "exec"), names)
    made = rotor(*names["bearings"](FRONT, REAR))
    assert_found(expected(SPEEDS[3], *(each.stiffness for each in seats)), made, SPEEDS[3])


def lowest(rotor: Any, speed: float) -> NDArray:
    """Which eigenvalues are those of a rigid body: ten, after the two of the free rotation."""
    return np.argsort(np.abs(np.linalg.eigvals(rotor.A(speed))))[2:12]


def test_ross_has_no_tilt_stiffness_of_its_own() -> None:
    """Why there is an element of ours, and what a version with one would be noticed by."""
    assert ross.__version__ in ("2.3.0", "3.0.0", "3.1.0")
    plain = ross.BearingElement(n=0, kxx=1.0, cxx=0.0)
    assert plain.K(0.0).shape == (3, 3)
    made = spindle_bearing(SPEEDS).to_ross(0)
    assert made.K(SPEEDS[2]).shape == made.C(0.0).shape == made.M(0.0).shape == (5, 5)


def test_stiffness_is_met_at_every_speed_given_and_goes_smoothly_between() -> None:
    solution = spindle_bearing(SPEEDS)
    between = spindle_bearing(0.5 * (SPEEDS[1:] + SPEEDS[:-1]))
    whole, plain = solution.to_ross(0), solution.to_ross(0, tilt="held")
    for number, speed in enumerate(SPEEDS):
        wanted = in_rotor_axes(solution.stiffness[number])
        assert whole.K(speed) == pytest.approx(wanted, rel=1e-9, abs=1e-9)
        # ROSS's splines may miss by the square root of the number of speeds, in N/m.
        assert plain.K(speed)[:2, :2] == pytest.approx(wanted[:2, :2], rel=1e-9, abs=3.0)
        assert plain.K(speed)[2, 2] == pytest.approx(wanted[2, 2], rel=1e-9, abs=3.0)
    for number, speed in enumerate(0.5 * (SPEEDS[1:] + SPEEDS[:-1])):
        wanted = np.diag(in_rotor_axes(between.stiffness[number]))
        assert np.diag(whole.K(speed)) == pytest.approx(wanted, rel=0.02)  # cubics over 3000 rpm each
        assert whole.K(speed)[:2, :2] == pytest.approx(plain.K(speed)[:2, :2], rel=1e-7, abs=10.0)  # as ROSS does it


@pytest.mark.skipif(ross.__version__.startswith("2."), reason="ROSS 2 knows one frequency, that of the shaft")
@pytest.mark.parametrize("tilt", ["included", "held"])
def test_stiffness_follows_the_speed_of_the_shaft_whatever_the_whirl(tilt: str) -> None:
    """ROSS 3 asks for coefficients at both; ours know the shaft's, and outside it goes on as ROSS's own do."""
    solution = spindle_bearing(SPEEDS)
    made, plain = solution.to_ross(0, tilt=tilt), solution.to_ross(0, tilt="held")
    for speed in (SPEEDS[2], 1.1 * SPEEDS[-1]):
        assert (made.K(10.0, speed) == made.K(1e4, speed)).all()
        assert (made.K(10.0, speed) == made.K(speed)).all()
        assert (made.K(10.0, speed)[:2, :2] == plain.K(speed)[:2, :2]).all()
    linear = solution.to_ross(0, tilt=tilt, interpolation="linear")
    middle = 0.5 * (SPEEDS[2] + SPEEDS[3])
    assert linear.K(middle) == pytest.approx(0.5 * (made.K(SPEEDS[2]) + made.K(SPEEDS[3])), rel=1e-12)


def test_a_single_case_is_the_same_at_every_speed() -> None:
    solution = spindle_bearing(SPEEDS)
    made = solution.to_ross(0, index=3)
    assert made.frequency is getattr(made, "speed", None) is None
    assert (made.K(0.0) == in_rotor_axes(solution.stiffness[3])).all()
    again = qs.to_ross(solution.stiffness[3], SPEEDS[3], 0)
    assert (again.K(1.0) == made.K(1.0)).all()
    assert qs.to_ross(solution.stiffness, SPEEDS, 0).K(99.0) == pytest.approx(solution.to_ross(0).K(99.0), rel=1e-15)


def test_damping_is_nothing_unless_it_is_given_and_acts_on_translations() -> None:
    solution = spindle_bearing(SPEEDS)
    assert not solution.to_ross(0).C(SPEEDS[1]).any()
    found = solution.to_ross(0, cxx=300.0, cyy=200.0, czz=100.0).C(SPEEDS[1])
    assert found == pytest.approx(np.diag([300.0, 200.0, 100.0, 0.0, 0.0]), abs=1e-9)


def test_what_ross_does_with_a_rotor_goes_with_the_element(tmp_path: Path) -> None:
    """Copies, added nodes, unbalance response, static deflection; files are refused, not halved."""
    solution = spindle_bearing(SPEEDS)
    made = rotor(*(solution.to_ross(node, tag=str(node), cxx=100.0) for node in (FRONT, REAR)))
    wanted = np.linalg.eigvals(made.A(SPEEDS[2]))[lowest(made, SPEEDS[2])]
    for other in (made.add_nodes([0.375]), copy.deepcopy(made)):
        assert_found(wanted, other, SPEEDS[2])
    response = made.run_unbalance_response(0, 1e-6, 0.0, SPEEDS[1:3])
    assert np.isfinite(response.forced_resp).all()
    assert len(made.run_static().deformation) == ELEMENTS + 1
    with pytest.raises(NotImplementedError, match="hold no tilt stiffness"):
        made.save(tmp_path / "rotor.toml")
