"""The spindle of the guide's page: `python -m tests.systems.rotor_dynamics.spindle` runs it in ROSS and keeps the
record.

Rotor and search are the page's own program. Picture and tables are made from the record, without ROSS.
"""

from __future__ import annotations

import contextlib
import io
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

import qsbearing as qs
from qsbearing.pictures.style import figure_of_size, legend, plain
from tests.systems.rotor_dynamics.rotor_program import load

PAGE = Path(qs.__file__).parent / "guide" / "rotor_dynamics.md"
RECORD = Path(__file__).with_name("spindle.json")
PRELOADS = (120.0, 240.0, 480.0, 720.0, 1440.0, 2400.0)
CAMPBELL = 240.0
TILTS = 720.0
SPEEDS = np.linspace(500, 24_000, 48)
KINDS = {"rest": "at rest", "spring": "at speed, springs", "rigid": "at speed, rings held"}


def program() -> dict[str, Any]:
    """What the page defines."""
    (code,) = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    names: dict[str, Any] = {"__name__": "page"}
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(code, PAGE.name, "exec"), names)
    return names | {"printed": printed.getvalue()}


def critical_speeds(page: dict[str, Any], preload: float) -> dict[str, float]:
    """First forward critical speed [rpm] with the stiffness at rest, and at speed with either kind of preload."""
    found = {}
    for kind in KINDS:
        solution = page["preloaded"](qs.Preload(**{"spring" if kind == "rest" else kind: preload}))
        rotor = page["spindle"](solution, 0 if kind == "rest" else None)
        found[kind] = round(page["critical_speed"](rotor) / qs.rpm, 1)
    return found


def tilt_choices(page: dict[str, Any]) -> dict[str, float]:
    """The same at rest, by what stands for the tilts [rpm]."""
    solution = page["preloaded"](qs.Preload(spring=TILTS))
    outward = -solution.stiffness[0, 4, 1] / solution.stiffness[0, 1, 1]
    rotors = {
        '`"included"`': page["spindle"](solution, 0),
        '`"held"`, nodes at the load centres': page["spindle"](solution, 0, "held", (0.1 - outward, 0.3 + outward)),
        '`"held"`, nodes in the middle of the bearings': page["spindle"](solution, 0, "held"),
        '`"free"`, nodes in the middle of the bearings': page["spindle"](solution, 0, "free"),
    }
    return {name: round(page["critical_speed"](rotor) / qs.rpm, 1) for name, rotor in rotors.items()}


def whirls(page: dict[str, Any]) -> dict[str, dict[str, list[float]]]:
    """Forward and backward frequencies over the speed [rpm]."""
    solution = page["preloaded"](qs.Preload(spring=CAMPBELL))
    return {
        kind: {
            way: [round(page["whirl"](rotor, speed * qs.rpm, way) / qs.rpm, 1) for speed in SPEEDS]
            for way in ("Forward", "Backward")
        }
        for kind, rotor in (("rest", page["spindle"](solution, 0)), ("spring", page["spindle"](solution)))
    }


def read() -> Any:
    """The record."""
    return json.loads(RECORD.read_text(encoding="utf-8"))


STYLES = {
    "rest": {"color": "0.35", "linestyle": "--"},
    "spring": {"color": "#d55e00", "linestyle": "-", "marker": "o"},
    "rigid": {"color": "#0072b2", "linestyle": "-", "marker": "s", "markerfacecolor": "none"},
}


def picture(record: Any) -> Figure:
    """Whirl frequencies against speed, critical speed against preload."""
    figure = figure_of_size(8.4, 3.6)
    figure.get_layout_engine().set(w_pad=0.12)  # type: ignore[union-attr,call-arg]
    left, right = figure.subplots(1, 2)
    for kind, ways in record["whirl_rpm"].items():
        for values in ways.values():
            style = STYLES[kind] | {"marker": ""}
            left.plot(SPEEDS / 1000, np.array(values) / 1000, label=f"stiffness {KINDS[kind]}", linewidth=1.4, **style)
    left.plot(SPEEDS / 1000, SPEEDS / 1000, color="0.6", linestyle=":", linewidth=1.0, label="synchronous")
    left.set(xlabel="speed, 1000 rpm", ylabel="whirl frequency, 1000 rpm", xlim=(0, 24), ylim=(0, 26))
    left.set_title(f"spring preload {CAMPBELL:.0f} N", fontsize=9)
    for kind, name in KINDS.items():
        values = [found[kind] / 1000 for found in record["critical_speed_rpm"].values()]
        right.semilogx(PRELOADS, values, label=f"stiffness {name}", linewidth=1.4, markersize=5, **STYLES[kind])
    right.set_xticks(PRELOADS, [f"{preload:.0f}" for preload in PRELOADS])
    right.minorticks_off()
    right.set(xlabel="preload at rest, N", ylabel="critical speed, 1000 rpm", ylim=(0, 22))
    right.set_title("first forward critical speed", fontsize=9)
    for axes in (left, right):
        plain(axes)
    legend(figure, left, right)
    return figure


def main() -> None:
    """Run it in ROSS and keep what comes out."""
    ross = load()
    page = program()
    found = {
        "ross": ross.__version__,
        "critical_speed_rpm": {f"{preload:g}": critical_speeds(page, preload) for preload in PRELOADS},
        "tilt_rpm": tilt_choices(page),
        "whirl_rpm": whirls(page),
    }
    RECORD.write_text(json.dumps(found, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
