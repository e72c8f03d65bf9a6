"""What must hold whatever the numbers are: `python -m tests.relations` runs the tests of relations and writes their
outcome to relations.json, for the validation report.

They state symmetries, limits, powers, energy, derivatives, motion; none compares with a number that the package
computed before.
"""

from __future__ import annotations

import ast
import json
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

from qsbearing.results import provenance

HERE = Path(__file__).parent
DATA = HERE / "relations.json"
FILES = (
    "model/contact/test_hertz.py",
    "model/kernel/test_equilibrium.py",
    "model/kernel/test_stiffness_and_energy.py",
    "model/kernel/test_symmetries.py",
    "model/kernel/test_limits.py",
    "model/kernel/test_ball_derivatives.py",
    "model/effects/test_gyroscopic_sign.py",
    "model/effects/test_minimum_dissipation.py",
    "model/effects/test_effects_absent.py",
    "model/effects/test_annulus.py",
    "verification/hard_cases/test_scale.py",
    "readings/test_motion.py",
)


def outcome(name: str) -> dict[str, Any]:
    """What a file's tests came to."""
    with tempfile.NamedTemporaryFile(suffix=".xml") as report:
        command = (sys.executable, "-m", "pytest", "-q", str(HERE / name), f"--junitxml={report.name}")
        subprocess.run(command, capture_output=True, check=False, cwd=HERE.parent)
        text = Path(report.name).read_text(encoding="utf-8")
    suite = ElementTree.fromstring(text).find("testsuite") if text else None
    counts = {
        key: int(suite.get(key, 0)) if suite is not None else 0 for key in ("tests", "failures", "errors", "skipped")
    }
    failed = counts["failures"] + counts["errors"]
    passed = counts["tests"] - failed - counts["skipped"]
    says = ast.get_docstring(ast.parse((HERE / name).read_text(encoding="utf-8"))) or ""
    return {
        "file": f"tests/{name}",
        "what": " ".join(says.split("\n\n")[0].split()),
        "passed": passed,
        "failed": failed,
        "skipped": counts["skipped"],
        "verdict": "pass" if passed and not failed else "fail",
    }


def main() -> None:
    """Run, count, write."""
    found = [outcome(name) for name in FILES]
    record = {"provenance": provenance.of_run("python -m tests.relations"), "files": found}
    target = Path(sys.argv[1]) if sys.argv[1:] else DATA
    target.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    for each in found:
        print(f"{each['verdict']}: {each['passed']} of {each['passed'] + each['failed']}, {each['file']}")


if __name__ == "__main__":
    main()
