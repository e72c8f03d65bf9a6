"""A row of agreement and its record, mesh convergence, and how a row reads."""
