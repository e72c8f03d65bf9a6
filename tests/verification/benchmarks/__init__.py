"""How fast: benchmarks, and the record that the guide's tables are made from. Never part of a test's pass mark."""

from qsbearing.model.compiler.compiled import always_compiled

always_compiled()  # in this process; the commands that are timed start as they do for users
