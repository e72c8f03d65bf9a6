"""The version of the package: a file of its own, so that no folder imports the whole package for it."""

__version__ = "0.3.0"
