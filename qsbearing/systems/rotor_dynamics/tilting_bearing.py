"""An element that brings a bearing's whole matrix into a rotor of ROSS; imports ROSS, which takes seconds.

ROSS's rotor accepts bearings of three coordinates, x, y, z; it then tells each element where in the rotor's matrices
these stand (`dof_global_index`), and adds the element's matrices there. This one takes in the node's rotations alpha
and beta as well, which follow x, y, z, and answers with matrices of five. So do 2.3.0, 3.0.0 and 3.1.0: another version
may assemble differently, and `tests/systems/rotor_dynamics` would show it.

ROSS 2 asks for matrices at a speed of the shaft, ROSS 3 at a frequency of the whirl and that speed.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import ross
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline


class TiltingBearingElement(ross.BearingElement):
    """A bearing between its node and ground, with tilts.

    kxx to kzz, damping and mass are those of its kind; they draw and print it. Damping and mass act on translations.
    """

    def __init__(self, n: int, matrix: NDArray, **coefficients: Any) -> None:
        super().__init__(n=n, **coefficients)
        self.matrix = matrix
        """Stiffness in the order x, y, z, alpha, beta; (5, 5), or (speed, 5, 5) over the shaft's speed; SI."""
        self._entries: Any = None
        if matrix.ndim == 3 and hasattr(ross, "BearingCoefficient"):  # ROSS 3 interpolates every coefficient by these
            axis = {"speed": self.speed, "interpolation": self.interpolation}
            self._entries = [[ross.BearingCoefficient(matrix[:, i, j], **axis) for j in range(5)] for i in range(5)]
        elif matrix.ndim == 3:  # as ROSS 2 interpolates: by cubics if there are points for them
            self._entries = make_interp_spline(self.frequency, matrix, k=min(3, len(self.frequency) - 1))

    @property
    def dof_global_index(self) -> dict[str, int] | None:
        """Where its coordinates stand in the rotor's matrices; None before a rotor is assembled."""
        return self._places

    @dof_global_index.setter
    def dof_global_index(self, places: dict[str, int] | None) -> None:
        if places is not None:
            first = places[f"x_{self.n}"]
            places = places | {f"alpha_{self.n}": first + 3, f"beta_{self.n}": first + 4}
        self._places = places

    def K(self, frequency: float, speed: float | None = None) -> NDArray:
        """Stiffness at a speed of the shaft [rad/s], which is the frequency if only that is given."""
        at = frequency if speed is None else speed
        if isinstance(self._entries, list):
            return np.array([[entry(speed=at) for entry in row] for row in self._entries])
        return self.matrix if self._entries is None else np.asarray(self._entries(at))

    def C(self, *frequency: float) -> NDArray:
        """Damping at a frequency, and in ROSS 3 at a speed of the shaft [rad/s]."""
        return np.pad(super().C(*frequency), (0, 2))

    def M(self, *frequency: float) -> NDArray:
        """Mass at a frequency, and in ROSS 3 at a speed of the shaft [rad/s]."""
        return np.pad(super().M(*frequency), (0, 2))

    def save(self, file: Any) -> None:
        """Refused: ROSS would keep the translations alone, and say nothing.

        Raises:
            NotImplementedError: always.
        """
        raise NotImplementedError(
            "ROSS's files hold no tilt stiffness. Save the bearing's scene file and make the element anew, or save a "
            'rotor whose bearings were made with tilt = "held" or "free"'
        )
