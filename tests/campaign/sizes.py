"""How a campaign is cut: known without loading any numerical library."""

CHUNK, GROUP = 1000, 25
"""Scenes of a chunk and of a group."""
