"""An element of ROSS, the open program of rotor dynamics, from a stiffness over speed.

ROSS's own bearing holds kxx, kxy, kyx, kyy, kzz over the speed of its shaft [N/m, rad/s] and nothing of tilts. With
tilts included, its assembly is given an element that holds all five coordinates (`tilting_bearing.py`).
"""

from __future__ import annotations

from math import prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.documents.installation import pip_install
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.of_cases import SolutionOfCases
from qsbearing.model.solution.status import Status
from qsbearing.model.validation import SPEED, ErrorDetail, SceneError, check_kind, choose, numeric, raise_if_any
from qsbearing.systems.rotor_dynamics.axes import MOVED, Tilt, in_rotor_axes, is_tilt_supported, translations

_SPEED_IN_ROSS = {"2": "frequency", "3": "speed"}
"""What a version calls the speed of the shaft, the axis of a table of coefficients. In 3 a frequency is the whirl's."""


def to_ross(
    stiffness: ArrayLike,
    speed: ArrayLike,
    n: int,
    *,
    tilt: Tilt | str = Tilt.INCLUDED,
    mirrored: bool = False,
    cxx: ArrayLike = 0.0,
    **element: Any,
) -> Any:
    """A bearing element of ROSS (the extra `ross`) at node n of its shaft.

    Args:
        stiffness: of one case (5, 5), or over the speed (speed, 5, 5); SI, in the order x, y, z, tilt y, tilt z of a
            solution, x being the shaft's axis.
        speed: of the shaft [rad/s]; rising where there are several. ROSS interpolates by cubics and extrapolates beyond
            both ends, ROSS 3 by straight lines: give speeds that span those of the rotor's analysis.
        n: node of the shaft.
        tilt: "included": the whole matrix. "held": ROSS's own element, with the stiffness at a slope of zero.
            "free": that element, with the stiffness while no moment is carried, as in a seat that swivels. The last two
            leave out what couples axial with radial motion: that element has no place for it.
        mirrored: the bearing is mounted the other way round: it carries a thrust on the shaft in -z, not in +z.
        cxx: damping in x, and in y unless cyy is given [N s/m]. ROSS asks for one. It is 0 unless given because none is
            computed: critical speeds hardly need it, amplitudes and stability do.
        element: further arguments of ROSS's `BearingElement`: cyy, czz, tag, n_link, ...

    Returns:
        `ross.BearingElement`; with tilts included one of its kind, which only the assembly of a rotor knows: it stands
            on ground (no n_link), and ROSS's files do not hold it.

    Raises:
        SceneError: every error of these arguments, at once; a stiffness that is NaN among them.
        ImportError: ROSS is not installed, or is neither 2 nor 3.
    """
    given = np.asarray(stiffness, float)
    speeds, errors = numeric("speed", speed, SPEED)
    kind, wrong = choose("tilt", tilt, Tilt)
    errors += wrong
    if speeds is not None:
        errors += _shape_errors(given, speeds) or _speed_errors(speeds)
    matrix = in_rotor_axes(given, mirrored=mirrored) if given.shape[-2:] == (5, 5) else None
    if matrix is not None:
        errors += _stiffness_errors(matrix, kind)
    if kind is Tilt.INCLUDED and element.get("n_link") is not None:
        cause = 'A node that it links to may have no rotations. tilt = "held" or "free" links as any bearing of ROSS'
        errors.append(
            ErrorDetail("n_link", "is given, but tilts are included: such a bearing stands on ground", cause=cause)
        )
    raise_if_any(errors)
    assert matrix is not None and speeds is not None
    if speeds.size == 1:
        return _element(matrix.reshape(5, 5), None, kind, {"n": n, "cxx": cxx} | element)
    return _element(matrix, speeds, kind, {"n": n, "cxx": cxx} | element)


def _element(matrix: NDArray, speed: NDArray | None, tilt: Tilt, element: dict[str, Any]) -> Any:
    try:
        import ross
    except ImportError as error:
        raise ImportError(f"to_ross needs ROSS: {pip_install('ross')} ({error})") from error
    axis = _SPEED_IN_ROSS.get(ross.__version__.split(".")[0])
    if axis is None:
        known = " and ".join(_SPEED_IN_ROSS)
        raise ImportError(
            f"to_ross knows ROSS {known}, not {ross.__version__}, where its arguments may mean something else: "
            f"{pip_install('ross')}"
        )
    moved = translations(matrix, Tilt.HELD if tilt is Tilt.INCLUDED else tilt)
    entries: dict[str, Any] = {f"k{a}{b}": moved[..., i, j] for i, a in enumerate("xy") for j, b in enumerate("xy")}
    entries["kzz"] = moved[..., 2, 2]
    if speed is None:
        entries = {name: float(value) for name, value in entries.items()}
    arguments = entries | {axis: speed} | element
    if tilt is not Tilt.INCLUDED:
        return ross.BearingElement(**arguments)
    from qsbearing.systems.rotor_dynamics.tilting_bearing import TiltingBearingElement

    return TiltingBearingElement(matrix=matrix, **arguments)


def _shape_errors(stiffness: NDArray, speed: NDArray) -> list[ErrorDetail]:
    if speed.ndim <= 1 and stiffness.shape == (*speed.shape, 5, 5):
        return []
    problem = f"is of shape {stiffness.shape}, the speed of shape {speed.shape}"
    return [ErrorDetail("stiffness", problem, cause="One matrix (5, 5), or one per speed: (speed, 5, 5) and (speed,)")]


def _speed_errors(speed: NDArray) -> list[ErrorDetail]:
    flat = np.atleast_1d(speed)
    if (flat < 0.0).any():
        cause = (
            "ROSS turns its shaft about +z. Solve at +speed, which is the same bearing seen in a mirror along its axis"
        )
        return [ErrorDetail("speed", "is negative", float(flat.min()), SPEED, cause=cause)]
    falls = np.flatnonzero(np.diff(flat) <= 0.0)
    if falls.size:
        cause = "ROSS interpolates over the speed: give it one axis, that of speed, from small to large"
        return [ErrorDetail("speed", "does not rise from case to case", float(flat[falls[0] + 1]), SPEED, cause=cause)]
    return []


def _stiffness_errors(matrix: NDArray, tilt: Tilt) -> list[ErrorDetail]:
    has_moved = np.isfinite(matrix[..., MOVED, MOVED]).all(axis=(-2, -1))
    unsolved = ~has_moved if tilt is Tilt.HELD else ~np.isfinite(matrix).all(axis=(-2, -1))
    if unsolved.any() and has_moved.all():
        cause = 'Where friction moves the balls, stiffness against tilts has no number. tilt = "held" needs none'
        return [ErrorDetail("tilt", "needs the stiffness against tilts, which is NaN", str(tilt), cause=cause)]
    if unsolved.any():
        problem = (
            f"{int(unsolved.sum())} of {unsolved.size} matrices hold NaN, the first at index {int(unsolved.argmax())}"
        )
        return [ErrorDetail("stiffness", problem, cause="A case that is not solved has none; leave it out")]
    loose = ~np.atleast_1d(is_tilt_supported(matrix)) if tilt is Tilt.FREE else np.zeros(1, bool)
    if loose.any():
        cause = 'Nothing resists them there, so that the matrix of the tilts has no inverse. tilt = "held" needs none'
        return [
            ErrorDetail("tilt", f"the tilts cannot be left free at index {int(loose.argmax())}", "free", cause=cause)
        ]
    return []


def ross_element(solution: SolutionOfCases, n: int, index: Any = None, **arguments: Any) -> Any:
    """`to_ross` with the stiffness and speeds of a solution's cases; `solution.to_ross`.

    Args:
        index: which cases, as numpy's arrays take it, such as (0, slice(None)); None: all.

    Returns:
        As `to_ross`.

    Raises:
        SceneError: as `to_ross`; and cases that are not solved, with status and reason.
    """
    check_kind("ross_element", solution, "Solution", "SetSolution")
    number = np.arange(prod(solution.shape)).reshape(solution.shape)
    errors = []
    try:
        chosen = number if index is None else number[index]
    except IndexError as error:
        cause = f"This solution has the cases {solution.shape}" if solution.shape else "A single case; leave index out"
        raise SceneError([ErrorDetail("index", str(error), index, cause=cause)]) from None
    if np.ndim(chosen) > 1:
        problem = f"leaves {np.ndim(chosen)} axes of cases, {np.shape(chosen)}"
        cause = "One axis is wanted, that of speed; such as index = (0, slice(None)) for the first of the other axis"
        errors.append(ErrorDetail("index", problem, index, cause=cause))
    errors += _unsolved(solution, np.ravel(chosen))
    raise_if_any(errors)
    speeds = np.broadcast_to(np.asarray(requested(solution).operation.speed, float), solution.shape).ravel()
    return to_ross(solution.stiffness.reshape(-1, 5, 5)[chosen], speeds[chosen], n, **arguments)


def _unsolved(solution: Any, chosen: NDArray) -> list[ErrorDetail]:
    """How cases ended that are not solved: one error for each way."""
    status = np.ravel(np.asarray(solution.status, str))
    reason = np.ravel(np.asarray(getattr(solution, "reason", np.full(solution.shape, "")), str))
    how = np.array([f"{one} ({why})" if why else one for one, why in zip(status[chosen], reason[chosen], strict=True)])
    errors = []
    for kind in dict.fromkeys(how[status[chosen] != Status.CONVERGED]):
        cases = chosen[how == kind]
        place = tuple(map(int, np.unravel_index(cases[0], solution.shape)))
        where = str(place if len(place) > 1 else place[0]) if place else ""
        of_set = hasattr(solution, "message")
        call = f"solution.message({where})" if of_set else f"qs.message({', '.join(filter(None, ('solution', where)))})"
        cause = f"{call} says why. Only solved cases have a stiffness; leave the others out"
        errors.append(ErrorDetail("status", f"{cases.size} of {chosen.size} cases: {kind}", cause=cause))
    return errors
