"""`qsbearing guide`: its topics, one of them on the terminal, or all as a page to read in a browser."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import click

from qsbearing.cli.files import check_installed, fill, folder
from qsbearing.cli.output import print_table, print_text, print_wrote, refuse

if TYPE_CHECKING:
    from pathlib import Path

    from qsbearing.documents.guide import Page


@click.command(short_help="Read the guide: topics, a page, or all as HTML.")
@click.argument("topic", required=False)
@click.option(
    "--html", "target", metavar="DIR", help="Write the guide to DIR: guide.html, a page for each topic, search."
)
@click.option("--open", "is_opened", is_flag=True, help="Open it in the browser, at TOPIC if one is named.")
def guide(topic: str | None, target: str | None, is_opened: bool) -> None:
    """List the topics of the guide, print TOPIC or one section of it (TOPIC#SECTION), or write all as HTML pages.

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
    what = "--html needs" if target is not None else "--open needs"
    check_installed(what, ("jinja2", "markdown_it", "mdit_py_plugins"), "report")
    from qsbearing.documents.guide import HOME, documents, file_of
    from qsbearing.documents.pages import pages
    from qsbearing.model.version import __version__
    from qsbearing.reports.guide_lists import LISTS

    into = folder(target) if target is not None else _own_folder()
    made = pages(documents(__version__, lists=LISTS), HOME)
    fill({into / name: partial(_file, name) for name in made}, lambda: made)
    print_wrote([into / HOME])
    if is_opened:
        page, _, section = (topic or "").partition("#")
        place = f"#{page}-{section}" if section else ""
        click.launch((into / (file_of(page) if page else HOME)).resolve().as_uri() + place)


def _file(name: str, made: dict[str, str]) -> bytes:
    return made[name].encode()


def _own_folder() -> Path:
    """Where a page is kept that nobody gave a place."""
    from platformdirs import user_cache_dir

    return folder(user_cache_dir("qsbearing"))
