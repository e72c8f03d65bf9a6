"""`python -m fem_check.release.packages DIR`: what is published: wheel and source with the site, constraints, bill of
materials.

pip resolves the extras of users and tells each file with its hash; from that both lists are made. Nothing is published
without the public address of the project, which `[project.urls]` in pyproject.toml states and nobody guesses.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import tomllib
import uuid
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import click

from qsbearing.model.version import __version__

ROOT = Path(__file__).parents[2]
EXTRAS = "all"
"""Of users; what tests and finite elements need is not published with the package."""
URLS = ("Documentation", "Source", "Issues", "Changelog")


def lacking(pyproject: dict[str, Any]) -> list[str]:
    """The public addresses that are not stated."""
    stated = pyproject["project"].get("urls", {})
    return [name for name in URLS if not str(stated.get(name, "")).startswith("https://")]


def constraints(report: dict[str, Any]) -> str:
    """Every package that pip would install, at its version, with the hashes of the files it would take."""
    lines = [f"# qsbearing[{EXTRAS}] {__version__}, Python {report['environment']['python_version']}; pip's -c and -r"]
    for each in _others(report):
        hashes = each["download_info"].get("archive_info", {}).get("hashes", {})
        named = "".join(f" --hash={kind}:{value}" for kind, value in sorted(hashes.items()))
        lines.append(f"{each['metadata']['name']}=={each['metadata']['version']}{named}")
    return "\n".join(lines) + "\n"


def bill_of_materials(report: dict[str, Any], made: datetime) -> dict[str, Any]:
    """The same as CycloneDX 1.5."""
    parts = [
        {
            "type": "library",
            "name": each["metadata"]["name"],
            "version": each["metadata"]["version"],
            "purl": f"pkg:pypi/{each['metadata']['name'].lower()}@{each['metadata']['version']}",
            "licenses": [{"license": {"name": _licence(each["metadata"])}}],
            "hashes": [
                {"alg": kind.upper().replace("SHA", "SHA-"), "content": value}
                for kind, value in each["download_info"].get("archive_info", {}).get("hashes", {}).items()
            ],
        }
        for each in _others(report)
    ]
    own = {"type": "library", "name": "qsbearing", "version": __version__, "purl": f"pkg:pypi/qsbearing@{__version__}"}
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "serialNumber": f"urn:uuid:{uuid.uuid4()}",
        "version": 1,
        "metadata": {"timestamp": made.isoformat(timespec="seconds"), "component": own},
        "components": parts,
    }


def _others(report: dict[str, Any]) -> list[dict[str, Any]]:
    others = [each for each in report["install"] if each["metadata"]["name"] != "qsbearing"]
    return sorted(others, key=lambda each: str(each["metadata"]["name"]).lower())


def _licence(metadata: dict[str, Any]) -> str:
    """As the package states it, in the first of the places where it may."""
    classified = [each.rpartition(":: ")[2] for each in metadata.get("classifier", ()) if each.startswith("License ::")]
    words = str(metadata.get("license") or "")  # a word, or the whole text
    told = (metadata.get("license_expression"), "" if "\n" in words else words, *classified)
    return next(filter(None, told), "not stated")


def _run(*command: str) -> str:
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout


@click.command(context_settings={"help_option_names": ["-h", "--help"]})
@click.argument("target", type=click.Path(path_type=Path, file_okay=False))
def main(target: Path) -> None:
    """Make the files to publish in the folder TARGET. Exit codes: 0 made, 2 the public address is not stated."""
    missing = lacking(tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8")))
    if missing:
        click.echo(f"pyproject.toml: [project.urls] states no https address for {', '.join(missing)}", err=True)
        sys.exit(2)
    target.mkdir(parents=True, exist_ok=True)
    _run(sys.executable, "-m", "qsbearing.site")
    _run(sys.executable, "-m", "pip", "wheel", "--no-deps", "--wheel-dir", str(target), ".")
    with tempfile.TemporaryDirectory() as folder:
        resolved = Path(folder) / "report.json"
        command = ("install", "--dry-run", "--ignore-installed", "--quiet", "--report", str(resolved), f".[{EXTRAS}]")
        _run(sys.executable, "-m", "pip", *command)
        report = json.loads(resolved.read_text(encoding="utf-8"))
    (target / f"constraints-{__version__}.txt").write_text(constraints(report), encoding="utf-8")
    bill = json.dumps(bill_of_materials(report, datetime.now(UTC)), indent=1)
    (target / f"qsbearing-{__version__}.cdx.json").write_text(bill + "\n", encoding="utf-8")
    click.echo("\n".join(sorted(path.name for path in target.iterdir())))


if __name__ == "__main__":
    main()
