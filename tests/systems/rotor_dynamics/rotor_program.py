"""ROSS, where it is installed; its import warns of a fluid-property library that it has no use for here."""

from __future__ import annotations

import warnings
from types import ModuleType

import pytest


def load() -> ModuleType:
    """ROSS; skips the tests that ask for it where there is none."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return pytest.importorskip("ross", reason="needs ROSS: pip install 'qsbearing[ross]'")
