"""The driver of all checks: the parts in C, with what the maps say about each family between them."""

from collections.abc import Sequence
from pathlib import Path

from tests.native.driver import Driver
from tests.native.exhaustive import permissions, references, scan, standstills, words
from tests.native.exhaustive.bench import Bench

from driveblocks.maps.model import Drive
from driveblocks.render.results import code
from structured_text.engines.engine import Source
from structured_text.engines.matiec import MatiecEngine

RESULTS = ("NOT_A_NUMBER", "NEGATIVE", "NO_SCALE", "NO_MAXIMUM", "NO_FULL_SCALE")


def text() -> str:
    """The whole driver after its prelude."""
    shared = [_part("scans"), scan.table(words.SCANS), _part("checksums"), _part("permissions"), permissions.table()]
    parts = [*(f"#define {name} {code(name)}" for name in RESULTS), _part("families")]
    parts += [_family(drive) for drive in standstills.families().values()]
    rows = [
        f'    {{"{prefix}", {prefix}_standstill, {prefix}_sweep, {prefix}_patterns}},'
        for prefix in standstills.families()
    ]
    table = ["static const Family FAMILIES[] = {", *rows, "    {NULL, NULL, NULL, NULL},", "};"]
    return "\n".join([*shared, *parts, *table, _part("main")])


def _part(name: str) -> str:
    return Path(__file__).with_name(f"{name}.c").read_text(encoding="utf-8")


def _family(drive: Drive) -> str:
    """The parts that are compiled once for each family."""
    first, second = (pin.upper() for pin in standstills.pins(drive))
    names = {"FAMILY": drive.prefix, "FIRST_WORD": first, "SECOND_WORD": second, **references.defines(drive)}
    before = [f"#define {name} {value}" for name, value in names.items()]
    return "\n".join([*before, _part("standstills"), _part("references"), *(f"#undef {name}" for name in names), ""])


def bench(engine: MatiecEngine, texts: Sequence[Source] = ()) -> Bench:
    """Compile the driver with the library, or with other ST of the same blocks, on a line of matiec."""
    return Bench(engine.name, Driver(text()).build(engine, texts))
