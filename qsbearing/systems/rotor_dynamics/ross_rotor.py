"""A whole rotor of ROSS: elements of a shaft between all that stands on it, and what holds it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.installation import pip_install
from qsbearing.model.material import Material
from qsbearing.model.validation import ErrorDetail, SceneError
from qsbearing.systems.rotor_dynamics.ross_bearing import to_ross

LONGEST = 0.5
"""Of an element, in outer diameters, unless more is asked for: bending waves of the first modes are far longer."""


class RotorSection(NamedTuple):
    """A length of shaft; SI."""

    begin: float
    end: float
    outer_diameters: tuple[float, float]
    """Where it begins and ends."""
    inner_diameters: tuple[float, float]
    material: Material


class Holder(NamedTuple):
    """What holds the shaft at a position."""

    position: float
    stiffness: NDArray
    """(5, 5), or over the speed (speed, 5, 5), about that position and in the order of a solution; SI."""
    name: str


def rotor(
    sections: Sequence[RotorSection],
    holders: Sequence[Holder],
    speed: NDArray,
    places: Sequence[float],
    disks: Sequence[dict[str, Any]],
    longest: float = LONGEST,
) -> Any:
    """A rotor of ROSS.

    Args:
        speed: of the shaft, over which holders have their stiffness [rad/s]; rising.
        places: further positions with a node [m].
        disks: arguments of ROSS's `DiskElement` each, but `position` [m] in place of n.
        longest: element, in outer diameters.

    Raises:
        SceneError: a disk without a position on the shaft; as `to_ross`.
        ImportError: ROSS is not installed.
    """
    low, high = sections[0].begin, sections[-1].end
    errors = [
        ErrorDetail("disks.position", "is not on the shaft", disk.get("position"), cause=f"{low:g} to {high:g} m")
        for disk in disks
        if not low <= disk.get("position", np.inf) <= high
    ]
    if errors:
        raise SceneError(errors)
    try:
        import ross
    except ImportError as error:
        raise ImportError(f"a rotor of ROSS needs it: {pip_install('ross')} ({error})") from error
    named = [*places, *(holder.position for holder in holders), *(disk["position"] for disk in disks)]
    materials: dict[str, Any] = {}
    elements, nodes = [], [low]
    for section in sections:
        inside = [x for x in named if section.begin < x < section.end]
        steps = np.unique(np.round([section.begin, *inside, section.end], 9))
        for begin, end in pairwise(steps):
            count = int(np.ceil((end - begin) / (longest * min(section.outer_diameters))))
            material = _material(ross, section.material, materials)
            cuts = np.linspace(begin, end, count + 1)
            ends = [section.begin, section.end]
            inner, outer = (np.interp(cuts, ends, each) for each in (section.inner_diameters, section.outer_diameters))
            for idl, idr, odl, odr in zip(inner[:-1], inner[1:], outer[:-1], outer[1:], strict=True):
                size = {"idl": idl, "idr": idr, "odl": odl, "odr": odr, "material": material}
                elements.append(ross.ShaftElement(L=(end - begin) / count, **size))
            nodes += list(cuts[1:])

    def node(position: float) -> int:
        return int(np.abs(np.array(nodes) - position).argmin())

    wheels = [
        ross.DiskElement(n=node(disk["position"]), **{key: value for key, value in disk.items() if key != "position"})
        for disk in disks
    ]
    bearings = []
    for holder in holders:
        at = speed if np.ndim(holder.stiffness) == 3 else 0.0
        bearings.append(to_ross(holder.stiffness, at, node(holder.position), tag=holder.name))
    return ross.Rotor(elements, wheels, bearings)


def _material(ross: Any, material: Material, known: dict[str, Any]) -> Any:
    """Of ROSS, each made once."""
    if repr(material) in known:
        return known[repr(material)]
    key = f"material_{len(known)}"
    numbers = (material.density, material.elastic_modulus, material.poisson_ratio)
    rho, modulus, ratio = (float(np.asarray(number)) for number in numbers)
    known[repr(material)] = ross.Material(key, rho=rho, E=modulus, Poisson=ratio)
    return known[repr(material)]
