"""What every command prints with, and the codes that it ends with."""

from __future__ import annotations

import os
import sys
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, NoReturn

import click

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from rich.console import RenderableType

    from qsbearing.documents.model import Block, Callout, Paragraph
    from qsbearing.model.scene.scene import Scene
    from qsbearing.systems.sets.bearing_set import BearingSet

SOLVED, UNSOLVED, BAD_INPUT, NOT_MET = 0, 1, 2, 3


def refuse(message: str) -> NoReturn:
    """End with what is wrong with the input."""
    note(message)
    sys.exit(BAD_INPUT)


def refuse_all(problems: list[str]) -> None:
    """Say several things that are wrong at once, and end; go on where there is none."""
    if problems:
        refuse("\nqsbearing: ".join(problems))


def note(message: str, name: str = "qsbearing") -> None:
    """Lines on standard error; what they repeat of a file or a command line cannot steer the terminal.

    Where nobody can read them, the command goes on and ends as it would.
    """
    from qsbearing.model.validation import printable

    with suppress(OSError):
        click.echo("\n".join(map(printable, f"{name}: {message}".split("\n"))), err=True)


def note_remark(remark: Callout | Paragraph, about: str = "") -> None:
    """A remark as a note, with its line to paste below it."""
    said = getattr(remark, "said", remark.text)
    note(f"{about}{said}" + (f"\n    {remark.paste}" if remark.paste else ""))


@contextmanager
def warnings_as_notes() -> Iterator[None]:
    """What Python is warned of, to a user as a sentence."""
    import warnings

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        yield
    for each in caught:
        note(str(each.message))


def print_table(shown: RenderableType | Sequence[Block]) -> None:
    """Blocks of a document, or what rich prints, on standard output."""
    from qsbearing.documents.terminal import text_of

    print_text(text_of(shown))


def print_wrote(paths: Iterable[object]) -> None:
    """Say which files were written; as in a note, their names cannot steer the terminal."""
    from qsbearing.model.validation import printable

    print_text("".join(f"wrote {printable(str(path))}\n" for path in paths))


def print_result(of: Scene | BearingSet, record: dict[str, Any]) -> None:
    """A result as JSON, with the input that it is reproduced from."""
    import json

    from qsbearing.results.whole import with_input

    print_text(json.dumps(with_input(of, record), indent=1, allow_nan=False) + "\n")


def print_text(text: str) -> None:
    """Text to standard output, whatever characters it can show."""
    stream = sys.stdout
    encoding = getattr(stream, "encoding", None) or "utf-8"
    try:
        from qsbearing.documents.numbers import MINUS

        if not _is_shown(MINUS, encoding):  # a sign must not become a question mark
            text = text.replace(MINUS, "-")
        stream.write(text.encode(encoding, "replace").decode(encoding))
        stream.flush()
    except BrokenPipeError:
        # The reader has seen enough, as `| head` has. What is left in the buffer goes nowhere, or Python would try to
        # write it once more on its way out.
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
    except OSError as error:
        raise OSError(error.errno, error.strerror, "standard output") from None


def _is_shown(letter: str, encoding: str) -> bool:
    try:
        letter.encode(encoding)
    except UnicodeEncodeError:
        return False
    return True


@contextmanager
def progress_bar(unit: str = "points") -> Iterator[Callable[[int, int], None]]:
    """A bar with rate and time left, where there is a terminal to show it; yields what tells it what is done."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    console = Console(stderr=True)
    columns = (BarColumn(), TextColumn("{task.fields[shown]}"), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
        task = progress.add_task("", total=None, shown="")

        def update(done: int, count: int) -> None:
            speed = progress.tasks[0].speed or 0.0
            shown = f"{done:,} of {count:,} {unit}, {speed:,.0f} per second"
            progress.update(task, completed=done, total=count, shown=shown)

        yield update
