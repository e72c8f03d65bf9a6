"""qsbearing: the quasi-static (Jones-Harris) model of angular-contact ball bearings.

    import qsbearing as qs
    solution = qs.solve(qs.load_scene("b218"))
    solution.inner.angle / qs.deg

SI units and radians everywhere: `22.225 * qs.mm`, `10_000 * qs.rpm`, `40 * qs.deg`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from qsbearing.units import GPa, MPa, N, Nm, Nmm, Pa, deg, kg, kg_m3, kN, m, mm, mrad, rad, rpm, um, zero_celsius

__version__ = "0.1.0"

if TYPE_CHECKING:
    from qsbearing import readings
    from qsbearing.chooser.choose import solve
    from qsbearing.contact.hertz import HertzForm, PointContact, point_contact, subsurface_shear
    from qsbearing.design.compare import compare
    from qsbearing.design.find import find
    from qsbearing.effects import (
        BallDiameterDeviations,
        BallExpansion,
        CentrifugalForce,
        ElasticRings,
        GyroscopicMoment,
        MomentShares,
        RingExpansion,
        RingState,
    )
    from qsbearing.effects.hertz_angle import HertzAngle
    from qsbearing.effects.orbit_radius import OrbitRadius
    from qsbearing.effects.raceway_control import RacewayControl
    from qsbearing.effects.tilt_lever import TiltLever
    from qsbearing.io.file_errors import FileErrorDetail, SceneFileError
    from qsbearing.io.printed_numbers import catalogue_numbers
    from qsbearing.io.scene_file import load_scene
    from qsbearing.io.set_file import load_set
    from qsbearing.material import SILICON_NITRIDE, STEEL, Material
    from qsbearing.messages import message, warnings
    from qsbearing.rotordynamics import stiffness_table, to_ross
    from qsbearing.scene.bearing import BallBearing, BearingKind
    from qsbearing.scene.operation import Operation
    from qsbearing.scene.preload import Preload
    from qsbearing.scene.scene import Scene
    from qsbearing.sets.bearing_set import BearingSet, Row
    from qsbearing.sets.preload_limits import preload_loads, preload_speeds
    from qsbearing.sets.set_solution import SetSolution
    from qsbearing.sets.shaft import (
        FloatingGroup,
        Housing,
        HousingStiffness,
        Shaft,
        ShaftLoad,
        ShaftSection,
        ShaftSupport,
        Spacer,
    )
    from qsbearing.sets.solve import solve_set
    from qsbearing.sets.system_life import system_life
    from qsbearing.solution.raceway_contacts import RacewayContacts
    from qsbearing.solution.solution import Solution, stiffness
    from qsbearing.solution.status import Reason, Status
    from qsbearing.studies.sobol import sobol_indices
    from qsbearing.studies.store import open_results
    from qsbearing.studies.study import Study
    from qsbearing.studies.sweep import sweep
    from qsbearing.thermal.network import Conductance, OilFlow, Thermal
    from qsbearing.validation import ErrorDetail, SceneError

# fmt: off
# Where each public name lives; imported when first used, so that `qsbearing --help` loads no numerical library.
_HOMES = {
    "chooser.choose": ("solve",),
    "contact.hertz": ("HertzForm", "PointContact", "point_contact", "subsurface_shear"),
    "effects": (
        "BallDiameterDeviations", "BallExpansion", "CentrifugalForce", "ElasticRings", "GyroscopicMoment",
        "MomentShares", "RingExpansion", "RingState",
    ),
    "effects.hertz_angle": ("HertzAngle",),
    "effects.orbit_radius": ("OrbitRadius",),
    "effects.raceway_control": ("RacewayControl",),
    "effects.tilt_lever": ("TiltLever",),
    "io.file_errors": ("FileErrorDetail", "SceneFileError"),
    "io.printed_numbers": ("catalogue_numbers",),
    "io.scene_file": ("load_scene",),
    "io.set_file": ("load_set",),
    "messages": ("message", "warnings"),
    "scene.bearing": ("BallBearing", "BearingKind"),
    "material": ("SILICON_NITRIDE", "STEEL", "Material"),
    "scene.operation": ("Operation",),
    "scene.preload": ("Preload",),
    "scene.scene": ("Scene",),
    "solution.raceway_contacts": ("RacewayContacts",),
    "rotordynamics": ("stiffness_table", "to_ross"),
    "sets.bearing_set": ("BearingSet", "Row"),
    "sets.preload_limits": ("preload_loads", "preload_speeds"),
    "sets.shaft": (
        "FloatingGroup", "Housing", "HousingStiffness", "Shaft", "ShaftLoad", "ShaftSection", "ShaftSupport", "Spacer",
    ),
    "sets.set_solution": ("SetSolution",),
    "sets.solve": ("solve_set",),
    "sets.system_life": ("system_life",),
    "solution.solution": ("Solution", "stiffness"),
    "solution.status": ("Reason", "Status"),
    "design.compare": ("compare",),
    "design.find": ("find",),
    "studies.sobol": ("sobol_indices",),
    "studies.store": ("open_results",),
    "studies.study": ("Study",),
    "studies.sweep": ("sweep",),
    "thermal.network": ("Conductance", "OilFlow", "Thermal"),
    "validation": ("ErrorDetail", "SceneError"),
}
_HOME = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "SILICON_NITRIDE", "STEEL", "BallBearing", "BallDiameterDeviations", "BallExpansion", "BearingKind", "BearingSet",
    "CentrifugalForce", "Conductance", "ElasticRings", "ErrorDetail", "FileErrorDetail", "FloatingGroup", "GPa",
    "GyroscopicMoment", "HertzAngle", "HertzForm", "Housing", "HousingStiffness", "MPa", "Material", "MomentShares",
    "N", "Nm", "Nmm", "OilFlow", "Operation", "OrbitRadius", "Pa", "PointContact", "Preload", "RacewayContacts",
    "RacewayControl", "Reason", "RingExpansion", "RingState", "Row", "Scene", "SceneError", "SceneFileError",
    "SetSolution", "Shaft", "ShaftLoad", "ShaftSection", "ShaftSupport", "Solution", "Spacer", "Status", "Study",
    "Thermal", "TiltLever", "catalogue_numbers", "compare", "deg", "find", "kN", "kg", "kg_m3", "load_scene",
    "load_set", "m", "message", "mm", "mrad", "open_results", "point_contact", "preload_loads", "preload_speeds",
    "rad", "readings", "rpm", "sobol_indices", "solve", "solve_set", "stiffness", "stiffness_table",
    "subsurface_shear", "sweep", "system_life", "to_ross", "um", "warnings", "zero_celsius",
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
