"""What a ball and a ring add to the approach of half-spaces under Hertz's pressure, by methods of their own.

The ball: an elastic sphere between two equal and opposite forces, in Legendre polynomials (A. I. Lur'e,
Three-Dimensional Problems of the Theory of Elasticity, 1964, section 6.4). Per force, along the radius,

    G(psi) = 1/(4 pi R 2 mu) sum_n 2 (2n+1) d_n P_n(cos psi),    n = 0, 2, 4, ...
    d_n = (4(1-nu) n + 2 - 4 nu + (2 + 2 nu) n/(n-1)) / (2n^2 + (2 + 4 nu) n + 2 + 2 nu),

where (2n+1) d_n = 4(1-nu) + 2(1-2nu)^2/n + O(1/n^2): the first term sums to the half-space's kernel over the chord, the
second to a logarithm, and the rest converges.

The ring: a Fourier series round the bearing's axis, with as many equal loads as there are balls, so with the harmonics
0, Z, 2Z, ...; each is a problem in the ring's section alone, solved with quadratic elements. Over the harmonic's number
the work falls smoothly, and is interpolated. The seat is rigid.

Pressure acts along the normal of the surface that both bodies share. Displacements count along it too.
"""

from __future__ import annotations

import itertools
from math import ceil, cos, log, pi, sin
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu
from scipy.special import eval_legendre, j1

from fem_check.independent.contact_problem import Array
from fem_check.independent.groove import BallInGroove
from fem_check.independent.references import ellipse
from fem_check.independent.ring_sections import RingProfile

TERMS = 400
"""Of the sphere's series: what is left out falls as 1/n^2."""
POINTS = (24, 48)
"""Of the pressure, along the radius of the ellipse and round it."""
ALONG, LAYER, GROWTH = 10, 0.25, 1.5
"""Of the ring's section: elements per semi-axis along the groove, depth of the first over the semi-minor axis, and how
fast they grow."""
SHORTEST = 8.0
"""Semi-minor axis times the wave number of the last harmonic: of the work 1e-5 is left."""
DEEPEST = 10.0
"""Ball radius times the wave number of the last harmonic that may reach the ring's seat or shoulders."""


def ball_excess(groove: BallInGroove, load: float) -> float:
    """What the ball, cut at its equator, adds to the compliance of its half-space [m/N]."""
    exact, radius, nu = ellipse(groove.problem(load)), groove.ball_radius, groove.ball.poisson_ratio
    rings, round_ = POINTS
    nodes, weights = np.polynomial.legendre.leggauss(rings)
    # Radius sin c and pressure cos c over the ellipse, both smooth.
    c, at = 0.25 * pi * (nodes + 1.0), (np.arange(round_) + 0.5) * 2.0 * pi / round_
    share = (weights * np.cos(c) ** 2 * np.sin(c))[:, None] * np.ones(round_)
    x = exact.semi_major_axis * np.outer(np.sin(c), np.cos(at)).ravel()
    y = exact.semi_minor_axis * np.outer(np.sin(c), np.sin(at)).ravel()
    z = np.sqrt(radius**2 - x * x - y * y)
    share = (share / share.sum()).ravel()
    apart = np.hypot(x[:, None] - x, y[:, None] - y)
    other = ~np.eye(len(x), dtype=bool)  # the difference of both kernels is finite there, a logarithm
    half = 0.5 * np.sqrt(apart**2 + (z[:, None] - z) ** 2) / radius
    force = share * radius / z  # per part of the load along the contact's axis
    stiff = pi * groove.ball.elastic_modulus / (1.0 - nu**2)
    kernel = np.outer(force, force)[other] * _sphere(half[other], nu) / (stiff * radius)
    return float(kernel.sum() - (np.outer(share, share)[other] / apart[other]).sum() / stiff)


def _sphere(half_sine: Array, nu: float) -> Array:
    """The sphere's kernel over (1 - nu^2)/(pi E R), by sin(psi/2)."""
    n = np.arange(2, TERMS + 1, 2)
    d = (4.0 * (1.0 - nu) * n + 2.0 - 4.0 * nu + (2.0 + 2.0 * nu) * n / (n - 1.0)) / (
        2.0 * n * n + (2.0 + 4.0 * nu) * n + 2.0 + 2.0 * nu
    )
    second = 2.0 * (1.0 - 2.0 * nu) ** 2
    rest = (2.0 * n + 1.0) * d - 4.0 * (1.0 - nu) - second / n
    table = np.linspace(0.0, 1.01 * half_sine.max(), 200)
    left = 2.0 * (eval_legendre(n[:, None], 1.0 - 2.0 * table**2).T @ rest)
    half_cosine = np.sqrt(1.0 - half_sine**2)

    def logarithm(s: Array) -> Array:
        return -np.log(s * (1.0 + s))

    # Even terms: half the sum over all at psi, half of that at pi - psi. n = 0 is (2 - 4 nu)/(2 + 2 nu) in itself.
    closed = 4.0 * (1.0 - nu) * (0.5 / half_sine + 0.5 / half_cosine - 2.0)
    closed = closed + second * (logarithm(half_sine) + logarithm(half_cosine))
    uniform = 2.0 * (2.0 - 4.0 * nu) / (2.0 + 2.0 * nu)
    return np.asarray((closed + uniform + np.interp(half_sine, table, left)) / (4.0 * (1.0 - nu)))


def ring_excess(groove: BallInGroove, balls: int, profile: RingProfile, load: float) -> float:
    """What a ring on a rigid seat adds to the compliance of its half-space, all balls loaded alike [m/N]."""
    problem = groove.problem(load)
    exact = ellipse(problem)
    section = _section(groove, profile, load)
    works = section.works(balls, SHORTEST * section.contact_radius / exact.semi_minor_axis)
    share = groove.race.compliance / (groove.ball.compliance + groove.race.compliance)
    mean = exact.approach - 0.1 * (
        problem.curvature_x * exact.semi_major_axis**2 + problem.curvature_y * exact.semi_minor_axis**2
    )
    return works - share * mean / load


def ring_doubt(
    groove: BallInGroove, balls: int, profile: RingProfile, others: list[list[RingProfile]], load: float
) -> float:
    """By how much the approach may differ where dimensions of the ring are assumed [m].

    Args:
        others: of each such dimension, rings with another; the root of the sum of the largest changes' squares counts.
    """
    if not others:
        return 0.0

    def works(each: RingProfile) -> float:
        # Waves too short to reach the seat are the same in all.
        section = _section(groove, each, load)
        return section.works(balls, DEEPEST * section.contact_radius / groove.ball_radius)

    usual = works(profile)
    changes = [max(abs(works(each) - usual) for each in some) for some in others]
    return load * float(np.hypot.reduce(changes))


def _section(groove: BallInGroove, profile: RingProfile, load: float) -> _Section:
    exact = ellipse(groove.problem(load))
    return _Section(groove, profile, exact.semi_major_axis, exact.semi_minor_axis)


class _Section:
    """A ring's section, its unknowns axial, radial and tangential: U cos n phi, V cos n phi, W sin n phi."""

    def __init__(self, groove: BallInGroove, profile: RingProfile, a: float, b: float) -> None:
        from skfem import Basis, ElementQuad2, ElementVector, MeshQuad, MeshQuad2

        side = -1.0 if groove.race_name == "inner" else 1.0
        self.side, self.groove, self.a, self.b = side, groove, a, b
        lean = side * np.array([sin(groove.contact_angle), cos(groove.contact_angle)])
        centre = np.array([0.0, 0.5 * groove.pitch_diameter]) + (groove.ball_radius - groove.groove_radius) * lean
        self.centre = centre
        self.contact_radius = float((centre + groove.groove_radius * lean)[1])
        lines, depths = _grid(groove, profile, centre, side, a, b)
        flat = MeshQuad2.from_mesh(MeshQuad.init_tensor(lines, depths))
        # To polar coordinates about the groove's centre, from its profile or a shoulder to the width or the seat.
        angle, part = flat.doflocs
        near, far = _reach(angle, groove, profile, centre, side)
        reach = near + part * (far - near)
        x, r = centre[0] + side * reach * np.sin(angle), centre[1] + side * reach * np.cos(angle)
        mesh = MeshQuad2(np.array([x, r]), flat.t)
        element = ElementVector(ElementQuad2(), 3)
        self.basis = Basis(mesh, element, intorder=5)
        self.parts = self._stiffness()
        held = np.abs(self.basis.doflocs[1] - profile.back_radius) < 1e-6 * profile.back_radius
        self.free = np.flatnonzero(~held)
        ends = (
            groove.contact_angle - np.arcsin(a / groove.groove_radius),
            groove.contact_angle + np.arcsin(a / groove.groove_radius),
        )
        middle = flat.p[:, flat.facets].mean(axis=1)
        loaded = np.flatnonzero((middle[1] < 1e-12) & (middle[0] > ends[0]) & (middle[0] < ends[1]))
        self._arc(flat.facets[:, loaded], loaded)

    def _arc(self, ends: Array, facets: Array) -> None:
        """Points of the pressed part of the profile; its shape functions times d xi, (shape, edge, point)."""
        groove, basis, places = self.groove, self.basis, self.basis.doflocs
        at, weights = np.polynomial.legendre.leggauss(6)
        shapes = np.array([0.5 * at * (at - 1.0), 0.5 * at * (at + 1.0), 1.0 - at * at])
        slopes = np.array([at - 0.5, at + 0.5, -2.0 * at])
        self.nodes = np.stack(
            [basis.nodal_dofs[:, ends[0]], basis.nodal_dofs[:, ends[1]], basis.facet_dofs[:, facets]], 1
        )
        points = np.einsum("csf,sq->cfq", places[:, self.nodes[0]], shapes)
        steps = np.einsum("csf,sq->cfq", places[:, self.nodes[0]], slopes)
        across = self.side * np.array([cos(groove.contact_angle), -sin(groove.contact_angle)])
        self.radii = points[1]
        self.xi = np.einsum("c,cfq->fq", across, points - self.centre[:, None, None])
        self.weights = shapes[:, None, :] * np.abs(np.einsum("c,cfq->fq", across, steps)) * weights

    def _stiffness(self) -> tuple[Any, Any, Any]:
        """Of the unknowns of harmonic n, for the powers 0, 1 and 2 of n."""
        material, basis = self.groove.race, self.basis
        mu = 0.5 * material.elastic_modulus / (1.0 + material.poisson_ratio)
        lame = 2.0 * mu * material.poisson_ratio / (1.0 - 2.0 * material.poisson_ratio)
        shapes = [each[0] for each in basis.basis]
        u, v, w = np.stack([np.asarray(each) for each in shapes], 1) / np.asarray(basis.global_coordinates())[1]
        (ux, ur), (vx, vr), (wx, wr) = np.stack([each.grad for each in shapes], 2)
        none = np.zeros_like(u)
        # Along x, r and the hoop, and the shears xr, x hoop and r hoop: strain = even + n odd.
        even = np.stack([ux, vr, v, ur + vx, wx, wr - w])
        odd = np.stack([none, none, w, none, -u, -v])
        weights = np.asarray(basis.global_coordinates())[1] * basis.dx
        elastic = np.diag([2.0 * mu] * 3 + [mu] * 3)
        elastic[:3, :3] += lame
        count = len(shapes)

        def of_elements(strain: Array) -> Array:
            return strain.transpose(2, 1, 0, 3).reshape(len(basis.dx), count, -1)

        strains = [of_elements(each) for each in (even, odd)]
        stresses = [of_elements(np.tensordot(elastic, each, 1) * weights) for each in (even, odd)]
        dofs = basis.element_dofs.T
        rows, columns = np.repeat(dofs, count, axis=1).ravel(), np.tile(dofs, count).ravel()

        def matrix(first: int, second: int) -> Any:
            entries = strains[first] @ stresses[second].transpose(0, 2, 1)
            return coo_matrix((entries.ravel(), (rows, columns)), (basis.N, basis.N)).tocsr()

        mixed = matrix(0, 1)
        return matrix(0, 0), mixed + mixed.T, matrix(1, 1)

    def works(self, balls: int, last: float) -> float:
        """The same of all harmonics up to one."""
        count = max(4, ceil(last / balls))
        some = np.unique(np.round(np.geomspace(1.0, count, 6 + 2 * ceil(log(count)))).astype(int))
        works = np.array([self.work(balls, int(number) * balls) for number in some])
        # Number times work over the logarithm of the number is smooth: straight first, then falling.
        number = np.arange(1, count + 1)
        return self.work(balls, 0) + float((CubicSpline(np.log(some), some * works)(np.log(number)) / number).sum())

    def work(self, balls: int, n: int) -> float:
        """Of one ball's load in the harmonic n, over its square [m/N]."""
        a, b, slope = self.a, self.b, self.groove.shared_slope(self.xi, 0.0 * self.xi)
        # Unit load: pressure 1.5/(pi a b) sqrt(1 - xi^2/a^2 - eta^2/b^2), and its cosine transform along eta.
        left = np.maximum(1.0 - (self.xi / a) ** 2, 0.0)
        wave, half = n / self.radii, b * np.sqrt(left)
        across = 0.5 * pi * b * left if n == 0 else pi * np.sqrt(left) * j1(wave * half) / wave
        amount = 1.5 / (pi * a * b) * across * balls / (2.0 * pi if n == 0 else pi)
        # The force per d xi d eta is p (slope, 1) in the contact's frame.
        c, s = cos(self.groove.contact_angle), sin(self.groove.contact_angle)
        force = np.zeros(self.basis.N)
        for axis, along in enumerate((self.side * (s + slope * c), self.side * (c - slope * s))):
            np.add.at(force, self.nodes[axis], np.einsum("sfq,fq->sf", self.weights, amount * along))
        force = force[self.free]
        first, second, third = self.parts
        matrix = (first + n * second + n**2 * third)[self.free][:, self.free].tocsc()
        moved = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0).solve(force)
        return float(force @ moved) * (2.0 * pi if n == 0 else pi) / balls


def _reach(angle: Array, groove: BallInGroove, profile: RingProfile, centre: Array, side: float) -> tuple[Array, Array]:
    """From the groove's centre to the surface and to the far side of the ring, along each angle."""
    radius, half = groove.groove_radius, 0.5 * profile.width
    s, c = np.sin(angle), np.cos(angle)
    lands = np.where(angle > 0.0, cos(profile.high_shoulder), cos(profile.low_shoulder)) * radius
    outside = (angle > profile.high_shoulder) | (angle < -profile.low_shoulder)
    near = np.where(outside, lands / c, radius)
    back = side * (profile.back_radius - centre[1])
    with np.errstate(divide="ignore"):
        return near, np.minimum(back / c, half / np.abs(s))


def _grid(
    groove: BallInGroove, profile: RingProfile, centre: Array, side: float, a: float, b: float
) -> tuple[Array, Array]:
    """Lines of the mesh: angles round the groove's centre, and parts of the way from its profile to the far side."""
    radius, half = groove.groove_radius, 0.5 * profile.width
    back = side * (profile.back_radius - centre[1])
    reach = float(np.arcsin(a / radius))
    at, low, high = groove.contact_angle, profile.low_shoulder, profile.high_shoulder
    corner = float(np.arctan2(half, back))
    ends = -float(np.arctan2(half, radius * cos(low))), float(np.arctan2(half, radius * cos(high)))
    stops = {ends[0], -low, -corner, at - reach, at + reach, corner, high, ends[1]}
    fine = reach / ALONG
    lines: list[Array] = [np.linspace(at - reach, at + reach, 2 * ALONG + 1)]
    for start, stop in itertools.pairwise(sorted(stops)):
        if start >= at - reach - 1e-12 and stop <= at + reach + 1e-12:
            continue
        # Finest at the end that is nearer the contact.
        length = stop - start
        away = max(start - (at + reach), (at - reach) - stop, 0.0)
        first = fine + (GROWTH - 1.0) * away
        count = max(1, ceil(log(1.0 + length * (GROWTH - 1.0) / first) / log(GROWTH)))
        parts = (GROWTH ** np.arange(count + 1) - 1.0) / (GROWTH**count - 1.0)
        lines.append(start + length * parts if start >= at else stop - length * parts)
    depth = float(_reach(np.array([at]), groove, profile, centre, side)[1][0]) - radius
    first = LAYER * b / depth
    count = ceil(log(1.0 + (GROWTH - 1.0) / first) / log(GROWTH))
    return np.unique(np.round(np.concatenate(lines), 12)), (GROWTH ** np.arange(count + 1) - 1.0) / (
        GROWTH**count - 1.0
    )
