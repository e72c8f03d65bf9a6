"""`python -m qsbearing`: the same as the console script."""

from qsbearing.cli import main

if __name__ == "__main__":
    main()
