"""A document with one of everything, and texts that would break a careless page."""

from __future__ import annotations

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import (
    Badge,
    Block,
    Bullets,
    Callout,
    Code,
    Document,
    Facts,
    Md,
    Paragraph,
    Picture,
    RowGroup,
    Section,
    Table,
    Trace,
)

NASTY = 'a_b*c* <script>alert(1)</script> & "quotes" `code` [x](y) # $ \\ @ρ'


def curve(alt: str = "A line that rises from zero to one.") -> Picture:
    """A small picture."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(4.0, 2.0))
    axes = figure.add_subplot()
    axes.plot([0.0, 1.0], [0.0, 1.0], marker="o", clip_on=True)
    axes.set_xlabel("load, N")
    return picture(figure, alt, "Load by load")


def document(*more: Block) -> Document:
    """One of everything."""
    rows = [[name, value, Badge(word)] for name, value, word in (
        ("alpha", "10", "pass"), ("beta", "-2.5", "fail"), ("gamma", "1e-3", "pass"), ("delta", "", "finding"),
    )]  # fmt: skip
    return Document(
        "One of everything",
        "Test page",
        [
            Section(
                "Words",
                [
                    Paragraph(Md("Plain, *leaning*, **heavy**, `typed_code` and [a table](#numbers).")),
                    Paragraph(NASTY),
                    Bullets(["first", Md("`second`")]),
                    Bullets(["first", "second"], numbered=True),
                    Code("qsbearing run b218\n\n# αi = 41.49°", "sh"),
                    Callout("Beware.", "warning"),
                    Section("Deeper", [Facts([("commit", "0f3a"), ("verdict", Badge("pass"))]), *more]),
                ],
            ),
            Section("Numbers", [
                Table(("name", "value", "verdict"), rows, "lrl", "To be sorted", tools=True),
                Table(("", "a"), [RowGroup("first"), ["x_y", "1"], RowGroup("second"), [NASTY, "2"]]),
                Trace("quick/patch_test.json", "fem-check run patch_test --level quick", "qsbearing 0.1.0"),
            ]),
            Section("Pictures", [curve(), curve("The same line once more.")]),
        ],
        summary="What every form must show.",
        head=[Callout("All is well.", "pass")],
    )  # fmt: skip
