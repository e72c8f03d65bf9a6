"""What accuracy costs: element families, fits, processes, the record, the advice made from it."""

import json
import os
import signal
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner
from skfem import MeshHex

from fem_check import half_space_contact, linear_solver, memory, meshing
from fem_check.agreement import Level
from fem_check.checks.other_contacts import slender_problem
from fem_check.cli import cli
from fem_check.contact_problem import ElasticConstants
from fem_check.cost import (
    advice,
    campaign,
    configurations,
    figures,
    fits,
    fresh_process,
    holdout,
    output,
    record,
    shapes,
    tables,
    timing,
)
from fem_check.elastic_body import DisplacementSpace, stiffness
from fem_check.element_family import FAMILIES, SERENDIPITY
from fem_check.references import hertz


def call(*arguments: str):
    return CliRunner().invoke(cli, list(arguments))


# --- element families -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_every_family_carries_constant_strain_and_rigid_motion(family):
    brick = meshing.load(meshing.half_space(3))
    sheared = np.array([[1.0, 0.2, -0.1], [0.1, 0.8, 0.15], [-0.05, 0.1, 1.3]]) @ brick.p
    body = family.body(MeshHex(sheared, brick.t, _boundaries=brick.boundaries, sort_t=False))
    space = DisplacementSpace(body, family)
    matrix = stiffness(space, 0.3)
    reference = DisplacementSpace(family.body(brick), family).nodes
    inside = np.all((reference > 1e-9) & (reference < reference.max(axis=1, keepdims=True) - 1e-9), axis=0)
    assert inside.sum() > 20
    strain = np.array([[1.0, 0.3, -0.2], [0.3, -0.5, 0.4], [-0.2, 0.4, 0.7]])
    force = (matrix @ (strain @ space.nodes).T.ravel()).reshape(-1, 3)
    # Constant stress is in balance at every node inside the body; on the skin it is not.
    assert np.abs(force[inside]).max() < 1e-10 * np.abs(force).max()
    turned = np.cross(np.array([0.3, -0.2, 0.5]), space.nodes.T).ravel()
    assert np.abs(matrix @ turned).max() < 1e-10 * np.abs(force).max()


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_no_family_gives_way_without_energy(family):
    # Too few quadrature points leave motions that cost nothing; only the six rigid ones may.
    cube = MeshHex().refined(1)
    cube = MeshHex(cube.p, cube.t, _boundaries={"contact": cube.facets_satisfying(lambda x: x[2] == 0.0)}, sort_t=False)
    energies = np.linalg.eigvalsh(stiffness(DisplacementSpace(family.body(cube), family), 0.3).toarray())
    assert np.sum(energies < 1e-10 * energies[-1]) == 6


def test_tetrahedra_fill_the_brick_and_fit_together():
    brick = meshing.load(meshing.half_space(3))
    (tetrahedral,) = [family for family in FAMILIES if family.name == "tet4"]
    body = tetrahedral.body(brick)
    a, b, c, d = (body.p[:, corner] for corner in body.t)
    volumes = np.abs(np.einsum("ie,ie->e", b - a, np.cross((c - a).T, (d - a).T).T)) / 6.0
    assert volumes.min() > 0.0
    assert volumes.sum() == pytest.approx(np.prod(brick.p.max(axis=1)), rel=1e-12)
    # Two triangles a quadrilateral on the skin: diagonals that did not match would leave more.
    assert len(body.boundary_facets()) == 2 * len(brick.boundary_facets())
    assert len(body.boundaries["contact"]) == 2 * len(brick.boundaries["contact"])


def test_families_agree_on_the_contact():
    problem = configurations.problem()
    exact = hertz(problem)
    # Quadratic displacements: all within the 3 % that one mesh of three elements is off in the mean.
    for family in FAMILIES:
        if family.name in ("hex8", "tet4"):
            continue
        bodies = half_space_contact.condensed_bodies(problem, 3, family=family)
        found = half_space_contact.solve_on(problem, bodies)[1].mean
        assert found.approach == pytest.approx(exact.approach, rel=3e-3), family.name
        assert found.semi_major_axis == pytest.approx(exact.semi_major_axis, rel=1e-2), family.name


# --- fits -------------------------------------------------------------------------------------------------------------


def test_a_power_law_is_found_with_its_interval():
    x = [1e3, 3e3, 1e4, 3e4]
    fit = fits.power_law(x, [2e-5 * value**1.4 for value in x])
    assert fit["exponent"] == pytest.approx(1.4)
    assert fit["factor"] == pytest.approx(2e-5)
    assert fit["uncertainty"] == pytest.approx(0.0, abs=1e-9)
    two = fits.power_law(x[:2], [1.0, 9.0])
    assert two["exponent"] == pytest.approx(2.0)
    assert two["uncertainty"] is None
    assert fits.power_law([1.0], [1.0])["exponent"] is None


def test_the_interval_holds_what_it_says():
    # 400 noisy power laws: the true exponent lies inside the 95 % interval 95 times in 100, 2 standard errors 2.2 %.
    generator = np.random.default_rng(3)
    x = np.logspace(3, 5, 6)
    inside = 0
    for _ in range(400):
        fit = fits.power_law(x, x**1.5 * np.exp(generator.normal(0.0, 0.2, len(x))))
        inside += abs(fit["exponent"] - 1.5) <= fit["uncertainty"]
    assert inside / 400 == pytest.approx(0.95, abs=0.033)


def test_ratios_come_out_again_within_their_bounds():
    # Runs on a machine whose speed drifts by a third from round to round, every series scattering by 8 % besides.
    generator = np.random.default_rng(5)

    def run() -> list[list[float]]:
        drift = np.exp(generator.normal(0.0, 0.3, 3))
        return [list(size * drift * np.exp(generator.normal(0.0, 0.08, 3))) for size in np.logspace(-1, 1, 40)]

    missed, widths = 0, []
    for _ in range(50):
        first, again = timing.ratios(run(), 7), timing.ratios(run(), 7)
        assert first[7] == {"median": 1.0, "low": 1.0, "high": 1.0}
        for one, other in zip(first, again, strict=True):
            assert one["low"] <= one["median"] <= one["high"]
            missed += not one["low"] <= other["median"] <= one["high"]
            widths.append(one["high"] / one["low"])
    # 2000 ratios at 99.9 %: two misses are expected; more than eight would be one chance in a thousand.
    assert missed <= 8
    # Bounds that held anything would say nothing: with the drift left in, they would be seven times apart.
    assert 1.5 < np.median(widths) < 3.0
    assert timing.ratios([[1.0, 2.0], []], 0)[1] is None


def test_configurations_take_turns_there_and_back(monkeypatch):
    called = []

    def call(function, argument):
        called.append(argument)
        if argument == 2:
            raise fresh_process.ProcessError("no two")
        return {"seconds": function(argument)}

    monkeypatch.setattr(fresh_process, "call", call)
    monkeypatch.setattr(timing, "REPEATS", 2)
    found = timing.interleaved(float, [1, 2, 3], Level.QUICK, lambda stage, part: None, str)
    assert called == [1, 2, 3, 3, 1]
    assert found == [[{"seconds": 1.0}] * 2, "no two", [{"seconds": 3.0}] * 2]
    assert timing.spread([1.0, 4.0, 2.0]) == {"median": 2.0, "low": 1.0, "high": 4.0, "runs": 3}


# --- processes of their own -------------------------------------------------------------------------------------------


def _fail(argument):
    raise ValueError(f"no {argument}")


def _die(argument):
    os.kill(os.getpid(), signal.SIGKILL)


def test_a_process_of_its_own_answers_or_says_why_not():
    answer = fresh_process.call(configurations.solve, configurations.Configuration(3, "scipy"))
    assert answer["dofs"] == 2376
    assert answer["sound"]
    assert answer["peak_memory_MB"] > answer["base_memory_MB"] > 0.0
    assert answer["seconds"] > answer["contact_seconds"] > 0.0
    with pytest.raises(fresh_process.ProcessError, match="ValueError: no bread"):
        fresh_process.call(_fail, "bread")
    with pytest.raises(fresh_process.ProcessError, match="code -9"):
        fresh_process.call(_die, None)


# --- configurations ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("level", list(Level))
def test_every_configuration_is_planned_once(level):
    planned = configurations.planned(level, "rslab", ["scipy", "cholmod"])
    assert len(planned) == len(set(planned))
    assert {each.family for each in planned} == {family.name for family in FAMILIES}
    assert {each.solver for each in planned} == {"rslab", "scipy", "cholmod"}
    plain = {each.elements for each in planned if each == configurations.Configuration(each.elements, "rslab")}
    # What advice solves is measured.
    finest = [count for count in advice.SEQUENCES if count in configurations.MESHES[level]]
    assert finest
    assert {count for each in finest for count in advice.SEQUENCES[each]} <= plain
    assert {each.box_size for each in planned if each.is_clamped} == {0.0, *configurations.BOX_SIZES}


def test_a_clamped_block_takes_back_nearly_half_of_the_approach():
    # Boussinesq's displacement falls like 1/distance, and the walls are two and a half semi-axes away.
    found = configurations.solve(configurations.Configuration(4, "scipy", is_clamped=True))
    assert -0.6 < found["error"]["approach"] < -0.3


# --- the record, measured on a refinement of a few configurations -----------------------------------------------------


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """`fem-check cost --out`, on few and coarse configurations in this process; scipy's solver not installed."""

    def call_here(function, argument):
        try:
            return function(argument)
        except Exception as problem:
            raise fresh_process.ProcessError(f"{type(problem).__name__}: {problem}") from None

    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(configurations.MESHES, Level.QUICK, (3, 4, 5))
        patch.setitem(configurations.FAMILY_MESHES, Level.QUICK, {})
        patch.setitem(configurations.CLAMPED_BLOCK_MESHES, Level.QUICK, (3,))
        patch.setitem(configurations.BOX_MESHES, Level.QUICK, ())
        patch.setitem(shapes.ELLIPTICITIES, Level.QUICK, (20.0,))
        patch.setattr(timing, "REPEATS", 1)
        patch.setattr(fresh_process, "call", call_here)
        patch.setitem(holdout.COUNT, Level.QUICK, 1)
        patch.setattr(linear_solver, "available", lambda: ["rslab"])
        patch.setenv(linear_solver.ENVIRONMENT, "rslab")
        folder = tmp_path_factory.mktemp("cost")
        result = call("cost", "--out", str(folder), "--json")
    assert result.exit_code == 0, result.output
    return result, folder


def test_no_number_of_a_picture_is_cut_off_and_an_error_of_zero_is_said():
    kept = record.read()
    for name in ("families", "far-field"):
        figure = figures.FIGURES[name][0](kept)
        figure.canvas.draw()
        frame = figure.axes[0].get_window_extent()
        assert all(frame.y0 <= text.get_window_extent().y0 for text in figure.axes[0].texts), name
    exact = kept["closed_forms"][-1]
    exact["error"] = dict.fromkeys(exact["error"], 0.0)
    axes = figures.combined(kept).axes[0]
    assert f"{exact['label']}: error 0, not shown" in axes.get_legend_handles_labels()[1]
    assert min(y for line in axes.lines for y in line.get_ydata()) > 1e-6


def test_cost_writes_one_record_with_tables_and_figures(small):
    result, folder = small
    kept = json.loads((folder / "fem_cost.json").read_text())
    assert json.loads(result.stdout) == kept
    assert set(record.FIELDS) <= set(kept)
    assert {path.name for path in folder.iterdir()} == {
        "fem_cost.json",
        *(f"fem_{name}.png" for name in figures.FIGURES),
        *(f"fem_{part}.csv" for part in tables.CSV_PARTS),
    }
    lines = (folder / "fem_configurations.csv").read_text().splitlines()
    assert len(lines) == 1 + len(kept["configurations"])
    assert "seconds.median" in lines[0]
    for entry in kept["configurations"]:
        if entry["status"] == record.MEASURED:
            assert entry["seconds"]["runs"] == 1
            assert entry["seconds"]["median"] > 0.0


def test_a_configuration_that_fails_is_kept_with_its_reason(small):
    # Clamped, the contact is longer than the patch of three elements: no number, and never a zero.
    _, folder = small
    kept = json.loads((folder / "fem_cost.json").read_text())
    (failed,) = [entry for entry in kept["configurations"] if entry["far_field"] != "exact"]
    assert "fills the whole patch" in failed["status"]
    assert failed["seconds"] is failed["worst_error"] is failed["peak_memory_MB"] is None
    assert any("Not measured: 3 elements" in line for line in tables.remarks(kept))


def test_what_is_not_installed_is_named_and_never_zero(small):
    _, folder = small
    kept = json.loads((folder / "fem_cost.json").read_text())
    assert kept["solvers"]["scipy"]["status"] == "not installed"
    assert [entry for entry in kept["configurations"] if entry["solver"] == "scipy"] == []
    (row,) = [row for row in tables.solvers(kept).rows if row[0] == "SuperLU (scipy)"]
    assert row[1:] == ("not installed", *[""] * (len(row) - 2))
    assert any("Not installed" in line and "SuperLU" in line for line in tables.remarks(kept))


def test_an_interrupted_measurement_leaves_the_earlier_files(tmp_path, monkeypatch):
    def stop(function, argument):
        raise KeyboardInterrupt

    (tmp_path / "fem_cost.json").write_text("earlier")
    monkeypatch.setattr(fresh_process, "call", stop)
    result = call("cost", "--out", str(tmp_path))
    assert result.exit_code != 0
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"fem_cost.json": "earlier"}


def test_a_folder_that_takes_no_files_is_refused_first(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setattr(campaign, "measure", lambda *_: pytest.fail("measured"))
    result = call("cost", "--out", str(tmp_path / "file" / "inside"))
    assert result.exit_code == 2
    assert "cannot be written" in result.stderr


def test_a_damaged_cost_record_is_named(tmp_path):
    (tmp_path / "quick.json").write_text('{"level": "quick"}')
    with pytest.raises(record.RecordError, match=r"quick.json lacks machine"):
        record.read(tmp_path)
    output.replace(tmp_path / "quick.json", b"{")
    with pytest.raises(record.RecordError, match=r"quick.json is no cost record"):
        record.read(tmp_path)


# --- the record that is kept ------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def kept():
    return advice.table()


def test_the_kept_record_shows_what_it_should(kept):
    refinement = record.mesh_refinement(kept["configurations"], kept["main_solver"])
    assert all(entry["sound"] for entry in kept["configurations"] if entry["status"] == record.MEASURED)
    # Finer is dearer in both; and the whole refinement buys accuracy, by at least the order that the edge allows.
    for name in ("seconds", "peak_memory_MB"):
        assert refinement[-1][name]["median"] > refinement[0][name]["median"]
    fineness = refinement[0]["element_size"] / refinement[-1]["element_size"]
    assert refinement[0]["worst_error"] / refinement[-1]["worst_error"] > fineness**1.5
    for entry in refinement:
        assert entry["worst_error"] < entry["worst_single_position"]
    # No clamped body comes near the exact far field on the same mesh.
    exact = {entry["elements_per_semi_axis"]: abs(entry["error"]["approach"]) for entry in refinement}
    for entry in kept["configurations"]:
        if entry["far_field"] != "exact":
            assert abs(entry["error"]["approach"]) > 10.0 * exact[entry["elements_per_semi_axis"]]
    assert kept["closed_forms"][-1]["worst_error"] < 1e-13
    assert len(kept["holdout_contacts"]) == holdout.COUNT[Level(kept["level"])]
    assert all(each["deviation"] <= each["expected_error"] <= each["asked"] for each in kept["holdout_contacts"])


def test_the_errors_kept_are_those_made_here(kept):
    # Errors do not depend on the machine: the coarsest mesh's are found again, to the digits kept.
    (entry,) = [
        e
        for e in record.mesh_refinement(kept["configurations"], kept["main_solver"])
        if e["elements_per_semi_axis"] == 4
    ]
    found = configurations.solve(configurations.Configuration(4, "scipy"))
    for name in configurations.JUDGED:
        assert found["error"][name] == pytest.approx(entry["error"][name], rel=1e-3, abs=1e-8)


# --- advice -----------------------------------------------------------------------------------------------------------


def test_advice_takes_the_cheapest_that_will_do(kept):
    problem = slender_problem(6.0)
    every = advice.choices(problem, kept, kept["main_solver"])
    dearer = 0.0
    for accuracy in (0.1, 1e-2, 5e-3, 3e-3, 1e-3):
        choice = advice.choose(problem, accuracy, kept, kept["main_solver"], None)
        assert choice.error <= accuracy
        assert all(other.seconds >= choice.seconds for other in every if other.error <= accuracy)
        assert choice.seconds >= dearer
        dearer = choice.seconds


def test_unlike_bodies_take_twice_the_time(kept):
    problem = slender_problem(6.0)
    hybrid = replace(problem, ball=ElasticConstants(310e9, 0.26))
    one, two = (advice.choose(each, 1e-3, kept, kept["main_solver"], None) for each in (problem, hybrid))
    assert two.elements == one.elements
    assert 1.7 < two.seconds / one.seconds <= 2.0


def test_advice_says_what_is_attainable(kept, monkeypatch, tmp_path):
    problem, solver = slender_problem(6.0), kept["main_solver"]
    finest = max(count for count in advice.SEQUENCES if count in {e["elements_per_semi_axis"] for e in kept["shapes"]})
    with pytest.raises(
        advice.AdviceError, match=rf"beyond the finest mesh.*best attainable here is .*with {finest} el"
    ):
        advice.choose(problem, 1e-9, kept, solver, None)
    with pytest.raises(advice.AdviceError, match=r"elements per semi-axis, and about .* MB, of which 400 MB are free"):
        advice.choose(problem, 1e-3, kept, solver, 400.0)
    with pytest.raises(advice.AdviceError, match="no measured mesh is available here"):
        advice.choose(problem, 1e-3, kept, solver, 10.0)
    with pytest.raises(advice.AdviceError, match=r"a/b = 50.0, and errors were measured up to 30"):
        advice.choose(slender_problem(50.0), 1e-2, kept, solver, None)
    # Without gmsh only the meshes that come with the package are to be had.
    monkeypatch.setattr(meshing, "gmsh_problem", lambda: "gmsh is not installed: pip install gmsh")
    monkeypatch.setenv("FEM_CHECK_CACHE", str(tmp_path))
    with pytest.raises(advice.AdviceError, match=r"best attainable here is .*with 6 elements"):
        advice.choose(problem, 1e-5, kept, solver, None)


def test_a_solver_measured_on_few_meshes_is_followed_along_its_power_law(kept):
    def entry(dofs, elements, solver, seconds):
        timed = {"median": seconds}
        return {
            "status": record.MEASURED, "family": SERENDIPITY.name, "far_field": "exact", "solver": solver, "dofs": dofs,
            "elements_per_semi_axis": elements, "seconds": timed,
        }  # fmt: skip

    made = [entry(1000 * n, n, "one", 1e-3 * n) for n in (1, 2, 4, 8, 16)]
    made += [entry(1000 * n, n, "two", 1e-3 * n**2) for n in (2, 4)]
    table = {"main_solver": "one", "configurations": made}
    assert advice._interpolated(table, 4, "two", "seconds") == pytest.approx(16e-3)
    assert advice._interpolated(table, 16, "two", "seconds") == pytest.approx(256e-3)
    assert advice._interpolated(table, 16, "never measured", "seconds") == pytest.approx(16e-3)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--accuracy", "0"], "a relative error, above 0 and below 1"),
        (["--accuracy", "nan"], "a relative error, above 0 and below 1"),
        (["--accuracy", "1"], "a relative error, above 0 and below 1"),
        (["--accuracy", "1e-3", "--elements", "6"], "name one of the two"),
        (["--accuracy", "1e-9"], "the best attainable here is"),
    ],
)
def test_bad_accuracy_is_exit_2_with_a_sentence(arguments, said):
    result = call("contact", "--scene", "b218", "--race", "inner", "--load-N", "100", *arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert "Traceback" not in result.output


def test_too_little_memory_leaves_a_coarser_mesh(kept, monkeypatch):
    monkeypatch.setattr(memory, "available_MB", lambda: 300.0)
    result = call("contact", "--scene", "b218", "--race", "inner", "--load-N", "100", "--accuracy", "1e-3")
    assert result.exit_code == 2
    assert "300 MB are free" in result.stderr


def scene_file(folder, ball_material="steel", groove=11.6281, other=11.6281, diameter=22.225, pitch=125.26):
    """A bearing of its own; the two groove radii in mm."""
    path = folder / "scene.toml"
    path.write_text(
        f"""[bearing]
ball_count = 16
ball_diameter_mm = {diameter}
pitch_diameter_mm = {pitch}
inner_groove_radius_mm = {groove}
outer_groove_radius_mm = {other}
free_contact_angle_deg = 40.0
ball_material = "{ball_material}"
ring_material = "steel"

[operation]
axial_load_N = 1000
"""
    )
    return str(path)


# Contacts that no record was made on: other shapes (a/b from 3 to 25), materials, sizes, loads.
CONTACTS = [
    ({}, "outer", 321.0),
    ({"ball_material": "silicon nitride"}, "inner", 2500.0),
    ({"groove": 11.25, "other": 11.3}, "inner", 40.0),
    ({"groove": 11.9}, "inner", 900.0),
    ({"groove": 12.5}, "inner", 5000.0),
    ({"groove": 14.0}, "inner", 700.0),
    ({"groove": 20.0}, "inner", 60.0),
    ({"other": 16.0}, "outer", 1500.0),
    ({"diameter": 6.35, "pitch": 40.0, "groove": 3.3, "other": 3.35}, "inner", 12.0),
    (
        {"diameter": 6.35, "pitch": 40.0, "groove": 3.3, "other": 3.35, "ball_material": "silicon nitride"},
        "outer",
        25.0,
    ),
]


def met(scene, race, load, accuracy):
    """Solve a contact to an accuracy, see that it is met, and hand back what was said of it."""
    result = call(
        "contact", "--scene", scene, "--race", race, "--load-N", str(load), "--accuracy", str(accuracy), "--json"
    )
    assert result.exit_code == 0, result.output
    entry = json.loads(result.stdout)
    found = entry["accuracy"]
    assert found["deviation"] <= accuracy
    judged = [row for row in entry["rows"] if row["quantity"] in configurations.JUDGED]
    assert len(judged) == 5
    assert all(abs(row["deviation_percent"]) <= 100.0 * accuracy for row in judged)
    assert all(row["tolerance_percent"] == pytest.approx(100.0 * accuracy) for row in judged)
    assert found["deviation"] <= found["expected_error"] <= accuracy
    return found


@pytest.mark.heavy
@pytest.mark.parametrize("elements", [8, 10, 12])
@pytest.mark.parametrize("which", [0, 2, 6])
def test_the_uncertainty_owns_up_to_the_error(which, elements, tmp_path):
    bearing, race, load = CONTACTS[which]
    scene = scene_file(tmp_path, **bearing)
    result = call(
        "contact", "--scene", scene, "--race", race, "--load-N", str(load), "--elements", str(elements), "--json"
    )
    for row in json.loads(result.stdout)["rows"]:
        if row["quantity"] in configurations.JUDGED:
            assert abs(row["deviation_percent"]) <= row["uncertainty_percent"], row["quantity"]


@pytest.mark.heavy
@pytest.mark.parametrize("accuracy", [1e-2, 3e-3, 1e-3, 5e-4, 2e-4])
@pytest.mark.parametrize("which", range(len(CONTACTS)))
def test_every_accuracy_is_met_on_every_contact(which, accuracy, tmp_path):
    half_space_contact.clear_cache()
    bearing, race, load = CONTACTS[which]
    found = met(scene_file(tmp_path, **bearing), race, load, accuracy)
    # Times are no pass mark on a shared machine; what was promised and what it took is for the eye (pytest -s).
    print(f"{found['seconds']:.2f} s, expected {found['expected_seconds']:.2f} s")


def test_an_accuracy_asked_for_is_met_and_said():
    met("7210c", "inner", 50.0, 1e-2)
    result = call("contact", "--scene", "7210c", "--race", "inner", "--load-N", "50", "--accuracy", "1e-2")
    assert result.exit_code == 0
    assert "Chosen: 5 elements per semi-axis" in result.output
    assert "Expected:" in result.output
    assert "Asked: 0.01. Reached:" in result.output


def test_the_true_gap_is_not_judged_by_hertz():
    result = call(
        "contact", "--scene", "7210c", "--race", "inner", "--load-N", "50", "--accuracy", "1e-2", "--geometry", "true",
        "--json",
    )  # fmt: skip
    assert result.exit_code == 0
    entry = json.loads(result.stdout)
    assert entry["accuracy"]["deviation"] is None
    assert entry["accuracy"]["uncertainty"] > 0.0
    assert {row["verdict"] for row in entry["rows"] if row["quantity"] in configurations.JUDGED} == {"finding"}
