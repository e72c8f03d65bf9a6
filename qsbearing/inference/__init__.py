"""Ball sets and groove radii that the data sheet of a bearing allows: always a list, never one set for certain."""
