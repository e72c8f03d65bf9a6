"""The version of the package: stands here alone, so that no room asks the top for it."""

__version__ = "0.1.0"
