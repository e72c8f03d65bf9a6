"""Checks run one after another; their records on disk, and the memory that they take."""
