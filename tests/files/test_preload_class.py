"""A preload by its class, as the catalogue's source prints them."""

from __future__ import annotations

from typing import Any

import pytest

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.files.set_file import set_of

ROWS = [{"position_mm": 0.0, "carries": "+x"}, {"position_mm": 20.0, "carries": "-x"}]


def document(**tables: Any) -> dict[str, Any]:
    return {"bearing": {"name": "71914C"}, "operation": {"speed_rpm": 0.0}, **tables}


@pytest.mark.parametrize(("word", "force"), [("light", 130.0), ("medium", 370.0), ("heavy", 740.0)])
def test_a_class_is_the_printed_force(word: str, force: float) -> None:
    """GMN S 61914 C: the columns FvL, FvM, FvS of its row."""
    at_the_top = scene_of(document(preload=word), "a file")
    in_bearing = scene_of(document(bearing={"name": "71914C", "preload": word}), "a file")
    assert at_the_top.preload == in_bearing.preload == qs.Preload(rigid=force)
    of = set_of(document(preload=word, rows=ROWS), "a file")
    assert of.preload == qs.Preload(rigid=force)


def test_rows_of_one_name_have_its_class() -> None:
    rows = [{**row, "bearing": {"name": "71914C"}} for row in ROWS]
    tables = document(preload="light", rows=rows)
    del tables["bearing"]
    assert set_of(tables, "a file").preload == qs.Preload(rigid=130.0)
    rows[1]["bearing"] = {"name": "71914E"}
    assert "the rows' bearings differ" in said(tables)


def said(tables: dict[str, Any]) -> str:
    with pytest.raises(qs.SceneFileError) as raised:
        (set_of if "rows" in tables else scene_of)(tables, "a file")
    assert len(raised.value.errors) == 1, raised.value
    return str(raised.value)


def test_what_is_no_class_and_where_none_is_known() -> None:
    assert "Did you mean medium?" in said(document(preload="medum"))
    assert "is no preload class" in said(document(bearing={"name": "71914C", "preload": 300}))
    assert "none are known of 'B218'" in said(document(bearing={"name": "B218"}, preload="light"))
    both = document(bearing={"name": "71914C", "preload": "light"}, preload={"rigid_N": 300.0})
    assert "is given together with [preload]" in said(both)


@pytest.mark.parametrize("tables", [{"preload": "light"}, {"bearing": {"name": "71914C", "preload": "light"}}])
def test_a_study_may_vary_the_force_of_a_class(tables: dict[str, Any]) -> None:
    results = qs.sweep(qs.Study.of(document(**tables), {"preload.rigid_N": [10.0, 20.0]}))
    assert results["ring_load_axial"].values == pytest.approx([10.0, 20.0])
