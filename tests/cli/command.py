"""The command in this process."""

from __future__ import annotations

from click.testing import CliRunner, Result

from qsbearing.cli import cli


def call(*arguments: object) -> Result:
    """One command; anything but a clean exit is an error."""
    result = CliRunner().invoke(cli, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exc_info
    return result
