"""Every code through the texts: results, faults, refusals, bits and values, in both languages."""

from array import array
from collections.abc import Callable, Iterator, Sequence

from tests.blocks.meanings import TEXTS, registers, spoken
from tests.native.exhaustive.bench import Bench, Finding, Trial, judged
from tests.native.exhaustive.scan import Call
from tests.shipped import drives

from driveblocks.maps.model import Drive
from driveblocks.reference import text
from driveblocks.render.results import RESULTS

ROOM = 128
KNOWN_RESULTS = {result.code: text.Texts(result.en, result.zh) for result in RESULTS}
NEAR = 17
"""Bits and values below this are asked at every address."""

Find = Callable[[int], text.Texts | None]
FindPlace = Callable[[Drive, int, int], text.Texts | None]


def _valued(drive: Drive) -> list[int]:
    return [row.address.first for _, row in registers(drive) if row.values]


def _bitwise(drive: Drive) -> list[int]:
    return [row.address.first for _, row in registers(drive) if any(bit.name for bit in row.bits)]


PLACES: tuple[tuple[str, FindPlace, Callable[[Drive], list[int]]], ...] = (
    ("BitText", text.bit, _bitwise),
    ("ValueText", text.value, _valued),
)
"""Texts that go by address and number: the end of the name, the reference model, and the addresses that have any."""


def _speaking(language: str) -> Iterator[tuple[str, Drive]]:
    """The drives that have texts in a language."""
    return ((prefix, drive) for prefix, drive in drives().items() if language in spoken(drive))


def _calls() -> Iterator[Call]:
    for language in TEXTS:
        yield Call(f"MB_ResultText{language}", text=True)
        for prefix, drive in _speaking(language):
            yield Call(f"{prefix}_FaultText{language}", text=True)
            yield Call(f"{prefix}_ErrorText{language}", text=True)
            for kind, _, addresses in PLACES:
                if addresses(drive):
                    yield Call(f"{prefix}_{kind}{language}", 2, text=True)


SCANS = (*_calls(),)


def answer(found: text.Texts | None, language: str) -> bytes:
    """A text as the driver gives it."""
    which, encoding = TEXTS[language]
    texts = found or text.UNKNOWN
    data = (texts[which] or texts.en).encode(encoding)
    return bytes([len(data)]) + data.ljust(ROOM - 1, b"\0")


def code_texts(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """All 65536 codes of results, faults and refusals; short: those below 300 and each 97th."""
    codes = [*range(300), *range(300, 0x10000, 97), 0xFFFF] if short else range(0x10000)
    for language in TEXTS:
        yield from judged(benches, iter([_coded(f"MB_ResultText{language}", KNOWN_RESULTS.get, codes)]))
        for prefix, drive in _speaking(language):
            faults, errors = _known(drive)
            yield from judged(benches, iter([_coded(f"{prefix}_FaultText{language}", faults, codes)]))
            yield from judged(benches, iter([_coded(f"{prefix}_ErrorText{language}", errors, codes)]))


def _known(drive: Drive) -> tuple[Find, Find]:
    return lambda code: text.fault(drive, code), lambda code: text.error(drive, code)


def _coded(function: str, find: Find, codes: Sequence[int]) -> Trial:
    wanted = b"".join(answer(find(code), function[-2:]) for code in codes)
    records = array("H", codes).tobytes()
    return Trial(Call(function, text=True), len(codes), records, wanted, lambda at: f"of {codes[at]}")


def place_texts(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """Every address with every number below 17; where an address or its neighbour has texts, with all 65536 numbers."""
    for language in TEXTS:
        for prefix, drive in _speaking(language):
            for kind, find, addresses in PLACES:
                if known := addresses(drive):
                    call = Call(f"{prefix}_{kind}{language}", 2, text=True)
                    yield from judged(benches, _placed(call, drive, find, known, short))


def _placed(call: Call, drive: Drive, find: FindPlace, known: list[int], short: bool) -> Iterator[Trial]:
    near = sorted({(address + step) % 0x10000 for address in known for step in (-1, 0, 1)})
    language = call.function[-2:]
    if short:
        yield _asked(
            call, drive, find, [(at, number) for at in near for number in (*range(20), 0x7FFF, 0xFFFF)], language
        )
        return
    for address in near:
        yield _asked(call, drive, find, [(address, number) for number in range(0x10000)], language)
    for number in range(NEAR):
        yield _asked(call, drive, find, [(address, number) for address in range(0x10000)], language)


def _asked(call: Call, drive: Drive, find: FindPlace, pins: list[tuple[int, int]], language: str) -> Trial:
    wanted = b"".join(answer(find(drive, *pair), language) for pair in pins)
    records = array("H", [word for pair in pins for word in pair]).tobytes()
    return Trial(call, len(pins), records, wanted, lambda at: f"of {pins[at][0]:04X}H and {pins[at][1]}")
