"""Files that a command writes: their places tried before the work begins, each then written whole or not at all."""

from __future__ import annotations

import importlib.util
import os
import warnings
from contextlib import ExitStack
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from qsbearing.cli.output import note, refuse, refuse_all

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    import xarray
    from matplotlib.figure import Figure

    from qsbearing.files.output_file import Writer

PICTURES = (".png", ".svg", ".pdf")
T = TypeVar("T")
K = TypeVar("K")


def ending(name: str) -> str:
    """Of a file's name, in small letters."""
    return os.path.splitext(name)[1].lower()  # noqa: PTH122 - pathlib costs --help its time


def missing(*modules: str) -> list[str]:
    """Those of the modules that are not installed."""
    return [name for name in modules if importlib.util.find_spec(name) is None]


def how_to_install(extra: str) -> str:
    """The command that does, for this copy."""
    from qsbearing.documents.installation import pip_install  # not at the start of every command

    return pip_install(extra)


def check_installed(what: str, modules: tuple[str, ...], extra: str) -> None:
    """End with what to install, where something is missing."""
    if lacks := missing(*modules):
        refuse(f"{what} {', '.join(lacks)}: {how_to_install(extra)}")


def ending_problems(option: str, target: str, known: tuple[str, ...]) -> list[str]:
    """Of a name whose ending says how to write the file."""
    return [] if ending(target) in known else [f"{option} {target}: the name must end in one of {', '.join(known)}"]


NOT_CSV = (".xlsx", ".xls", ".ods", ".parquet", ".json", ".nc", ".toml", ".html", *PICTURES)


def csv_problems(target: str | None) -> list[str]:
    """Of --csv: a name that says another form than what is written."""
    form = ending(target or "")
    said = f"--csv {target}: the file is CSV, which Excel opens; its name must not end in {form}"
    return [said] if form in NOT_CSV else []


def picture_problems(picture: str | None) -> list[str]:
    """Of --plot."""
    if picture is None:
        return []
    needs = [f"--plot needs matplotlib: {how_to_install('plot')}"] if missing("matplotlib") else []
    return ending_problems("--plot", picture, PICTURES) + needs


def claimed(
    stack: ExitStack, targets: Mapping[str, str | None], problems: list[str], scene: str | None = None
) -> dict[str, Writer]:
    """What writes each file that is asked for, by its option; ends with these problems and where a file cannot be.

    Args:
        scene: what is read, and must not be written over.
    """
    requested = {option: target for option, target in targets.items() if target is not None}
    known = {} if scene is None or not requested else {os.path.realpath(scene): "SCENE"}
    for option, target in requested.items():
        other = known.setdefault(os.path.realpath(target), option) if target else option
        if other != option:
            problems.append(f"{option}: the same file as {other}")
    writers = {}
    for option, target in requested.items():
        from qsbearing.files.output_file import output_file

        try:
            writers[option] = stack.enter_context(output_file(target))
        except (OSError, ValueError) as error:
            problems.append(f"{option} {target}: {error}")
    refuse_all(problems)
    return writers


def write_files(writers: Mapping[K, Writer], make: Mapping[K, Callable[[], bytes]]) -> None:
    """Write the files that were claimed, once all of them are made: all of them, or none."""
    contents = {option: make[option]() for option in writers}
    try:
        for option, writer in writers.items():
            writer.fill(contents[option])
        for writer in writers.values():
            writer.put()
    except OSError as error:  # a disk that filled up meanwhile
        refuse(f"cannot write: {error}")


def folder(target: str) -> Path:
    """The folder of that name, made if it is not there; ends with exit code 2 where there cannot be one."""
    from pathlib import Path  # not above: it costs --help its time

    path = Path(target)
    try:
        path.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        refuse(f"{target}: cannot be a folder: {getattr(error, 'strerror', None) or error}")
    return path


def fill(makers: Mapping[Path, Callable[[T], bytes]], make: Callable[[], T]) -> None:
    """Claim every file of a folder, then make what they show and write it in each form: all of them, or none."""
    from qsbearing.files.output_file import output_file

    with ExitStack() as stack:
        writers = {}
        for path in makers:
            try:
                writers[path] = stack.enter_context(output_file(str(path)))
            except OSError as error:
                refuse(f"{path}: {error}")
        content = make()
        write_files(writers, {path: partial(maker, content) for path, maker in makers.items()})


def picture_bytes(picture: Figure, target: str) -> bytes:
    """A picture in the form that the file's name asks for."""
    from io import BytesIO

    data = BytesIO()
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        picture.savefig(data, format=ending(target)[1:])
    lacking = [each for each in said if str(each.message).startswith("Glyph")]  # in matplotlib's words, one for each
    if lacking:
        note(BOXES.format(where=target))
    for each in said:
        if each not in lacking:
            warnings.warn_explicit(each.message, each.category, each.filename, each.lineno)
    return data.getvalue()


BOXES = "letters that no font here has are boxes in {where}"


def draw(results: xarray.Dataset, target: str, **chosen: Any) -> bytes:
    """The picture of a study's results; ends with exit code 2 where they cannot be drawn."""
    from qsbearing.pictures.study import PictureError, picture

    try:
        return picture_bytes(picture(results, **chosen), target)
    except PictureError as error:
        refuse(str(error))
