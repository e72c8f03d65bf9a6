"""Sets: rows of bearings on one rigid shaft, preloaded against each other; their equilibrium from the rows' own."""
