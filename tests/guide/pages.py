"""What of a page can be run, in its order.

    ```toml     first line `# NAME.toml`: written to that file; `# NAME.toml, continued`: added to it; else my.toml
    ```xml      first line `<!-- NAME -->`: written to that file
    ```sh       commands of qsbearing and fem-check, run in this process; `> FILE` keeps what they print
    ```python   one program from the page's top to its end; what a line `print(...)  # -> TEXT` prints must be TEXT

A block behind the comment `<!-- minutes long -->` is left to the heavy tests. Commands of qsbearing inside a sentence,
in back quotes, run too, after the blocks, if they have arguments, none of which is a placeholder in
capitals or opens a browser. A command that another page has run on the same files is not run again.
"""

from __future__ import annotations

import contextlib
import io
import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import click
from click.testing import CliRunner

import qsbearing.cli

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "qsbearing" / "guide"
NOT_HERE = ("python", "python3", "pip", "pytest")
"""The repository's own scripts, and the installation, which continuous integration runs."""
_BLOCK = re.compile(r"(<!-- minutes long -->\n+)?^```(\w+)\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)
_INLINE = re.compile(r"`(qsbearing [a-z][^`\n]*)`")
_PLACEHOLDER = re.compile(r"(?<![\w.])[A-Z]{3,}[A-Z.]*\b|\[|\.\.\.|--open")


_RUN: set[tuple[str, ...]] = set()
"""Commands that ended well, with the text of the scenes that they name."""


@dataclass(frozen=True)
class Block:
    """A piece of a page that runs."""

    language: str
    text: str
    is_heavy: bool = False


def blocks(page: Path) -> list[Block]:
    """The page's fenced blocks, then the commands in its sentences."""
    text = page.read_text(encoding="utf-8")
    found = [Block(language, body, bool(heavy)) for heavy, language, body in _BLOCK.findall(text)]
    sentences = _BLOCK.sub("", text)
    inline = [command for command in _INLINE.findall(sentences) if not _PLACEHOLDER.search(command)]
    return found + [Block("sh", command + "\n") for command in dict.fromkeys(inline) if len(command.split()) > 2]


def commands(text: str) -> Iterator[list[str]]:
    """The words of each command of a shell block: comments, continued lines and the environment's folder taken away."""
    for line in text.replace("\\\n", " ").replace(" && ", "\n").splitlines():
        words = shlex.split(line, comments=True)
        if words:
            yield [words[0].removeprefix(".venv/bin/"), *words[1:]]


def run_command(words: list[str], folder: Path) -> None:
    """Run one command with the folder as the current one; it must end well."""
    scenes = [folder / word for word in words if word.endswith(".toml")]
    done = (*words, *(path.read_text(encoding="utf-8") for path in scenes if path.exists()))
    if done in _RUN and ">" not in words:
        return
    target = None
    program: click.Command
    if ">" in words:
        at = words.index(">")
        target, words = folder / words[at + 1], words[:at]
    if words[0] == "fem-check":
        from fem_check.cli import cli as program
    else:
        assert words[0] == "qsbearing", f"{words[0]} is not a command of this project"
        program = qsbearing.cli.cli
    with contextlib.chdir(folder):
        result = CliRunner().invoke(program, words[1:], catch_exceptions=False)
    assert result.exit_code == 0, f"{shlex.join(words)}: exit code {result.exit_code}\n{result.output}"
    _RUN.add(done)
    if target:
        target.write_text(result.stdout, encoding="utf-8")


def write_file(text: str, folder: Path) -> None:
    """Keep a file that the page shows."""
    named = re.match(r"(?:# |<!-- )([\w.]+\.(?:toml|rexs))(, continued)?(?: -->)?\n", text)
    name, continued = named.groups() if named else ("my.toml", None)
    with (folder / name).open("a" if continued else "w", encoding="utf-8") as file:
        file.write(text)


def run_program(text: str, folder: Path, names: dict[str, object]) -> None:
    """Run a Python block; what it says that it prints, it prints."""
    printed = io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(printed):
        exec(compile(text, "page", "exec"), names)
    for expected in re.findall(r"^print\(.*\)  # -> (.*)$", text, flags=re.MULTILINE):
        assert expected in printed.getvalue().splitlines(), f"{expected!r} is not among\n{printed.getvalue()}"


def run_page(page: Path, folder: Path, *, heavy: bool) -> int:
    """Run the page's blocks in order; how many heavy ones there were."""
    names: dict[str, object] = {"__name__": "page"}
    count = 0
    for block in blocks(page):
        count += block.is_heavy
        if block.language in ("toml", "xml"):
            write_file(block.text, folder)
        elif block.is_heavy and not heavy:
            continue
        elif block.language == "sh":
            for words in commands(block.text):
                if words[0] not in NOT_HERE:
                    run_command(words, folder)
        elif block.language == "python":
            run_program(block.text, folder, names)
    return count
