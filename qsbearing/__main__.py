"""`python -m qsbearing`: the same as the console script."""

from qsbearing.cli import main

main()
