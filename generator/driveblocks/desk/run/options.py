"""The words of the command line: what they are, and what does not go together."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from driveblocks.desk.words import LOOPBACK, NO_PORT, is_port


@dataclass(frozen=True, kw_only=True)
class Options:
    program: Path | None
    name: str | None = None
    maps: tuple[str, ...] = ()
    simulate: tuple[str, ...] = ()
    tcp: str | None = None
    simulated: bool = False
    port: str | None = None
    form: str | None = None
    scan: str = "10ms"
    watchdog: str | None = None
    length: str | None = None
    show: tuple[str, ...] = ()
    script: Path | None = None
    scenario: Path | None = None
    trace: Path | None = None
    picture: Path | None = None
    allow_run: bool = False
    demo: bool = False
    fast: bool = False

    @property
    def loopback(self) -> bool:
        return self.tcp is not None and self.tcp.rpartition(":")[0] in LOOPBACK

    @property
    def real(self) -> bool:
        """Whether real drives may hear it: nobody can know what is behind an address, so its user has to say."""
        return self.port is not None or (self.tcp is not None and not self.simulated)


def wrong(options: Options) -> Iterator[str]:
    if (options.program is None) != options.demo:
        yield "--demo brings its own program; leave yours out" if options.demo else "name a program, or write --demo"
    ways = [
        word
        for word, given in (("--simulate", options.simulate), ("--tcp", options.tcp), ("--port", options.port))
        if given
    ]
    if options.demo:
        ways.insert(0, "--demo")
    if len(ways) > 1:
        yield f"{' and '.join(ways)} exclude each other: drives are simulated, or real"
    if options.tcp is not None and not is_port(options.tcp.rpartition(":")[2]):
        yield f"--tcp {options.tcp} is no address; write HOST:PORT, with a port of 1 to 65535"
    if options.port == "":
        yield NO_PORT
    if options.simulated and not options.loopback:
        yield (
            f"--simulated is for a simulator of this computer; write --tcp {LOOPBACK[1]}:5020 --simulated, "
            "or name drives by --simulate"
        )
    if options.allow_run and not options.real:
        yield "--allow-run is for a real port; simulated drives may always run"
    yield from _wrong_files(options)
    if options.fast and (options.tcp or options.port):
        yield "--fast is for simulated drives; a port has its own time"
    if options.fast and not options.demo and options.length is None:
        yield "--fast needs --for: it would never end"


def _wrong_files(options: Options) -> Iterator[str]:
    if options.trace is not None and options.trace == options.picture:
        yield f"--trace and --picture both name {options.trace}; name two files"
    if options.scenario is not None and (options.tcp or options.port or options.demo):
        yield "--scenario is for drives that this run simulates; driveblocks simulate has its own, and so has --demo"
