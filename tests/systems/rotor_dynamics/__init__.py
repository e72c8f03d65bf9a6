"""Stiffness for rotor dynamics: axes, table, ROSS."""
