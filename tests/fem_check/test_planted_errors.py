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

from fem_check.book.cases import ALL as CASES
from fem_check.checks import ALL

ROOT = Path(__file__).parents[2]

# What is planted: file, line as it stands, line as it is made, the check that sees it.
SOLUTION = "solution_contacts"
GROOVE = "half_space_contacts"
EDGE = "contact_at_the_edge"
PLANTED = {
    "raceway curvature sign swapped": (
        "qsbearing/model/contact/hertz.py",
        "(1.0 + side * ball_diameter / pitch_diameter * cos_angle))",
        "(1.0 - side * ball_diameter / pitch_diameter * cos_angle))",
        SOLUTION,
    ),
    "groove curvature +10 %": (
        "qsbearing/model/contact/hertz.py",
        "return (2.0 * groove_radius_coefficient - 1.0) /",
        "return 1.1 * (2.0 * groove_radius_coefficient - 1.0) /",
        SOLUTION,
    ),
    "E' from the ball's modulus alone": (
        "qsbearing/model/contact/hertz.py",
        "(1.0 - poisson_ratio_2**2) / elastic_modulus_2)",
        "(1.0 - poisson_ratio_1**2) / elastic_modulus_1)",
        SOLUTION,
    ),
    "load exponent 1.49": (
        "qsbearing/model/kernel/contact_line.py",
        "return stiffness * approach * root, 1.5 * stiffness * root",
        "return stiffness * approach**1.49, 1.49 * stiffness * approach**0.49",
        SOLUTION,
    ),
    "pressures of solve() x 2/3": (
        "qsbearing/model/kernel/results.py",
        "pressure = 1.5 * stiffness / (pi * a * b)",
        "pressure = stiffness / (pi * a * b)",
        SOLUTION,
    ),
    "semi-axes of solve() at a wrong groove": (
        "qsbearing/model/kernel/raceway_stiffness.py",
        "transverse_curvature(diameter, coefficient), 1.0)",
        "transverse_curvature(diameter, 1.01 * coefficient), 1.0)",
        SOLUTION,
    ),
    "centrifugal force doubled": (
        "qsbearing/model/effects/centrifugal_force.py",
        "half = 0.5 * mass * pitch_diameter",
        "half = mass * pitch_diameter",
        SOLUTION,
    ),
    "cos alpha dropped from the groove's radius": (
        "fem_check/independent/groove.py",
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
    "the ring twice as many degrees wide": (
        "fem_check/solids/true_contact.py",
        "return pi / self.ball_count",
        "return 2.0 * pi / self.ball_count",
        "true_geometry",
    ),
    "what the bodies add to the approach x 2": (
        "fem_check/solids/true_contact.py",
        "return (ball - share * rest) / load, (ring - (1.0 - share) * rest) / load",
        "return 2.0 * (ball - share * rest) / load, 2.0 * (ring - (1.0 - share) * rest) / load",
        "true_geometry",
    ),
    "what the ring adds to the approach x 2": (
        "fem_check/solids/true_contact.py",
        "return (ball - share * rest) / load, (ring - (1.0 - share) * rest) / load",
        "return (ball - share * rest) / load, 2.0 * (ring - (1.0 - share) * rest) / load",
        "true_geometry",
    ),
    "load lost at the edge x 1.05": (
        "qsbearing/readings/cut_contact.py",
        '"load_loss": (0.16078,',
        '"load_loss": (0.20957,',
        EDGE,
    ),
    "the edge's part of the major axis halved": (
        "qsbearing/readings/cut_contact.py",
        "log_t, log_k = np.log(np.maximum(t, LEAST))",
        "log_t, log_k = np.log(np.maximum(0.5 * t, LEAST))",
        EDGE,
    ),
    "pressure at the edge by the root of the radius": (
        "qsbearing/readings/cut_contact.py",
        "1.07 * np.cbrt(",
        "1.07 * np.sqrt(",
        EDGE,
    ),
    "the odd half of a pressure even": (
        "fem_check/elements/boussinesq.py",
        "total[axis] += sign_x * part if is_odd else part",
        "total[axis] += part",
        EDGE,
    ),
    "the edge's radius doubled": (
        "fem_check/mechanics/edge_contact.py",
        "(x - edge) ** 2 / (2.0 * radius)",
        "(x - edge) ** 2 / (4.0 * radius)",
        EDGE,
    ),
    "gap +1 %": (
        "fem_check/mechanics/contact.py",
        "gaps = basis.weighted(",
        "gaps = 1.01 * basis.weighted(",
        GROOVE,
    ),
    "frozen contact set": (
        "fem_check/mechanics/contact.py",
        "if not drop.any() and not add.any():",
        "if True:",
        GROOVE,
    ),
    "tension kept": (
        "fem_check/mechanics/contact.py",
        "drop = active & (pressure < 0.0)",
        "drop = active & (pressure < -np.inf)",
        GROOVE,
    ),
    "quadrature weights +0.2 %": (
        "fem_check/elements/elastic_body.py",
        "np.matmul(stacked * volumes[:, None, :]",
        "np.matmul(stacked * (1.002 * volumes[:, None, :])",
        "patch_test",
    ),
    "solver noise 1e-5": (
        "fem_check/elements/elastic_body.py",
        "        return moved\n\n    def reaction",
        "        moved[self.free] *= 1.0 + 1e-5 * np.random.default_rng(1).standard_normal(moved[self.free].shape)\n"
        "        return moved\n\n    def reaction",
        GROOVE,
    ),
    "free symmetry plane": (
        "fem_check/elements/elastic_body.py",
        "fixed[space.nodes[0] < small[0]] = [is_odd != (axis == 0) for axis in range(3)]",
        "pass",
        GROOVE,
    ),
    "load along z 10 % too large": (
        "qsbearing/model/solution/flatten.py",
        "load / (force * diameter) if channel.is_rotation else load / force",
        "load / (force * diameter) if channel.is_rotation else (1.1 if channel is CHANNELS[2] else 1.0) * load / force",
        SOLUTION,
    ),
    "load along z with the wrong sign": (
        "qsbearing/model/solution/flatten.py",
        "load / (force * diameter) if channel.is_rotation else load / force",
        "load / (force * diameter) if channel.is_rotation else (-1) ** (channel is CHANNELS[2]) * load / force",
        SOLUTION,
    ),
    "stiffness +0.1 %": (
        "qsbearing/model/kernel/results.py",
        "out[k, p, q] = work.matrix[p, q] * size",
        "out[k, p, q] = 1.001 * work.matrix[p, q] * size",
        SOLUTION,
    ),
    "stiffness transposed": (
        "qsbearing/model/kernel/results.py",
        "out[k, p, q] = work.matrix[p, q] * size",
        "out[k, q, p] = work.matrix[p, q] * size",
        SOLUTION,
    ),
    "rings grow by rotation twice as much": (
        "qsbearing/model/effects/annulus.py",
        "size = (3.0 + nu) / 8.0 * rho",
        "size = (3.0 + nu) / 4.0 * rho",
        SOLUTION,
    ),
    "interference taken for a radial one": (
        "qsbearing/model/effects/ring_expansion.py",
        "overlap = 0.5 * interference",
        "overlap = interference",
        SOLUTION,
    ),
    "warm rings shrink": (
        "qsbearing/model/effects/ring_expansion.py",
        "growth * (1.0 + ring.strain) + ring.strain * centre",
        "growth * (1.0 + ring.strain) - ring.strain * centre",
        SOLUTION,
    ),
    "balls grow by heat twice as much": (
        "qsbearing/model/effects/ball_expansion.py",
        "ball_diameter=strain *",
        "ball_diameter=2.0 * strain *",
        SOLUTION,
    ),
    "rigid preload +1 %": (
        "qsbearing/model/solution/solver.py",
        "held, rings = preloaded.displacement[..., 0], scene.ring_expansion",
        "held, rings = 1.01 * preloaded.displacement[..., 0], scene.ring_expansion",
        SOLUTION,
    ),
    "spring preload +1 %": (
        "qsbearing/model/solution/solver.py",
        '{"axial_load": scene.preload.spring}',
        '{"axial_load": 1.01 * scene.preload.spring}',
        SOLUTION,
    ),
    "balls slip at 1.1 mu": (
        "qsbearing/model/effects/gyroscopic_moment.py",
        "slope = bound if friction > 0.0 else -bound",
        "slope = 1.1 * bound if friction > 0.0 else -1.1 * bound",
        SOLUTION,
    ),
    "minimum dissipation by a wrong radius": (
        "qsbearing/model/effects/raceway_control.py",
        "inner_constant * (1.0 + g * co)",
        "inner_constant * (1.0 - g * co)",
        SOLUTION,
    ),
    "outer ring turns the other way": (
        "qsbearing/model/kernel/kinematics.py",
        "speed = (inner_speed * bu + outer_speed * av) * inverse",
        "speed = (inner_speed * bu - outer_speed * av) * inverse",
        SOLUTION,
    ),
    "orbits on the pitch circle all the same": (
        "qsbearing/model/kernel/ball_inertia.py",
        "if not case.displaced_orbit:",
        "if True:",
        SOLUTION,
    ),
    "Harris's shares as the controlling raceway's": (
        "qsbearing/model/effects/gyroscopic_moment.py",
        "return (1.0, 1.0) if convention == _HARRIS else (2.0, 0.0)",
        "return (2.0, 0.0)",
        SOLUTION,
    ),
    "Jones's criterion without the angle between the contacts": (
        "qsbearing/model/effects/raceway_control.py",
        "outer_spin_constant * cos_difference > inner",
        "outer_spin_constant > inner",
        SOLUTION,
    ),
    "free angle of a clearance": (
        "qsbearing/model/bearing.py",
        "/ (4.0 * np.asarray(groove_centre_distance, float))",
        "/ (4.01 * np.asarray(groove_centre_distance, float))",
        SOLUTION,
    ),
    "unequal balls by half their deviations": (
        "qsbearing/model/solution/flatten.py",
        "1.0 + self._deviations_of(start, stop) /",
        "1.0 + 0.5 * self._deviations_of(start, stop) /",
        SOLUTION,
    ),
    "rows of a set tilt the wrong way": (
        "qsbearing/systems/sets/rigid_shaft.py",
        "matrix[:, 1, 4], matrix[:, 2, 3] = arm, -arm",
        "matrix[:, 1, 4], matrix[:, 2, 3] = arm, arm",
        SOLUTION,
    ),
    "rows of a set displaced without their offset": (
        "qsbearing/systems/sets/solve.py",
        "np.asarray(row.offset, float) + by + deflection",
        "0.0 * np.asarray(row.offset, float) + by + deflection",
        SOLUTION,
    ),
    "groove of the catalogue, digits swapped": (
        "qsbearing/files/catalogue/b218.toml",
        "inner_groove_radius_mm = 11.6281",
        "inner_groove_radius_mm = 11.6821",
        SOLUTION,
    ),
    "Poisson's ratio of silicon nitride": (
        "qsbearing/model/material.py",
        "poisson_ratio=0.26,\n    density=3200.0",
        "poisson_ratio=0.27,\n    density=3200.0",
        SOLUTION,
    ),
    "density of steel, digits swapped": (
        "qsbearing/model/material.py",
        "elastic_modulus=208e9,\n    poisson_ratio=0.3,\n    density=7800.0",
        "elastic_modulus=208e9,\n    poisson_ratio=0.3,\n    density=7080.0",
        SOLUTION,
    ),
    "no moment of friction at the groove (19.15)": (
        "qsbearing/model/kernel/ball.py",
        "h3 = case.tilt_lever * h1 + case.inner_coefficient * ti",
        "h3 = case.tilt_lever * h1",
        SOLUTION,
    ),
    "friction of the wrong sign on the ring (19.14)": (
        "qsbearing/model/kernel/ball.py",
        "h2 = qi * ci + ti * si",
        "h2 = qi * ci - ti * si",
        SOLUTION,
    ),
    "contacts of one shape where each has its own": (
        "qsbearing/model/kernel/raceway_stiffness.py",
        "    if case.actual_angle:\n        coefficient",
        "    if False:\n        coefficient",
        SOLUTION,
    ),
    "tilt lever of the pitch circle forgotten": (
        "qsbearing/model/solution/flatten.py",
        "if is_exact else 0.5 * pitch",
        "if is_exact or True else 0.5 * pitch",
        SOLUTION,
    ),
    "a published fit, digits swapped": (
        "qsbearing/model/contact/hertz.py",
        "return 1.0339 * ratio**0.636",
        "return 1.0393 * ratio**0.636",
        SOLUTION,
    ),
    "far field +1 %": (
        "fem_check/elements/elastic_body.py",
        "prescribed_displacement = far.transpose(",
        "prescribed_displacement = 1.01 * far.transpose(",
        "load_power_law",
    ),
    # Uncertainties that are too small, and code verification.
    "mesh uncertainty returns 0": (
        "fem_check/rows/convergence.py",
        "return SAFE_FACTOR * max(steps)",
        "return 0.0 * max(steps)",
        "convergence_order",
    ),
    "mesh uncertainty returns 0, load series": (
        "fem_check/rows/convergence.py",
        "return SAFE_FACTOR * max(steps)",
        "return 0.0 * max(steps)",
        "load_power_law",
    ),
    "uncertainty of ratios returns 0": (
        "fem_check/rows/convergence.py",
        "return max(abs(value - values[-1]) for value in values[:-1])",
        "return 0.0 * max(abs(value - values[-1]) for value in values[:-1])",
        "true_geometry",
    ),
    "pooled scatter returns 0": (
        "fem_check/rows/convergence.py",
        "return float(stdtrit(freedom, 0.975) * pooled)",
        "return 0.0 * pooled",
        "true_geometry",
    ),
    "curved edges straight": (
        "fem_check/solids/tetrahedral_body.py",
        "positions[:, _edge_nodes(straight, *mesh.curved_edges)] = mesh.curved_nodes",
        "_edge_nodes(straight, *mesh.curved_edges)",
        "manufactured_solution",
    ),
    "Lame's constants swapped": (
        "fem_check/elements/elastic_body.py",
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
        "fem_check/elements/elastic_body.py",
        "prescribed_displacement = far.transpose",
        "prescribed_displacement = 1.01 * far.transpose",
        GROOVE,
    ),
}
RING = "elastic_ring"
SECTOR = "bearing_sector"
PLANTED |= {
    "a term of Michell's with the wrong displacement": (
        "qsbearing/model/effects/ring_compliance.py",
        "(n + 2.0, 1.0, kappa - 1.0 - n)",
        "(n + 2.0, 1.0, kappa + 1.0 - n)",
        RING,
    ),
    "a shaft that pulls its ring in": (
        "qsbearing/model/effects/ring_compliance.py",
        "return PressureCompliance(-(own.outside_by_outside + own.outside_by_bore * seat), seat)",
        "return PressureCompliance(-(own.outside_by_outside - own.outside_by_bore * seat), seat)",
        RING,
    ),
    "a ring 5 % wider": (
        "qsbearing/model/effects/ring_compliance.py",
        "(2.0 * np.pi * np.asarray(radius, float) * np.asarray(width, float))",
        "(2.1 * np.pi * np.asarray(radius, float) * np.asarray(width, float))",
        RING,
    ),
    "a half-plane's part left in the compliance": (
        "qsbearing/model/effects/ring_compliance.py",
        "local = 2.0 * np.asarray(radius, float)",
        "local = 0.0 * np.asarray(radius, float)",
        RING,
    ),
    "shoulders left out": (
        "qsbearing/model/effects/ring_section.py",
        "for shoulder in shoulders:",
        "for shoulder in (0.0, 0.0):",
        RING,
    ),
    # In the model, seen by the sector.
    "elastic modulus x 1.05": (
        "qsbearing/model/contact/hertz.py",
        "return 2.0 / ((1.0 - poisson_ratio_1**2) / elastic_modulus_1",
        "return 2.1 / ((1.0 - poisson_ratio_1**2) / elastic_modulus_1",
        SECTOR,
    ),
    "centrifugal force x 1.1": (
        "qsbearing/model/effects/centrifugal_force.py",
        "half = 0.5 * mass * pitch_diameter",
        "half = 0.55 * mass * pitch_diameter",
        SECTOR,
    ),
    "gyroscopic moment of the other sign": (
        "qsbearing/model/kernel/ball_inertia.py",
        "mg, mg_i, mg_o = gyroscopic_moment(ball_inertia(diameter)",
        "mg, mg_i, mg_o = gyroscopic_moment(-ball_inertia(diameter)",
        SECTOR,
    ),
    "load on the ring x 1.02": (
        "qsbearing/model/solution/flatten.py",
        "load / (force * diameter) if channel.is_rotation else load / force",
        "load / (force * diameter) if channel.is_rotation else 1.02 * load / force",
        SECTOR,
    ),
    "contact angle + 0.3 degrees": (
        "qsbearing/model/solution/flatten.py",
        '_sine_and_cosine(v["free_contact_angle"])',
        '_sine_and_cosine(v["free_contact_angle"] + 0.005)',
        SECTOR,
    ),
    # In the sector itself.
    "body force of the ball x 1.1": (
        "fem_check/solids/condensation.py",
        "forces -= carried @ share[:, some]",
        "forces -= 1.1 * carried @ share[:, some]",
        SECTOR,
    ),
    "centrifugal force of the sector x 1.1": (
        "fem_check/solids/bearing_sector.py",
        "bearing.drawing.ball_mass * radius * (orbit * speed) ** 2",
        "1.1 * bearing.drawing.ball_mass * radius * (orbit * speed) ** 2",
        SECTOR,
    ),
    "elastic modulus of the meshed bodies x 1.05": (
        "fem_check/solids/tetrahedral_body.py",
        "return self.material.elastic_modulus * elastic_body",
        "return 1.05 * self.material.elastic_modulus * elastic_body",
        SECTOR,
    ),
    "weights of the pressure on the mesh x 1.01": (
        "fem_check/solids/contact_frame.py",
        "weights = sp.diags(projected) @",
        "weights = 1.01 * sp.diags(projected) @",
        SECTOR,
    ),
    "weights of the pressure's own quadrature x 1.01": (
        "fem_check/elements/pressure_basis.py",
        "return sp.csr_matrix(sp.diags(area) @ self.values(x, y))",
        "return sp.csr_matrix(sp.diags(1.01 * area) @ self.values(x, y))",
        SECTOR,
    ),
    "friction against the gyroscopic moment halved": (
        "fem_check/solids/bearing_sector.py",
        "share = 2.0 * self.gyroscopic /",
        "share = 1.0 * self.gyroscopic /",
        SECTOR,
    ),
    "uncertainties that do not cover": (
        "fem_check/rows/convergence.py",
        "return SAFE_FACTOR * max(steps)",
        "return 0.2 * SAFE_FACTOR * max(steps)",
        "convergence_order",
    ),
}
PARTS = "solution_parts"
# Those with a path of tests are seen by a test of that alone: checks have no row for it, or none so narrow.
PLANTED |= {
    "attitude angle of the other sign": (
        "qsbearing/model/kernel/results.py",
        "out[tables[ATTITUDE_ANGLE], k, j] = atan2(p, q)",
        "out[tables[ATTITUDE_ANGLE], k, j] = atan2(-p, q)",
        PARTS,
    ),
    "balls slip at twice mu": (
        "qsbearing/model/kernel/results.py",
        "    bound = case.friction_coefficient",
        "    bound = 2.0 * case.friction_coefficient",
        PARTS,
    ),
    "spin of the other sign": (
        "qsbearing/readings/ball_motion.py",
        "out[2, k, j] = spin",
        "out[2, k, j] = -spin",
        PARTS,
    ),
    "orthogonal shear stress + 5 %": (
        "qsbearing/readings/subsurface_stress.py",
        "return root / (2.0 * t * (t + 1.0))",
        "return 1.05 * root / (2.0 * t * (t + 1.0))",
        PARTS,
    ),
    "Cowper's shear coefficient + 5 %": (
        "qsbearing/systems/sets/beam.py",
        "return np.asarray(6.0 * (1.0 + nu)",
        "return np.asarray(6.3 * (1.0 + nu)",
        PARTS,
    ),
    "half of a housing's compliance": (
        "qsbearing/systems/sets/shaft.py",
        "0.0 if stiffness is None else 1.0 / stiffness",
        "0.0 if stiffness is None else 0.5 / stiffness",
        PARTS,
    ),
    "half of the inner ring's compliance": (
        "qsbearing/model/effects/elastic_rings.py",
        "return _given(compliance, bottom, self.inner_width",
        "return _given(compliance, bottom, 2.0 * self.inner_width",
        PARTS,
    ),
    "a hollow shaft as a solid one": (
        "qsbearing/model/effects/elastic_rings.py",
        "hollow = 0.0 if self.shaft == SOLID else _half(self.shaft_bore_diameter)",
        "hollow = 0.0",
        PARTS,
    ),
    "ball of the catalogue, digits swapped": (
        "qsbearing/files/catalogue/gmn_spindle_bearings.csv",
        "S 6206 C TA,30.0,62.0,16.0,46.0,9.525",
        "S 6206 C TA,30.0,62.0,16.0,46.0,9.252",
        PARTS,
    ),
    "width of the catalogue, digits swapped": (
        "qsbearing/files/catalogue/gmn_spindle_bearings.csv",
        "S 6206 C TA,30.0,62.0,16.0,",
        "S 6206 C TA,30.0,62.0,61.0,",
        PARTS,
    ),
    "outside diameter for the bore": (
        "qsbearing/files/catalogue/spindle_series.py",
        '"outside_diameter_mm": "D_mm"',
        '"outside_diameter_mm": "d_mm"',
        PARTS,
    ),
    "a tilt in milliradians read as degrees": (
        "qsbearing/model/described.py",
        'Unit("mrad", "mrad", mrad, ANGLE)',
        'Unit("mrad", "mrad", 17.453 * mrad, ANGLE)',
        PARTS,
    ),
    "tilt lever of batches + 1 %": (
        "qsbearing/model/kernel/lanes.py",
        "ring.pitch_diameter[lane], ring.tilt_lever[lane] = case.pitch_diameter, case.tilt_lever",
        "ring.pitch_diameter[lane], ring.tilt_lever[lane] = case.pitch_diameter, 1.01 * case.tilt_lever",
        PARTS,
    ),
    "an exponent of Hamrock and Brewe": (
        "qsbearing/model/contact/hertz.py",
        "return ratio ** (2.0 / pi)",
        "return ratio ** (2.0 / 3.0)",
        SOLUTION,
    ),
    "an outer ring held all round, not axially": (
        "fem_check/solids/bearing_sector.py",
        "fixed[np.abs(x - (section.groove_centre[0] + 0.5 * section.width)) < NEAR, 0] = True",
        "fixed[np.abs(x - (section.groove_centre[0] + 0.5 * section.width)) < NEAR] = True",
        RING,
    ),
    "a contact's heat to the other ring": (
        "qsbearing/systems/heat/balance.py",
        'parts = {"inner_ring": inner * to_rings, "outer_ring": (1.0 - inner) * to_rings,',
        'parts = {"inner_ring": (1.0 - inner) * to_rings, "outer_ring": inner * to_rings,',
        PARTS,
    ),
    "heat to the balls as to the rings": (
        "qsbearing/systems/heat/balance.py",
        '"balls": 1.0 - to_rings}',
        '"balls": to_rings}',
        PARTS,
    ),
    "oil's heat by twice its flow": (
        "qsbearing/systems/heat/network.py",
        "return self.flow * self.density * self.specific_heat",
        "return 2.0 * self.flow * self.density * self.specific_heat",
        PARTS,
    ),
    "friction of the contacts + 1 %": (
        "qsbearing/readings/contact_friction.py",
        "out[0, k, j] = force * mean",
        "out[0, k, j] = 1.01 * force * mean",
        PARTS,
    ),
    "balls that the heat balance leaves cold": (
        "qsbearing/systems/heat/hot.py",
        'if isinstance(effect, BallExpansion) and "balls" in own:',
        'if isinstance(effect, BallExpansion) and "ball" in own:',
        PARTS,
    ),
    "azimuths from y away from z": (
        "qsbearing/model/kernel/ring.py",
        "balls[j].azimuth_sine = sin(azimuth)",
        "balls[j].azimuth_sine = -sin(azimuth)",
        SOLUTION,
    ),
    "moments of mirrored axes": (
        "qsbearing/model/solution/flatten.py",
        "load / (force * diameter) if channel.is_rotation else load / force",
        "-load / (force * diameter) if channel.is_rotation else load / force",
        SOLUTION,
    ),
    "inclined boundary elements, e of the other sign": (
        "fem_check/mechanics/boundary_element.py",
        "square, shared = -0.25 * (0.5 + e) * along,",
        "square, shared = -0.25 * (0.5 - e) * along,",
        "tests/fem_check/test_boundary_element.py",
    ),
    "film, digits swapped": (
        "qsbearing/readings/film_thickness.py",
        "return 3.63 * exp(",
        "return 3.36 * exp(",
        "book hamrock_209_film",
    ),
    "the best row stands for all": (
        "fem_check/rows/agreement.py",
        "row.reach_percent > known.reach_percent",
        "row.reach_percent < known.reach_percent",
        "tests/fem_check/test_pieces.py",
    ),
    "hardening x 1.3": (
        "fem_check/mechanics/elastic_plastic.py",
        "at = 1.0 + e * (before.hardening + step) / y",
        "at = 1.0 + 1.3 * e * (before.hardening + step) / y",
        "tests/fem_check/test_elastic_plastic.py",
    ),
    "a as read x 1.0004": (
        "fem_check/mechanics/measuring.py",
        "    a = solution.unit_lengths * np.sqrt(",
        "    a = 1.0004 * solution.unit_lengths * np.sqrt(",
        "tests/fem_check/test_measuring.py",
    ),
}
# Seen by what is unlike: of a set in which no two things are alike, and of tests where checks have no row.
PLANTED |= {
    "a cone as the cylinder where it begins": (
        "qsbearing/systems/sets/beam.py",
        "outer, inner = (first + part * grows for first, grows in (self.outer, self.inner))",
        "outer, inner = (first + 0.0 * part * grows for first, grows in (self.outer, self.inner))",
        PARTS,
    ),
    "the weight of a cone as of the cylinder where it begins": (
        "qsbearing/systems/sets/weight.py",
        "part * (one[..., 1] - one[..., 0])",
        "0.0 * part * (one[..., 1] - one[..., 0])",
        PARTS,
    ),
    "a mass without weight": (
        "qsbearing/systems/sets/weight.py",
        "_load(of.gravity, each.position, each.mass)",
        "_load(of.gravity, each.position, 0.0 * each.mass)",
        PARTS,
    ),
    "weights in one piece where the line is asked for": (
        "qsbearing/systems/sets/deflection.py",
        "self._acting(requested)\n        bent",
        "self._acting([])\n        bent",
        PARTS,
    ),
    "a support twice as stiff": (
        "qsbearing/systems/sets/elastic_shaft.py",
        "elasticity += own.swapaxes(1, 2) @ support.stiffness @ own",
        "elasticity += 2.0 * own.swapaxes(1, 2) @ support.stiffness @ own",
        PARTS,
    ),
    "a seat out of line the other way": (
        "qsbearing/systems/sets/elastic_shaft.py",
        "columns.append((moved - places.out_of_line())",
        "columns.append((moved + places.out_of_line())",
        PARTS,
    ),
    "a tilted housing's tilts swapped": (
        "qsbearing/systems/sets/row.py",
        '("housing_tilt_y", ANGLE, 0.1),\n    ("housing_tilt_z", ANGLE, 0.1),',
        '("housing_tilt_z", ANGLE, 0.1),\n    ("housing_tilt_y", ANGLE, 0.1),',
        PARTS,
    ),
    "a spacer as warm as the shaft": (
        "qsbearing/systems/sets/axial_growth.py",
        'own, given = getattr(spacer, f"{side}_temperature"), getattr(self._of, body)',
        "own, given = None, getattr(self._of, body)",
        PARTS,
    ),
    "a spacer longer on both sides": (
        "qsbearing/systems/sets/axial_growth.py",
        "np.asarray(spacer.inner_length, float) - np.asarray(spacer.outer_length, float)",
        "0.0 * np.asarray(spacer.inner_length, float) + 0.0 * np.asarray(spacer.outer_length, float)",
        PARTS,
    ),
    "a preload without what the shaft draws back": (
        "qsbearing/systems/sets/solve.py",
        "row.offset, float) + by + deflection",
        "row.offset, float) + by + 0.0 * deflection",
        PARTS,
    ),
    "a seat's bore from where its section begins": (
        "qsbearing/systems/sets/shaft.py",
        "return float(begin + part * (end - begin))",
        "return float(begin + 0.0 * part * (end - begin))",
        PARTS,
    ),
    "a warm shaft no thicker": (
        "qsbearing/systems/sets/elastic_shaft.py",
        "np.stack([each * grown for each in side])",
        "np.stack([each * np.ones_like(grown) for each in side])",
        PARTS,
    ),
    "shear in the ring by the ball's Poisson ratio": (
        "qsbearing/readings/subsurface_stress.py",
        "poisson = np.asarray(bearing.ring_material.poisson_ratio, float)",
        "poisson = np.asarray(bearing.ball_material.poisson_ratio, float)",
        PARTS,
    ),
    "spin of an outer ring that stands still": (
        "qsbearing/readings/ball_motion.py",
        "outer = 0.0 if operation.outer_speed is None else operation.outer_speed",
        "outer = 0.0",
        PARTS,
    ),
    "arrays judged by their best element": (
        "fem_check/rows/compared.py",
        "np.abs(computed - expected).max()",
        "np.abs(computed - expected).min()",
        "tests/fem_check/test_pieces.py",
    ),
    "von Mises with half its shear": (
        "fem_check/elements/fields.py",
        "+ 2.0 * (shear**2).sum(axis=0)",
        "+ 1.0 * (shear**2).sum(axis=0)",
        "tests/fem_check/test_fields.py",
    ),
    "the best row shown as the worst": (
        "fem_check/report/rows.py",
        "max(same, key=_badness)",
        "min(same, key=_badness)",
        "tests/fem_check/test_report.py",
    ),
    "unequal balls of a chosen contact alike": (
        "fem_check/contacts/chosen.py",
        "_groove(drawings[ball],",
        "_groove(drawings[0],",
        "tests/fem_check/test_chosen_contacts.py",
    ),
    "a true ring of the ball's material": (
        "fem_check/solids/true_contact.py",
        'TetrahedralBody(self.mesh("ring"), self.groove.race)',
        'TetrahedralBody(self.mesh("ring"), self.groove.ball)',
        "tests/fem_check/test_true_contact.py",
    ),
    "p of 50 to 80 mm, digits swapped": (
        "qsbearing/files/fits.toml",
        "p = [6, 12, 15, 18, 22, 26, 32,",
        "p = [6, 12, 15, 18, 22, 26, 23,",
        "tests/files/test_printed_tables.py",
    ),
    "eC behind a filter of 25 um": (
        "qsbearing/readings/cleanliness.py",
        "FILTER_25: _Constants(1.6329, 0.0288)",
        "FILTER_25: _Constants(1.6329, 0.0298)",
        "tests/readings/test_printed_factors.py",
    ),
    "kN/mm^2 as N/mm^2": (
        "qsbearing/files/rexs/units.py",
        '"kN/mm^2": GPa',
        '"kN/mm^2": MPa',
        "tests/files/rexs/test_units.py",
    ),
    "inertias of a disk swapped": (
        "qsbearing/systems/sets/rotor.py",
        '"Ip": "polar_inertia", "Id": "diametral_inertia"',
        '"Ip": "diametral_inertia", "Id": "polar_inertia"',
        "tests/systems/sets/test_rotor.py",
    ),
    "f that rigidities ask for, above that of C0": (
        "qsbearing/inference/ratings_fit.py",
        "OWN_F_OFFSETS = np.array([0.0, 0.0013, 0.0056])",
        "OWN_F_OFFSETS = np.array([0.0, 0.0013, 0.0065])",
        "tests/inference/test_own_grooves.py",
    ),
}
COMPILED = ("load exponent 1.49", "centrifugal force doubled")
COMPILED_ALONE = "tilt lever of batches + 1 %"
"""The plain kernel has no batches."""


@pytest.mark.parametrize("name", PLANTED)
def test_the_line_is_still_there(name):
    # Otherwise nobody would know before the minutes of the heavy ones.
    path, old, new, check = PLANTED[name]
    assert (ROOT / path).read_text().count(old) == 1, f"{path}: plant the error where the formula is now"
    assert new != old
    assert check in ALL or check.removeprefix("book ") in CASES or (ROOT / check).is_file()


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
    command = [
        "-m",
        "fem_check",
        *(check.split() if check not in ALL else ("run", check)),
        "--out",
        str(folder / "out"),
    ]
    if check.startswith("tests/"):
        shutil.copytree(ROOT / "tests", folder / "tests", ignore=shutil.ignore_patterns("verification", "__pycache__"))
        shutil.copy(ROOT / "pyproject.toml", folder)
        command = ["-m", "pytest", "-q", "-p", "no:cacheprovider", "--rootdir", str(folder), check]
    return subprocess.run(
        [sys.executable, *command],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(folder)} | kernel,
        capture_output=True,
        text=True,
        check=False,
    )


def assert_caught(done: subprocess.CompletedProcess[str], folder: Path, check: str) -> None:
    """A row out of tolerance, and nothing else, ended the run."""
    assert done.returncode == 1, done.stderr
    if check.startswith("tests/"):
        assert " failed" in done.stdout, done.stdout
        return
    name = f"book/{check.removeprefix('book ')}" if check not in ALL else f"quick/{check}"
    record = json.loads((folder / "out" / f"{name}.json").read_text())
    assert any(row["verdict"] == "fail" for row in record["rows"])


def test_weights_of_the_quadrature_are_seen(tmp_path):
    # The one that costs two seconds; the others run with `-m heavy`.
    name = "quadrature weights +0.2 %"
    assert_caught(run_planted(tmp_path, name, PLANTED[name][3]), tmp_path, PLANTED[name][3])


@pytest.mark.heavy
@pytest.mark.parametrize("name", PLANTED)
def test_planted_error_is_seen(name, tmp_path):
    check = PLANTED[name][3]
    assert_caught(run_planted(tmp_path, name, check, compiled=name == COMPILED_ALONE), tmp_path, check)


@pytest.mark.heavy
@pytest.mark.parametrize("name", COMPILED)
def test_planted_error_is_seen_compiled(name, tmp_path):
    assert_caught(run_planted(tmp_path, name, SOLUTION, compiled=True), tmp_path, SOLUTION)


@pytest.mark.heavy
@pytest.mark.parametrize("check", [SOLUTION, GROOVE, "patch_test", "true_geometry"])
def test_without_an_error_the_copy_passes(check, tmp_path):
    done = run_planted(tmp_path, None, check)
    assert done.returncode == 0, done.stdout
