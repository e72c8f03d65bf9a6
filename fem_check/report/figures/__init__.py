"""Pictures, drawn from the numbers in the records."""

import matplotlib

matplotlib.use("Agg")
