"""Makes libraries and the manifest beside them, which says what they were made from and for."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path

from qsbearing.model.compiler.library import MANIFEST, OWN, digest, platform_name
from tests.verification.kernel_library import inputs


def make_own() -> Path:
    """This platform's library, for the source as it stands."""
    return _make([platform_name()], OWN)[0]


def make_all(folder: Path) -> list[Path]:
    """The libraries of all platforms."""
    from tests.verification.kernel_library.targets import TARGETS

    other = {name: installed for name, pinned in inputs.pinned().items() if (installed := version(name)) != pinned}
    if other:
        raise SystemExit(
            f"installed: {other}; the libraries are made with {inputs.pinned()}: pip install -e '.[kernel]'"
        )
    return _make(TARGETS, folder)


def _make(platforms: Iterable[str], folder: Path) -> list[Path]:
    from tests.verification.kernel_library import compile_all, targets

    folder.mkdir(parents=True, exist_ok=True)
    sources = inputs.sources()
    of_sources = digest(sources)  # as they are loaded
    text, entries = compile_all.compiled_module(inputs.entries())
    made = {name: targets.linked(name, text, folder) for name in platforms}
    manifest = {
        "digest": of_sources,
        "made_by": inputs.made_by(),
        "libraries": {name: {"sha256": hashlib.sha256(path.read_bytes()).hexdigest()} for name, path in made.items()},
        "sources": sources,
        "entries": entries,
    }
    (folder / MANIFEST).write_text(json.dumps(manifest, indent=1) + "\n", encoding="utf-8")
    return list(made.values())


def differing(one: Path, other: Path) -> list[str]:
    """Files of one folder that another does not hold with the same bytes."""
    return [
        path.name
        for path in sorted(one.iterdir())
        if not (other / path.name).exists() or (other / path.name).read_bytes() != path.read_bytes()
    ]


def is_current(folder: Path) -> bool:
    """Whether a folder's manifest is for the source as it stands."""
    path = folder / MANIFEST
    if not path.exists():
        return False
    manifest = json.loads(path.read_text(encoding="utf-8"))
    return bool(manifest["sources"] == inputs.sources() and manifest["digest"] == digest(manifest["sources"]))
