"""How this copy of the package was installed, and so what to type to install more of it.

Source: direct_url.json of the installed distribution (PEP 610), which pip and uv write for what is not of an index.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from importlib import metadata

NAME = "qsbearing"


def pip_install(extra: str) -> str:
    """The command that adds an extra, such as "app", to this copy.

    Where what it was installed from is a folder or file that is no longer there, it installs the extra's packages.
    """
    import json  # none of these at the start of every command
    from importlib import metadata
    from pathlib import Path

    source = Path(__file__).parents[2]
    try:
        distribution = metadata.distribution(NAME)
    except metadata.PackageNotFoundError:  # run from a source tree
        return _command(f"{source}[{extra}]", option="-e ")
    origin = json.loads(distribution.read_text("direct_url.json") or "{}")
    if not origin:
        return _command(f"{NAME}[{extra}]")
    return _of_origin(origin, extra) or _command(*_packages(distribution, extra))


def _of_origin(origin: dict[str, Any], extra: str) -> str:
    """By what direct_url.json holds; empty where a place on this disk is gone."""
    from pathlib import Path
    from urllib.parse import urlsplit
    from urllib.request import url2pathname

    url, vcs, folder = str(origin["url"]), origin.get("vcs_info"), origin.get("dir_info")
    part = f"#subdirectory={origin['subdirectory']}" if "subdirectory" in origin else ""
    if vcs is not None:
        revision = vcs.get("requested_revision") or vcs.get("commit_id") or ""
        return _command(f"{NAME}[{extra}] @ {vcs['vcs']}+{url}{'@' if revision else ''}{revision}{part}")
    parts = urlsplit(url)
    place = Path(url2pathname(parts.path)) if parts.scheme == "file" else None
    if place is not None and not place.exists():
        return ""
    if place is not None and folder is not None and not part:
        return _command(f"{place}[{extra}]", option="-e " if folder.get("editable") else "")
    return _command(f"{NAME}[{extra}] @ {url}{part}")


def _packages(distribution: metadata.Distribution, extra: str) -> list[str]:
    """What an extra requires, and the extras within it; markers of the system are left to pip."""
    named = [each.partition(";") for each in distribution.requires or ()]
    own = [what.strip() for what, _, when in named if f'extra == "{extra}"' in when.replace("'", '"')]
    packages = dict.fromkeys(each for each in own if not each.startswith(f"{NAME}["))
    for each in own:
        if each.startswith(f"{NAME}["):
            inner = each.partition("[")[2].partition("]")[0]
            packages |= dict.fromkeys(one for name in inner.split(",") for one in _packages(distribution, name.strip()))
    return list(packages)


def _command(*what: str, option: str = "") -> str:
    import shlex

    quoted = (each if each.startswith("'") else f"'{each}'" for each in map(shlex.quote, what))
    return f"pip install {option}{' '.join(quoted)}"
