"""The design report of a scene or a set: input, assumptions, results, and the evidence that applies."""
