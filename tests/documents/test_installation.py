"""What to type to install more of the package, for how it was installed."""

from __future__ import annotations

import json
import shlex
from importlib import metadata
from pathlib import Path
from typing import Any

import pytest

from qsbearing.documents.installation import pip_install

REQUIRES = [
    "numpy>=1.26", "starlette>=0.40; extra == 'app'", "qsbearing[plot]; extra == 'app'",
    'matplotlib>=3.8.1 ; extra == "plot"', "meshio>=5.3; extra == 'fem'",
]  # fmt: skip


class Installed:
    """As much of a distribution as is asked for."""

    requires = REQUIRES

    def __init__(self, origin: dict[str, Any] | None) -> None:
        self.origin = origin

    def read_text(self, name: str) -> str | None:
        assert name == "direct_url.json"
        return None if self.origin is None else json.dumps(self.origin)


def asked(monkeypatch: pytest.MonkeyPatch, origin: dict[str, Any] | None) -> list[str]:
    monkeypatch.setattr(metadata, "distribution", lambda name: Installed(origin))
    return shlex.split(pip_install("app"))


def test_each_way_of_installing_has_its_command(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    folder, git = (tmp_path / "a b").as_uri(), "https://example.org/q.git"
    (tmp_path / "a b").mkdir()
    (tmp_path / "q.whl").touch()
    wheel = (tmp_path / "q.whl").as_uri()
    vcs = {"vcs": "git", "commit_id": "abc"}
    for origin, words in (
        (None, ["qsbearing[app]"]),
        ({"url": folder, "dir_info": {"editable": True}}, ["-e", f"{tmp_path / 'a b'}[app]"]),
        ({"url": folder, "dir_info": {}}, [f"{tmp_path / 'a b'}[app]"]),
        ({"url": git, "vcs_info": vcs}, [f"qsbearing[app] @ git+{git}@abc"]),
        ({"url": git, "vcs_info": vcs | {"requested_revision": "v1"}}, [f"qsbearing[app] @ git+{git}@v1"]),
        ({"url": git, "vcs_info": vcs, "subdirectory": "x"}, [f"qsbearing[app] @ git+{git}@abc#subdirectory=x"]),
        ({"url": wheel, "archive_info": {}}, [f"qsbearing[app] @ {wheel}"]),
        ({"url": "https://example.org/q.whl", "archive_info": {}}, ["qsbearing[app] @ https://example.org/q.whl"]),
        ({"url": f"{folder}/gone", "dir_info": {}}, ["starlette>=0.40", "matplotlib>=3.8.1"]),
        ({"url": f"{folder}/gone.whl", "archive_info": {}}, ["starlette>=0.40", "matplotlib>=3.8.1"]),
    ):
        assert asked(monkeypatch, origin) == ["pip", "install", *words]


def test_a_source_tree_that_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> None:
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "distribution", missing)
    *_, editable, what = shlex.split(pip_install("fem"))
    assert editable == "-e" and (Path(what.removesuffix("[fem]")) / "pyproject.toml").is_file()


def test_one_function_writes_every_such_advice() -> None:
    root = Path(__file__).parents[2]
    files = [path for name in ("qsbearing", "fem_check") for path in (root / name).rglob("*.py")]
    own = [path.name for path in files if "pip install 'qsbearing[" in path.read_text(encoding="utf-8")]
    assert own == []
