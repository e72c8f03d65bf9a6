"""The committed meshes, their rebuilding, and damaged files."""

import hashlib
import lzma
import sys

import numpy as np
import pytest

from fem_check import meshing
from fem_check.meshing import MeshError

needs_gmsh = pytest.mark.skipif(meshing.gmsh_problem() is not None, reason=str(meshing.gmsh_problem()))


@pytest.mark.parametrize("recipe", meshing.COMMITTED, ids=lambda recipe: recipe.name)
def test_committed_files_are_what_the_manifest_says(recipe):
    entry = meshing.manifest()[recipe.file_name]
    path = meshing.locate(recipe)
    assert hashlib.sha256(lzma.decompress(path.read_bytes())).hexdigest() == entry["sha256"]
    mesh = meshing.load(recipe)
    assert mesh.p.shape[1] == entry["nodes"]
    assert mesh.t.shape[1] == recipe.elements == entry["elements"]


@needs_gmsh
def test_a_rebuilt_mesh_is_the_committed_one(tmp_path):
    recipe = meshing.half_space(4)
    meshing.make(recipe, tmp_path / "again.msh.xz")
    again, kept = meshing.read(tmp_path / "again.msh.xz"), meshing.load(recipe)
    # Transfinite points are computed by the same few operations each time: rounding between builds of gmsh only.
    np.testing.assert_allclose(again.p, kept.p, atol=1e-12)
    np.testing.assert_array_equal(again.t, kept.t)
    for tag in meshing.TAGS:
        np.testing.assert_array_equal(np.sort(again.boundaries[tag]), np.sort(kept.boundaries[tag]))


def test_lines_stand_where_the_recipe_says():
    recipe = meshing.half_space(4)
    mesh = meshing.load(recipe)
    x = np.unique(np.round(mesh.p[0], 9))
    inner = recipe.x[0]
    np.testing.assert_allclose(x[: inner.elements + 1], np.linspace(0, inner.length, inner.elements + 1), atol=1e-9)
    steps = np.diff(x[inner.elements :])
    np.testing.assert_allclose(steps[1:] / steps[:-1], recipe.x[1].growth, rtol=1e-6)
    assert x[-1] == pytest.approx(meshing.CUT)


def test_missing_file(tmp_path):
    with pytest.raises(MeshError, match="no such mesh file"):
        meshing.read(tmp_path / "none.msh")


def test_truncated_file(tmp_path):
    text = lzma.decompress(meshing.locate(meshing.half_space(4)).read_bytes()).decode()
    (tmp_path / "half.msh").write_text(text[: len(text) // 2])
    (tmp_path / "half.msh.xz").write_bytes(lzma.compress(text.encode())[:5000])
    for name in ("half.msh", "half.msh.xz"):
        with pytest.raises(MeshError, match="not a whole gmsh mesh"):
            meshing.read(tmp_path / name)


def test_untagged_and_wrongly_tagged_files(tmp_path):
    text = lzma.decompress(meshing.locate(meshing.half_space(4)).read_bytes()).decode()
    (tmp_path / "renamed.msh").write_text(text.replace('"contact"', '"top"'))
    with pytest.raises(MeshError, match=r"lacks the tagged surface\(s\) contact"):
        meshing.read(tmp_path / "renamed.msh")
    swapped = text.replace('"contact"', '"x"').replace('"symmetry_x"', '"contact"').replace('"x"', '"symmetry_x"')
    (tmp_path / "swapped.msh").write_text(swapped)
    with pytest.raises(MeshError, match="do not lie where that tag belongs"):
        meshing.read(tmp_path / "swapped.msh")


def test_a_lost_committed_mesh_is_named(tmp_path, monkeypatch):
    (tmp_path / meshing.MANIFEST).write_text((meshing.committed_folder() / meshing.MANIFEST).read_text())
    monkeypatch.setattr(meshing.files, "committed_folder", lambda: tmp_path)
    with pytest.raises(MeshError, match=r"half_space_04\.msh\.xz is missing: bring it back"):
        meshing.load(meshing.half_space(4))


def test_without_gmsh_the_debian_packages_are_named(tmp_path, monkeypatch):
    class Broken:
        def find_spec(self, name, path=None, target=None):
            if name == "gmsh":
                raise OSError("libGLU.so.1: cannot open shared object file")
            return None

    monkeypatch.delitem(sys.modules, "gmsh", raising=False)
    monkeypatch.setattr(sys, "meta_path", [Broken(), *sys.meta_path])
    monkeypatch.setenv("FEM_CHECK_CACHE", str(tmp_path))
    with pytest.raises(MeshError, match="apt-get install libgl1 libglu1-mesa"):
        meshing.load(meshing.half_space(5 + 6))
    assert meshing.load(meshing.half_space(4)).t.shape[1] == meshing.half_space(4).elements
