"""The guide's page on Hertz and finite elements of B218, from the records: `python -m tests.guide.agreement` writes it
and its picture."""

from __future__ import annotations

import textwrap
from typing import Any

from fem_check.report import agreement
from fem_check.report.sections import agreement as section
from fem_check.report.sections.agreement import CHECK, QUESTION, alt, caption
from fem_check.running import records_store
from tests.guide.pages import GUIDE

PAGE, PICTURE = GUIDE / "agreement.md", GUIDE / "agreement.svg"
WIDTH = 120
START, END = "<!-- agreement: made by tests/guide/agreement.py -->", "<!-- end of agreement -->"


def record() -> dict[str, Any]:
    """The check's, of the release level where there is one."""
    return dict(records_store.read_all()[CHECK])


def page(of: dict[str, Any]) -> str:
    """The page as text."""
    contacts = agreement.contacts_of(of)
    made = of["provenance"]
    rows = [[cell.replace("-", "−") if number > 2 else cell for number, cell in enumerate(line)]
            for line in agreement.lines(contacts)]  # fmt: skip
    table = [agreement.HEADINGS, ["---"] * len(agreement.HEADINGS), *rows]
    lines = ["| " + " | ".join(row) + " |" for row in table]
    right = agreement.solved_right(contacts)
    loads = " and ".join(
        ", ".join(f"{each:,.0f}" for each in part)
        for part in (sorted({each.load for each in contacts})[:-1], [max(each.load for each in contacts)])
    )
    parts = [
        f"# {QUESTION}",
        START,
        f"Approach, ellipse and pressure of {contacts[0].bearing}'s contacts at {loads} N on both raceways: Hertz's "
        "formulas, which `qsbearing` uses, beside finite elements that know nothing of them.",
        "\n".join(
            [
                *([f"- **The formulas are solved right.** {right}"] if right else []),
                f"- **In the real groove Hertz is an approximation.** {agreement.errs(contacts)}",
            ]
        ),
        "Both are computations, not measurements. What the differences come from, and what loads and angles of the "
        "whole bearing make of them, is told in [finite elements](finite_elements.md).",
        f"![{alt(contacts)}]({PICTURE.name})",
        f"*{caption(contacts)}. Below: true bodies − Hertz, with the uncertainty.*",
        "\n".join(lines),
        "- *Hertz*: at the contact angle under the load, which is beside it.\n"
        "- *half-spaces*: the same contact with Hertz's parabolic gap, for which he is exact: deviations are errors.\n"
        "- *true bodies*: half a ball and one pitch of the ring with their real surfaces. The approach counts from the "
        "ball's equator to the ring's rigid seat, so it holds the compliance of both bodies.",
        f"{agreement.made_by(of)} Record of {made['date'][:10]}, commit `{made['commit'][:12]}`. "
        f"All of it again: `{made['command']} --out my_results`.",
        END,
        "Contacts of your own bearing at loads of your choice, about a minute each:",
        "<!-- minutes long -->\n```sh\n.venv/bin/fem-check contact --scene b218 --race inner --load-N 2000 "
        "--angle loaded --geometry both\n```",
    ]
    return "\n\n".join(map(_wrapped, parts)) + "\n"


def _wrapped(part: str) -> str:
    """Paragraphs and items as other pages have them; headings, tables, pictures and commands as they are."""
    if part.startswith(("#", "|", "![", "<!--")):
        return part
    return "\n".join(
        textwrap.fill(line, WIDTH, subsequent_indent="  " if line.startswith("- ") else "") for line in part.split("\n")
    )


def drawn(of: dict[str, Any]) -> str:
    """The picture."""
    return section.drawn(agreement.contacts_of(of)).data.decode("utf-8")


def main() -> None:
    """Write both."""
    of = record()
    PAGE.write_text(page(of), encoding="utf-8")
    PICTURE.write_text(drawn(of), encoding="utf-8")


if __name__ == "__main__":
    main()
