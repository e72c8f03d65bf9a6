"""What is published beside the wheel: constraints with hashes, a bill of materials, and nothing without an address."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from click.testing import CliRunner

from fem_check.release import packages


def a_package(name: str, version: str, **metadata: Any) -> dict[str, Any]:
    """As pip's report tells it."""
    return {
        "metadata": {"name": name, "version": version, **metadata},
        "download_info": {"url": "https://x", "archive_info": {"hashes": {"sha256": "a" * 64}}},
    }


REPORT = {
    "environment": {"python_version": "3.12"},
    "install": [
        a_package("scipy", "1.15.0", classifier=["License :: OSI Approved :: BSD License"]),
        a_package("qsbearing", "0"),
        a_package("NumPy", "2.2.0", license_expression="BSD-3-Clause"),
    ],
}


def test_constraints_name_every_other_package_with_its_hash() -> None:
    lines = packages.constraints(REPORT).splitlines()
    assert [line.partition(" ")[0] for line in lines[1:]] == ["NumPy==2.2.0", "scipy==1.15.0"]
    assert all(line.endswith(f"--hash=sha256:{'a' * 64}") for line in lines[1:])


def test_the_bill_of_materials_names_licences_and_hashes() -> None:
    bill = packages.bill_of_materials(REPORT, datetime(2026, 1, 1, tzinfo=UTC))
    assert [each["purl"] for each in bill["components"]] == ["pkg:pypi/numpy@2.2.0", "pkg:pypi/scipy@1.15.0"]
    assert [each["licenses"][0]["license"]["name"] for each in bill["components"]] == ["BSD-3-Clause", "BSD License"]
    assert bill["components"][0]["hashes"] == [{"alg": "SHA-256", "content": "a" * 64}]
    assert json.loads(json.dumps(bill)) == bill


def test_nothing_is_made_without_a_public_address(tmp_path: Path) -> None:
    """It is not known here, and none is invented."""
    said = CliRunner().invoke(packages.main, [str(tmp_path / "out")])
    assert said.exit_code == 2
    assert "Documentation, Source, Issues, Changelog" in said.stderr
    assert not (tmp_path / "out").exists()
    stated = {"project": {"urls": dict.fromkeys(packages.URLS, "https://example.org")}}
    assert packages.lacking(stated) == []
    assert packages.lacking({"project": {"urls": {"Source": "example.org"}}}) == list(packages.URLS)
