"""How fast: benchmarks, and the record that the README's tables are made from. Never part of a test's pass mark."""
