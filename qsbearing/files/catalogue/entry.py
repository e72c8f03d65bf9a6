"""One bearing of the catalogue, in the words and units of a scene file."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class CatalogueEntry:
    """One published bearing."""

    name: str
    description: str
    source: str
    bearing: dict[str, Any]
    """The [bearing] table of a scene file, complete."""
    provenance: dict[str, str]
    """For each key of `bearing`, where its value comes from, or that it is assumed or inferred."""
    material_provenance: dict[str, str]
    """The same of single numbers of a material, as `ball_material.density_kg_m3`, where they are not of one source."""
    example: dict[str, dict[str, Any]]
    """The [operation] and [effects] tables of a scene that uses it."""
    dimensions: dict[str, float] = field(default_factory=dict)
    """Of its cross-section, and its printed ratings, by keys with units; empty where no source has any."""
    dimensions_source: str = ""
    """Where they come from, if not from the source of all."""

    @property
    def assumed(self) -> tuple[str, ...]:
        """Keys whose values the source does not print."""
        return tuple(key for key, origin in self.provenance.items() if origin.startswith(("assumed", "inferred")))
