"""How fast: benchmarks, and the record that the guide's tables are made from. Never part of a test's pass mark."""
