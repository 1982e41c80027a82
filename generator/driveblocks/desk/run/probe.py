"""A program after its first scan, without a port: what it says of its line and its drives before anything is sent."""

import threading
from collections.abc import Callable, Sequence

from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import VirtualClock
from driveblocks.desk.port import WirePort
from driveblocks.desk.run import source, wiring
from driveblocks.desk.run.controller import Controller
from driveblocks.maps.collection import Source as Map
from driveblocks.maps.problem import Refused
from structured_text.engines.engine import BuildError, ScanError


def compiled(
    name: str,
    text: str,
    maps: Sequence[Map],
    program: str | None = None,
    tell: Callable[[float], None] = lambda _: None,
) -> source.Loaded:
    """Compile a text; `name` is what its messages begin with; `tell` takes the share done. Raises Refused."""
    try:
        return source.load(name, text, maps, program, tell)
    except BuildError as error:
        raise Refused(f"{error}{source.advice(str(error))}") from None


def controller(loaded: source.Loaded, scan_us: int) -> Controller:
    """An instance of a program. Raises Refused."""
    try:
        wired = wiring.find(loaded.program, set(loaded.drives))
    except BuildError as error:
        raise Refused(str(error)) from None
    return Controller(loaded.library, loaded.program.name, wired, loaded.drives, scan_us)


def probed(loaded: source.Loaded, scan_us: int, limit_us: int) -> Controller:
    """The program after one scan, which may take `limit_us`. Raises Refused."""
    probe = controller(loaded, scan_us)
    port, *others = (WirePort(Bus([], 9600, 10), VirtualClock()) for _ in probe.lines)
    probe.connect(port, None, *others)
    errors: list[ScanError] = []

    def scan() -> None:
        try:
            probe.scan(scan_us)
        except ScanError as error:
            errors.append(error)

    thread = threading.Thread(target=scan, daemon=True)
    thread.start()
    thread.join(limit_us / 1e6)
    if thread.is_alive():
        place = probe.place(thread.ident)
        raise Refused(f"{place}: the first scan has not ended within {limit_us / 1e6:g} s; nothing was sent")
    for error in errors:
        raise Refused(str(error)) from None
    return probe
