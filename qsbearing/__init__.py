"""qsbearing: the quasi-static (Jones-Harris) model of angular-contact ball bearings."""

__version__ = "0.1.0"
