"""`python -m qsbearing.site DIR`: the guide and a reference made from the code, as pages; needs the extra "docs".

Pages are written to a folder of their own as plain Markdown, from which MkDocs makes the site. None of them is kept:
the guide is the guide's own text, names come from `qsbearing/__init__.pyi`, keys from the schema of files and the
descriptions of inputs, commands from click, results from their descriptions.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from qsbearing.documents.guide import BUILT, FOLDER, OF_GUIDE, beside_pages, bring_beside, topics
from qsbearing.model.version import __version__
from qsbearing.reports.guide_lists import LISTS
from qsbearing.site.home import home
from qsbearing.site.reference import Pages, command_pages, key_pages, python_pages, result_pages
from qsbearing.site.versions import list_versions

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
TABS = ("Learn", "Do", "Trust", "Develop")
"""Headings of the guide's first page that are the site's own parts, in this order; its lists name the pages."""
WAYS_IN = "guide.md"
"""The guide's first page; the site has one of its own."""
UNUSED = ("**/*.map", "assets/javascripts/lunr/*.js", "assets/javascripts/lunr/min/*.js", "sitemap.xml.gz")
"""Of the theme: languages of the search other than English, and maps of its scripts."""
IN_FILES = ("search/search_index.json", "objects.inv", "sitemap.xml", "404.html")
"""What pages opened as files do not read."""
UNSEARCHED = "---\nsearch: {exclude: true}\n---\n\n"
"""Beginning of pages of names and changes, whose subjects have pages of their own: a fifth of all that is searched."""


def write_pages(folder: Path) -> list[dict[str, Any]]:
    """Write every page of the site to a folder; the order of them, as MkDocs takes it."""
    shutil.copytree(HERE / "assets", folder / "assets")
    bring_beside(folder)
    guide = topics(lists=LISTS)
    for page in guide.values():
        name = WAYS_IN if page.topic == "index" else f"{page.topic}.md"
        text = _of_site(page.text)
        (folder / name).write_text(f"{UNSEARCHED}{text}" if page.topic == "interface" else text, encoding="utf-8")
    (folder / "index.md").write_text(home(folder), encoding="utf-8")
    reference = [
        {"Python": list(_written(folder, python_pages(), "reference/"))},
        {"Files": list(_written(folder, key_pages(), "reference/"))},
        {"Commands": list(_written(folder, command_pages(), "reference/"))},
        {"Results": list(_written(folder, result_pages(), "reference/"))},
        {"Names that stay": "interface.md"},
    ]
    about = [{"About": list(_written(folder, _about()))}] if (ROOT / "CHANGELOG.md").is_file() else []
    *parts, develop = _parts(guide)
    return [{"Home": "index.md"}, *parts, {"Reference": reference}, develop, *about]


def _about() -> Pages:
    """What a copy of the repository has besides, an installed package not."""

    def text(name: str) -> str:
        return (ROOT / name).read_text(encoding="utf-8")

    contributing = text(".github/CONTRIBUTING.md").replace("](../qsbearing/guide/", "](")
    return {
        "contributing.md": ("Contributing", _of_site(contributing)),
        "changes.md": ("Changes", UNSEARCHED + _of_site(text("CHANGELOG.md"))),
        "cite.md": ("How to cite", f"# How to cite\n\n```yaml\n{text('CITATION.cff')}```\n"),
        "licences.md": ("Licences of others", UNSEARCHED + text("qsbearing/THIRD_PARTY_LICENSES.md")),
    }


def _written(folder: Path, pages: Pages, under: str = "") -> Iterator[dict[str, str]]:
    """Of pages by their files: (title, text)."""
    for name, (title, text) in pages.items():
        path = folder / under / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        yield {title: f"{under}{name}"}


def _parts(guide: dict[str, Any]) -> list[dict[str, Any]]:
    """The tabs of the guide, with the pages that the lists below these headings name."""
    parts: dict[str, list[dict[str, str]]] = {TABS[0]: [{"What do you want to know?": WAYS_IN}]}
    part = ""
    for line in guide["index"].text.splitlines():
        if line.startswith("## "):
            part = line[3:].strip()
        elif part in TABS and line.startswith("- ["):
            topic = line.partition("](")[2].partition(".md")[0]
            if topic != "interface":  # which stands in the reference
                parts.setdefault(part, []).append({guide[topic].title.replace("`", ""): f"{topic}.md"})
    named = {path.removesuffix(".md") for pages in parts.values() for page in pages for path in page.values()}
    missing = set(guide) - named - {"index", "interface"}
    if missing or tuple(parts) != TABS:
        raise ValueError(f"pages that no list of the first page names: {sorted(missing)}; parts: {list(parts)}")
    return [{part: pages} for part, pages in parts.items()]


def share_with_guide(site: Path) -> None:
    """Leave out what a wheel has beside the guide's pages, and lead there instead."""
    names = beside_pages()
    for name in names:
        (site / name).unlink(missing_ok=True)
    for page in site.glob("*.html"):
        text = page.read_text(encoding="utf-8")
        for name in names:
            text = text.replace(f'"{name}"', f'"{OF_GUIDE}{name}"')
        page.write_text(text, encoding="utf-8")


def _of_site(text: str) -> str:
    """The guide's Markdown without links into the repository, which the site does not hold: their words stay."""

    def lead(link: re.Match[str]) -> str:
        path, _, _ = link[2].partition("#")
        is_held = not path or path.startswith(("http", "mailto")) or (FOLDER / path).exists()
        return link[0] if is_held else link[1]

    return re.sub(r"(?<!!)\[([^\]]+)\]\(([^)\s]+)\)", lead, text)


def configured(pages: Path, site: Path, nav: list[dict[str, Any]], is_one_of_several: bool) -> str:
    """The configuration of one run, in JSON, which is YAML. Of several sites each shows the list of versions, and has
    its own there; one that stands alone names it in its title."""
    given: dict[str, Any] = {
        "INHERIT": str(HERE / "mkdocs.yml"),
        "docs_dir": str(pages),
        "site_dir": str(site),
        "nav": nav,
    }
    given |= {"theme": {"custom_dir": str(HERE / "theme")}, "copyright": f"qsbearing {__version__}, MIT licence"}
    if is_one_of_several:
        return json.dumps(given | {"extra": {"version": {"provider": "mike"}}})
    return json.dumps(given | {"site_name": f"qsbearing {__version__}"})


def set_close(page: str) -> str:
    """HTML without the indents and empty lines of the templates, and without marks of code that have no colour: a
    tenth of it when packed. Code keeps its lines."""
    page = re.sub(r'<span class="[nw]">([^<]*)</span>', r"\1", page)
    return re.sub(r"(<(pre|textarea)\b.*?</\2>)|\s*\n\s*", lambda part: part[1] or "\n", page, flags=re.DOTALL)


@click.command(context_settings={"help_option_names": ["-h", "--help"]})
@click.argument("target", type=click.Path(path_type=Path, file_okay=False), required=False)
@click.option("--alone", is_flag=True, help="Make it in TARGET itself, without a list of versions.")
@click.option("--pages", "kept", type=click.Path(path_type=Path), help="Keep the Markdown pages in this folder.")
def main(target: Path | None, alone: bool, kept: Path | None) -> None:
    """Make the site in the folder TARGET/VERSION, beside those of other versions, and list them all; without TARGET,
    where a wheel takes it from.

    Exit code 1 where a link leads nowhere, or a docstring names what there is not.
    """
    is_one_of_several = target is not None and not alone
    site = BUILT if target is None else target if alone else target / __version__
    with tempfile.TemporaryDirectory() as temporary:
        pages = kept or Path(temporary) / "pages"
        shutil.rmtree(pages, ignore_errors=True)
        config = Path(temporary) / "mkdocs.yml"
        text = configured(pages.resolve(), site.resolve(), write_pages(pages), is_one_of_several)
        config.write_text(text, encoding="utf-8")
        command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "-f", str(config)]
        ended = subprocess.run(command, env=os.environ | {"NO_MKDOCS_2_WARNING": "1"}, check=False)
    if ended.returncode:
        sys.exit(ended.returncode)
    for pattern in (*UNUSED, *(IN_FILES if site == BUILT else ())):
        for path in site.glob(pattern):
            path.unlink()
    for page in site.rglob("*.html"):
        page.write_text(set_close(page.read_text(encoding="utf-8")), encoding="utf-8")
    if site == BUILT:
        share_with_guide(site)
    if is_one_of_several:
        list_versions(site.parent)


if __name__ == "__main__":
    main()
