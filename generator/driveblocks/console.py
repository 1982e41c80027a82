"""Where commands print: a terminal with colours, or a plain file or pipe; the same words and columns in both."""

import sys

from rich.console import Console, RenderableType

NARROWEST = 60
"""Columns below which tables would lose text; a narrower terminal breaks the lines itself."""


def use_utf8() -> None:
    """Make both standard streams UTF-8: under a C locale Python may choose ASCII, and the manuals are Chinese."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="replace")


def write(*pieces: RenderableType) -> None:
    """Print text and tables as wide as the terminal or COLUMNS, or 80 columns where neither is known.

    Text is printed as it is: no markup, no emoji names, no colouring by guess. What does not go to a terminal has no
    escape codes and no blanks at the end of a line.
    """
    console = Console(markup=False, emoji=False, highlight=False)
    console.width = max(console.width, NARROWEST)
    if console.is_terminal:
        for piece in pieces:
            console.print(piece)
        return
    with console.capture() as capture:
        for piece in pieces:
            console.print(piece)
    sys.stdout.write("".join(f"{line.rstrip()}\n" for line in capture.get().splitlines()))
