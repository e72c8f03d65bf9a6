"""HTML: sound, complete, and of one piece; read back by a parser that knows nothing of how it was made."""

import dataclasses
import re

import pytest

from qsbearing.documents.data import BrokenLinkError
from qsbearing.documents.html import html
from qsbearing.documents.model import Badge, Code, Document, Md, Paragraph, Picture, RowGroup, Section, Table, Trace
from tests.documents.example import NASTY, curve, document
from tests.documents.page import Page

WHOLE = re.compile(r'<span class="whole">(.*?)</span>')


def test_a_page_is_sound_and_says_all() -> None:
    page = Page.of(html(document()))
    assert page.faults == []
    assert [text.removesuffix(" #") for _, text in page.headings] == [
        "One of everything", "Words", "Deeper", "Numbers", "Pictures",
    ]  # fmt: skip
    assert NASTY in page.text
    assert "Plain, leaning, heavy, typed_code and a table." in page.text
    assert "qsbearing run b218\n\n# αi = 41.49°" in page.text
    assert page.tables[0][2] == ["beta", "-2.5", "fail"]
    assert page.tables[1][-1] == [NASTY, "2"]
    assert "fem-check run patch_test --level quick" in page.text


def test_the_same_document_is_the_same_page() -> None:
    assert html(document()) == html(document())


@pytest.mark.parametrize(
    ("spoil", "fault"),
    [
        (lambda text: text.replace('id="numbers"', 'id="other"'), "#numbers leads nowhere"),
        (lambda text: text.replace("<h3", "<h5").replace("</h3>", "</h5>"), "level 5 after one of level 2"),
        (lambda text: text.replace("</figure>", "", 1), "where <figure> is open"),
        (lambda text: text.replace('aria-label="A line', 'data-label="A line'), "a picture without words"),
        (lambda text: text.replace("<style>", "<style>@import 'https://x.org/a.css';"), "loaded from elsewhere"),
        (lambda text: text.replace("<main", '<img src="http://x.org/a.png"><main'), "loaded from elsewhere"),
        (lambda text: text.replace("p1-", "p0-"), "two things are called"),
    ],
)
def test_the_judge_sees_what_is_wrong(spoil, fault) -> None:  # type: ignore[no-untyped-def]
    text = html(document())
    assert spoil(text) != text
    assert fault in "; ".join(Page.of(spoil(text)).faults)


def test_no_line_ends_within_an_option() -> None:
    words = [
        Paragraph(Md("Then `run --plot x.png`: *so*.")),
        Paragraph(Md("Or `qsbearing run a_long_name.toml --plot x.png`.")),
        Code(f"x --out a -y b --vary {'long' * 10}s -z {'long' * 12}", "sh"),
    ]
    text = html(Document("One", "two", [Section("Three", words)]))
    assert WHOLE.findall(text) == ["run --plot x.png", "--plot", "--out a", "-y b", "--vary", "long" * 10 + "s", "-z"]
    assert "a_long_<wbr>name.<wbr>toml" in text
    assert "Then run --plot x.png: so." in Page.of(text).text


def test_a_long_name_in_a_table_may_break() -> None:
    """Else the column of names takes the room of the others."""
    table = Table(("name", "is"), [["a_long_name_of_a_scene", "a_short & one"]])
    text = html(Document("One", "two", [Section("Three", [table])]))
    assert "a_<wbr>long_<wbr>name_<wbr>of_<wbr>a_<wbr>scene" in text
    assert "a_short &amp; one" in text


def test_a_command_is_shown_and_copied_as_it_is_written() -> None:
    lines = 'run "a & b" --out x  # it writes x\n\n# and <this>\nrun --csv y > <z>'
    text = html(Document("One", "two", [Section("Three", [Code(lines, "sh")])]))
    assert lines + "\n" in Page.of(text).text
    assert text.count('class="c1"') == 2


def test_a_number_is_not_parted_from_its_unit() -> None:
    text = html(
        Document("One", "two", [Section("Three", [Paragraph("At 10 000 rpm 5 % of 3 balls, 2 µm, 12 mm high.")])])
    )
    assert (
        "At 10\N{NO-BREAK SPACE}000\N{NO-BREAK SPACE}rpm 5\N{NO-BREAK SPACE}% of 3 balls, 2\N{NO-BREAK SPACE}µm" in text
    )


def test_a_unit_is_not_parted() -> None:
    text = html(Document("One", "two", [Section("Three", [Paragraph("In N/µm and N m/rad.")])]))
    assert "In N/\N{WORD JOINER}µm and N\N{NO-BREAK SPACE}m/rad." in text


def test_a_power_of_ten_and_the_value_of_a_symbol_are_not_parted() -> None:
    text = html(Document("One", "two", [Section("Three", [Paragraph("Within 3.4e-5 at a/b = 50, and Z = 3.")])]))
    assert 'Within <span class="whole">3.4e−5</span> at a/b\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}50' in text
    assert "Z\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}3." in text


def test_the_command_of_a_record_is_not_parted_at_its_options() -> None:
    text = html(
        Document("One", "two", [Section("Three", [Trace("r.json", "fem-check run conformity --level release")])])
    )
    assert '<span class="whole">--level</span> release' in text


def test_a_command_is_not_parted_at_its_hyphen() -> None:
    text = html(
        Document("One", "two", [Section("Three", [Paragraph(Md("See `fem-check run solution_contacts --scene x`."))])])
    )
    assert '<span class="whole">fem-check</span> run' in text


def test_a_backslash_stays_with_its_option() -> None:
    long = 'run \\\n  --vary "ball_diameter_mm=normal(22.225,0.0005)" \\\n  --out x \\\n  y'
    text = html(Document("One", "two", [Section("Three", [Code(long, "sh")])]))
    assert "0.0005)&#34; \\</span>" in text
    assert '<span class="whole">--out x \\</span>' in text


def test_a_table_or_picture_without_caption_leaves_no_room_for_one() -> None:
    blocks = [Table(("a",), [["1"]]), Picture(curve().data, "a curve")]
    text = html(Document("One", "two", [Section("Three", blocks)]))
    assert "<caption" not in text and "<figcaption" not in text


def test_a_caption_of_a_picture_is_a_sentence_and_that_of_a_table_a_heading() -> None:
    table = Table(("a", "b"), [["1", "2"]], caption="A table.")
    found = html(document(dataclasses.replace(curve(), caption="A line"), table))
    assert "A line.</figcaption>" in re.sub(r"\s*(</figcaption>)", r"\1", found)
    assert "A table</span></caption>" in found


def test_numbers_name_their_columns_where_rows_are_stacked() -> None:
    rows = [["a", "1", "2"]]
    several, one, none = (
        Table(("what", "mean\nN", "most"), rows, align, stack=stack)
        for align, stack in (("lrr", True), ("lrl", True), ("lrr", False))
    )
    found = [html(Document("One", "two", [Section("Three", [table])])) for table in (several, one, none)]
    assert [re.findall(r'data-of="([^"]*)"', text) for text in found] == [["mean N", "most"], [], []]


def test_no_style_or_script_is_written_into_the_pieces() -> None:
    """The page forbids the browser to load anything, and holds one script and one style, its own."""
    text = html(document())
    assert text.count("<script>") == 1 + 0
    assert "default-src 'none'" in text
    assert "<script>alert" not in text


def test_mistakes_of_whoever_writes_a_document_are_refused() -> None:
    with pytest.raises(BrokenLinkError, match="#nowhere"):
        html(document(Paragraph(Md("[lost](#nowhere)"))))
    with pytest.raises(ValueError, match="same name: words"):
        Document("x", "y", [Section("Words", []), Section("words", [])])
    with pytest.raises(ValueError, match="1 cells in a row of 2"):
        Table(("a", "b"), [["1"]])
    with pytest.raises(ValueError, match="no rows across"):
        Table(("a",), [RowGroup("x")], tools=True)
    with pytest.raises(ValueError, match="without words"):
        Picture(curve().data, " ")
    assert Badge("expected", "pass").kind == "pass"


def _luminance(colour: str) -> float:
    channels = [int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def test_colours_have_contrast_enough_to_be_read() -> None:
    """WCAG 2.1, 1.4.3: text at least 4.5 to 1 against what it stands on."""
    import re

    found = dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6});", html(document())))
    grounds = {"ink": ("paper", "faint"), "soft": ("paper", "faint"), "accent": ("paper",)}
    grounds |= {name: (f"{name}-back", "paper") for name in ("pass", "fail", "finding")}
    grounds["ink"] += ("pass-back", "fail-back", "finding-back")
    for text, behind in grounds.items():
        for ground in behind:
            light, dark = sorted((_luminance(found[text]), _luminance(found[ground])), reverse=True)
            assert (light + 0.05) / (dark + 0.05) >= 4.5, (text, ground)


def test_a_hollow_mark_has_no_filling() -> None:
    """Ghostscript, when it smooths lines, draws nothing of a mark whose filling is transparent."""
    from matplotlib.figure import Figure

    from qsbearing.documents.drawing import picture

    figure = Figure(figsize=(4.0, 2.0))
    figure.add_subplot().plot([0.0, 1.0], marker="s", markerfacecolor="none")
    drawn = picture(figure, "A line.").data.decode()
    assert "fill: none; stroke: #1f77b4" in drawn
    assert "fill-opacity: 0;" not in drawn


def test_a_heading_keeps_the_letter_of_its_raceway_or_axis() -> None:
    table = Table(("ball", "angle o\ndeg", "radial y", "load of a ball"), [["0", "1", "2", "3"]])
    assert [each for each in WHOLE.findall(html(document(table))) if " " in each][-2:] == ["angle o", "radial y"]


def test_no_line_ends_within_a_power_of_ten_or_after_an_estimate_s_sign() -> None:
    page = html(Document("T", "", [Section("S", [Paragraph("within 1e-11, ≈ 400 %")])]))
    assert "1e−11" in WHOLE.findall(page)
    assert "≈\N{NO-BREAK SPACE}400\N{NO-BREAK SPACE}%" in page
