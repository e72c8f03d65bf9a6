"""An independent high-precision reference for quasi-static ball-bearing models."""
