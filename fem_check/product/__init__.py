"""What is under test: the scenes of `qsbearing`, and the problems that they ask."""
