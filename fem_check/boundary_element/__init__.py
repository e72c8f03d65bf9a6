"""Reference values of a boundary-element half-space with the exact gap, and the script that made them."""
