"""Contact: the condition, half-spaces by finite and by boundary elements, what is measured of a solved one."""
