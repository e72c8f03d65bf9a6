"""A bearing's stiffness as programs of rotor dynamics take it: their axes, a table, an element of ROSS.

Linear in small vibrations about the solved equilibrium; damping is not computed anywhere in this package.
"""

from __future__ import annotations

from qsbearing.systems.rotor_dynamics.axes import Tilt, in_rotor_axes, load_centres
from qsbearing.systems.rotor_dynamics.over_frequency import StiffnessOverFrequency, stiffness_over_frequency
from qsbearing.systems.rotor_dynamics.ross_bearing import to_ross
from qsbearing.systems.rotor_dynamics.table import stiffness_columns, stiffness_table

__all__ = [
    "StiffnessOverFrequency",
    "Tilt",
    "in_rotor_axes",
    "load_centres",
    "stiffness_columns",
    "stiffness_over_frequency",
    "stiffness_table",
    "to_ross",
]
