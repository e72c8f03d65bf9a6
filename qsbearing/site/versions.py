"""Sites of several versions side by side in one folder: the list of them, and which one the folder itself leads to."""

from __future__ import annotations

import json
from contextlib import suppress
from pathlib import Path

LATEST = "latest"
"""Name of the newest by which the theme knows that a page is not of an older one."""
LEADS_ON = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>qsbearing {version}</title>
<meta http-equiv="refresh" content="0; url={version}/index.html">
<link rel="icon" href="{version}/assets/images/favicon.png">
<a href="{version}/index.html">qsbearing {version}</a></html>
"""


def list_versions(folder: Path) -> None:
    """Write `versions.json` as the theme's list of versions reads it, the newest first, and the page that leads there.
    A folder that is named otherwise than a version is none."""
    from packaging.version import InvalidVersion, Version

    names = {}
    for page in folder.glob("*/index.html"):
        with suppress(InvalidVersion):
            names[Version(page.parent.name)] = page.parent.name
    newest, *older = (names[version] for version in sorted(names, reverse=True))
    listed = [{"version": newest, "title": newest, "aliases": [LATEST]}]
    listed += [{"version": name, "title": name, "aliases": []} for name in older]
    (folder / "versions.json").write_text(json.dumps(listed, indent=1) + "\n", encoding="utf-8")
    (folder / "index.html").write_text(LEADS_ON.format(version=newest), encoding="utf-8")
