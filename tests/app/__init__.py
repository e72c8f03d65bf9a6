"""The page: what it answers, and what a browser makes of it."""
