"""What a brick is: three edges cut into segments, each of so many elements."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass


@dataclass(frozen=True)
class Segment:
    """A stretch of one edge of the brick."""

    length: float
    elements: int
    growth: float = 1.0
    """Length of each element over the one before it."""


@dataclass(frozen=True)
class Recipe:
    """A graded brick; the contact lies on its face z = 0, on the first `contact_segments` of x and of y."""

    name: str
    elements_per_semi_axis: int
    x: tuple[Segment, ...]
    y: tuple[Segment, ...]
    z: tuple[Segment, ...]
    contact_segments: int = 1

    @property
    def elements(self) -> int:
        """Number of hexahedra."""
        counts = [sum(segment.elements for segment in axis) for axis in (self.x, self.y, self.z)]
        return counts[0] * counts[1] * counts[2]

    @property
    def dofs(self) -> int:
        """Degrees of freedom of its 20-node elements (vertices and edges, three each)."""
        nx, ny, nz = (sum(segment.elements for segment in axis) for axis in (self.x, self.y, self.z))
        vertices = (nx + 1) * (ny + 1) * (nz + 1)
        edges = nx * (ny + 1) * (nz + 1) + (nx + 1) * ny * (nz + 1) + (nx + 1) * (ny + 1) * nz
        return 3 * (vertices + edges)

    @property
    def digest(self) -> str:
        """Short fingerprint of the recipe."""
        return hashlib.sha256(json.dumps(asdict(self), sort_keys=True).encode()).hexdigest()[:12]

    @property
    def file_name(self) -> str:
        """Its file."""
        return f"{self.name}.msh"
