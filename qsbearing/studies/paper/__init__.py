"""The figures of the source paper, each from a study file, and what is stated of them."""
