"""Chosen contacts of a bearing against Hertz, as `fem-check contact` runs them: one table from load to verdict."""
