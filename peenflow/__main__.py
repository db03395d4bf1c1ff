"""`python -m peenflow`, as job scripts call it."""

from peenflow.cli import main

main()
