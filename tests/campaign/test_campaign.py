"""The campaign itself: drawn the same every time, checks that can fail, certificates that hold; and 10 000 scenes."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.compiled import COMPILED
from qsbearing.newton import STALLED
from tests.campaign.__main__ import scene_text
from tests.campaign.campaign import run_campaign
from tests.campaign.certificates import (
    as_left,
    certify,
    null_motion,
    pushes,
    restrictions_broken,
    supports_nothing,
    unsupported_direction,
)
from tests.campaign.checks import findings
from tests.campaign.chunk import run_chunk
from tests.campaign.envelope import HELD, Group, chunk_groups
from tests.campaign.journal import Journal
from tests.campaign.sizes import CHUNK, GROUP
from tests.campaign.summary import quantile, summarise
from tests.campaign.worker import Task, Worker, learned, memory_MB
from tests.qsbearing.scenes import B218, BOTH, DEEP_GROOVE, INNER, OUTER, PER_BALL, resting, solved, turning

compiled_only = pytest.mark.skipif(not COMPILED, reason="thousands of scenes take hours in plain Python")


def same(one: Group, other: Group) -> bool:
    """Whether two groups hold the same numbers."""
    return one.toml(0, "") == other.toml(0, "") and all(
        np.array_equal(value, other.operation[key]) for key, value in one.operation.items()
    )


def one_case(named: str, seed: int = 1) -> tuple[Group, qs.Solution]:
    """A scene as the campaign has it, and its solution."""
    chunk, index = map(int, named.split("/"))
    group = chunk_groups(seed, chunk)[index // GROUP].part([index % GROUP])
    return group, qs.solve(group.scene(), threads=1)


def assert_sound(group: Group, solution: qs.Solution) -> None:
    """That the one case converged and passes every check."""
    assert solution.converged.all()
    assert not any(bad.any() for bad in findings(group.scene(), solution).failed().values())


def certificate_of(group: Group, solution: qs.Solution) -> str:
    """The kind of certificate of the one case's refusal, which it must be."""
    assert solution.status == [qs.Status.NO_EQUILIBRIUM]
    return certify(group, solution, np.array([0]))[0].kind


# Drawing ------------------------------------------------------------------------------------------------------------


def test_a_draw_depends_on_seed_and_chunk_alone() -> None:
    again = chunk_groups(3, 17)
    for one, other in zip(chunk_groups(3, 17), again, strict=True):
        assert same(one, other)
    assert not same(chunk_groups(4, 17)[0], again[0])
    assert not same(chunk_groups(3, 18)[0], again[0])


def test_a_shorter_chunk_is_the_beginning_of_the_whole() -> None:
    whole, part = chunk_groups(3, 2), chunk_groups(3, 2, 2 * GROUP + 7)
    assert [group.size for group in part] == [GROUP, GROUP, 7]
    assert sum(group.size for group in whole) == CHUNK
    for one, other in zip(part, whole, strict=False):
        assert same(one, other.part(slice(0, one.size)))


def test_the_envelope_is_as_wide_as_it_says() -> None:
    """Sizes, angles, conformities, speeds, loads and every pattern of held channels come up."""
    groups = [group for chunk in range(8) for group in chunk_groups(5, chunk)]
    assert {group.held for group in groups} == set(HELD)
    assert {group.control for group in groups} == {None, *qs.RacewayControl}
    assert {group.kind for group in groups} == set(qs.BearingKind)
    assert {group.hertz_angle for group in groups} == set(qs.HertzAngle)

    def of(table: str, key: str) -> np.ndarray:
        return np.concatenate([getattr(group, table)[key] for group in groups if key in getattr(group, table)])

    diameter = of("bearing", "ball_diameter_mm")
    assert 0.5 <= diameter.min() < 0.52 < 96.0 < diameter.max() <= 100.0
    assert (of("bearing", "ball_count").min(), of("bearing", "ball_count").max()) == (3, 60)
    coefficient = of("bearing", "inner_groove_radius_mm") / diameter
    assert 0.5005 <= coefficient.min() < 0.501
    assert 0.7 < coefficient.max() <= 0.75
    angle = of("bearing", "free_contact_angle_deg")
    assert angle.min() == 0.0
    assert 73.0 < angle.max() <= 75.0
    parameter = of("bearing", "pitch_diameter_mm") * np.maximum(
        np.abs(of("operation", "speed_rpm")), np.abs(of("operation", "outer_speed_rpm"))
    )
    assert (parameter == 0.0).mean() > 0.05
    assert 4.8e6 < parameter.max() <= 5.0000001e6
    load = np.abs(of("operation", "axial_load_N"))
    assert load[load > 0.0].min() < 1e-5
    assert load.max() > 1e6


def test_a_scene_file_holds_the_scene_to_the_last_bit(tmp_path: Path) -> None:
    """Written, read back, and every number the same; what is solved from it ends as the batch does."""
    for group in chunk_groups(6, 0)[:: 5 if COMPILED else 40]:
        path = tmp_path / "scene.toml"
        path.write_text(group.toml(3, "A sentence\nof two lines."), encoding="utf-8")
        read, meant = qs.load_scene(path), group.part(3).scene()
        for name in ("hertz_angle", "hertz_form", "tilt_lever", "raceway_control", "ball_effects"):
            assert getattr(read, name) == getattr(meant, name)
        for part in ("bearing", "operation"):
            for name, value in vars(getattr(meant, part)).items():
                if name not in ("name", "ball_material", "ring_material"):
                    assert getattr(getattr(read, part), name) == value, name
        for side in ("ball_material", "ring_material"):
            for name in ("elastic_modulus", "poisson_ratio", "density"):
                assert getattr(getattr(read.bearing, side), name) == getattr(getattr(meant.bearing, side), name)


# Checks -------------------------------------------------------------------------------------------------------------


def failing(solution: qs.Solution) -> set[str]:
    """Which checks a solution of one case fails."""
    return {name for name, bad in findings(solution.scene, solution).failed().items() if bad[0]}


def sample(control: qs.RacewayControl = OUTER, **changes: Any) -> qs.Solution:
    loads = {"axial_load": 12e3, "radial_load_y": 3e3, "radial_load_z": -1.5e3, "moment_y": 40.0, "moment_z": -60.0}
    return solved(turning(np.array([6000.0]), control=control, **(loads | changes)))


@pytest.mark.parametrize("control", [OUTER, INNER, PER_BALL])
def test_sound_solutions_pass(control: qs.RacewayControl) -> None:
    assert failing(sample(control)) == set()
    assert failing(sample(control, axial_load=None, axial_displacement=20e-6)) == set()
    assert (
        failing(solved(resting(DEEP_GROOVE, axial_load=np.array([300.0]), radial_load_y=900.0, moment_z=1.0))) == set()
    )


def change_load(solution: qs.Solution, factor: float) -> None:
    solution.inner.load[0, 3] *= factor


def change_angle(solution: qs.Solution) -> None:
    solution.outer.angle[0, 5] += 1e-8


def change_displacement(solution: qs.Solution) -> None:
    solution.displacement[0, 1] += 1e-12


def change_reaction(solution: qs.Solution) -> None:
    solution.load[0, 2] *= 1.0 + 1e-9


@pytest.mark.parametrize(
    ("spoil", "red"),
    [
        (lambda s: change_load(s, 1.0 + 1e-8), {"imbalance", "hertz"}),
        (lambda s: change_load(s, -1.0), {"imbalance", "tension"}),
        (lambda s: change_load(s, np.nan), {"imbalance", "not_finite", "tension"}),
        (lambda s: change_load(s, 0.0), {"imbalance", "tension"}),
        (change_angle, {"imbalance", "closure"}),
        (change_displacement, {"closure"}),
        (change_reaction, {"imbalance"}),
        (lambda s: s._residual.__setitem__(0, np.nan), {"misreported"}),
        (lambda s: s.inner.semi_major_axis.__setitem__((0, 2), 1e-3), {"hertz"}),
        (lambda s: s.displacement.__setitem__((0, 0), np.inf), {"closure", "not_finite"}),
    ],
    ids=["load", "pull", "nan", "lost", "angle", "displacement", "reaction", "residual", "ellipse", "infinite"],
)
def test_each_check_turns_red(spoil: Any, red: set[str]) -> None:
    """A number changed by a hundred-millionth, or by a picometre, is found out."""
    solution = sample()
    for side in (solution.inner, solution.outer):
        assert side.load.size
        assert side.angle.size
    spoil(solution)
    assert red <= failing(solution)


def test_friction_without_load_is_seen() -> None:
    """Inner control beyond the speed at which the inner race can carry the friction: the state as it was left."""
    solution = qs.solve(turning(np.array([9600.0]), control=INNER, axial_load=2e3))
    assert solution.status[0] == "no_equilibrium"
    left = as_left(solution)
    if (left.inner.load == 0.0).all():
        assert "friction_without_load" in failing(left)


def test_the_open_side_is_seen() -> None:
    solution = solved(turning(np.array([2000.0]), replace(B218, kind=qs.BearingKind.DEEP_GROOVE), axial_load=-5e3))
    object.__setattr__(solution.scene.bearing, "kind", qs.BearingKind.ANGULAR_CONTACT)
    assert failing(solution) == {"open_side"}


def test_control_that_contradicts_jones_is_seen() -> None:
    solution = sample(PER_BALL)
    assert not findings(solution.scene, solution).control[0]
    solution = sample(PER_BALL)
    solution._control[:] = 1 - solution._control
    assert findings(solution.scene, solution).control[0]


# Certificates -------------------------------------------------------------------------------------------------------


def test_a_reversed_thrust_is_unsupported_along_the_axis() -> None:
    """The only direction: the ring moves back along x, and no ball is pressed."""
    direction = unsupported_direction(resting(axial_load=-5e3))
    assert direction == pytest.approx([-1.0, 0.0, 0.0, 0.0, 0.0], abs=1e-12)


def test_a_moment_beyond_the_thrust_has_a_direction_that_is_checked() -> None:
    """Thrust needs its line of action within the ball circle: a moment beyond that tilts the ring off."""
    radius = float(B218.inner_groove_centre_radius)
    for factor, found in ((0.9, False), (1.1, True)):
        scene = resting(axial_load=1e3, moment_z=factor * 1e3 * radius)
        direction = unsupported_direction(scene)
        assert (direction is not None) == found
        if direction is not None:
            assert direction @ pushes(scene, 0.0) == pytest.approx(
                np.minimum(direction @ pushes(scene, 0.0), 0.0), abs=1e-12
            )
            assert supports_nothing(scene, direction)
            assert not supports_nothing(scene, -direction)


def test_friction_on_the_ring_forbids_the_certificate() -> None:
    """Under inner control friction, too, pushes the ring: the cone of normal loads proves nothing."""
    assert unsupported_direction(turning(3000, control=INNER, effects=BOTH, axial_load=-5e3)) is None
    assert unsupported_direction(turning(0, control=INNER, effects=BOTH, axial_load=-5e3)) is not None
    assert unsupported_direction(turning(3000, control=OUTER, effects=BOTH, axial_load=-5e3)) is not None


def test_a_ring_on_one_ball_moves_without_end() -> None:
    one = replace(B218, ball_count=1, kind=qs.BearingKind.DEEP_GROOVE)
    assert null_motion(resting(one, moment_y=3.0)) is not None
    assert null_motion(resting(replace(one, ball_count=3), axial_load=5.0, moment_y=3.0)) is None
    held = {"radial_displacement_y": 0.0, "radial_displacement_z": 0.0, "tilt_y": 0.0, "tilt_z": 0.0}
    assert null_motion(resting(one, axial_load=5.0, **held)) is None


def test_no_certificate_for_what_has_an_equilibrium() -> None:
    """Every scene of a chunk that is solved: nothing proves that it cannot be."""
    for group in chunk_groups(8, 0)[:: 4 if COMPILED else 39]:
        solution = qs.solve(group.scene(), threads=1)
        good = ~np.any(list(findings(group.scene(), solution).failed().values()), axis=0) & solution.converged
        for k in np.flatnonzero(good):
            assert unsupported_direction(group.part(int(k)).scene()) is None
            assert null_motion(group.part(int(k)).scene()) is None
        broken = restrictions_broken(group, solution)
        for name in ("open_side", "over_shoulder", "friction_without_load"):
            assert not (broken[name] & good).any(), name


@pytest.mark.parametrize("named", ["172/34", "375/434"])
def test_a_balance_at_rest_that_no_speed_outlives_is_a_certificate(named: str) -> None:
    """Balls at rest that touch neither raceway have no place: what is told of one speaks against no balance."""
    group, solution = one_case(named)
    assert solution.status == [qs.Status.NO_EQUILIBRIUM]
    assert solution.speed_reached == [0.0]
    assert certificate_of(group, solution) == "open side, followed up in speed"


# Keeping count ------------------------------------------------------------------------------------------------------


def test_quantiles() -> None:
    assert quantile({3: 98, 7: 1, 50: 1}, 0.5) == 3
    assert quantile({3: 98, 7: 1, 50: 1}, 0.99) == 7
    assert quantile({3: 98, 7: 1, 50: 1}, 0.9999) == 50
    assert quantile({}, 0.5) is None


def test_a_worker_that_does_not_come_back_teaches_where() -> None:
    """First its group is solved scene by scene, then the scene is left out; a worker that never began is an error."""
    task = Task(4, CHUNK)
    assert learned(Worker(None, None, 0.0, task, (7, -1))).isolated == {7}  # type: ignore[arg-type]
    assert learned(Worker(None, None, 0.0, task, (7, 3))).hung == {7 * GROUP + 3}  # type: ignore[arg-type]
    with pytest.raises(RuntimeError, match="start"):
        learned(Worker(None, None, 0.0, task))  # type: ignore[arg-type]


def test_what_hangs_or_raises_is_a_failure_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """A scene that does not come back is left out, one that raises is told apart; their neighbours are solved."""
    count = GROUP if COMPILED else 4
    clean = run_chunk(9, 0, count)
    hung = run_chunk(9, 0, count, isolated={0}, hung={2})
    assert hung["classes"]["hung"] == 1
    assert sum(hung["classes"].values()) == count
    assert [failure["index"] for failure in hung["failures"] if failure["status"] == "hung"] == [2]
    assert sum(clean["classes"].values()) == count

    solve = qs.solve

    def solve_but(scene: qs.Scene, **options: Any) -> qs.Solution:
        if np.size(scene.operation.speed) != 1 or float(np.asarray(scene.operation.speed).flat[0]) == spoilt:
            raise ZeroDivisionError("on purpose")
        return solve(scene, **options)

    spoilt = float(np.asarray(chunk_groups(9, 0)[0].part([1]).scene().operation.speed)[0])
    monkeypatch.setattr(qs, "solve", solve_but)
    raised = run_chunk(9, 0, count)
    indices = [failure["index"] for failure in raised["failures"] if failure["status"] == "raised"]
    assert 1 in indices
    assert all("on purpose" in failure["what"] for failure in raised["failures"] if failure["status"] == "raised")


def test_a_campaign_is_resumed_where_it_stopped(tmp_path: Path) -> None:
    """A journal cut off in the middle of a line: what is whole is kept, the rest done again, the sum the same."""
    first = {"chunk": 0, "scenes": 10}
    journal = Journal(tmp_path, 5, "abc", resume=False)
    journal.add(first)
    journal.add({"chunk": 1, "scenes": 10})
    text = journal.path.read_text(encoding="utf-8")
    journal.path.write_text(text[:-5], encoding="utf-8")
    again = Journal(tmp_path, 5, "abc", resume=True)
    assert again.chunks == [first]
    again.add({"chunk": 1, "scenes": 10})
    assert journal.path.read_text(encoding="utf-8") == text
    with pytest.raises(ValueError, match="already"):
        Journal(tmp_path, 5, "abc", resume=False)
    with pytest.raises(ValueError, match="another campaign"):
        Journal(tmp_path, 6, "abc", resume=True)


@compiled_only
def test_ten_thousand_scenes(tmp_path: Path) -> None:
    """Every one converged and checked, or refused and certified; and the same summary from its journal."""
    before = memory_MB()  # what this process took for other tests counts in the campaign's peak
    summary = run_campaign(10_000, 1, tmp_path, workers=2)
    assert summary["count"] == 10_000
    again = run_campaign(10_000, 1, tmp_path, workers=2, resume=True)
    changing = ("seconds", "peak_memory_MB")
    assert {**again, **dict.fromkeys(changing)} == {**summary, **dict.fromkeys(changing)}
    assert json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))["digest"] == summary["digest"]
    assert summary["peak_memory_MB"] - before <= 900
    assert [path.name for path in (tmp_path / "failures").glob("*.toml")] == []
    assert summary["failures_total"] == 0
    assert summary["largest"]["residual"] <= STALLED
    iterations = summary["iterations_of_converged"]
    assert iterations["median"] <= 7


@compiled_only
@pytest.mark.parametrize("named", ["557/698", "569/513"])
def test_closing_chains_comes_to_an_end(named: str, tmp_path: Path) -> None:
    """Two scenes of which some chain opened again after every step, by rounding: the solver never came back."""
    path = tmp_path / "scene.toml"
    path.write_text(scene_text(1, named), encoding="utf-8")
    command = [sys.executable, "-m", "qsbearing", "run", str(path), "--json"]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert json.loads(ended.stdout)["status"] == "no_equilibrium"


@compiled_only
@pytest.mark.parametrize("named", ["71/198", "28/476", "90/247"])
def test_a_ball_leaves_the_outer_raceway(named: str, tmp_path: Path) -> None:
    """Three scenes that have a balance with some ball off a groove, which steps that only ever ease a contact miss."""
    path = tmp_path / "scene.toml"
    path.write_text(scene_text(1, named), encoding="utf-8")
    assert qs.solve(qs.load_scene(path)).converged


@compiled_only
@pytest.mark.parametrize("named", ["527/965", "703/801", "551/612", "261/496", "886/319"])
def test_contacts_so_light_that_next_to_nothing_resists_their_turning(named: str) -> None:
    """What keeps an unloaded ball solvable must not resist it either: Newton's method squares the error here too."""
    group, solution = one_case(named)
    assert_sound(group, solution)
    assert solution.iterations[0] <= 10


def test_no_link_is_shorter_than_nothing() -> None:
    """Balls without load whose centre lies beyond the inner groove's: their one link at rest parts into two, and the
    inner one points the other way."""
    assert_sound(*one_case("676/346"))


@compiled_only
@pytest.mark.parametrize("named", ["0/434", "0/436", "0/448", "2/64", "2/74", "4/711", "6/852"])
def test_loads_ahead_of_inertia_lead_to_a_sound_balance(named: str) -> None:
    """The balance at rest is next to it; from closed forms Newton's method met another first, in which balls slip."""
    group, solution = one_case(named)
    assert_sound(group, solution)
    assert solution.iterations[0] <= 20


@compiled_only
@pytest.mark.parametrize("named", ["0/997", "2/272", "2/73", "9/96"])
def test_a_sound_balance_up_in_speed(named: str) -> None:
    """Under every limit of friction balls slip or leave their grooves; followed up from rest without one, none does."""
    assert_sound(*one_case(named))


@compiled_only
@pytest.mark.parametrize("named", ["3/856", "3/946", "5/342", "7/20", "2/457"])
def test_controls_that_agree_are_found_from_the_inner_ones(named: str) -> None:
    """From outer control of all balls Newton's method ends where controls and balance contradict each other, or
    (the last) over the shoulder."""
    group, solution = one_case(named)
    assert_sound(group, solution)
    assert solution.control_is_consistent[0]


@compiled_only
def test_a_ball_that_only_rounding_presses_is_not_rolled() -> None:
    """Balls that lie free, their inner approach 4e-17 m, would be asked for friction that nothing carries."""
    assert_sound(*one_case("280/206"))


@compiled_only
@pytest.mark.parametrize("named", ["506/485", "135/256", "315/215", "88/874"])
def test_a_ball_on_top_of_the_inner_groove(named: str) -> None:
    """Where that lies below the outer groove's top, the ball thrown there goes no further: over the inner shoulder."""
    group, solution = one_case(named)
    assert solution.reason == [qs.Reason.OVER_SHOULDER]
    assert certificate_of(group, solution) == "over the shoulder, a balance"


@compiled_only
@pytest.mark.parametrize("named", ["115/255", "132/838"])
def test_balls_that_slip_at_a_tenth_of_their_load(named: str) -> None:
    """No balance with friction as large as load is found, one with a tenth is, and its balls are asked for more."""
    group, solution = one_case(named)
    assert solution.reason == [qs.Reason.FRICTION_WITHOUT_LOAD]
    assert solution.speed_reached == [1.0]
    assert not restrictions_broken(group, solution, (None, 1.0))["friction_above_load"].any()
    assert restrictions_broken(group, solution)["friction_above_load"].all()


@compiled_only
@pytest.mark.parametrize("named", ["529/807", "544/838"])
def test_loads_lightened_to_the_last(named: str) -> None:
    """Balances that heavier loads lead to, if the last steps down are as short as they must be."""
    assert certificate_of(*one_case(named)) == "over the shoulder, a balance"


@compiled_only
def test_loads_far_below_the_dead_forces_of_a_path() -> None:
    """They must come into their own while there is still way to go; the second's balance is sound."""
    assert certificate_of(*one_case("44/46")) == "over the shoulder, a balance"
    assert_sound(*one_case("49/907"))


@pytest.mark.parametrize("named", ["28/423", "755/903"])
def test_an_inner_link_far_shorter_than_the_outer_one(named: str) -> None:
    """What the outer link's rounding leaves to the inner one is no gap, though it is many roundings of its own."""
    group, solution = one_case(named)
    assert_sound(group, solution)
    assert solution.iterations[0] <= 10


@compiled_only
@pytest.mark.parametrize(
    ("named", "certificate"), [("634/554", "friction above the load"), ("862/423", "over the shoulder")]
)
def test_a_path_among_loads_near_the_rounding_of_inertia(named: str, certificate: str) -> None:
    """Rounding of the largest force is more of these balls' loads than balance on a path asks for elsewhere."""
    assert certificate_of(*one_case(named)) == f"{certificate}, a balance"


@compiled_only
def test_frozen_forces_where_paths_are_lost() -> None:
    """Paths from heavy loads and from pressed balls are lost here, and so is the way to ever lighter loads."""
    assert_sound(*one_case("695/25"))
    assert certificate_of(*one_case("852/868")) == "over the shoulder, a balance"


@compiled_only
@pytest.mark.parametrize(
    ("seed", "named", "certificate"),
    [
        (1, "755/417", "over the shoulder, a balance"),
        (1, "356/841", "over the shoulder, a balance"),
        (2, "96/971", "over the shoulder, a balance"),
        (3, "48/242", "friction above the load, a balance"),
        (4, "38/460", "over the shoulder, a balance"),
    ],
)
def test_fifty_balls_of_which_few_carry(seed: int, named: str, certificate: str) -> None:
    """Loads of a millionth of inertia and less: every path is lost here among equivalent places of the balls."""
    assert certificate_of(*one_case(named, seed)) == certificate


@compiled_only
@pytest.mark.parametrize("named", ["0/935", "2/436", "8/888", "5/71", "6/510", "8/538", "1/345", "7/782", "14/992"])
def test_a_sound_balance_beside_one_that_is_none(named: str) -> None:
    """A nearer start leads to the open side, over the shoulder, or, for the last three, to balls that slip."""
    group, solution = one_case(named, 3)
    assert_sound(group, solution)
    for side in (solution.inner, solution.outer):
        assert side.required_friction is None or np.nanmax(side.required_friction) <= 1.0


def test_lines_at_right_angles_are_checked_with_all_digits() -> None:
    """An arcsine near one has half of them: too few for a moment that vanishes with what the angle lacks."""
    assert certificate_of(*one_case("954/525")) == "open side, a balance"


@compiled_only
@pytest.mark.parametrize("named", ["300/96", "321/325"])
def test_a_balance_come_back_to_keeps_its_own_law_of_friction(named: str) -> None:
    """Other controls were tried, under other limits of friction, and led nowhere: the balance that refuses the scene,
    found with friction limited, is one under its own limit only."""
    assert certificate_of(*one_case(named)) == "over the shoulder, a balance"


@compiled_only
def test_a_moment_that_vanishes_by_mirroring_is_known_no_better_than_its_line() -> None:
    """Balls that touch the far side of the inner groove, which rolling sees mirrored, to 1e-15 of angle zero: what the
    rounding of angles makes of their moment is no imbalance."""
    assert_sound(*one_case("682/623"))


@compiled_only
@pytest.mark.parametrize("named", ["0/309", "0/977", "3/247", "3/433"])
def test_balls_that_slip_though_they_have_room_are_lifted(named: str) -> None:
    """Friction limited, a ball may end against a raceway that hardly presses it, and slip there: out of touch, where
    its grooves leave it room and nothing throws it, it has no moment to be carried."""
    assert_sound(*one_case(named))


@compiled_only
@pytest.mark.parametrize(
    "named, kind", [("305/42", "friction above the load, a balance"), ("321/178", "open side, a balance")]
)
def test_slipping_is_no_balance_however_far_the_way_out_of_it_led(named: str, kind: str) -> None:
    """Without its limit of friction Newton's method ran away from the balance in which balls slip: what it met there
    must not count among the forces of the balance come back to, beside which nothing would seem to slip."""
    assert certificate_of(*one_case(named)) == kind


@compiled_only
def test_the_same_chunk_twice_to_the_last_bit() -> None:
    """Whatever was solved before it, and in whatever company: the digest covers every status, load and displacement."""
    count = 4 * GROUP
    first = run_chunk(1, 3, count)
    run_chunk(1, 4, GROUP)
    again = run_chunk(1, 3, count)
    for key in first.keys() - {"seconds"}:
        assert first[key] == again[key], key


def test_a_summary_adds_up() -> None:
    chunks = [run_chunk(2, chunk, GROUP if COMPILED else 2) for chunk in (0, 1)]
    summary = summarise(2, chunks, 1.0, 100.0)
    assert summary["count"] == sum(summary["classes"].values()) == sum(chunk["scenes"] for chunk in chunks)
    assert sum(sum(row.values()) for row in summary["families"].values()) == summary["count"]
    assert summary["failures_total"] == sum(len(chunk["failures"]) for chunk in chunks)
    refused = summary["classes"].get("no_equilibrium", 0)
    assert sum(summary["no_equilibrium"]["certificates"].values()) == refused
