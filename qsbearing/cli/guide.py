"""`qsbearing guide`: its topics, one of them on the terminal, or all as a site to read in a browser."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from qsbearing.cli.files import check_installed, folder
from qsbearing.cli.output import print_table, print_text, print_wrote, refuse

if TYPE_CHECKING:
    from pathlib import Path

    from qsbearing.documents.guide import Page

FIRST = "index.html"
"""Of the pages of the site."""


@click.command(short_help="Read the guide: topics, a page, or all as HTML.")
@click.argument("topic", required=False)
@click.option("--html", "target", metavar="DIR", help="Write it to DIR, with a reference and a search: index.html.")
@click.option("--open", "is_opened", is_flag=True, help="Open it in the browser, at TOPIC if one is named.")
def guide(topic: str | None, target: str | None, is_opened: bool) -> None:
    """List the topics of the guide, print TOPIC or one section of it (TOPIC#SECTION), or show all as a site.

    The site has the guide, a reference of Python, files, commands and results, and a search that needs no network. A
    wheel carries it; in a copy of the repository it is made, which needs the extra "docs".

    Exit codes: 0 done, 2 bad input.
    """
    from qsbearing.documents.guide import meant_by, topics
    from qsbearing.model.validation import alike, question
    from qsbearing.reports.guide_lists import LISTS

    pages = topics(lists=LISTS)
    text = ""
    if topic is not None:
        page, _, section = topic.partition("#")
        if page not in pages:
            meant = question(alike(page, pages)) or meant_by(page, pages)
            refuse(f"no topic {page} in the guide{f'. {meant}' if meant else ''}\n    topics: {', '.join(pages)}")
        text = pages[page].plain(section)
        if not text:
            refuse(f"no section {section} in the topic {page}; `qsbearing guide {page}` prints it all")
    if target is not None or is_opened:
        _write(topic, target, is_opened)
    elif text:
        from rich.markdown import Markdown

        print_table(Markdown(text, hyperlinks=False))
    else:
        _list(pages)


def _list(pages: dict[str, Page]) -> None:
    from qsbearing.documents.model import Table

    print_table([Table(("topic", ""), [(page.topic, page.title) for page in pages.values()], "ll", "The guide")])
    print_text("\n`qsbearing guide TOPIC` prints one; `qsbearing guide --open` shows all in a browser.\n")


def _write(topic: str | None, target: str | None, is_opened: bool) -> None:
    """Put the site where it is asked for, or where it is kept; open it."""
    from shutil import copytree

    carried = _carried()
    into = folder(target) if target is not None else carried or _own_folder()
    if into != carried:
        if carried is not None:
            copytree(carried, into, dirs_exist_ok=True)
            _bring_pictures(into)
        else:
            what = "--html needs" if target is not None else "--open needs"
            check_installed(what, ("mkdocs", "material", "mkdocstrings", "matplotlib", "pydantic"), "docs")
            _build(into)
    print_wrote([into / FIRST])
    if is_opened:
        page, _, section = (topic or "index").partition("#")
        click.launch((into / f"{page}.html").resolve().as_uri() + (f"#{section}" if section else ""))


def _bring_pictures(into: Path) -> None:
    """A site that a wheel carries shows those of the guide beside it; a copy needs its own."""
    from qsbearing.documents.guide import OF_GUIDE, bring_beside

    bring_beside(into)
    for page in into.glob("*.html"):
        page.write_text(page.read_text(encoding="utf-8").replace(OF_GUIDE, ""), encoding="utf-8")


def _build(into: Path) -> None:
    """In a process of its own: its engine is none of what the command needs."""
    from subprocess import run
    from sys import executable

    click.echo("qsbearing: making the site, some twenty seconds", err=True)
    ended = run([executable, "-m", "qsbearing.site", str(into), "--alone"], capture_output=True, text=True, check=False)
    if ended.returncode:
        refuse(f"the site cannot be made: {ended.stdout}{ended.stderr}")


def _carried() -> Path | None:
    """The site that a wheel carries; None in a copy of the repository."""
    from qsbearing.documents.guide import BUILT

    return BUILT if (BUILT / FIRST).is_file() else None


def _own_folder() -> Path:
    """Where a site is kept that nobody gave a place."""
    from platformdirs import user_cache_dir

    return folder(f"{user_cache_dir('qsbearing')}/site")
