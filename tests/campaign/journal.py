"""The campaign's journal: one line a finished chunk, appended; what is there need not be done again."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from tests.campaign.sizes import CHUNK, GROUP


class Journal:
    """`chunks.jsonl` in the campaign's folder: a heading, then the chunks in the order in which they were done.

    Raises:
        ValueError: the folder holds another campaign, or one that was not asked to be resumed.
    """

    def __init__(self, folder: Path, seed: int, source: str, *, resume: bool) -> None:
        self.path = folder / "chunks.jsonl"
        self._heading = {"seed": seed, "chunk": CHUNK, "group": GROUP, "source": source}
        self.chunks: list[dict[str, Any]] = []
        if self.path.exists():
            if not resume:
                raise ValueError(f"{self.path} holds a campaign already: --resume to go on with it, or another --out")
            self._read()
        else:
            folder.mkdir(parents=True, exist_ok=True)
            self._append(self._heading)

    def _read(self) -> None:
        whole = self.path.read_bytes()
        kept = whole[: whole.rfind(b"\n") + 1]  # a line that was cut off is done again
        lines = [json.loads(line) for line in kept.splitlines()]
        if not lines:
            self._append(self._heading)
            return
        if lines[0] != self._heading:
            raise ValueError(f"{self.path} holds another campaign: {lines[0]}, not {self._heading}")
        if len(kept) < len(whole):
            self.path.write_bytes(kept)
        self.chunks = lines[1:]

    def _append(self, line: dict[str, Any]) -> None:
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")

    def add(self, chunk: dict[str, Any]) -> None:
        """Keep a finished chunk."""
        self.chunks.append(chunk)
        self._append(chunk)

    def done(self) -> dict[int, int]:
        """How many scenes of which chunks are done."""
        return {chunk["chunk"]: chunk["scenes"] for chunk in self.chunks}
