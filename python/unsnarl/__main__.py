"""``python -m unsnarl`` is the program ``unsnarl``."""

from ._program import main

main()
