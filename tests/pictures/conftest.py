"""These are drawn."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.drawing import drawing


@pytest.fixture(scope="package", autouse=True)
def all_drawn() -> Iterator[None]:
    """Every picture."""
    with drawing():
        yield
