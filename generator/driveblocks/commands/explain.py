"""`driveblocks explain`: what a pasted frame says, or what is wrong with it and what it might be instead."""

import sys
from typing import TYPE_CHECKING

import click

from driveblocks.commands import echo_json

if TYPE_CHECKING:
    from driveblocks.desk.explain.explanation import Explanation
    from driveblocks.maps.model import Drive


@click.command()
@click.argument(
    "frame",
    metavar="FRAME",
    help="The frame as it was logged: bytes in hexadecimal, a hexdump, or the characters of an ASCII frame;"
    " - reads standard input.",
)
@click.option("--drive", metavar="DRIVE", help="Name or model number of a shipped drive, or the path of a map.")
@click.option("--request", metavar="FRAME", help="The request that the frame should answer.")
@click.option("--json", is_flag=True, help="Print everything as JSON.")
def run(frame: str, drive: str | None, request: str | None, json: bool) -> None:
    """Explain a frame, or say what is wrong with it.

    A good frame is shown as its fields, checksum, registers and values, a wrong one with what it might be instead.
    Without a drive the standard alone is used. The exit status is 0 for a good frame, 1 for a wrong one, and 2 if the
    input cannot be read.

    Example: driveblocks explain "01 03 02 01 F4 B8 53" --drive jscc --request "01 03 20 00 00 01 8F CA"
    """
    from driveblocks.desk.explain.explanation import Explainer
    from driveblocks.desk.explain.paste import read
    from driveblocks.maps import load

    path, known = load.named(drive) if drive is not None else (None, None)
    asked = read(request, "request") if request is not None else None
    pasted = read(_stdin(), "stdin") if frame == "-" else read(frame, "frame")
    made = Explainer(known).explain(pasted, asked)
    _print(made, known, path.stem if path is not None else None, json)
    if not made.good:
        sys.exit(1)


def _stdin() -> str:
    """Standard input as text; bytes that are none are shown as they are, so that their place can be reported."""
    from driveblocks.desk.explain.paste import LONGEST

    return sys.stdin.buffer.read(LONGEST + 1).decode("utf-8", "replace")


def _print(made: "Explanation", drive: "Drive | None", stem: str | None, json: bool) -> None:
    if json:
        from driveblocks.desk.explain import plain

        echo_json(plain.of_explanation(made, stem))
        return
    from driveblocks import console
    from driveblocks.desk.explain import page

    console.write(*page.pages(made, drive))
