"""Bearings together and around: rows on a shaft, heat, rotor dynamics."""
