"""Studies over many solves."""
