"""Words through a drive's decoders, scales, fault numbers, standstill and texts, against the reference model."""

import random
from collections.abc import Iterable, Iterator, Mapping

from tests.blocks.library import Blocks, scan

from driveblocks.maps.model import Drive, Register, Section
from driveblocks.reference import fault, naming, register, standstill, text
from driveblocks.reference.naming import name_of

UNITS = {
    "Hz": "Hz", "A": "A", "V": "V", "kW": "KW", "W": "W", "%": "Percent", "r/min": "Rpm", "Nm": "Nm", "s": "S",
    "ms": "Ms", "h": "H", "°C": "DegC", "kHz": "KHz", "Ohm": "Ohm", "kWh": "KWh",
}  # fmt: skip
"""How a unit ends the name of a scale's function."""

EDGES = (0x0000, 0x0001, 0x7FFF, 0x8000, 0x8001, 0xFFFF, 0xA5A5, 0x5A5A)
TEXTS = {"En": (0, "ascii"), "Zh": (1, "utf-8")}


def scale_name(drive: Drive, row: Register) -> str:
    """The function that turns a register's word into its unit."""
    return f"{drive.prefix}_{name_of(row)}{UNITS[row.unit or '']}"


def interesting(row: Register) -> list[int]:
    """Words that tell the bits, fields and values of a register apart, and some that mean nothing."""
    single = [1 << bit for bit in range(16)]
    listed = [value.value & 0xFFFF for value in row.values]
    fields = [value.value << bit.bit.first for bit in row.bits for value in bit.values]
    beside = [word ^ 1 << bit for word in listed[:3] for bit in (0, 5, 15)]
    chance = random.Random(row.address.first)
    others = [chance.randrange(0x10000) for _ in range(8)]
    return list(dict.fromkeys([*EDGES, *single, *listed, *fields, *beside, *range(1, 20), *others]))


def decoded(drive: Drive) -> Iterator[Register]:
    """The registers that have a decoder."""
    return (row for _, row in drive.registers() if register.decode(row, 0))


def assert_decoder(blocks: Blocks, drive: Drive, row: Register) -> None:
    """Every output for every interesting word."""
    instance = blocks.library.instance(f"{drive.prefix}_{name_of(row)}")
    for word in interesting(row):
        scan(instance, {"Value": word})
        wanted = register.decode(row, word)
        found = {name: instance[name] for name in wanted}
        assert found == wanted, (f"{row.address.first:04X}H", f"{word:04X}H", differing(found, wanted))


def differing(found: Mapping[str, object], wanted: Mapping[str, object]) -> dict[str, object]:
    """What was found where it is not what is wanted."""
    return {name: found[name] for name, value in wanted.items() if found[name] != value}


def scaled(drive: Drive) -> Iterator[Register]:
    """The registers that have a scale."""
    return (row for _, row in drive.registers() if row.scale is not None and row.unit is not None)


def assert_scale(blocks: Blocks, drive: Drive, row: Register, some: Iterable[int] = range(0, 0x10000, 257)) -> None:
    """The nearest REAL to the exact value, within the last place that one operation may cost; of words or of pairs."""
    pairs = [high << 16 | low for high in EDGES for low in EDGES] if row.words == 2 else []
    for word in (*EDGES, *some, *pairs):
        pins = {"High": word >> 16, "Low": word & 0xFFFF} if row.words == 2 else {"Raw": word}
        value = blocks.call(scale_name(drive, row), pins)
        exact = register.exact(row, word)
        assert isinstance(value, float)
        assert abs(value - exact) <= abs(exact) / 2**23, (f"{row.address.first:04X}H", word, value, float(exact))


def assert_standstill(blocks: Blocks, drive: Drive) -> None:
    """Each condition alone broken and kept, and random words."""
    pins = {one.register: word_pin(drive, one.register) for one in drive.operation.standstill.all}
    instance = blocks.library.instance(f"{drive.prefix}_Standstill")
    for words in proofs(drive, list(pins)):
        scan(instance, {pins[address]: word for address, word in words.items()})
        assert instance["StandstillProven"] is standstill.proven(drive, words), words


def word_pin(drive: Drive, address: int) -> str:
    """The pin that takes a register's word."""
    row = drive.register_at(address)
    assert row is not None
    return naming.word_pin(row, address)


def proofs(drive: Drive, addresses: list[int]) -> Iterator[dict[int, int]]:
    """Words by register: the proof, then each single bit of it changed, then pairs of random words."""
    good = dict.fromkeys(addresses, 0)
    for one in drive.operation.standstill.all:
        good[one.register] |= (one.equals or 0) << (one.bit.first if one.bit else 0)
    yield good
    for address in addresses:
        for bit in range(16):
            yield {**good, address: good[address] ^ 1 << bit}
    chance = random.Random(drive.prefix)
    for _ in range(40):
        yield {address: chance.choice([good[address], chance.randrange(0x10000)]) for address in addresses}


def assert_fault_number(blocks: Blocks, drive: Drive) -> None:
    """Every bit alone, and random words: the lowest number and the count."""
    relation = drive.faults.bits
    assert relation is not None
    addresses = range(relation.first, relation.last + 1)
    instance = blocks.library.instance(f"{drive.prefix}_FaultNumber")
    chance = random.Random(drive.prefix)
    several = [[chance.randrange(0x10000) for _ in addresses] for _ in range(20)]
    alone = [[1 << bit if at == there else 0 for there in addresses] for at in addresses for bit in range(16)]
    for words in (*alone, *several, [0] * len(addresses), [0xFFFF] * len(addresses)):
        scan(instance, {word_pin(drive, address): word for address, word in zip(addresses, words, strict=True)})
        wanted = fault.numbered(drive, words)
        assert (instance["FaultNumber"], instance["Count"]) == (wanted.number, wanted.count), words


def codes(known: Iterable[int | None]) -> list[int]:
    """Known codes, their neighbours, and some that nothing has."""
    listed = [code for code in known if code is not None]
    return sorted({*listed, *((code + 1) % 0x10000 for code in listed), 0, 255, 65535})


def assert_text(blocks: Blocks, function: str, pins: dict[str, int], found: text.Texts | None) -> None:
    """A text function in the language that its name ends in."""
    which, encoding = TEXTS[function[-2:]]
    wanted = (found or text.UNKNOWN)[which].encode(encoding)
    assert blocks.call(function, dict(pins)) == wanted, (function, pins)


def spoken(drive: Drive) -> tuple[str, ...]:
    """The languages of a drive's texts."""
    return ("En", "Zh") if drive.manual.written_in == "zh" else ("En",)


def assert_code_texts(blocks: Blocks, drive: Drive) -> None:
    """Texts of faults and refusals, in its languages."""
    faults = codes(one.code for one in drive.faults.codes)
    errors = codes(text.error_number(one) for one in drive.errors.codes)
    for language in spoken(drive):
        for code in faults:
            assert_text(blocks, f"{drive.prefix}_FaultText{language}", {"Code": code}, text.fault(drive, code))
        for code in errors if drive.errors.codes else ():
            assert_text(blocks, f"{drive.prefix}_ErrorText{language}", {"Code": code}, text.error(drive, code))


def registers(drive: Drive) -> Iterator[tuple[Section, Register]]:
    """The holding registers: coils and inputs, whose addresses are theirs too, have no texts to ask for."""
    return ((section, row) for section, row in drive.registers() if row.address.last <= 0xFFFF)


def assert_bit_texts(blocks: Blocks, drive: Drive) -> None:
    """Texts of the bits of every register, in its languages; an address without bits has none."""
    rows = [row.address.first for _, row in registers(drive) if any(bit.name for bit in row.bits)]
    for language in spoken(drive) if rows else ():
        for address in codes(rows):
            for bit in range(17):
                pins = {"Address": address, "BitNumber": bit}
                found = text.bit(drive, address, bit) if address in rows else None
                assert_text(blocks, f"{drive.prefix}_BitText{language}", pins, found)


def assert_value_texts(blocks: Blocks, drive: Drive) -> None:
    """Texts of the values of every register, in its languages."""
    rows = {row.address.first: row for _, row in registers(drive) if row.values}
    for language in spoken(drive) if rows else ():
        for address in codes(rows):
            listed = rows[address].values if address in rows else ()
            for value in codes(one.value for one in listed):
                pins = {"Address": address, "Value": value}
                assert_text(blocks, f"{drive.prefix}_ValueText{language}", pins, text.value(drive, address, value))
