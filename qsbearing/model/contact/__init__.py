"""The point contact of two elastic bodies."""
