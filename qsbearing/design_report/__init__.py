"""The design report of a scene: what went in, what was assumed, what came out, and the evidence that applies to it."""
