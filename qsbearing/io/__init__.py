"""Scene files, the catalogue, and results as text and files."""
