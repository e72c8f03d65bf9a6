"""Tables of force and stiffness for other programs: their axes, their grid, and by how much interpolation errs."""
