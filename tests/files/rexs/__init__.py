"""Models of REXS in, results back."""
