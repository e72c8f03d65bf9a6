"""Scenes are drawn the same every time, as widely as the envelopes say, and are the same when written to a file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from tests.verification.campaign.envelope import CHUNK, ENVELOPES, WHOLE, chunk_groups, scene_file, scene_name
from tests.verification.campaign.group import GROUP, Group
from tests.verification.campaign.realistic import ANGLES
from tests.verification.campaign.wild import CONTROLS, HELD

BEARING_KEYS = ("ball_diameter_mm", "inner_groove_radius_mm", "free_contact_angle_deg")
PINNED = {
    "ball_diameter_mm": 19911.998822572576,
    "inner_groove_radius_mm": 10654.943467828685,
    "free_contact_angle_deg": 21176.006692078783,
    "speed_rpm": 24078011.980433814,
    "outer_speed_rpm": 8694923.830150735,
    "axial_load_N": 10572811.119530857,
    "moment_y_Nm": 1498659.3625956893,
    "axial_displacement_um": 4483.290864098515,
    "tilt_z_mrad": 12.59528613172153,
    "first_ball_azimuth_deg": 113303.26741056371,
}
"""Sums of the sizes of chunk 7 of seed 1, as drawn for the first record."""

every_envelope = pytest.mark.parametrize("envelope", list(ENVELOPES))


def same(one: Group, other: Group) -> bool:
    """Whether two groups hold the same numbers."""
    return one.toml(0, "") == other.toml(0, "") and all(
        np.array_equal(value, other.operation[key]) for key, value in one.operation.items()
    )


def drawn(groups: list[Group], table: str, key: str) -> np.ndarray:
    """All values of a key."""
    return np.concatenate([getattr(group, table)[key] for group in groups if key in getattr(group, table)])


@every_envelope
def test_a_draw_depends_on_seed_and_chunk_alone(envelope: str) -> None:
    again = chunk_groups(3, 17, envelope=envelope)
    for one, other in zip(chunk_groups(3, 17, envelope=envelope), again, strict=True):
        assert same(one, other)
    assert not same(chunk_groups(4, 17, envelope=envelope)[0], again[0])
    assert not same(chunk_groups(3, 18, envelope=envelope)[0], again[0])


def test_the_wild_scenes_are_those_on_record() -> None:
    """Any other draw, or the same in another order, changes the last of a chunk."""
    groups = chunk_groups(1, 7)
    found = {
        key: float(np.abs(drawn(groups, table, key)).sum())
        for table, keys in (("bearing", BEARING_KEYS), ("operation", PINNED.keys() - set(BEARING_KEYS)))
        for key in keys
    }
    assert found == pytest.approx(PINNED, rel=1e-12)


@every_envelope
def test_a_shorter_chunk_is_the_beginning_of_the_whole(envelope: str) -> None:
    whole, part = chunk_groups(3, 2, envelope=envelope), chunk_groups(3, 2, 2 * GROUP + 7, envelope)
    assert [group.size for group in part] == [GROUP, GROUP, 7]
    assert sum(group.size for group in whole) == CHUNK
    for one, other in zip(part, whole, strict=False):
        assert same(one, other.part(slice(0, one.size)))


def test_the_wild_envelope_is_as_wide_as_it_says() -> None:
    """Sizes, angles, grooves, speeds, loads and every pattern of held channels come up."""
    groups = [group for chunk in range(8) for group in chunk_groups(5, chunk)]
    assert {group.held for group in groups} == set(HELD)
    assert {group.control for group in groups} == {None, *CONTROLS}
    assert {group.kind for group in groups} == set(qs.BearingKind) - {qs.BearingKind.FOUR_POINT}
    assert {group.hertz_angle for group in groups} == set(qs.HertzAngle)
    diameter = drawn(groups, "bearing", "ball_diameter_mm")
    assert 0.5 <= diameter.min() < 0.52 < 96.0 < diameter.max() <= 100.0
    count = drawn(groups, "bearing", "ball_count")
    assert (count.min(), count.max()) == (3, 60)
    coefficient = drawn(groups, "bearing", "inner_groove_radius_mm") / diameter
    assert 0.5005 <= coefficient.min() < 0.501
    assert 0.7 < coefficient.max() <= 0.75
    angle = drawn(groups, "bearing", "free_contact_angle_deg")
    assert angle.min() == 0.0
    assert 73.0 < angle.max() <= 75.0
    parameter = speed_parameter(groups)
    assert (parameter == 0.0).mean() > 0.05
    assert 4.8e6 < parameter.max() <= 5.0000001e6
    load = np.abs(drawn(groups, "operation", "axial_load_N"))
    assert load[load > 0.0].min() < 1e-5
    assert load.max() > 1e6


def speed_parameter(groups: list[Group]) -> np.ndarray:
    """Dm n of the faster ring [mm rpm]."""
    speeds = [np.abs(drawn(groups, "operation", key)) for key in ("speed_rpm", "outer_speed_rpm")]
    return np.asarray(drawn(groups, "bearing", "pitch_diameter_mm") * np.maximum(*speeds))


def test_the_realistic_envelope_is_what_it_says() -> None:
    """Catalogue bearings: nothing outside its table, and all of its range."""
    groups = [group for chunk in range(8) for group in chunk_groups(5, chunk, envelope="realistic")]
    assert {group.kind for group in groups} == {qs.BearingKind.ANGULAR_CONTACT}
    assert {group.control for group in groups} == {None, qs.RacewayControl.OUTER, qs.RacewayControl.PER_BALL}
    both = np.mean([len(group.effects) == 2 for group in groups])
    assert both == pytest.approx(0.8, abs=0.06)
    held = {sum(group.held) for group in groups}
    assert held == {0, 1, 2, 3}
    assert not any(group.held[1] or group.held[2] for group in groups)

    def ranges(key: str, unit: np.ndarray | float = 1.0) -> tuple[float, float]:
        values = drawn(groups, "bearing", key) / unit
        return float(values.min()), float(values.max())

    diameter, pitch = (drawn(groups, "bearing", f"{key}_diameter_mm") for key in ("ball", "pitch"))
    count = drawn(groups, "bearing", "ball_count")
    assert ranges("ball_count") == (8, 25)
    assert ranges("ball_diameter_mm") == pytest.approx((3.0, 40.0), rel=0.01)
    assert ranges("free_contact_angle_deg") == pytest.approx((12.0, 45.0), abs=0.01)
    for side in ("inner", "outer"):
        assert ranges(f"{side}_groove_radius_mm", diameter) == pytest.approx((0.515, 0.54), abs=1e-4)
    filled = diameter / (pitch * np.sin(np.pi / count))
    assert 0.65 <= filled.min() <= filled.max() <= 0.97
    listed = np.isin(drawn(groups, "bearing", "free_contact_angle_deg"), ANGLES).mean()
    assert listed == pytest.approx(0.5, abs=0.02)
    parameter = speed_parameter(groups)
    assert (parameter == 0.0).mean() == pytest.approx(0.1, abs=0.01)
    assert 2.45e6 < parameter.max() <= 2.5000001e6
    density = np.concatenate([group.materials["ball_material"]["density_kg_m3"] for group in groups])
    assert set(density) == {3200.0, 7800.0}
    assert_loads_are_what_they_say(groups)


def assert_loads_are_what_they_say(groups: list[Group]) -> None:
    """From a light preload to the static ratings, which are written out here once more."""
    for group in (group for group in groups if not group.held[0]):
        bearing, operation = group.bearing, group.operation
        angle = np.radians(bearing["free_contact_angle_deg"])
        area = bearing["ball_count"] * bearing["ball_diameter_mm"] ** 2
        axial = operation["axial_load_N"]
        share = axial / (61.6 * area * np.sin(angle))
        assert 0.002 * (1 - 1e-12) <= share.min() <= share.max() <= 1.0
        radial = np.hypot(operation["radial_load_y_N"], operation["radial_load_z_N"])
        assert (radial <= 14.7 * area * np.cos(angle) * (1 + 1e-12)).all()
        assert (radial * np.tan(angle) <= 3.0 * axial * (1 + 1e-12)).all()
        if not group.held[3]:
            moment = np.hypot(operation["moment_y_Nm"], operation["moment_z_Nm"])
            assert (moment <= axial * 0.5e-3 * bearing["pitch_diameter_mm"]).all()


@every_envelope
def test_a_scene_file_holds_the_scene_to_the_last_bit(envelope: str, tmp_path: Path) -> None:
    """Written, read back, and every number the same; what is solved from it ends as the batch does."""
    for group in chunk_groups(6, 0, envelope=envelope)[:: 8 if has_fast_code() else 40]:
        path = tmp_path / "scene.toml"
        path.write_text(group.toml(3, "A sentence\nof two lines."), encoding="utf-8")
        read, meant = qs.load_scene(path), group.part(3).scene()
        for name in (
            "hertz_angle",
            "hertz_form",
            "tilt_lever",
            "raceway_control",
            "ball_effects",
            "orbit_radius",
            "preload",
        ):
            assert getattr(read, name) == getattr(meant, name)
        assert len(read.ring_effects) == len(meant.ring_effects)
        for effect in meant.ring_effects:
            [found] = [each for each in read.ring_effects if each.name == effect.name]
            for name, value in vars(effect).items():
                assert np.array_equal(getattr(found, name), value), name
        for part in ("bearing", "operation"):
            for name, value in vars(getattr(meant, part)).items():
                if name not in ("name", "ball_material", "ring_material"):
                    assert getattr(getattr(read, part), name) == value, name
        for side in ("ball_material", "ring_material"):
            for name in ("elastic_modulus", "poisson_ratio", "density"):
                assert getattr(getattr(read.bearing, side), name) == getattr(getattr(meant.bearing, side), name)


def test_a_scene_is_found_by_its_number() -> None:
    number = 2 * CHUNK + 3 * GROUP + 4
    assert scene_name("wild", 9, number) == "wild/9/2/79"
    group = chunk_groups(9, 2)[3]
    assert scene_file("wild", 9, number) == group.toml(4, "Campaign scene wild/9/2/79.")
    assert scene_file("wild", 9, number, "it slips").startswith("# Campaign scene wild/9/2/79: it slips\n")


def test_what_may_end_without_convergence() -> None:
    """The rate itself of a million; below that what chance adds; none of realistic scenes, however many."""
    wild, realistic = ENVELOPES["wild"], ENVELOPES["realistic"]
    assert wild.allowed(WHOLE) == 200
    assert wild.allowed(2 * WHOLE) == 400
    assert [wild.allowed(count) for count in (1, 3000, 20_000)] == [1, 2, 8]
    assert {realistic.allowed(count) for count in (1, 40_000, WHOLE)} == {0}
