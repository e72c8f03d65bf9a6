"""A new number or material of any class of inputs is one field: reading, writing, schema, hints, studies, reports
follow.

Done on a copy of the package, in which every class gets one field more, a line each.
"""

from __future__ import annotations

import ast
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

import pytest

import qsbearing as qs

PACKAGE = Path(qs.__file__).parent


class New(NamedTuple):
    """A field that a class gets."""

    of: str
    """Where the class is."""
    field: str
    unit: str
    """What `given_in` is given."""
    path: str
    """Of the key that must follow."""
    default: str = "None"
    value: Any = 3.0

    @property
    def file(self) -> str:
        """Which of `FILES` gives it."""
        known = {"systems.sets": "set", "systems.heat": "heat"}
        return "wear" if "GrooveWear" in self.of else known.get(".".join(self.of.split(".")[:2]), "everything")

    @property
    def metadata(self) -> str:
        """Of the field."""
        if self.unit.startswith("one_of"):
            return f"described.{self.unit}"
        return "described.A_MATERIAL" if isinstance(self.value, str) else f"described.given_in({self.unit})"


NEW = [
    New("model.bearing.BallBearing", "waviness", '"um"', "bearing.waviness_um", default="0.0"),
    New("model.material.Material", "hardness", '"GPa"', "bearing.ball_material.hardness_GPa"),
    New("model.operation.Operation", "axial_shock", '"N"', "operation.axial_shock_N"),
    New("model.scene.preload.Preload", "nut_moment", '"N m"', "preload.nut_moment_Nm"),
    New("model.effects.gyroscopic_moment.GyroscopicMoment", "slip", "", "effects.slip"),
    New("model.effects.ring_expansion.RingExpansion", "roughness", '"um"', "effects.ring_expansion.roughness_um"),
    New("model.effects.ball_expansion.BallExpansion", "core", '"C"', "effects.ball_expansion.core_C"),
    New(
        "model.effects.elastic_rings.ElasticRings",
        "outer_mass",
        '"kg", part=OUTER',
        "effects.elastic_rings.outer.mass_kg",
    ),
    New("readings.rating_life.LifeArguments", "hydrogen", "", "readings.life.hydrogen"),
    New("readings.static_rating.StaticSafetyArguments", "worn", '"um"', "readings.static_safety.worn_um"),
    New("readings.ball_advance.PocketClearance", "play", '"mm"', "readings.ball_advance.play_mm"),
    New("readings.contact_friction.FrictionArguments", "shear", '"GPa"', "readings.friction.shear_GPa"),
    New("readings.film_thickness.FilmArguments", "starved", '"mm"', "readings.film.starved_mm"),
    New("readings.friction_estimate.EstimateArguments", "level", '"mm"', "readings.friction_estimate.level_mm"),
    New("readings.shoulder_overrun.OverrunArguments", "lip", '"mm"', "readings.overrun.lip_mm"),
    New("systems.sets.bearing_set.BearingSet", "lift", '"um"', "shaft.lift_um"),
    New("systems.sets.row.Row", "cage_mass", '"kg"', "rows.1.cage_mass_kg"),
    New("systems.sets.shaft.Shaft", "run_out", '"um"', "shaft.run_out_um"),
    New("systems.sets.shaft.ShaftSection", "fillet", '"mm"', "shaft.sections.1.fillet_mm"),
    New("systems.sets.shaft.ShaftLoad", "lead", '"deg"', "shaft.loads.1.lead_deg"),
    New("systems.sets.shaft.ShaftMass", "skew", '"mrad"', "shaft.masses.1.skew_mrad"),
    New("systems.sets.gears.Gear", "skew", '"mrad"', "shaft.gears.1.skew_mrad"),
    New("systems.sets.belts.Belt", "stretch", '"um"', "shaft.belts.1.stretch_um"),
    New("systems.sets.shaft.ShaftSupport", "roll", '"kN m/rad"', "shaft.supports.1.roll_stiffness_kNm_per_rad"),
    New("systems.sets.shaft.HousingStiffness", "cross", '"N/um"', "rows.1.housing_stiffness.cross_stiffness_N_per_um"),
    New("systems.sets.shaft.Housing", "wall", '"mm"', "housing.wall_mm"),
    New("systems.sets.shaft.Spacer", "pitch", '"mm"', "spacers.1.pitch_mm"),
    New("systems.sets.shaft.FloatingGroup", "drag", '"N"', "floating.1.drag_N"),
    New(
        "model.effects.ball_expansion.BallExpansion",
        "skin_material",
        "",
        "effects.ball_expansion.skin_material",
        value="M50",
    ),
    New("systems.sets.shaft.ShaftSection", "skin_material", "", "shaft.sections.1.skin_material", value="M50"),
    New("systems.sets.shaft.ShaftMass", "skin_material", "", "shaft.masses.1.skin_material", value="M50"),
    New("systems.sets.shaft.Housing", "skin_material", "", "housing.skin_material", value="M50"),
    New("systems.sets.shaft.Spacer", "skin_material", "", "spacers.1.skin_material", value="M50"),
    New("systems.sets.row.Row", "squeeze", '"N"', "rows.1.squeeze_N", default="0.0"),
    New(
        "model.effects.elastic_rings.ElasticRings",
        "outer_lip",
        '"mm", part=OUTER, printed="width"',
        "effects.elastic_rings.outer.lip_mm",
    ),
    New(
        "readings.friction_estimate.EstimateArguments",
        "rim",
        '"mm", printed="width"',
        "readings.friction_estimate.rim_mm",
    ),
    New("model.effects.groove_wear.GrooveWear", "rest", '"um"', "effects.groove_wear.rest_um", default="0.0"),
    New("model.effects.groove_wear.GrooveWear", "rim", '"mm", printed="width"', "effects.groove_wear.rim_mm"),
    New("model.effects.groove_wear.GrooveWear", "skin_material", "", "effects.groove_wear.skin_material", value="M50"),
    New(
        "model.effects.groove_wear.GrooveWear",
        "by_side",
        '"um", is_list=True',
        "effects.groove_wear.by_side_um",
        value=[1.0, 2.5],
    ),
    New(
        "model.effects.groove_wear.GrooveWear",
        "way",
        "one_of(BearingKind)",
        "effects.groove_wear.way",
        value="deep_groove",
    ),
    New("systems.heat.network.Thermal", "wind", '"rpm"', "thermal.wind_rpm"),
    New("systems.heat.network.OilFlow", "leak", '"cm3/min"', "thermal.oil.leak_cm3_min"),
    New("systems.heat.network.Conductance", "area", '"mm"', "thermal.conductances.1.area_mm"),
]
BEARING: dict[str, Any] = {
    "ball_count": 16, "ball_diameter_mm": 22.225, "pitch_diameter_mm": 125.26, "inner_groove_radius_mm": 11.6281,
    "outer_groove_radius_mm": 11.6281, "free_contact_angle_deg": 40.0, "ring_material": "steel",
    "ball_material": {"elastic_modulus_GPa": 208.0, "poisson_ratio": 0.3, "density_kg_m3": 7800.0},
}  # fmt: skip
FILES: dict[str, dict[str, Any]] = {
    "everything": {
        "bearing": BEARING | {"ball_material": BEARING["ball_material"] | {"thermal_expansion_per_K": 1.2e-5}},
        "operation": {"speed_rpm": 1000.0},
        "preload": {"rigid_N": 500.0},
        "effects": {
            "ball": ["gyroscopic_moment"],
            "raceway_control": "outer",
            "ring_expansion": {"bore_diameter_mm": 90.0, "outside_diameter_mm": 160.0},
            "ball_expansion": {"ball_temperature_C": 30.0},
            "elastic_rings": {"outer": {"outside_diameter_mm": 160.0, "width_mm": 30.0, "housing": "free"}},
        },
        "readings": {
            "life": {}, "static_safety": {}, "ball_advance": {}, "friction": {"friction_coefficient": 0.05},
            "lubricant": {"iso_viscosity_grade": 68.0, "oil_temperature_C": 40.0}, "film": {},
            "overrun": {"outer_shoulder_diameter_mm": 139.0},
            "friction_estimate": {"bore_diameter_mm": 90.0, "outside_diameter_mm": 160.0},
        },
    },
    "set": {
        "bearing": BEARING,
        "operation": {"speed_rpm": 1000.0},
        "rows": [{"position_mm": 100.0 * n, "carries": way} for n, way in enumerate(("+x", "-x", "+x", "-x"))],
        "shaft": {
            "sections": [{"length_mm": 600.0, "outer_diameter_mm": 90.0}],
            "loads": [{"position_mm": 20.0, "axial_N": 100.0}],
            "supports": [{"position_mm": 400.0, "radial_y_stiffness_N_per_um": 5.0}],
            "masses": [{"position_mm": 300.0, "mass_kg": 2.0}],
            "gears": [{"position_mm": 50.0, "azimuth_deg": 0.0, "pitch_diameter_mm": 99.0, "torque_Nm": 5.0,
                       "drives": True}],
            "belts": [{"position_mm": 60.0, "azimuth_deg": 0.0, "pitch_diameter_mm": 99.0, "torque_Nm": 5.0,
                       "drives": False, "pretension_N": 400.0}],
            "start_mm": -100.0,
        },
        "housing": {"temperature_C": 30.0},
        "spacers": [{"rows": [1, 2], "inner_length_mm": 30.0}],
        "floating": [{"rows": [3, 4], "spring_N": 10.0}],
        "preload": {"rigid_N": 500.0},
    },
    "heat": {
        "bearing": BEARING,
        "operation": {"speed_rpm": 1000.0, "axial_load_N": 1000.0},
        "effects": {"ball": ["centrifugal_force"], "raceway_control": "outer"},
        "readings": {"friction": {"friction_coefficient": 0.05}},
        "thermal": {
            "conductances": [
                {"between": ["inner_ring", "ambient"], "W_per_K": 10.0},
                {"between": ["outer_ring", "oil"], "W_per_K": 10.0},
            ],
            "fixed": {"ambient_C": 20.0},
            "oil": {
                "flow_cm3_min": 9.0, "inlet_temperature_C": 20.0, "density_kg_m3": 900.0, "specific_heat_J_kgK": 1900.0,
            },
        },
    },
}  # fmt: skip
FILES["wear"] = {
    "bearing": BEARING,
    "operation": {"axial_load_N": 100.0},
    "effects": {"groove_wear": {"depth_um": 2.0}},
}
"""With the effect of the walk-through, and its table."""
FILES["set"]["rows"][0]["housing_stiffness"] = {"axial_stiffness_N_per_um": 500.0}

TRIAL = """
import copy, json, sys
from qsbearing.files import paths
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.columns import scene_numbers
from qsbearing.reports import inputs, set_inputs
from qsbearing.studies import keys
from qsbearing.studies.schema import file_schema

new, files = json.loads(sys.stdin.read())
schema = json.dumps(file_schema())
def answers(each):
    path = tuple(each["path"].split("."))
    without = files[each["file"]]
    document = copy.deepcopy(without)
    paths.put(document, path, each["value"])
    of = scene_or_set_of(copy.deepcopy(document), "a file")
    written = input_tables(of)
    section = (inputs if isinstance(of, Scene) else set_inputs).section(of, "", of.thermal)
    slip = copy.deepcopy(without)
    paths.put(slip, (*path[:-1], path[-1][:2] + path[-1][3:]), 3.0)
    try:
        scene_or_set_of(slip, "a file")
        hint = ""
    except SceneFileError as error:
        hint = str(error)
    return {
        "written": paths.value_at(written, path),
        "again": paths.value_at(input_tables(scene_or_set_of(copy.deepcopy(written), "a file")), path),
        "schema": f'"{path[-1]}"' in schema,
        "hint": hint if "Did you mean" not in hint else path[-1] in hint,
        "report": path[-1] in repr(section),
        "study": keys.find(each["path"] + ".density_kg_m3" * (each["value"] == "M50")) is not None,
        "unset": unset(without, path),
        "stands_in": unset(without | {"bearing": without["bearing"] | {"width_mm": 31.0}}, path),
    }
def unset(file, path):
    return paths.value_at(input_tables(scene_or_set_of(copy.deepcopy(file), "a file")), path)


for each in new:
    try:
        print(json.dumps([each["path"], answers(each)]))
    except Exception as error:
        print(json.dumps([each["path"], f"{type(error).__name__}: {error}"]))
whole = copy.deepcopy(files["everything"])
for each in new:
    if each["file"] == "everything":
        paths.put(whole, tuple(each["path"].split(".")), each["value"])
print(json.dumps(["columns", sorted(scene_numbers(scene_or_set_of(whole, "a file")))]))
"""


def add(new: New, package: Path) -> None:
    """Add the field to its class in this copy, behind the others."""
    *folders, module, name = new.of.split(".")
    file = package.joinpath(*folders, f"{module}.py")
    text = file.read_text(encoding="utf-8")
    (of,) = (each for each in ast.parse(text).body if isinstance(each, ast.ClassDef) and each.name == name)
    is_field = [isinstance(each, ast.AnnAssign) and "ClassVar" not in ast.unparse(each) for each in of.body]
    last = len(is_field) - 1 - is_field[::-1].index(True)
    behind = of.body[last + 1] if len(of.body) > last + 1 else None
    end = behind.end_lineno if isinstance(behind, ast.Expr) else of.body[last].end_lineno
    lines = text.splitlines()
    assert end is not None
    lines.insert(end, f"    {new.field}: Any = field(default={new.default}, metadata={new.metadata})")
    at = lines.index("from __future__ import annotations") + 1
    lines.insert(at, "from qsbearing.model import described")
    if "one_of" in new.metadata:
        lines.insert(at + 1, "from qsbearing.model.bearing import BearingKind")
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def add_effect(package: Path) -> None:
    """Add that of the walk-through: one file, and one line."""
    page = (package / "guide" / "adding_an_effect.md").read_text(encoding="utf-8")
    file, line = (page.split(f"```{language}\n")[1].split("```")[0] for language in ("python", "text"))
    effects = package / "model" / "effects"
    (effects / "groove_wear.py").write_text(file, encoding="utf-8")
    listed = (effects / "__init__.py").read_text(encoding="utf-8")
    (effects / "__init__.py").write_text(
        listed.replace('    "centrifugal_force",\n', line + '    "centrifugal_force",\n')
    )


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    folder = tmp_path_factory.mktemp("one_place")
    shutil.copytree(PACKAGE, folder / "qsbearing", ignore=shutil.ignore_patterns("__pycache__", "records"))
    add_effect(folder / "qsbearing")
    for each in NEW:
        add(each, folder / "qsbearing")
    environment = {**os.environ, "PYTHONPATH": str(folder), "NUMBA_DISABLE_JIT": "1"}
    given = json.dumps([[{"path": each.path, "file": each.file, "value": each.value} for each in NEW], FILES])
    command = [sys.executable, "-c", TRIAL]
    done = subprocess.run(
        command, env=environment, cwd=folder, input=given, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return dict(map(json.loads, done.stdout.splitlines()))


@pytest.mark.parametrize("new", NEW, ids=lambda new: new.path)
def test_a_field_is_read_written_hinted_at_and_shown(answers: dict[str, Any], new: New) -> None:
    unset = None if new.default == "None" else 0.0
    assert answers[new.path] == {
        "written": new.value, "again": new.value, "schema": True, "hint": True, "report": True,
        "study": isinstance(new.value, float) or new.value == "M50",
        "unset": unset, "stands_in": 31.0 if "printed" in new.unit else unset,
    }  # fmt: skip


def test_the_fields_of_a_scene_are_columns(answers: dict[str, Any]) -> None:
    assert {
        "waviness_um", "ball_material_hardness_GPa", "axial_shock_N", "preload_nut_moment_Nm", "slip",
        "ring_expansion_roughness_um", "ball_expansion_core_C", "skin_material_density_kg_m3",
        "elastic_rings_outer_mass_kg",
    } <= {*answers["columns"]}  # fmt: skip
