"""Warnings that differ in their numbers alone, said once with the range of the numbers; JSON holds each by itself."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from qsbearing.model.ranked_warning import Rank, RankedWarning, capital, in_order, ranked, said_of

NUMBER = re.compile(
    r"\brows? \d+(?:(?:, | and | to )\d+)*(?: \([^)]*\))?|\(no\. [^)]*\)"  # the numbers of rows and balls are names
    r"|(?P<number>(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?!\w))",
    re.IGNORECASE,
)
ROW = re.compile(r"Row (\d+) \([^)]*\): (.*)")
SIDE = re.compile(r"\b(at|of) (an|the|that) (inner|outer)\b")
"""Where a sentence names its raceway, so that it can name both."""


def numbered(word: str, numbers: Sequence[int]) -> str:
    """A word with numbers in their order: row 1, rows 1 and 3, rows 1 to 4."""
    first, last = numbers[0], numbers[-1]
    if len(numbers) == 1:
        return f"{word} {first}"
    if len(numbers) > 2 and last - first == len(numbers) - 1:
        return f"{word}s {first} to {last}"
    return f"{word}s {', '.join(map(str, numbers[:-1]))} and {last}"


def together(
    word: str, said: Mapping[int, Iterable[str]], names: Mapping[int, str] | None = None
) -> list[RankedWarning]:
    """Warnings of several things, each once, after the things that have it.

    Args:
        word: for one of the things.
        said: of each, by its number.
        names: of each; a sentence that begins with its name or contains it says by itself whose it is.
    """
    names = names or {}
    alike: dict[tuple[str, Rank, str], dict[int, list[RankedWarning]]] = {}
    for number, sentences in said.items():
        for each in map(ranked, sentences):
            key = without_numbers(each, names.get(number)), each.rank, each.see
            alike.setdefault(key, {}).setdefault(number, []).append(each)
    return in_order(each for of in alike.values() for each in _of_several(word, of, names))


def rows_together(sentences: Sequence[str]) -> list[str]:
    """Sentences that begin with "Row 1 (its bearing):", those alike but for their numbers once, with their rows."""
    alike: dict[str, dict[int, str]] = {}
    for each in sentences:
        found = ROW.fullmatch(each)
        if found is None:
            alike[each] = {0: each}
        else:
            alike.setdefault(without_numbers(found[2]), {})[int(found[1])] = each
    return [next(iter(of.values())) if len(of) == 1 else _of_rows(of) for of in alike.values()]


def _of_rows(of: Mapping[int, str]) -> str:
    said = [found[2] for found in map(ROW.fullmatch, of.values()) if found is not None]
    return f"{capital(numbered('row', sorted(of)))}: {in_ranges(said)}"


def both_raceways(warnings: Iterable[str]) -> list[RankedWarning]:
    """The same of the inner and of the outer raceway, once."""
    found: dict[tuple[str, Rank, str], list[RankedWarning]] = {}
    for each in map(ranked, warnings):
        key = SIDE.sub(r"\1 \2", without_numbers(each))
        is_of_side = key != without_numbers(each)
        found.setdefault((key if is_of_side else each, each.rank, each.see), []).append(each)
    return [each for of in found.values() for each in _of_both(of)]


def without_numbers(text: str, name: str | None = None) -> str:
    """The sentence without its numbers."""
    text = text.replace(name, "each") if name else text
    return NUMBER.sub(lambda found: "#" if found["number"] else found[0], text)


def _of_several(word: str, of: Mapping[int, Sequence[RankedWarning]], names: Mapping[int, str]) -> list[RankedWarning]:
    (number, sentences), *others = of.items()
    name = names.get(number)
    if not others:
        which = capital(name or numbered(word, [number]))
        return [each if name and name in each else said_of(which, each) for each in dict.fromkeys(sentences)]
    texts = [each.replace(names[n], "each") if n in names else each for n, found in of.items() for each in found]
    text = RankedWarning(in_ranges(texts), sentences[0].rank, sentences[0].see)
    return [said_of(capital(numbered(word, sorted(of))), text)]


def _of_both(of: Sequence[RankedWarning]) -> list[RankedWarning]:
    first = of[0]
    sides = {found[3] for each in of for found in SIDE.finditer(each)}
    if len(of) == 1 or len(sides) == 1:
        return list(dict.fromkeys(of))
    text = SIDE.sub(lambda found: f"{found[1]} {found[2]} inner and {found[2]} outer", in_ranges(of))
    return [RankedWarning(text, first.rank, first.see)]


def in_ranges(sentences: Sequence[str]) -> str:
    """Sentences that differ in their numbers alone as one: where they do, the smallest and the largest."""
    ranges = iter([sorted(set(each), key=float) for each in zip(*map(_numbers, sentences), strict=True)])

    def both(found: re.Match[str]) -> str:
        if not found["number"]:
            return found[0]
        each = next(ranges)
        return each[0] if len(each) == 1 else f"{each[0]} to {each[-1]}"

    return NUMBER.sub(both, sentences[0])


def _numbers(text: str) -> Iterator[str]:
    return (found["number"] for found in NUMBER.finditer(text) if found["number"])
