"""qsbearing: the quasi-static (Jones-Harris) model of angular-contact ball bearings.

    import qsbearing as qs
    solution = qs.solve(qs.load_scene("b218"))
    solution.inner.angle / qs.deg

SI units and radians everywhere: `22.225 * qs.mm`, `10_000 * qs.rpm`, `40 * qs.deg`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from qsbearing.units import GPa, MPa, N, Nm, Nmm, Pa, deg, kg, kg_m3, kN, m, mm, mrad, rad, rpm, um

__version__ = "0.1.0"

if TYPE_CHECKING:
    from qsbearing.bearing import BallBearing, BearingKind
    from qsbearing.effects import CentrifugalForce, GyroscopicMoment, MomentShares
    from qsbearing.faults import Fault, SceneError
    from qsbearing.file_fault import FileFault, SceneFileError
    from qsbearing.hertz import HertzForm, PointContact, point_contact, subsurface_shear
    from qsbearing.material import SILICON_NITRIDE, STEEL, Material
    from qsbearing.operation import Operation
    from qsbearing.outcome import message, warnings
    from qsbearing.raceway_control import RacewayControl
    from qsbearing.scene import HertzAngle, Scene, TiltLever
    from qsbearing.scene_file import load_scene
    from qsbearing.solution import RacewayContacts, Reason, Solution, Status, stiffness
    from qsbearing.solving import solve

# Where each public name lives; imported when first used, so that `qsbearing --help` loads no numerical library.
_HOME = {
    "BallBearing": "bearing",
    "BearingKind": "bearing",
    "CentrifugalForce": "effects",
    "Fault": "faults",
    "FileFault": "file_fault",
    "GyroscopicMoment": "effects",
    "HertzAngle": "scene",
    "HertzForm": "hertz",
    "Material": "material",
    "MomentShares": "effects",
    "Operation": "operation",
    "PointContact": "hertz",
    "RacewayContacts": "solution",
    "RacewayControl": "raceway_control",
    "SILICON_NITRIDE": "material",
    "STEEL": "material",
    "Scene": "scene",
    "SceneError": "faults",
    "SceneFileError": "file_fault",
    "Solution": "solution",
    "Reason": "solution",
    "Status": "solution",
    "TiltLever": "scene",
    "load_scene": "scene_file",
    "point_contact": "hertz",
    "solve": "solving",
    "message": "outcome",
    "stiffness": "solution",
    "warnings": "outcome",
    "subsurface_shear": "hertz",
}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'qsbearing' has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(f"qsbearing.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOME})


__all__ = [
    "SILICON_NITRIDE",
    "STEEL",
    "BallBearing",
    "BearingKind",
    "CentrifugalForce",
    "Fault",
    "FileFault",
    "GPa",
    "GyroscopicMoment",
    "HertzAngle",
    "HertzForm",
    "MPa",
    "Material",
    "MomentShares",
    "N",
    "Nm",
    "Nmm",
    "Operation",
    "Pa",
    "PointContact",
    "RacewayContacts",
    "RacewayControl",
    "Reason",
    "Scene",
    "SceneError",
    "SceneFileError",
    "Solution",
    "Status",
    "TiltLever",
    "deg",
    "kN",
    "kg",
    "kg_m3",
    "load_scene",
    "m",
    "message",
    "mm",
    "mrad",
    "point_contact",
    "rad",
    "rpm",
    "solve",
    "stiffness",
    "subsurface_shear",
    "um",
    "warnings",
]
