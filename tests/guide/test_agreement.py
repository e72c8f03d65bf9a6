"""The guide's page on Hertz and finite elements is what the record says, and tells when it lacks something."""

import copy
import re

import numpy as np
import pytest

from tests.guide import agreement

pytest.importorskip("matplotlib")


@pytest.fixture(scope="module")
def record():
    return agreement.record()


def test_the_committed_page_is_that_of_the_record(record):
    assert agreement.PAGE.read_text(encoding="utf-8") == agreement.page(record)


def test_the_committed_picture_is_that_of_the_record(record, drawn):
    number = r"-?\d+(?:\.\d+)?"
    kept, made = agreement.PICTURE.read_text(encoding="utf-8"), agreement.drawn(record)
    assert re.sub(number, "", kept) == re.sub(number, "", made)
    # A tenth of a point, for other libraries round otherwise.
    np.testing.assert_allclose(*(np.array(re.findall(number, each), float) for each in (kept, made)), atol=0.1)


def test_a_changed_number_changes_the_page_and_the_sentence(record):
    changed = copy.deepcopy(record)
    row = next(
        row
        for row in changed["rows"]
        if row["case"].startswith("B218 inner, Q = 5000 N") and row["case"].endswith("true contact")
        and row["quantity"] == "semi_major_axis"
    )  # fmt: skip
    row["found"] = 0.95 * row["reference"]
    row["deviation_percent"] = -5.0
    told = agreement.page(changed)
    assert told != agreement.page(record)
    assert "−5.0 % (a)" in told and "−1.2, −5.0 % at" in told


def test_without_half_spaces_and_pressures_the_page_says_what_it_has(record):
    bare = copy.deepcopy(record)
    bare["rows"] = [row for row in bare["rows"] if not row["case"].endswith("half-spaces")]
    bare["pictures"].pop("pressures", None)
    told = agreement.page(bare)
    assert "solved right" not in told and "Ellipses of the true bodies" in told
    assert "| 5.2890 |  | " in told
