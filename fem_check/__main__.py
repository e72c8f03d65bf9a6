"""`python -m fem_check` is `fem-check`."""

from fem_check.cli import main

__all__ = ["main"]

if __name__ == "__main__":
    main()
