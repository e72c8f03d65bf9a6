"""The whole contact on coarse meshes, its invariants, and planted errors that must not pass."""

from dataclasses import replace

import numpy as np
import pytest

from fem_check.checks import ALL
from fem_check.elements import elastic_body
from fem_check.elements.elastic_body import Support
from fem_check.independent.contact_problem import ContactProblem, ElasticConstants
from fem_check.independent.references import hertz
from fem_check.mechanics import contact, half_space_contact, measuring
from fem_check.product.scenes import groove_contact
from fem_check.rows import agreement

STEEL = ElasticConstants(208e9, 0.3)
LEVEL = agreement.MeshLevel.QUICK
CHECK = "half_space_contacts"


def silent(stage: str, part: float) -> None:
    pass


@pytest.fixture(scope="module", autouse=True)
def one_mesh_of_each_size():
    """Without the meshes out of the contact's proportions, which widen the uncertainty; the release gate has them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(half_space_contact, "STRETCHES", ((1.0, 1.0),))
        yield


@pytest.fixture(scope="module")
def inner():
    return groove_contact("b218", "inner")


def test_similar_contacts_are_exactly_similar(inner):
    bodies = half_space_contact.condensed_bodies(inner.problem(1.0), 4)
    light, heavy = (half_space_contact.solve_on(inner.problem(load), bodies)[1].mean for load in (10.0, 80.0))
    # The same mesh at twice the size: only rounding is between them.
    assert heavy.semi_major_axis / light.semi_major_axis == pytest.approx(2.0, rel=1e-9)
    assert heavy.approach / light.approach == pytest.approx(4.0, rel=1e-9)


def test_compliances_add(inner):
    problem = inner.problem(1000.0)
    rigid = replace(problem, ball=ElasticConstants(1e6 * STEEL.elastic_modulus, 0.3))
    bodies = half_space_contact.condensed_bodies(problem, 4)
    both, one = (half_space_contact.solve_on(p, bodies)[1].mean for p in (problem, rigid))
    # delta ~ compliance^(2/3): half the compliance, and the unit length of the mesh follows.
    assert one.approach / both.approach == pytest.approx(0.5 ** (2.0 / 3.0), rel=1e-5)


def test_a_stiffer_ball_gives_less(inner):
    problem = inner.problem(1000.0)
    ceramic = replace(problem, ball=ElasticConstants(310e9, 0.27))
    bodies, hybrid = half_space_contact.condensed_bodies(problem, 4), half_space_contact.condensed_bodies(ceramic, 4)
    measured = half_space_contact.solve_on(ceramic, hybrid)[1].mean
    assert measured.approach < half_space_contact.solve_on(problem, bodies)[1].mean.approach
    # Four elements per semi-axis: 0.5 % is what that mesh gives for steel too.
    assert measured.approach == pytest.approx(hertz(ceramic).approach, rel=5e-3)


def test_a_patch_too_small_is_said(inner):
    problem = inner.problem(1000.0)
    bodies = half_space_contact.condensed_bodies(problem, 4)
    flexibility = contact.total_flexibility(problem, bodies.ball, bodies.race)
    with pytest.raises(contact.ContactError, match="fills the whole patch"):
        contact.solve(problem, bodies.basis, flexibility, np.array([0.5 * hertz(problem).semi_minor_axis]))


# --- planted errors: each must turn the verdict -----------------------------------------------------------------------


def verdict_of(name: str) -> str:
    return ALL[name].run(LEVEL, silent).verdict


@pytest.fixture
def one_load(monkeypatch):
    """One contact stands for all of the check."""
    from fem_check.checks import half_space_contacts
    from fem_check.checks.half_space_contacts import HalfSpaceContact

    of = HalfSpaceContact("B218 inner", groove_contact("b218", "inner").problem(1000.0))
    monkeypatch.setattr(half_space_contacts, "contacts", lambda level, scene: [of])


@pytest.mark.usefixtures("one_load")
def test_without_a_planted_error_it_is_within_its_gate():
    findings = ALL[CHECK].run(LEVEL, silent)
    assert findings.verdict == "pass"
    # The estimate must own up to the error it makes: the true error of each gated quantity is known here.
    for row in findings.rows[:4]:
        assert abs(row.deviation_percent) <= row.uncertainty_percent


@pytest.mark.usefixtures("one_load")
def test_planted_wrong_modulus(monkeypatch):
    right = contact.total_flexibility

    def wrong(problem, ball, race):
        return right(replace(problem, ball=replace(problem.ball, elastic_modulus=1.02 * 208e9)), ball, race)

    monkeypatch.setattr(contact, "total_flexibility", wrong)
    assert verdict_of(CHECK) == "fail"


@pytest.mark.usefixtures("one_load")
def test_planted_groove_radius(monkeypatch):
    right = contact.solve

    def wrong(problem, basis, flexibility, unit_lengths, gap=None):
        off = replace(groove_contact("b218", "inner"), groove_radius=1.01 * 11.6281e-3).problem(problem.load)
        return right(replace(problem, curvature_x=off.curvature_x), basis, flexibility, unit_lengths, gap)

    monkeypatch.setattr(contact, "solve", wrong)
    assert verdict_of(CHECK) == "fail"


@pytest.mark.usefixtures("one_load")
@pytest.mark.parametrize("check", ["asymmetry", "force_imbalance"])
def test_planted_unsoundness(check, monkeypatch):
    right = measuring.measure

    def wrong(field, ball, race):
        measured = right(field, ball, race)
        return replace(measured, soundness=replace(measured.soundness, **{check: 0.01}))

    monkeypatch.setattr(measuring, "measure", wrong)
    assert verdict_of(CHECK) == "fail"


def test_the_active_set_leaves_neither_penetration_nor_load(inner):
    problem = inner.problem(1000.0)
    _, measured = half_space_contact.solve_on(problem, half_space_contact.condensed_bodies(problem, 4))
    assert measured.soundness.penetration < measuring.LIMITS.penetration
    assert measured.soundness.load_error < measuring.LIMITS.load_error


@pytest.mark.usefixtures("one_load")
def test_planted_missing_far_field(monkeypatch):
    right = elastic_body.condense

    def wrong(brick, basis, poisson_ratio, support, **rest):
        return right(brick, basis, poisson_ratio, Support.CLAMPED, **rest)

    monkeypatch.setattr(elastic_body, "condense", wrong)
    half_space_contact.clear_cache()
    try:
        assert verdict_of(CHECK) == "fail"
    finally:
        half_space_contact.clear_cache()


# --- meshes of the release level: minutes -----------------------------------------------------------------------------


@pytest.mark.heavy
@pytest.mark.parametrize("k", [1.0, 20.0])
def test_release_level_other_shapes(k):
    from fem_check.checks.half_space_contacts import ellipse_of

    problem: ContactProblem = ellipse_of(k)
    study = half_space_contact.mesh_study(problem, half_space_contact.SEQUENCES[agreement.MeshLevel.RELEASE])
    rows = half_space_contact.rows("case", study, agreement.MeshLevel.RELEASE, "Hertz")
    assert [row for row in rows if row.verdict != "pass"] == []
