"""What tests expect of each shipped drive: one module per map, of the same name, typed by hand from its documents.

A new family is its map, its module here, and what `make blocks` writes. The names of a module, which leaves out what
does not apply (addresses are those on the wire):

    STATUS, FACES, CHART   the status word, what it is in each situation, and its bits that follow a chart of states
    FREQUENCY, COUNTS_PER_HZ, FAULT   output frequency; register and word in trip 18
    HELD       what its registers held in the manual's examples, by the id of the request
    PRINTED_WRONG   frames whose printed bytes are none, and what the blocks say of them
    CODES      refusals: function, address, quantity, value, read-only, running, busy
    PASSING    function that reads, and most words read and written on behalf of a person
    CONTROL    the weakest rung of what moves the motor, where that is not `read`
    PINS       pins without which nothing starts, besides those of every drive
    BRIEF      words of the six answers at the top of its page: wire, keypad, cable, reset, fault, speed
    ALIKE      commands, each with a value or bit that is called like it
    PLUG, TERMINATION, WIRED   pins with their wires; words of the resistors; whether a document says how to connect it
    KEYPAD     its settings: code | menu | as delivered | what it takes | a count; `-` for what no document prints.
               A value may carry a word of what the document says of it: `4=19200`
    ROWS, COMMANDS, REFERENCE ...   facts, which `tests/maps/test_facts_typed.py` compares with the map
"""

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from tests import shipped

HERE = Path(__file__).parent


def modules() -> dict[str, ModuleType]:
    """The modules by the prefix of their drive; a map without one is an error of import."""
    return {each.drive.prefix: import_module(f"tests.families.{Path(each.path).stem}") for each in shipped.sources()}


def own(name: str) -> dict[str, Any]:
    """What the modules that have this name say under it, by prefix."""
    return {prefix: getattr(each, name) for prefix, each in modules().items() if hasattr(each, name)}


def said(name: str) -> dict[str, Any]:
    """The same, where a drive whose map has a base is as that, unless its own module says otherwise."""
    return shipped.sisters(own(name))
