"""`qsbearing app`: a local page with sliders."""

from __future__ import annotations

import click

from qsbearing.cli.files import check_installed
from qsbearing.cli.output import note, refuse


@click.command(short_help="Explore a scene with sliders, in the browser.")
@click.argument("scene", default="b218")
@click.option("--port", type=click.IntRange(1, 65535), default=8218, show_default=True, help="Port of the page.")
@click.option(
    "--host",
    default="127.0.0.1",
    show_default=True,
    help="Address to serve on; other computers can open the page only at another address.",
)
@click.option("--open", "is_opened", is_flag=True, help="Open the page in the browser.")
def app(scene: str, port: int, host: str, is_opened: bool) -> None:
    """Serve a page on this computer that shows SCENE, a file or a bearing of the catalogue: its numbers as sliders and
    fields, its effects as switches, and beside them the resulting contacts, stiffness and life. Of a set of rows, a
    file with [[rows]], speed, loads (those on its shaft too) and preload are fields, and each row has a tab.

    The address that is printed has a token, without which nobody reads the scene.

    Exit codes: 0 ended, 2 bad input.
    """
    check_installed("app needs", ("starlette", "uvicorn", "jinja2", "matplotlib", "tomli_w"), "app")
    from qsbearing.app.server import EVERYWHERE, serve
    from qsbearing.model.validation import SceneError

    def ready(address: str) -> None:
        elsewhere = "; elsewhere with this computer's name in it" if host in EVERYWHERE else ""
        note(f"{address} shows {scene}{elsewhere}; Ctrl+C ends")
        if is_opened:
            import webbrowser

            webbrowser.open(address)

    try:
        serve(scene, host, port, ready)
    except SceneError as error:
        refuse(str(error))
