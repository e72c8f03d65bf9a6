"""What of a page can be run, in its order.

    ```toml     first line `# NAME.toml`: written to that file; `# NAME.toml, continued`: added to it; else my.toml
    ```xml      first line `<!-- NAME -->`: written to that file
    ```sh       commands of qsbearing and fem-check, run in this process; `> FILE` keeps what they print
    ```python   one program from the page's top to its end; what a line `print(...)  # -> TEXT` prints must be TEXT

    ```text     behind a block of commands that ran: lines that these print

A block behind the comment `<!-- minutes long -->` is left to the heavy tests. Commands of qsbearing inside a sentence,
in back quotes, run too, after the blocks, if they have arguments, none of which is a placeholder in
capitals or opens a browser. A command that another page has run on the same files is not run again.

Numbers of three digits and more in the sentences of a section are those that its examples print or have
(`tests/guide/told_numbers.py`).
"""

from __future__ import annotations

import contextlib
import io
import re
import shlex
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click
from click.testing import CliRunner

import qsbearing.cli
from tests.guide.mentions import NO_EXAMPLE, printed, unmentioned
from tests.guide.told_numbers import FROM_ELSEWHERE, unfounded

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "qsbearing" / "guide"
PAGES = [ROOT / "README.md", *sorted(GUIDE.glob("*.md"))]
"""README and guide."""
NOT_HERE = ("python", "python3", "pip", "pytest", "git")
"""The repository's own scripts, and the installation, which continuous integration runs."""
_BLOCK = re.compile(r"(<!-- minutes long -->\n+)?^```(\w+)\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)
_INLINE = re.compile(r"`(qsbearing [a-z][^`\n]*)`")
_PLACEHOLDER = re.compile(r"(?<![\w.])[A-Z]{3,}[A-Z.]*\b|\[|\.\.\.|--open")


REFUSED = {"inch.toml"}
"""Files that a page shows for the sentence with which they are refused."""
_RUN: dict[tuple[str, ...], tuple[set[str], str]] = {}
"""Commands that ended well, with the text of the scenes that they name: the remarks and all else that they print."""


@dataclass(frozen=True)
class Block:
    """A piece of a page that runs."""

    language: str
    text: str
    is_heavy: bool = False
    section: int = 0
    """Of its page, which headings divide."""


def blocks(page: Path) -> list[Block]:
    """The page's fenced blocks, then the commands in its sentences."""
    found, inline = [], dict[str, Block]()
    for number, section in enumerate(sections(page.read_text(encoding="utf-8"))):
        found += [Block(language, body, bool(heavy), number) for heavy, language, body in _BLOCK.findall(section)]
        for command in _INLINE.findall(sentences(section)):
            if len(command.split()) > 2 and not _PLACEHOLDER.search(command):
                inline.setdefault(command, Block("sh", command + "\n", section=number))
    return [*found, *inline.values()]


def sentences(text: str) -> str:
    """Without blocks."""
    return _BLOCK.sub("", text)


def sections(text: str) -> list[str]:
    """A page between its headings, which are not looked for in blocks."""
    fenced = [each.span() for each in _BLOCK.finditer(text)]
    heads = [each.start() for each in re.finditer(r"^#+ ", text, flags=re.MULTILINE)]
    heads = [at for at in heads if not any(start <= at < end for start, end in fenced)]
    return [text[start:end] for start, end in zip([0, *heads], [*heads, len(text)], strict=True)]


def commands(text: str) -> Iterator[list[str]]:
    """The words of each command of a shell block: comments, continued lines and the environment's folder taken away."""
    for line in text.replace("\\\n", " ").replace(" && ", "\n").splitlines():
        words = shlex.split(line, comments=True)
        if words:
            yield [words[0].removeprefix(".venv/bin/"), *words[1:]]


def run_command(words: list[str], folder: Path) -> tuple[set[str], str]:
    """Run one command with the folder as the current one; it must end well. The remarks that it prints, and all that it
    prints."""
    scenes = [folder / word for word in words if word.endswith(".toml")]
    done = (*words, *(path.read_text(encoding="utf-8") for path in scenes if path.exists()))
    if done in _RUN and ">" not in words:
        return _RUN[done]
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
    with contextlib.chdir(folder), printed() as said:
        result = CliRunner().invoke(program, words[1:], catch_exceptions=False)
    assert result.exit_code == 0, f"{shlex.join(words)}: exit code {result.exit_code}\n{result.output}"
    _RUN[done] = said, result.output
    if target:
        target.write_text(result.stdout, encoding="utf-8")
    return _RUN[done]


def write_file(text: str, folder: Path) -> str:
    """Keep a file that the page shows; its name."""
    named = re.match(r"(?:# |<!-- )([\w.]+\.(?:toml|rexs))(, continued)?(?: -->)?\n", text)
    name, continued = named.groups() if named else ("my.toml", None)
    with (folder / name).open("a" if continued else "w", encoding="utf-8") as file:
        file.write(text)
    return str(name)


def files_of(page: Path, folder: Path) -> Iterator[tuple[str, dict[str, Any]]]:
    """Every TOML block of a page as tables, behind what it continues, with the name of its file."""
    for block in blocks(page):
        if block.language == "toml":
            name = write_file(block.text, folder)
            yield name, tomllib.loads((folder / name).read_text(encoding="utf-8"))
            if not block.text.startswith(f"# {name}"):
                (folder / name).unlink()
        elif block.language == "sh":
            for words in commands(block.text):
                if words[:2] == ["qsbearing", "init"]:
                    run_command(words, folder)


def not_printed(text: str, output: str, last_digit: float = 0.0) -> list[str]:
    """Lines that a page shows and the command does not print.

    Args:
        last_digit: by how much numbers may differ in their last digit.
    """
    lines = [line.split() for line in output.splitlines()]
    return [line for line in text.splitlines() if not any(_alike(line.split(), each, last_digit) for each in lines)]


OF_ELEMENTS = 2.5
"""By how much numbers of finite elements differ in their last digit from one processor to another."""


def _alike(shown: list[str], printed: list[str], last_digit: float) -> bool:
    return len(shown) == len(printed) and all(map(_same, shown, printed, [last_digit] * len(shown)))


def _same(one: str, other: str, last_digit: float) -> bool:
    number = re.fullmatch(r"[−+]?\d+(?:\.(\d+))?(%|°)?", one)
    if one == other or not number:
        return one == other
    try:
        shown, printed = (float(each.rstrip("%°").replace("−", "-")) for each in (one, other))
    except ValueError:
        return False
    return abs(shown - printed) < last_digit * 10.0 ** -len(number[1] or "")


def run_program(text: str, folder: Path, names: dict[str, object]) -> str:
    """Run a Python block; what it says that it prints, it prints. All that it prints."""
    printed = io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(printed):
        exec(compile(text, "page", "exec"), names)
    for expected in re.findall(r"^print\(.*\)  # -> (.*)$", text, flags=re.MULTILINE):
        assert expected in printed.getvalue().splitlines(), f"{expected!r} is not among\n{printed.getvalue()}"
    return printed.getvalue()


def run_page(page: Path, folder: Path, *, heavy: bool) -> None:
    """Run the page's blocks in order, those that take minutes only if asked to."""
    names: dict[str, object] = {"__name__": "page"}
    text = page.read_text(encoding="utf-8")
    found = blocks(page)
    said: set[str] = set()
    examples: dict[int, str] = {}
    output = ran = ""
    for block in found:
        if block.language in ("toml", "xml"):
            write_file(block.text, folder)
        elif block.language == "text" and output:
            last_digit = OF_ELEMENTS if "fem-check" in ran else 0.0
            lacking = not_printed(block.text, output, last_digit)
            assert lacking == [], f"{page.name} shows what its commands do not print"
        elif block.is_heavy and not heavy:
            output = ""
        elif block.language == "sh":
            output, ran = "", block.text
            for words in commands(block.text):
                if words[0] not in NOT_HERE:
                    of_command, one = run_command(words, folder)
                    said, output = said | of_command, output + one
                    examples[block.section] = examples.get(block.section, "") + one
        elif block.language == "python":
            with printed() as of_program:
                one = run_program(block.text, folder, names)
            said = said | of_program
            examples[block.section] = examples.get(block.section, "") + one
    if sentences(text).strip() and page.name not in NO_EXAMPLE:
        unsaid = sorted(unmentioned(sentences(text), said))
        assert unsaid == [], f"{page.name} does not mention what its examples remark: {unsaid}"
        shown = " ".join(block.text for block in found)
        whole = examples.keys() - {block.section for block in found if block.is_heavy and not heavy}
        parts = sections(text)
        strange = {each for one in whole for each in unfounded(sentences(parts[one]), examples[one] + shown)}
        assert strange - set(FROM_ELSEWHERE.get(page.name, {})) == set(), f"{page.name}: no example gives {strange}"
