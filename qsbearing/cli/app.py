"""`qsbearing app`: a local page to work on a scene in."""

from __future__ import annotations

import click

from qsbearing.cli.files import check_installed
from qsbearing.cli.output import note, refuse
from qsbearing.cli.settings import set_option, settings_of


@click.command(short_help="Work on a scene in the browser.")
@click.argument("scene", default="b218")
@set_option
@click.option("--port", type=click.IntRange(1, 65535), default=8218, show_default=True, help="Port of the page.")
@click.option(
    "--host",
    default="127.0.0.1",
    show_default=True,
    help="Address to serve on; other computers can open the page only at another address.",
)
@click.option("--open", "is_opened", is_flag=True, help="Open the page in the browser.")
def app(scene: str, settings: tuple[str, ...], port: int, host: str, is_opened: bool) -> None:
    """Serve a page on this computer to work on SCENE, a file or a bearing of the catalogue: each of its five channels
    loaded, placed or free, its numbers as sliders and fields, its effects as switches with what they need, and beside
    them contacts, stiffness and life, what is required of them, and other states to compare with. Of a set of rows, a
    file with [[rows]], speed, loads (those on its shaft too) and preload are fields, and each row has a tab.

    The address that is printed has a token, without which nobody reads the scene. Behind # it keeps the state of the
    page, so that a reload finds it again.

    Exit codes: 0 ended, 2 bad input.
    """
    check_installed("app needs", ("starlette", "uvicorn", "jinja2", "matplotlib", "tomli_w"), "app")
    from qsbearing.app.server import EVERYWHERE, serve
    from qsbearing.model.validation import SceneError

    pairs = settings_of(settings)

    def ready(address: str) -> None:
        elsewhere = "; elsewhere with this computer's name in it" if host in EVERYWHERE else ""
        changed = f" with {', '.join(settings)}" if settings else ""
        note(f"{address} shows {scene}{changed}{elsewhere}; Ctrl+C ends")
        if is_opened:
            import webbrowser

            webbrowser.open(address)

    try:
        serve(scene, host, port, ready, pairs)
    except SceneError as error:
        refuse(str(error))
