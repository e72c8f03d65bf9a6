"""Is what `qsbearing` says beside contacts and equilibrium right: batches, motion, stresses, shafts, heat, keys...?

Each row has its own small reference: single calls, vectors, an integral, a beam, numbers typed a second time.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from dataclasses import replace
from operator import attrgetter
from pathlib import Path

import numpy as np

import qsbearing as qs
from fem_check.checks.elastic_ring import equilibrium
from fem_check.checks.heat_parts import heat_rows
from fem_check.checks.motion_parts import LOADS, SPEED, motion_rows, stress_rows
from fem_check.checks.product_scenes import B218, BOTH
from fem_check.checks.unlike_parts import unlike_rows
from fem_check.independent import catalogue_table
from fem_check.independent.ring_growth import compliance_on_shaft
from fem_check.product import problems
from fem_check.product.scenes import drawing_at_rest
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress, collapsed
from fem_check.rows.compared import compared
from qsbearing.files import catalogue

FEW, MANY = 64, 1000


def batch_rows() -> Iterator[AgreementRow]:
    """Cases in one call against calls of their own: as many as are solved one by one, and side by side where there is
    machine code."""
    for count in (FEW, MANY):
        yield from batch_of(count)


def batch_of(count: int) -> Iterator[AgreementRow]:
    """A batch, of which ten cases are solved again."""
    share = np.linspace(0.5, 1.0, count)
    speed = SPEED * share[::-1]
    loads = {name: getattr(LOADS, name) * share for name in ("axial_load", "radial_load_y", "radial_load_z")}
    many = qs.solve(qs.Scene(B218, replace(LOADS, speed=speed, **loads), **BOTH))
    at = range(0, count, count // 10)
    each = [
        qs.solve(qs.Scene(B218, replace(LOADS, speed=speed[i], **{name: of[i] for name, of in loads.items()}), **BOTH))
        for i in at
    ]
    case, source = f"B218, {count} cases in one call", "each case in a call of its own"
    for name, unit, of in (
        ("displacement", "m, rad", lambda of: of.displacement),
        ("inner contact load", "N", lambda of: of.inner.load),
        ("outer contact angle", "rad", lambda of: of.outer.angle),
        ("stiffness", "SI", lambda of: of.stiffness),
    ):
        yield compared(case, name, unit, of(many)[list(at)], [of(one) for one in each], source)


BORE, WIDTH, HOLLOW, ALUMINIUM = 90e-3, 30e-3, 60e-3, (70e9, 0.33)


def ring_rows() -> Iterator[AgreementRow]:
    """An elastic inner ring on a hollow shaft of aluminium under thrust, where it gives way alike all round."""
    rigid = qs.Scene(B218, qs.Operation(axial_load=20e3))
    rings = qs.ElasticRings(
        bore_diameter=BORE, inner_width=WIDTH, shaft_bore_diameter=HOLLOW, shaft_elastic_modulus=ALUMINIUM[0],
        shaft_poisson_ratio=ALUMINIUM[1],
    )  # fmt: skip
    solution = qs.solve(replace(rigid, ring_effects=(rings,)))
    drawing = drawing_at_rest(rigid, EXAMPLE)
    bottom = drawing.inner_groove_centre_radius - drawing.inner_groove_radius
    steel = drawing.ring.elastic_modulus, drawing.ring.poisson_ratio
    count = len(solution.azimuth)
    compliance = compliance_on_shaft((0.5 * HOLLOW, 0.5 * BORE, bottom), steel, ALUMINIUM) / (
        2.0 * np.pi * bottom * WIDTH
    )
    load, shaft = equilibrium(problems.of_scene(rigid, EXAMPLE), np.full((count, count), compliance))
    case, source = "elastic inner ring on a hollow shaft, 20 kN axial", "Lame's cylinders, an equilibrium of its own"
    why = "twice what bending from ball to ball adds, which the model has and the cylinders have not"
    for quantity, unit, computed, expected, tolerance in (
        ("contact load", "N", solution.inner.load, load, 1.4e-4),
        ("axial displacement", "m", solution.displacement[0], shaft[0], 2.4e-3),
    ):
        yield replace(compared(case, quantity, unit, computed, expected, source, tolerance), why_tolerance=why)


KEYS = {
    "axial_displacement_um": ("axial_displacement", 41.0, 41e-6),
    "radial_displacement_y_um": ("radial_displacement_y", -12.0, -12e-6),
    "radial_displacement_z_um": ("radial_displacement_z", 20.0, 20e-6),
    "tilt_y_mrad": ("tilt_y", 0.3, 0.3e-3),
    "tilt_z_mrad": ("tilt_z", -0.2, -0.2e-3),
    "speed_rpm": ("speed", 6000.0, 6000.0 * np.pi / 30.0),
    "outer_speed_rpm": ("outer_speed", -900.0, -900.0 * np.pi / 30.0),
    "axial_load_N": ("axial_load", 1234.0, 1234.0),
    "radial_load_y_N": ("radial_load_y", -567.0, -567.0),
    "radial_load_z_N": ("radial_load_z", 89.0, 89.0),
    "moment_y_Nm": ("moment_y", 12.0, 12.0),
    "moment_z_Nm": ("moment_z", -34.0, -34.0),
}
"""Key of a scene file: field of the operation, number written, in SI units."""


def key_rows() -> Iterator[AgreementRow]:
    """Keys of a scene file, in two files: a channel has its load or its displacement."""
    channels = list(KEYS)
    speeds = channels[5:7]
    with tempfile.TemporaryDirectory() as folder:
        for names in ([*channels[:5], *speeds], [*channels[7:], *speeds]):
            lines = ["[bearing]", 'name = "B218"', "[operation]", *(f"{name} = {KEYS[name][1]}" for name in names)]
            path = Path(folder) / "scene.toml"
            path.write_text("\n".join(lines) + "\n", encoding="utf-8")
            operation = qs.load_scene(path).operation
            for name in names:
                field, _, expected = KEYS[name]
                yield compared(name, "keys of [operation] in SI units", "SI", getattr(operation, field), expected, "SI")


def catalogue_rows() -> Iterator[AgreementRow]:
    """Every bearing of the printed table, with balls of steel and of ceramic."""
    rows = catalogue_table.rows()
    case, source = f"{len(rows)} bearings of the table, steel and ceramic balls", "the printed table, read again"
    expected: dict[str, list[float]] = {}
    by_name: dict[str, list[float]] = {}
    for row in rows:
        for hybrid in ("", "_hybrid"):
            bearing = qs.load_scene(row.name + hybrid).bearing
            entry = catalogue.find(row.name + hybrid)
            assert entry is not None
            told = {name: attrgetter(name)(bearing) for name in row.lengths}
            for keys in row.others(bool(hybrid)):
                told[keys[0]] = next((entry.dimensions[key] for key in keys if key in entry.dimensions), None)
            printed = row.lengths | {keys[0]: value for keys, value in row.others(bool(hybrid)).items()}
            for name, value in printed.items():
                expected.setdefault(name, []).append(value)
                by_name.setdefault(name, []).append(np.nan if told[name] is None else float(np.asarray(told[name])))
    for name, values in expected.items():
        off = np.asarray(by_name[name]) / np.asarray(values)
        short = name.removeprefix("outline.").removesuffix("_mm").removesuffix("_N")
        yield compared(case, f"{short} over the printed", "1", off, np.ones_like(off), source)
    odd = [row.name for row in rows if not row.has_standard_balls]
    yield AgreementRow(
        case, "balls of a standard size", "1", float(len(rows)), "ISO 3290-1: inches by 1/64, or millimetres by 1/2",
        float(len(rows) - len(odd)), None, 0.0, "a count", ", ".join(odd[:3]) or None,
    )  # fmt: skip
    over = np.array([row.pitch_over_mean for row in rows])
    yield AgreementRow(
        case, "pitch diameter over the mean of bore and outside diameter, farthest from 1", "1", 1.0, "drawing",
        float(over[np.argmax(np.abs(over - 1.0))]), None, 5.1, "rings of unequal height, as the lowest has",
        rows[int(np.argmax(np.abs(over - 1.0)))].name,
    )  # fmt: skip
    boundaries = catalogue_table.unlike_boundaries(rows)
    yield AgreementRow(
        case, "boundary dimensions unlike their designation's", "1", 0.0, "ISO 15: one designation, one d, D and B",
        float(len(boundaries)), None, 0.0, "a count", ", ".join(boundaries[:3]) or None,
    )  # fmt: skip
    twins = catalogue_table.unlike_twins(rows)
    yield AgreementRow(
        case, "sizes whose balls differ with the angle", "1", 0.0, "the table: one ring, two angles", float(len(twins)),
        None, 0.0, "a count", ", ".join(twins[:3]) or None,
    )  # fmt: skip
    for series, spreads in catalogue_table.SPREAD.items():
        some = [row for row in rows if row.series == series]
        ratios = [row.dynamic_over_iso for row in some], [row.static_over_iso for row in some]
        for name, values, allowed in zip(("C over ISO 281's", "C0 over Z Dw2 cos alpha"), ratios, spreads, strict=True):
            off = np.asarray(values) / np.median(values)
            worst = int(np.argmax(np.abs(off - 1.0)))
            yield AgreementRow(
                f"{len(some)} bearings of series {series}", f"{name}, over the median", "1", 1.0, "ISO 281 and ISO 76",
                float(off[worst]), None, None if allowed is None else 100.0 * allowed, catalogue_table.WHY_SPREAD,
                some[worst].name,
            )  # fmt: skip


PARTS = {
    "a batch": batch_rows,
    "motion": motion_rows,
    "stresses": stress_rows,
    "an elastic shaft": unlike_rows,
    "elastic rings": ring_rows,
    "heat": heat_rows,
    "scene files": key_rows,
    "catalogue": catalogue_rows,
}


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """All parts; always B218, whatever the scene."""
    rows: list[AgreementRow] = []
    for done, (name, part) in enumerate(PARTS.items()):
        progress(name, done / len(PARTS))
        more = list(part())
        rows += collapsed(more, "a scene file") if part is key_rows else more
    return Findings(rows)


CHECK = Check(
    name="solution_parts",
    question="Are batches, motion, stresses, elastic shafts, heat, scene files and the catalogue right?",
    kind=CheckKind.VERIFICATION,
    reference="single calls, vectors, integrals, a beam, balances of heat, the printed table; no code of qsbearing",
    tolerance="1e-9; friction 1e-4; standard sizes exactly; ratings against ISO's as far as makers differ",
    run=run,
    largest_dofs=lambda level: 0,
)
