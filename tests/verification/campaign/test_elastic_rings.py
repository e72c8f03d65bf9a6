"""Random bearings between elastic rings, recomputed from what their solutions say."""

from __future__ import annotations

import numpy as np
import pytest

from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.model.effects import elastic_rings as model
from tests.verification.campaign.elastic_rings import batch

compiled_only = pytest.mark.skipif(not has_fast_code(), reason="hundreds of bearings take hours in plain Python")


@compiled_only
@pytest.mark.parametrize("number", [2, 5])
def test_random_rings_deflect_as_their_loads_say(number: int) -> None:
    """One batch with shoulders on both rings, one with some on the outer ring alone."""
    with np.errstate(all="ignore"):
        found = batch(np.random.default_rng([1, number]), 100)
    assert found.wrong == {}
    assert found.ended["converged"] > 50


@compiled_only
def test_a_wrong_section_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """A section with shoulders a ten-thousandth too high."""
    height = model.bending_height
    monkeypatch.setattr(model, "bending_height", lambda *section: 1.0001 * height(*section))
    with np.errstate(all="ignore"):
        assert len(batch(np.random.default_rng([1, 2]), 100).wrong) > 20
