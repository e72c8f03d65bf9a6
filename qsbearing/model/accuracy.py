"""The error that choosing effects may leave: of numbers alone, so that the help of a command loads nothing else."""

DEFAULT_ACCURACY = 0.01
"""Where none is given."""
FINEST, COARSEST = 1e-12, 1.0
"""What of it may be asked for: the solver's own tolerance, and everything."""
ALLOWED = f"{FINEST:g} to {COARSEST:g}"
"""The same in words."""


def is_allowed(accuracy: float) -> bool:
    """Whether this may be asked for."""
    return FINEST <= accuracy <= COARSEST
