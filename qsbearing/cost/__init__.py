"""What accuracy costs: fidelities of the model, tolerances of the solver and sizes of the problem, measured.

`qsbearing cost` measures and draws; `qsbearing run --accuracy` chooses a fidelity by what was measured. Nothing else of
the package imports from here.
"""
