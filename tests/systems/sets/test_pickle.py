"""A solution is plain data: what it says and computes is the same after it was pickled, as between processes."""

from __future__ import annotations

import pickle
import re
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.catalogue import find
from qsbearing.files.scene_or_set import load_scene_or_set
from qsbearing.files.template import set_template
from tests.guide.pages import GUIDE


def solved(name: str, tmp_path: Any) -> Any:
    if name == "pair":
        entry = find("7210C")
        assert entry is not None
        text = set_template(entry)
    else:
        text = re.findall(rf"```toml\n(# {name}.toml\n.*?)```", (GUIDE / "heat.md").read_text(), flags=re.DOTALL)[0]
    path = tmp_path / "scene.toml"
    path.write_text(text)
    of = load_scene_or_set(path)
    return qs.solve_set(of) if isinstance(of, qs.BearingSet) else qs.solve(of)


@pytest.mark.parametrize("name", ["pair", "spindle", "tight"])
def test_a_solution_is_pickled(name: str, tmp_path: Any) -> None:
    solution = solved(name, tmp_path)
    again = pickle.loads(pickle.dumps(solution))
    assert repr(again) == repr(solution)
    assert qs.message(again) == qs.message(solution)
    assert [str(each) for each in qs.warnings(again)] == [str(each) for each in qs.warnings(solution)]
    np.testing.assert_array_equal(again.stiffness, solution.stiffness)
    if name == "pair":
        np.testing.assert_array_equal(again.preload_mounted, solution.preload_mounted)
    else:
        assert again.thermal.message() == solution.thermal.message()
        assert again.thermal.temperatures == solution.thermal.temperatures
