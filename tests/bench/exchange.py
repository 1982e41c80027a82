"""Measurement of a read of ten registers: request built, reply parsed, RTU and ASCII, by everybody who can."""

from collections.abc import Iterable

from pymodbus.framer import FramerAscii, FramerRTU
from pymodbus.framer.base import FramerBase
from pymodbus.pdu import DecodePDU
from pymodbus.pdu.register_message import ReadHoldingRegistersRequest, ReadHoldingRegistersResponse
from tests.bench.forms import NATIVE, ROUNDS, texts, timed
from tests.bench.inputs import WORDS
from tests.bench.record import Rows
from tests.bench.turns import Work, side_by_side

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import EngineError, Instance
from structured_text.engines.matiec import MatiecEngine

FRAMERS: dict[str, type[FramerBase]] = {"rtu": FramerRTU, "ascii": FramerAscii}
CHAINS = {"drive": "BN_Drive", "any": "BN_Any"}


def native(engines: Iterable[MatiecEngine], rounds: int = ROUNDS) -> Rows:
    """Nanoseconds of each `ask rtu`, `read ascii` ...: columns `c` by hand, `drive` and `any` by blocks, of each line.

    Raises EngineError if a reply is not believed, or a request is not what pymodbus sends.
    """
    rows: Rows = {}
    for engine in engines:
        taken, said = timed(engine, (NATIVE / "exchange.c").read_text("utf-8"), *WORDS, rounds=rounds)
        for line in said:
            name, frame = line.split(" ")
            if frame != ask(FRAMERS[name.rpartition("_")[2]](DecodePDU(False))).hex():
                raise EngineError(f"{engine.name}: {name} makes {frame}")
        for form, one in taken.items():
            who, _, what = form.partition(" ")
            columns = rows.setdefault(what, {})
            columns[f"{who} {engine.name}"] = one.least
            columns[f"{who} {engine.name} median"] = one.median
    return rows


def python(rounds: int = 300) -> Rows:
    """The same by pymodbus and by the blocks on the embedded engine, in this process."""
    rows: Rows = {}
    for mode in FRAMERS:
        everybody = {"pymodbus": _pymodbus(mode), **_embedded(mode)}
        works = {f"{what} {mode}|{who}": work for who, each in everybody.items() for what, work in each.items()}
        for name, taken in side_by_side(works, rounds).items():
            what, _, who = name.partition("|")
            columns = rows.setdefault(what, {})
            columns[who], columns[f"{who} median"] = taken.least, taken.median
    return rows


def measure(engines: Iterable[MatiecEngine]) -> Rows:
    """Everybody. Raises EngineError as the two do."""
    rows = native(engines)
    for what, columns in python().items():
        rows.setdefault(what, {}).update(columns)
    return rows


def ask(framer: FramerBase) -> bytes:
    """The request as pymodbus's client sends it."""
    return framer.buildFrame(ReadHoldingRegistersRequest(address=0, count=len(WORDS), dev_id=1))


def answer(mode: str) -> bytes:
    """The reply as pymodbus's server sends it."""
    return FRAMERS[mode](DecodePDU(True)).buildFrame(ReadHoldingRegistersResponse(registers=WORDS, dev_id=1))


def _pymodbus(mode: str) -> dict[str, Work]:
    client, reply = FRAMERS[mode](DecodePDU(False)), answer(mode)
    pdu = client.handleFrame(reply, 0, 0)[1]
    if pdu is None or pdu.registers != WORDS:
        raise EngineError("pymodbus does not understand its own reply")
    return {"ask": lambda: ask(client), "read": lambda: client.handleFrame(reply, 0, 0)}


def _embedded(mode: str) -> dict[str, dict[str, Work]]:
    library = EmbeddedEngine().build(texts())
    works: dict[str, dict[str, Work]] = {}
    for who, prefix in CHAINS.items():
        asks = library.instance(f"{prefix}Ask{mode.title()}")
        reads = library.instance(f"{prefix}Read{mode.title()}")
        box = "Chars" if mode == "ascii" else "Adu"
        reads[box], reads["Count"] = answer(mode), len(answer(mode))
        _judge(asks, reads, box, mode)
        works[f"{who} embedded"] = {"ask": asks.scan, "read": reads.scan}
    return works


def _judge(asks: Instance, reads: Instance, box: str, mode: str) -> None:
    """Raise EngineError unless one asks what pymodbus asks, and the other believes what it answers."""
    asks.scan()
    reads.scan()
    sent, words = asks[box], reads["Words"]
    wanted = ask(FRAMERS[mode](DecodePDU(False)))
    if not isinstance(sent, list) or sent[: len(wanted)] != [*wanted]:
        raise EngineError("the embedded engine asks another request")
    if not isinstance(words, list) or words[: len(WORDS)] != WORDS:
        raise EngineError("the embedded engine does not believe the reply")
