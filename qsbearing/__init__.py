"""qsbearing: the quasi-static (Jones-Harris) model of angular-contact ball bearings.

    import qsbearing as qs
    solution = qs.solve(qs.load_scene("b218"))
    solution.inner.angle / qs.deg

SI units and radians everywhere: `22.225 * qs.mm`, `10_000 * qs.rpm`, `40 * qs.deg`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from qsbearing.model.above import DONE_BY
from qsbearing.model.units import GPa, MPa, N, Nm, Nmm, Pa, deg, kg, kg_m3, kN, m, mm, mrad, rad, rpm, um, zero_celsius
from qsbearing.model.version import __version__ as __version__

# Methods of scenes and solutions that the model and the systems leave to the folders above it.
DONE_BY.update(
    html_of="qsbearing.app.notebook",
    plot="qsbearing.app.notebook",
    message="qsbearing.messages",
    warnings="qsbearing.messages",
    of_solution="qsbearing.systems.rotor_dynamics.ross_bearing",
)

if TYPE_CHECKING:
    from qsbearing import readings
    from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
    from qsbearing.files.printed_numbers import catalogue_numbers
    from qsbearing.files.scene_file import load_scene
    from qsbearing.files.set_file import load_set
    from qsbearing.inference.data_sheet import DataSheet
    from qsbearing.inference.infer import InferredBearing, infer_bearing
    from qsbearing.inference.practice import RatingPractice
    from qsbearing.messages import message, warnings
    from qsbearing.model.bearing import BallBearing, BearingKind
    from qsbearing.model.contact.hertz import HertzForm, PointContact, point_contact, subsurface_shear
    from qsbearing.model.effects import (
        BallDiameterDeviations,
        BallExpansion,
        CentrifugalForce,
        ElasticRings,
        GyroscopicMoment,
        MomentShares,
        RingExpansion,
        RingState,
    )
    from qsbearing.model.effects.hertz_angle import HertzAngle
    from qsbearing.model.effects.orbit_radius import OrbitRadius
    from qsbearing.model.effects.raceway_control import RacewayControl
    from qsbearing.model.effects.tilt_lever import TiltLever
    from qsbearing.model.material import SILICON_NITRIDE, STEEL, Material
    from qsbearing.model.operation import Operation
    from qsbearing.model.scene.preload import Preload
    from qsbearing.model.scene.scene import Scene
    from qsbearing.model.solution.raceway_contacts import RacewayContacts
    from qsbearing.model.solution.solution import Solution, stiffness
    from qsbearing.model.solution.status import Reason, Status
    from qsbearing.model.validation import ErrorDetail, SceneError
    from qsbearing.studies.chooser.choose import solve
    from qsbearing.studies.design.compare import compare
    from qsbearing.studies.design.find import find
    from qsbearing.studies.sobol import sobol_indices
    from qsbearing.studies.store import open_results
    from qsbearing.studies.study import Study
    from qsbearing.studies.sweep import sweep
    from qsbearing.systems.heat.network import Conductance, OilFlow, Thermal
    from qsbearing.systems.rotor_dynamics import stiffness_table, to_ross
    from qsbearing.systems.sets.bearing_set import BearingSet, Row
    from qsbearing.systems.sets.preload_limits import preload_loads, preload_speeds
    from qsbearing.systems.sets.set_solution import SetSolution
    from qsbearing.systems.sets.shaft import (
        FloatingGroup,
        Housing,
        HousingStiffness,
        Shaft,
        ShaftLoad,
        ShaftSection,
        ShaftSupport,
        Spacer,
    )
    from qsbearing.systems.sets.solve import solve_set
    from qsbearing.systems.sets.system_life import system_life

# fmt: off
# Where each public name lives; imported when first used, so that `qsbearing --help` loads no numerical library.
_HOMES = {
    "studies.chooser.choose": ("solve",),
    "model.contact.hertz": ("HertzForm", "PointContact", "point_contact", "subsurface_shear"),
    "model.effects": (
        "BallDiameterDeviations", "BallExpansion", "CentrifugalForce", "ElasticRings", "GyroscopicMoment",
        "MomentShares", "RingExpansion", "RingState",
    ),
    "model.effects.hertz_angle": ("HertzAngle",),
    "model.effects.orbit_radius": ("OrbitRadius",),
    "model.effects.raceway_control": ("RacewayControl",),
    "model.effects.tilt_lever": ("TiltLever",),
    "files.file_errors": ("FileErrorDetail", "SceneFileError"),
    "files.printed_numbers": ("catalogue_numbers",),
    "files.scene_file": ("load_scene",),
    "files.set_file": ("load_set",),
    "inference.data_sheet": ("DataSheet",),
    "inference.infer": ("InferredBearing", "infer_bearing"),
    "inference.practice": ("RatingPractice",),
    "messages": ("message", "warnings"),
    "model.bearing": ("BallBearing", "BearingKind"),
    "model.material": ("SILICON_NITRIDE", "STEEL", "Material"),
    "model.operation": ("Operation",),
    "model.scene.preload": ("Preload",),
    "model.scene.scene": ("Scene",),
    "model.solution.raceway_contacts": ("RacewayContacts",),
    "systems.rotor_dynamics": ("stiffness_table", "to_ross"),
    "systems.sets.bearing_set": ("BearingSet", "Row"),
    "systems.sets.preload_limits": ("preload_loads", "preload_speeds"),
    "systems.sets.shaft": (
        "FloatingGroup", "Housing", "HousingStiffness", "Shaft", "ShaftLoad", "ShaftSection", "ShaftSupport", "Spacer",
    ),
    "systems.sets.set_solution": ("SetSolution",),
    "systems.sets.solve": ("solve_set",),
    "systems.sets.system_life": ("system_life",),
    "model.solution.solution": ("Solution", "stiffness"),
    "model.solution.status": ("Reason", "Status"),
    "studies.design.compare": ("compare",),
    "studies.design.find": ("find",),
    "studies.sobol": ("sobol_indices",),
    "studies.store": ("open_results",),
    "studies.study": ("Study",),
    "studies.sweep": ("sweep",),
    "systems.heat.network": ("Conductance", "OilFlow", "Thermal"),
    "model.validation": ("ErrorDetail", "SceneError"),
}
_HOME = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "SILICON_NITRIDE", "STEEL", "BallBearing", "BallDiameterDeviations", "BallExpansion", "BearingKind", "BearingSet",
    "CentrifugalForce", "Conductance", "DataSheet", "ElasticRings", "ErrorDetail", "FileErrorDetail", "FloatingGroup",
    "GPa", "GyroscopicMoment", "HertzAngle", "HertzForm", "Housing", "HousingStiffness", "InferredBearing", "MPa",
    "Material", "MomentShares", "N", "Nm", "Nmm", "OilFlow", "Operation", "OrbitRadius", "Pa", "PointContact",
    "Preload", "RacewayContacts", "RacewayControl", "RatingPractice", "Reason", "RingExpansion", "RingState", "Row",
    "Scene", "SceneError", "SceneFileError", "SetSolution", "Shaft", "ShaftLoad", "ShaftSection", "ShaftSupport",
    "Solution", "Spacer", "Status", "Study", "Thermal", "TiltLever", "catalogue_numbers", "compare", "deg", "find",
    "infer_bearing", "kN", "kg", "kg_m3", "load_scene", "load_set", "m", "message", "mm", "mrad", "open_results",
    "point_contact", "preload_loads", "preload_speeds", "rad", "readings", "rpm", "sobol_indices", "solve",
    "solve_set", "stiffness", "stiffness_table", "subsurface_shear", "sweep", "system_life", "to_ross", "um",
    "warnings", "zero_celsius",
]
# fmt: on


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name == "readings":
        return import_module("qsbearing.readings")
    if name not in _HOME:
        raise AttributeError(f"module 'qsbearing' has no attribute {name!r}")
    value = getattr(import_module(f"qsbearing.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
