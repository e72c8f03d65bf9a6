"""A starting point in double precision for the fifty-digit Newton iteration.

With each ball's centrifugal force held fast and no gyroscopic moment, equilibrium is the least of a convex potential

    P(d, X) = sum over balls of  2/5 Ki <|A(d) - X| - Li>^(5/2) + 2/5 Ko <|X| - Lo>^(5/2) - Fc X2  -  F . d,

which a damped Newton method finds from anywhere.  From there the centrifugal force is let go to follow the ball, and
the gyroscopic moment is raised from nothing to its full size in steps, with Newton's method on the true equations.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .jones_harris import Scene, ball_equations, groove_centre, ring_contribution

Start = tuple[dict[int, tuple[float, float]], list[float]]


def find_start(scene: Scene) -> Start:
    """Positions X (m) of the balls that have one, and the ring's displacement d (m, rad)."""
    X, d = least_potential(scene)
    if not scene.turns:
        return {j: tuple(X[j]) for j in range(scene.ball_count) if is_squeezed(scene, j, d)}, list(d)
    if not scene.centrifugal:
        raise NotImplementedError("a gyroscopic moment without the centrifugal force")
    unknowns = newton(replace(scene, gyroscopic=0.0), pack(scene, X, d))
    if unknowns is None:
        raise ArithmeticError("no start found without the gyroscopic moment")
    reached, step = 0.0, 1.0
    while reached < scene.gyroscopic:
        target = min(scene.gyroscopic, reached + step)
        found = newton(replace(scene, gyroscopic=target), unknowns)
        if found is not None:
            unknowns, reached, step = found, target, 2 * step
        elif step > 1e-3:
            step /= 4
        else:
            raise ArithmeticError(f"no start found beyond {reached:.3f} of the gyroscopic moment")
    X, d = unpack(scene, unknowns)
    return {j: tuple(X[j]) for j in range(scene.ball_count)}, list(d)


def is_squeezed(scene: Scene, ball: int, d: np.ndarray) -> bool:
    """Whether a ball at rest touches the rings."""
    own = scene.of_ball(ball)
    return bool(np.hypot(*groove_centre(scene, ball, d)) > own.Li + own.Lo)


# ------------------------------------------------------------------------------------------------ the convex problem


def contact_terms(K: float, length: float, at: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """Energy (J), force (N) and stiffness (N/m) of one contact whose centres are `at` apart and touch at `length`."""
    distance = float(np.hypot(*at))
    approach = distance - length
    if approach <= 0:
        return 0.0, np.zeros(2), np.zeros((2, 2))
    n = at / distance
    load = K * approach**1.5
    along = np.outer(n, n)
    return 0.4 * K * approach**2.5, load * n, 1.5 * K * approach**0.5 * along + load / distance * (np.eye(2) - along)


def lever(scene: Scene, ball: int) -> np.ndarray:
    """dA/dd, 2 x 5, with the tilts measured by Ri times the angle (m)."""
    c, s = scene.psi[ball]
    return np.array([[1, 0, 0, s, -c], [0, c, s, 0, 0]], dtype=float)


def potential(scene: Scene, Fc: float, X: np.ndarray, d: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """P with its gradient and Hessian over all X and the five ring channels (tilts as lengths)."""
    Z = scene.ball_count
    size = 2 * Z + 5
    energy, gradient, hessian = 0.0, np.zeros(size), np.zeros((size, size))
    ring = slice(2 * Z, size)
    for j in range(Z):
        own, B = slice(2 * j, 2 * j + 2), lever(scene, j)
        A, its = np.array(groove_centre(scene, j, d)), scene.of_ball(j)
        Eo, Fo, Ho = contact_terms(its.Ko, its.Lo, X[j])
        Ei, Fi, Hi = contact_terms(its.Ki, its.Li, A - X[j])
        energy += Eo + Ei - Fc * X[j, 1]
        gradient[own] += Fo - Fi - [0, Fc]
        gradient[ring] += B.T @ Fi
        hessian[own, own] += Ho + Hi
        hessian[own, ring] -= Hi @ B
        hessian[ring, own] -= B.T @ Hi
        hessian[ring, ring] += B.T @ Hi @ B
    for c in scene.free:
        force = scene.loads[c] / (scene.Ri if c > 2 else 1)
        energy -= force * d[c] * (scene.Ri if c > 2 else 1)
        gradient[2 * Z + c] -= force
    return energy, gradient, hessian


def least_potential(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """(X, d) at rest, or with the centrifugal force of a nominal orbital speed on every ball."""
    Z = scene.ball_count
    orbit = (scene.wi * (1 - scene.g * scene.cos0) + scene.wo * (1 + scene.g * scene.cos0)) / 2
    Fc = scene.mass * scene.dm / 2 * orbit**2 if scene.centrifugal else 0.0
    d = np.array([0.0 if value is None else value for value in scene.held])
    if scene.held[0] is None:
        d[0] = 2e-3 * scene.BD
    A = np.array([groove_centre(scene, j, d) for j in range(Z)])
    X = A * scene.Lo / (scene.Lo + scene.Li)
    kept = list(range(2 * Z)) + [2 * Z + c for c in scene.free]
    scale = max([Fc] + [abs(v) / (scene.Ri if c > 2 else 1) for c, v in enumerate(scene.loads) if v is not None])
    spring = 1.5 * scene.Ki * (1e-4 * scene.BD) ** 0.5  # N/m, a lightly loaded contact: the measure of the damping
    damping = 1.0
    for _ in range(2000):
        energy, gradient, hessian = potential(scene, Fc, X, d)
        if np.abs(gradient[kept]).max() < 1e-10 * max(scale, 1e-3):
            break
        matrix = hessian[np.ix_(kept, kept)]
        step = np.zeros(2 * Z + 5)
        step[kept] = -np.linalg.solve(matrix + damping * spring * np.eye(len(kept)), gradient[kept])
        shift = step[2 * Z :] / np.array([1, 1, 1, scene.Ri, scene.Ri])
        new_X, new_d = X + step[: 2 * Z].reshape(Z, 2), d + shift
        new_energy, new_gradient, _ = potential(scene, Fc, new_X, new_d)
        better = new_energy < energy or np.abs(new_gradient[kept]).max() < np.abs(gradient[kept]).max()
        if better:
            X, d, damping = new_X, new_d, max(damping / 5, 1e-12)
        elif damping < 1e12:
            damping *= 6
        else:
            break
    return X, d


# ------------------------------------------------------------------------------------------------ the true equations


def pack(scene: Scene, X: np.ndarray, d: np.ndarray) -> np.ndarray:
    """All X and the free channels in one vector, tilts times Ri (m)."""
    return np.concatenate([X.ravel(), (d * [1, 1, 1, scene.Ri, scene.Ri])[scene.free]])


def unpack(scene: Scene, unknowns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The inverse of `pack`, with the held channels put in."""
    Z = scene.ball_count
    d = np.array([0.0 if value is None else value for value in scene.held])
    d[scene.free] = unknowns[2 * Z :] / np.array([1, 1, 1, scene.Ri, scene.Ri])[scene.free]
    return unknowns[: 2 * Z].reshape(Z, 2), d


def ball_forces(scene: Scene, ball: int, X: np.ndarray, d: np.ndarray) -> np.ndarray:
    """A ball's two force errors and its five shares of the ring's load (moments over Ri), N."""
    A, own = groove_centre(scene, ball, d), scene.of_ball(ball)
    x = [
        float(X[0]), float(X[1]), float(np.hypot(A[0] - X[0], A[1] - X[1]) - own.Li),
        float(np.hypot(X[0], X[1]) - own.Lo),
    ]  # fmt: skip
    d = [float(value) for value in d]
    ring = np.array(ring_contribution(scene, ball, x, d)) / [1, 1, 1, scene.Ri, scene.Ri]
    return np.concatenate([ball_equations(scene, ball, x, d)[2:], ring])


def all_forces(scene: Scene, unknowns: np.ndarray, derivatives: bool) -> tuple[np.ndarray, np.ndarray | None]:
    """Force errors of all balls and free channels (N) and, if wanted, their differenced derivatives (N/m)."""
    Z, free = scene.ball_count, scene.free
    X, d = unpack(scene, unknowns)
    errors = np.zeros(2 * Z + len(free))
    jacobian = np.zeros((len(errors), len(errors))) if derivatives else None
    errors[2 * Z :] = [-scene.loads[c] / (scene.Ri if c > 2 else 1) for c in free]
    columns = [2 + c for c in free]
    h = 1e-10
    for j in range(Z):
        rows = ball_forces(scene, j, X[j], d)
        errors[2 * j : 2 * j + 2] = rows[:2]
        errors[2 * Z :] += rows[columns]
        if jacobian is None:
            continue
        for i in range(2):
            up, down = X[j].copy(), X[j].copy()
            up[i] += h
            down[i] -= h
            slope = (ball_forces(scene, j, up, d) - ball_forces(scene, j, down, d)) / (2 * h)
            jacobian[2 * j : 2 * j + 2, 2 * j + i] = slope[:2]
            jacobian[2 * Z :, 2 * j + i] = slope[columns]
        for i, c in enumerate(free):
            shift = np.zeros(5)
            shift[c] = h / (scene.Ri if c > 2 else 1)
            slope = (ball_forces(scene, j, X[j], d + shift) - ball_forces(scene, j, X[j], d - shift)) / (2 * h)
            jacobian[2 * j : 2 * j + 2, 2 * Z + i] = slope[:2]
            jacobian[2 * Z :, 2 * Z + i] += slope[columns]
    return errors, jacobian


def newton(scene: Scene, unknowns: np.ndarray, iterations: int = 60) -> np.ndarray | None:
    """Newton's method with a line search on the force errors; None if it stalls."""
    scale = max([1e-3] + [abs(v) / (scene.Ri if c > 2 else 1) for c, v in enumerate(scene.loads) if v is not None])
    errors, jacobian = all_forces(scene, unknowns, True)
    for _ in range(iterations):
        size = np.linalg.norm(errors)
        if np.abs(errors).max() < 1e-9 * scale:
            return unknowns
        try:
            step = -np.linalg.solve(jacobian, errors)
        except np.linalg.LinAlgError:
            return None
        fraction = min(1.0, 0.2 * scene.BD / max(np.abs(step).max(), 1e-30))
        while fraction > 1e-6:
            trial = unknowns + fraction * step
            if np.linalg.norm(all_forces(scene, trial, False)[0]) < (1 - 1e-4 * fraction) * size:
                break
            fraction /= 2
        else:
            return unknowns if np.abs(errors).max() < 1e-6 * scale else None
        unknowns = trial
        errors, jacobian = all_forces(scene, unknowns, True)
    return None
