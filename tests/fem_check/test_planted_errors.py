"""Errors planted in a copy of the packages, one at a time: each must make `fem-check run` fail.

A formula is changed where it stands in the source, and the command runs on the copy in a process of its own. The
kernel runs as plain Python, the same source and much sooner ready; two of the errors are also compiled.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

# What is planted: file, line as it stands, line as it is made, the check that sees it.
SOLUTION = "solution_contacts"
GROOVE = "ball_in_inner_groove"
PLANTED = {
    "raceway curvature sign swapped": (
        "qsbearing/contact/hertz.py",
        "(1.0 + side * ball_diameter / pitch_diameter * cos_angle))",
        "(1.0 - side * ball_diameter / pitch_diameter * cos_angle))",
        SOLUTION,
    ),
    "groove curvature +10 %": (
        "qsbearing/contact/hertz.py",
        "return (2.0 * groove_radius_coefficient - 1.0) /",
        "return 1.1 * (2.0 * groove_radius_coefficient - 1.0) /",
        SOLUTION,
    ),
    "E' from the ball's modulus alone": (
        "qsbearing/contact/hertz.py",
        "(1.0 - poisson_ratio_2**2) / elastic_modulus_2)",
        "(1.0 - poisson_ratio_1**2) / elastic_modulus_1)",
        SOLUTION,
    ),
    "load exponent 1.49": (
        "qsbearing/kernel/contact_line.py",
        "return stiffness * approach * root, 1.5 * stiffness * root",
        "return stiffness * approach**1.49, 1.49 * stiffness * approach**0.49",
        SOLUTION,
    ),
    "pressures of solve() x 2/3": (
        "qsbearing/kernel/results.py",
        "return 1.5 * size / (pi * a * b)",
        "return size / (pi * a * b)",
        SOLUTION,
    ),
    "semi-axes of solve() at a wrong groove": (
        "qsbearing/kernel/raceway_stiffness.py",
        "transverse_curvature(1.0, coefficient), 1.0)",
        "transverse_curvature(1.0, 1.01 * coefficient), 1.0)",
        SOLUTION,
    ),
    "centrifugal force doubled": (
        "qsbearing/effects/centrifugal_force.py",
        "half = 0.5 * mass * pitch_diameter",
        "half = mass * pitch_diameter",
        SOLUTION,
    ),
    "cos alpha dropped from the groove's radius": (
        "fem_check/groove.py",
        "self.ball_diameter / self.pitch_diameter * cos(self.contact_angle)",
        "self.ball_diameter / self.pitch_diameter",
        SOLUTION,
    ),
    "the parabola in place of the exact gap": (
        "fem_check/solids/true_contact.py",
        "problem.parabolic_gap if parabola else frame.gap",
        "problem.parabolic_gap",
        "true_geometry",
    ),
    "the ball clamped at its equator": (
        "fem_check/solids/true_contact.py",
        "fixed[np.abs(frame.normal @ offset) < NEAR, 0] = True",
        "fixed[np.abs(frame.normal @ offset) < NEAR] = True",
        "true_geometry",
    ),
    "gap +1 %": (
        "fem_check/contact.py",
        "gaps = basis.weighted(",
        "gaps = 1.01 * basis.weighted(",
        GROOVE,
    ),
    "frozen contact set": (
        "fem_check/contact.py",
        "if not drop.any() and not add.any():",
        "if True:",
        GROOVE,
    ),
    "tension kept": (
        "fem_check/contact.py",
        "drop = active & (pressure < 0.0)",
        "drop = active & (pressure < -np.inf)",
        GROOVE,
    ),
    "quadrature weights +0.2 %": (
        "fem_check/elastic_body.py",
        "np.matmul(stacked * volumes[:, None, :]",
        "np.matmul(stacked * (1.002 * volumes[:, None, :])",
        "patch_test",
    ),
    "solver noise 1e-5": (
        "fem_check/elastic_body.py",
        "moved[free] = factor.solve(free_loads[:, some].toarray() - coupling @ moved[prescribed_dofs])",
        "moved[free] = factor.solve(free_loads[:, some].toarray() - coupling @ moved[prescribed_dofs])\n"
        "        moved[free] *= 1.0 + 1e-5 * np.random.default_rng(1).standard_normal(moved[free].shape)",
        GROOVE,
    ),
    "free symmetry plane": (
        "fem_check/elastic_body.py",
        "fixed[space.nodes[0] < small[0], 0] = True",
        "pass",
        GROOVE,
    ),
    # Uncertainties that are too small, and code verification.
    "mesh uncertainty returns 0": (
        "fem_check/convergence.py",
        "return SAFE_FACTOR * max(steps)",
        "return 0.0 * max(steps)",
        "sphere_on_plane",
    ),
    "mesh uncertainty returns 0, load series": (
        "fem_check/convergence.py",
        "return SAFE_FACTOR * max(steps)",
        "return 0.0 * max(steps)",
        "load_power_law",
    ),
    "uncertainty of ratios returns 0": (
        "fem_check/convergence.py",
        "return max(abs(value - values[-1]) for value in values[:-1])",
        "return 0.0 * max(abs(value - values[-1]) for value in values[:-1])",
        "true_geometry",
    ),
    "curved edges straight": (
        "fem_check/solids/tetrahedral_body.py",
        "positions[:, _edge_nodes(straight, *mesh.curved_edges)] = mesh.curved_nodes",
        "_edge_nodes(straight, *mesh.curved_edges)",
        "manufactured_solution",
    ),
    "Lame's constants swapped": (
        "fem_check/elastic_body.py",
        "matrix = first * product + second * product.transpose(0, 1, 4, 3, 2)",
        "matrix = second * product + first * product.transpose(0, 1, 4, 3, 2)",
        "manufactured_solution",
    ),
    "facets' areas +0.1 %": (
        "fem_check/solids/tetrahedral_body.py",
        "(normals * outward[:, None] * weights)",
        "(1.001 * normals * outward[:, None] * weights)",
        "patch_test",
    ),
    "far-field displacement x 1.01": (
        "fem_check/elastic_body.py",
        "prescribed_displacement = far.transpose",
        "prescribed_displacement = 1.01 * far.transpose",
        "sphere_on_plane",
    ),
}
COMPILED = ("load exponent 1.49", "centrifugal force doubled")


def run_planted(folder: Path, name: str | None, check: str, compiled: bool = False) -> subprocess.CompletedProcess[str]:
    """Run a check on a copy of both packages, with an error in it."""
    for package in ("qsbearing", "fem_check"):
        shutil.copytree(ROOT / package, folder / package, ignore=shutil.ignore_patterns("records", "__pycache__"))
    (folder / "meshes").symlink_to(ROOT / "meshes")
    if name is not None:
        path, old, new, _ = PLANTED[name]
        source = (folder / path).read_text()
        assert source.count(old) == 1, f"{path} no longer holds one {old!r}: plant the error where the formula is now"
        (folder / path).write_text(source.replace(old, new))
    kernel = {"NUMBA_CACHE_DIR": str(folder / "cache")} if compiled else {"NUMBA_DISABLE_JIT": "1"}
    return subprocess.run(
        [sys.executable, "-m", "fem_check", "run", check, "--out", str(folder / "out")],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(folder)} | kernel,
        capture_output=True,
        text=True,
        check=False,
    )


def assert_caught(done: subprocess.CompletedProcess[str], folder: Path, check: str) -> None:
    """A row out of tolerance, and nothing else, ended the run."""
    assert done.returncode == 1, done.stderr
    record = json.loads((folder / "out" / "quick" / f"{check}.json").read_text())
    assert any(row["verdict"] == "fail" for row in record["rows"])


def test_weights_of_the_quadrature_are_seen(tmp_path):
    # The one that costs two seconds; the others run with `-m heavy`.
    name = "quadrature weights +0.2 %"
    assert_caught(run_planted(tmp_path, name, PLANTED[name][3]), tmp_path, PLANTED[name][3])


@pytest.mark.heavy
@pytest.mark.parametrize("name", PLANTED)
def test_planted_error_is_seen(name, tmp_path):
    check = PLANTED[name][3]
    assert_caught(run_planted(tmp_path, name, check), tmp_path, check)


@pytest.mark.heavy
@pytest.mark.parametrize("name", COMPILED)
def test_planted_error_is_seen_compiled(name, tmp_path):
    assert_caught(run_planted(tmp_path, name, SOLUTION, compiled=True), tmp_path, SOLUTION)


@pytest.mark.heavy
@pytest.mark.parametrize("check", [SOLUTION, GROOVE, "patch_test", "true_geometry"])
def test_without_an_error_the_copy_passes(check, tmp_path):
    done = run_planted(tmp_path, None, check)
    assert done.returncode == 0, done.stdout
