"""The solver: one case at a time, on plain numbers."""
