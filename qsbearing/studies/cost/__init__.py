"""What accuracy costs: model levels, tolerances and sizes, measured; and the cheapest level for an accuracy asked.

Only the commands `cost` and `run --accuracy` import from here.
"""
