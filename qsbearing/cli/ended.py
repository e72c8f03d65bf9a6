"""How a command ends: each kind of end has an exit code of its own, so that a script can tell a crash from physics.

==============  ==================================================================================================
0, 1, 2         what the command itself says: done, no equilibrium (or out of tolerance), bad input
2               also what the computer refuses: a full disk, a closed output, too little memory
3               solved, but a requirement of [require] is not met, or a table errs by more than is wished
70              a defect of this program
128 + signal    ended by a signal: 130 by Ctrl-C, 143 by `kill` or `timeout`
==============  ==================================================================================================
"""

from __future__ import annotations

import errno
import gc
import os
import signal
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, NoReturn, TextIO

import click

from qsbearing.cli.output import BAD_INPUT, SOLVED, note

if TYPE_CHECKING:
    from types import TracebackType

DEFECT = 70
"""EX_SOFTWARE of sysexits.h."""
INTERRUPTED = 128 + signal.SIGINT
TRACEBACK = "QSBEARING_TRACEBACK"
"""Environment variable: with any text in it, an error of Python is shown whole."""
OF_THE_COMPUTER = {
    getattr(errno, name)
    for name in ("ENOSPC", "EDQUOT", "EROFS", "EACCES", "EPERM", "EIO", "ENOMEM", "EMFILE", "ENFILE", "EFBIG", "EPIPE")
    if hasattr(errno, name)
}
"""Of an OSError that no program can help."""
_ROOT = os.path.dirname(os.path.dirname(os.path.dirname(__file__)))  # noqa: PTH120 - pathlib costs --help its time
OWN = tuple(os.path.join(_ROOT, package, "") for package in ("qsbearing", "fem_check"))  # noqa: PTH118
"""How the names of our own files begin."""


def run_to_the_end(command: click.Command, name: str) -> NoReturn:
    """Run a command of the console and leave Python with its exit code, without a traceback."""
    signal.signal(signal.SIGTERM, _terminated)
    # At Python's own threshold a twentieth of a `run` goes into looking for garbage among what it has just imported.
    gc.set_threshold(100_000)
    if sys.stderr is None:  # closed by the shell: 2>&-
        sys.stderr = open(os.devnull, "w")  # noqa: SIM115, PTH123 - until Python ends
    if sys.stdout is None:
        note("standard output is closed: results cannot be shown", name)
        sys.exit(BAD_INPUT)
    code = _code_of(command, name)
    try:
        sys.stdout.flush()
    except OSError as error:
        code = code if isinstance(error, BrokenPipeError) else _refused(error, name)
    try:
        sys.stderr.flush()
    except OSError:  # a full disk keeps what was to be said: Python would end with 120 for it
        _silent(code, sys.stderr)
    sys.exit(code)


def _code_of(command: click.Command, name: str) -> int:
    try:
        if f"_{name}_COMPLETE".replace("-", "_").upper() in os.environ:  # a shell that asks for words to complete
            command.main(prog_name=name)
        with command.make_context(name, sys.argv[1:]) as context:  # click's own way ends with 1 by a signal or a pipe
            command.invoke(context)
        return SOLVED
    except click.exceptions.Exit as done:
        return done.exit_code
    except SystemExit as stopped:
        return stopped.code if isinstance(stopped.code, int) else SOLVED
    except click.ClickException as error:
        with suppress(OSError):
            error.show()
        return BAD_INPUT
    except (KeyboardInterrupt, click.Abort):
        note("interrupted", name)
        return INTERRUPTED
    except BrokenPipeError:
        return _silent(SOLVED)
    except Exception as error:
        return _refused(error, name)


def _refused(error: Exception, name: str) -> int:
    """The exit code of an error that no command has expected, said in one sentence."""
    from qsbearing.model.validation import SceneError

    if os.environ.get(TRACEBACK):
        import traceback

        with suppress(OSError):
            traceback.print_exception(error)
    if isinstance(error, SceneError):
        note(str(error), name)
        return BAD_INPUT
    if isinstance(error, MemoryError):
        note("there is not enough memory for this", name)
        return BAD_INPUT
    if isinstance(error, OSError) and error.errno in OF_THE_COMPUTER:
        note(f"{error.filename or 'standard output'}: {error.strerror}", name)  # files that we write have a name
        return _silent(BAD_INPUT)
    said = f"{type(error).__name__}: {str(error).partition(chr(10))[0]}".removesuffix(": ")
    note(
        f"a defect of this program, not of your input ({said}, {_place(error.__traceback__)})\n"
        f"    Please report it to those who gave you {name}, with this command, its files and what "
        f"{TRACEBACK}=1 makes it print",
        name,
    )
    return DEFECT


def _place(trace: TracebackType | None) -> str:
    """Our own innermost line of a traceback."""
    import traceback

    own = [each for each in traceback.extract_tb(trace) if each.filename.startswith(OWN)]
    last = (own or traceback.extract_tb(trace))[-1]
    return f"{os.path.basename(last.filename)} line {last.lineno}"  # noqa: PTH119


def _silent(code: int, stream: TextIO | None = None) -> int:
    """Throw away what Python would try to write to it (standard output) once more on its way out."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), (stream or sys.stdout).fileno())
    return code


def _terminated(number: int, frame: object) -> NoReturn:
    """End as after any error, so that no half-written file stays."""
    signal.signal(number, signal.SIG_IGN)  # `timeout` sends it twice
    sys.exit(128 + number)
