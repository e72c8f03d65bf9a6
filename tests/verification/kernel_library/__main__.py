"""`python -m tests.verification.kernel_library`: make the kernel's machine code from its source.

Without a word, this platform's library alone, into a folder that is not committed: for work on the kernel. With `all`,
those of every platform, which are committed and come with the package; it needs the versions of the extra "kernel".
With `compare`, `all` again and beside what is committed: the same bytes, or an error.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from tests.verification.kernel_library import build


def main(asked: str = "own") -> None:
    """Do it."""
    if asked == "own":
        print(build.make_own())
    elif asked == "all":
        for path in build.make_all(build.FOLDER):
            print(path)
    elif asked == "compare":
        with tempfile.TemporaryDirectory() as folder:
            build.make_all(Path(folder))
            differing = build.differing(Path(folder), build.FOLDER)
        if differing:
            raise SystemExit(f"made again, these differ from what is committed: {', '.join(differing)}")
    else:
        raise SystemExit(f"{asked}: must be own, all or compare")


main(*sys.argv[1:])
