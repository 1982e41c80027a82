"""What a simulated drive replies, by MODBUS Application Protocol V1.1b3 and its map's limits and refusals."""

from collections.abc import Iterator

from driveblocks.bench.simulator.machine import Machine
from driveblocks.bench.simulator.memory import inside
from driveblocks.bench.simulator.table import Limit, Table
from driveblocks.maps.form import SPACES, is_bit, space_of
from driveblocks.modbus import layout

SHORT = 6
"""Bytes of every request but 10H: unit, function and two words."""
TABLES = {1: "coil", 2: "discrete", 4: "input", 5: "coil"}
"""The tables of functions that are not of holding registers."""
READS = (1, 2, 3, 4)


class Refused(Exception):  # noqa: N818  (a refusal is an answer, no error of the program)
    """Why a request is refused: one of `refusal.REASONS`."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)


def answer(machine: Machine, request: bytes) -> bytes | None:
    """The reply; None where nobody listens, the request is cut short, or it is a broadcast."""
    called = request[:1] == bytes([machine.unit])
    everyone = machine.table.broadcast is not None and request[:1] == bytes([machine.table.broadcast])
    if (
        not machine.powered
        or machine.now < machine.deaf_until
        or not (called or everyone)
        or not _whole(machine, request)
    ):
        return None
    try:
        data = _granted(machine, request, everyone=everyone)
    except Refused as refused:
        return _refusal(machine, request, refused.reason) if called else None
    if not called:
        return None
    machine.hear(request)
    return request[:2] + data


def _whole(machine: Machine, request: bytes) -> bool:
    """Whether a request is as long as its function says; of other functions nobody knows."""
    if len(request) < 2 or request[1] not in machine.table.functions:
        return len(request) >= 2
    return layout.request(request) is not None


def _granted(machine: Machine, request: bytes, *, everyone: bool) -> bytes:
    """The data of the reply. Raises Refused."""
    table, function = machine.table, request[1]
    if function not in table.functions or function not in (*READS, 5, 6, 8, 16):
        raise Refused("function")
    first, number = int.from_bytes(request[2:4], "big"), int.from_bytes(request[4:6], "big")
    if function == 8:
        if first not in table.sub_functions:
            raise Refused("function")
        return request[2:]
    at = first + SPACES[_table(machine, function)]
    if function in READS:
        words = _read(machine, at, number)
        data = _packed(words) if is_bit(at) else b"".join(word.to_bytes(2, "big") for word in words)
        return bytes([len(data)]) + data
    if everyone and table.broadcasts and first not in table.broadcasts:
        raise Refused("address")
    _write(machine, at, list(_written(machine, function, number, request)))
    return request[2:SHORT]


def _written(machine: Machine, function: int, number: int, request: bytes) -> Iterator[int]:
    """The words that a request writes; of a coil 1 or 0. Raises Refused."""
    if function == 5:
        if number not in (0, layout.COIL_ON):
            raise Refused("value")
        yield number // layout.COIL_ON
    elif function == 6:
        yield number
    elif not 1 <= number <= machine.table.most.write or request[6] != 2 * number:
        raise Refused("quantity")
    else:
        yield from (int.from_bytes(request[at : at + 2], "big") for at in range(7, len(request), 2))


def _table(machine: Machine, function: int) -> str:
    """The table that a function is of; 04H reads holding registers where the map has no others."""
    table = TABLES.get(function, "holding")
    known = any(space_of(span.first) == table for span in machine.table.readable)
    return table if known or function != 4 else "holding"


def _packed(bits: list[int]) -> bytes:
    """Coils as bytes, the first as the lowest bit of the first one (6.1)."""
    number = sum(bit << place for place, bit in enumerate(bits))
    return number.to_bytes(layout.bytes_of(len(bits)), "little")


def _read(machine: Machine, first: int, number: int) -> list[int]:
    table = machine.table
    if not 1 <= number <= (16 * table.most.read if is_bit(first) else table.most.read):
        raise Refused("quantity")
    addresses = range(first, first + number)
    if not all(inside(table.readable, address) for address in addresses) or _crosses(table, addresses):
        raise Refused("address")
    return [machine.word(address) for address in addresses]


def _crosses(table: Table, addresses: range) -> bool:
    """Whether registers are in more than one of the groups that the drive keeps apart."""
    return addresses[0] // table.group != addresses[-1] // table.group


def _write(machine: Machine, first: int, words: list[int]) -> None:
    table, memory = machine.table, machine.memory
    addresses = range(first, first + len(words))
    if _crosses(table, addresses):
        raise Refused("address")
    for address in addresses:
        if not inside(table.writable, address):
            raise Refused("read_only" if inside(table.readable, address) else "address")
    for limit in table.limits:
        if limit.register in addresses and not limit.low <= _number(machine, addresses, words, limit) <= limit.high:
            raise Refused("value")
    parameters = any(memory.parameter(address) for address in addresses)
    if (parameters or machine.habits.busy_refuses_all) and machine.now < machine.busy_until:
        _refuse(machine, "busy")
    if parameters and machine.motor.driven:
        _refuse(machine, "running")
    before = {memory.home(each): (memory[each], memory.changed.get(memory.home(each), 0)) for each in addresses}
    stored = [memory.write(address, word, machine.now) for address, word in zip(addresses, words, strict=True)]
    if any(stored):
        machine.busy_until = machine.now + machine.habits.store_ms
    machine.written(before)


def _number(machine: Machine, addresses: range, words: list[int], limit: Limit) -> int:
    """What a limited register would hold after a write."""
    word, bits = words[limit.register - addresses[0]], 16
    if limit.above is not None:
        high = words[limit.above - addresses[0]] if limit.above in addresses else machine.memory[limit.above]
        word, bits = word | high << 16, 32
    return word - (1 << bits) if limit.signed and word >> bits - 1 else word


def _refuse(machine: Machine, reason: str) -> None:
    """Refuse for a reason for which not every drive does."""
    if machine.table.codes[reason] is not None:
        raise Refused(reason)


def _refusal(machine: Machine, request: bytes, reason: str) -> bytes:
    dialect, code = machine.table.dialect, machine.table.codes[reason] or 0
    if dialect.address is None or dialect.function is None:
        return bytes([request[0], (request[1] + dialect.added) & 0xFF, code])
    machine.memory.words[dialect.address] = code
    return bytes([request[0], dialect.function]) + dialect.address.to_bytes(2, "big") + code.to_bytes(2, "big")
