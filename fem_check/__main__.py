"""`python -m fem_check` is `fem-check`."""

import os

# Before numpy is loaded: its matrices here have some hundred rows, for which a second thread only waits: beside other
# processes up to twenty times the processor time of the first. The sparse solver has threads of its own.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from fem_check.cli import main

__all__ = ["main"]

if __name__ == "__main__":
    main()
