"""`qsbearing explain`: which effects and choices a scene calls for, and why."""

from __future__ import annotations

import json
import sys

import click

from qsbearing.cli.explain_set import show_set
from qsbearing.cli.explained import remarks, table
from qsbearing.cli.output import UNSOLVED, note, print_table, print_text, refuse
from qsbearing.cli.scene import load_one, solving


@click.command(short_help="Show which effects a scene calls for, and by how much.")
@click.argument("scene")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object instead of a table, and nothing else.")
@click.option("--verify", is_flag=True, hidden=True, help="What is done anyway: solve with and without each.")
@click.option(
    "--tolerance", type=float, default=0.01, show_default=True, help="The relative change below which none is needed."
)
def explain(scene: str, as_json: bool, verify: bool, tolerance: float) -> None:
    """Show for every effect and choice, named by SCENE or not, how much it matters at this operating point.

    Each is solved with and without: what leaving it out changes of contact angles, loads, pressures, displacement and
    stiffness; how much longer a solve takes with it; and a verdict: needed, not needed, likely needed but without the
    data that it takes (then its changes are estimated, and marked ≈), or not assessed and why. The indicator is a
    dimensionless number that its influence follows.

    Of a set of rows, what its preload does is said first.

    Exit codes: 0 explained, 1 the scene has no solution, 2 bad input.
    """
    from dataclasses import replace

    from qsbearing.chooser.explain import explain
    from qsbearing.messages import message
    from qsbearing.scene.scene import Scene

    if not 0.0 < tolerance <= 1.0:
        refuse(f"--tolerance {tolerance:g}: a relative change, above 0 and at most 1 (0.01 is one per cent)")
    loaded = load_one(scene)
    if not isinstance(loaded, Scene):
        show_set(loaded, as_json, tolerance)
        return
    with solving():
        solution, rows = explain(replace(loaded, tolerance=None), tolerance)
    if as_json:
        found = {"status": str(solution.status), "message": message(solution), "tolerance": tolerance}
        print_text(json.dumps(found | {"effects": [vars(row) for row in rows]}, indent=1, allow_nan=False) + "\n")
    else:
        print_table(table(rows, tolerance))
        for each in remarks(rows):
            print_table(each)
    if not solution.converged:
        note(message(solution))
        sys.exit(UNSOLVED)
