"""What the guide's page states of the inference, measured on all rows."""

from __future__ import annotations

import pytest

from tests.guide.pages import GUIDE
from tests.inference.measured import stiffness_shares, table


@pytest.mark.heavy
def test_the_measured_table_is_that_of_the_guide() -> None:
    page = (GUIDE / "data_sheet.md").read_text(encoding="utf-8")
    assert "\n".join(table()) in page
    assert min(stiffness_shares()) >= 0.9
