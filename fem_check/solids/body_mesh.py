"""The mesh of a body: curved tetrahedra with nodes on the true surfaces, and its file."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from fem_check.independent.contact_problem import Array
from fem_check.meshing import MeshError


@dataclass(frozen=True)
class BodyMesh:
    """Curved tetrahedra: their vertices, and the nodes of those edges that are not straight."""

    points: Array
    """Vertices, (3, vertex) [m]."""
    tetrahedra: Array
    """Vertices of each, (4, element)."""
    curved_edges: Array
    """Vertices of each curved edge, (2, edge)."""
    curved_nodes: Array
    """The node in its middle, on the true surface, (3, edge) [m]."""

    def shifted(self, by: Array) -> BodyMesh:
        """The mesh moved as a whole by a vector [m]."""
        return replace(self, points=self.points + by[:, None], curved_nodes=self.curved_nodes + by[:, None])

    def turned(self, axes: Array) -> BodyMesh:
        """The mesh in other axes: those of its own are the columns of `axes`, shape (3, 3)."""
        return replace(self, points=axes @ self.points, curved_nodes=axes @ self.curved_nodes)

    def save(self, path: Path) -> None:
        """Write whole or not at all; compressed, in single precision: 1e-9 m, where elements are 1e-5 m and more.

        The gap never comes from these points.
        """
        handle, temporary = tempfile.mkstemp(suffix=".npz", dir=path.parent)
        small = np.uint16 if self.points.shape[1] < 2**16 else np.uint32
        try:
            with os.fdopen(handle, "wb") as file:
                np.savez_compressed(
                    file,
                    points=self.points.astype(np.float32),
                    tetrahedra=self.tetrahedra.astype(small),
                    curved_edges=self.curved_edges.astype(small),
                    curved_nodes=self.curved_nodes.astype(np.float32),
                )
            Path(temporary).chmod(0o644)
            Path(temporary).replace(path)
        except BaseException:
            Path(temporary).unlink(missing_ok=True)
            raise

    @classmethod
    def read(cls, path: Path) -> BodyMesh:
        """Read what `save` wrote.

        Raises:
            MeshError: the file is missing or damaged.
        """
        try:
            with np.load(path) as file:
                return cls(
                    file["points"].astype(np.float64),
                    file["tetrahedra"].astype(np.int64),
                    file["curved_edges"].astype(np.int64),
                    file["curved_nodes"].astype(np.float64),
                )
        except Exception as problem:  # of damaged bytes zipfile and numpy raise almost anything
            raise MeshError(f"{path} is not a mesh of a body ({problem})") from problem
