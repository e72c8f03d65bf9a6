"""Elastic bodies by finite elements: element families, pressure, stresses, the sparse solver."""
