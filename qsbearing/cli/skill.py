"""`qsbearing skill`: how a language model works with the commands."""

from __future__ import annotations

import click

from qsbearing.cli.output import print_text


@click.command(short_help="Print a skill for language models.")
def skill() -> None:
    """Print SKILL.md: which command answers what, how to read remarks and statuses, what not to claim. Programs that
    know skills read it from a folder of that name, such as .claude/skills/qsbearing/SKILL.md.
    """
    from qsbearing.documents.guide import skill_text

    print_text(skill_text())
