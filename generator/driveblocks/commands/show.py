"""`driveblocks show`: everything that a map holds about a drive, a register, a fault, the frames or the errata."""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import click

from driveblocks.commands import echo_json, refuse

if TYPE_CHECKING:
    from rich.console import RenderableType

    from driveblocks.maps.model import Drive

TOPICS = ("registers", "faults", "errors", "frames", "errata", "absent", "serial", "settings", "notices")


@click.command()
@click.argument("drive", metavar="DRIVE", help="Name or model number of a shipped drive, or the path of a map.")
@click.argument(
    "what",
    required=False,
    metavar="[REGISTER|FAULT|TOPIC]",
    help=f"A register by address or id, a fault by display or code, or one of {', '.join(TOPICS)}.",
)
@click.option("--json", is_flag=True, help="Print everything as JSON: the drive, or one topic of it.")
def run(drive: str, what: str | None, json: bool) -> None:
    """Show a drive, or one register, fault or topic of it.

    Examples: driveblocks show sn300g5, driveblocks show sn300g5 0026H, driveblocks show sn300g5 U1-07,
    driveblocks show sn300g5 1EH, driveblocks show chf errata, driveblocks show jscc --json
    """
    from driveblocks import console
    from driveblocks.maps import catalog, load

    path, known = load.named(drive)
    topic = what.lower() if what and what.lower() in TOPICS else None
    if json:
        _print_json(known, path.stem, what, topic)
    else:
        console.write(*_pages(known, catalog.shown(path), what, topic))


def _print_json(drive: "Drive", stem: str, what: str | None, topic: str | None) -> None:
    from driveblocks.maps import view

    if what is not None and topic is None:
        refuse(f"`--json` prints a whole drive or a topic, not `{what}`; topics are {', '.join(TOPICS)}")
    everything = view.of_drive(drive, stem)
    shown = {"drive": stem, topic: everything[topic]} if topic else everything
    echo_json(shown)


def _pages(drive: "Drive", file: str, what: str | None, topic: str | None) -> "Iterator[RenderableType]":
    if what is None:
        from driveblocks.show import overview

        return overview.pages(drive, file)
    return _topic(topic)(drive) if topic else _found(drive, what)


def _topic(topic: str) -> "Callable[[Drive], Iterator[RenderableType]]":
    from driveblocks.show import errata, faults, frames, line, registers

    pages: dict[str, Any] = {
        "registers": registers.tables, "faults": faults.faults, "errors": faults.errors, "frames": frames.frames,
        "errata": errata.errata, "absent": errata.absences, "serial": line.serial, "settings": line.settings,
        "notices": errata.notices,
    }  # fmt: skip
    return pages[topic]  # type: ignore[no-any-return]


def _found(drive: "Drive", word: str) -> "Iterator[RenderableType]":
    """The pages of everything that is written like the word; what else it may mean follows in one line each."""
    from driveblocks.maps import lookup
    from driveblocks.show import entry

    matches = lookup.find(drive, word)
    if not matches:
        refuse(_nothing(drive, word))
    chosen = [match for match in matches if match.spelled == matches[0].spelled]
    return entry.pages(drive, chosen, [match for match in matches if match not in chosen])


def _nothing(drive: "Drive", word: str) -> str:
    from driveblocks.maps import lookup

    near = lookup.near(drive, word, TOPICS)
    lines = [f"{drive.prefix} has no register, fault or topic `{word}`"]
    lines += ["nearest are", *(f"  {one}" for one in near)] if near else []
    return "\n".join([*lines, f"topics are {', '.join(TOPICS)}"])
