"""Sobol indices: those of a sum are the parts of its variance, and together they are one."""

from __future__ import annotations

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.studies.sobol import sobol_indices
from qsbearing.studies.study import Study

pytest.importorskip("xarray")


def test_a_linear_result_is_shared_out_by_its_variances() -> None:
    """The axial load of a held displacement: to first order a sum, so that parts follow from two derivatives."""
    document = {
        "bearing": {"name": "B218"},
        "operation": {"axial_displacement_um": 30.0, "radial_load_y_N": 0, "tilt_y_mrad": 0, "tilt_z_mrad": 0},
    }
    vary = {"axial_displacement_um": "normal(30,0.1)", "ball_material.elastic_modulus_GPa": "normal(208,1)"}
    study = Study.of(document, vary, quantities=["ring_load_axial"])
    indices = sobol_indices(study, 1024)
    steps = {"axial_displacement_um": [29.9, 30.1], "ball_material.elastic_modulus_GPa": [207, 209]}
    slopes = [
        np.ptp(qs.sweep(Study.of(document, {key: both}))["ring_load_axial"].values) for key, both in steps.items()
    ]
    expected = np.square(slopes) / np.square(slopes).sum()
    # 1024 base samples: the estimators' own error is about two hundredths.
    np.testing.assert_allclose(indices["first_order"].sel(result="ring_load_axial"), expected, atol=0.04)
    np.testing.assert_allclose(indices["total"].sel(result="ring_load_axial"), expected, atol=0.04)
    assert indices.attrs["points"] == 4096


def test_what_has_no_indices_is_refused() -> None:
    with pytest.raises(qs.SceneError, match="random keys only"):
        sobol_indices(Study.of("b218", {"speed_rpm": [1, 2]}))
    with pytest.raises(qs.SceneError, match="random keys only"):
        sobol_indices(Study.of("b218", {"speed_rpm": [1, 2], "axial_load_N": "normal(1e4,1)"}))
    with pytest.raises(qs.SceneError, match="power of two"):
        sobol_indices(Study.of("b218", {"axial_load_N": "normal(1e4,1)"}), 100)
