"""What accuracy costs with finite elements, measured: meshes, element families, far fields, linear solvers.

`fem-check cost` measures and draws; `fem-check contact --accuracy` chooses a mesh by what was measured.
"""
