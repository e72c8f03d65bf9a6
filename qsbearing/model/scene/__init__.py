"""What is asked: the bearing, its operation, and the scene that joins them with effects and choices."""
