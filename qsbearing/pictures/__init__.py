"""Pictures of a solved case, one function each; matplotlib is imported where it draws.

Each takes a solution and, where it has case axes, the index of one case; and returns a figure of matplotlib.
"""

from qsbearing.pictures.contact_angles import contact_angles
from qsbearing.pictures.contact_ellipses import contact_ellipses
from qsbearing.pictures.load_distribution import load_distribution
from qsbearing.pictures.sheet import overview

__all__ = ["contact_angles", "contact_ellipses", "load_distribution", "overview"]
