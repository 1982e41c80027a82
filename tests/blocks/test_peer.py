"""pymodbus as the other end of the line, both ways, RTU and ASCII; and properties by hypothesis.

pymodbus is no judge of lengths over 125 registers, of units that do not answer, nor of functions that it does not know.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pymodbus.framer import FramerAscii, FramerRTU
from pymodbus.framer.base import FramerBase
from pymodbus.pdu import DecodePDU, ExceptionResponse, ModbusPDU
from pymodbus.pdu.diag_message import ReturnQueryDataRequest, ReturnQueryDataResponse
from pymodbus.pdu.register_message import (
    ReadHoldingRegistersRequest,
    ReadHoldingRegistersResponse,
    ReadInputRegistersRequest,
    ReadInputRegistersResponse,
    WriteMultipleRegistersRequest,
    WriteMultipleRegistersResponse,
    WriteSingleRegisterRequest,
    WriteSingleRegisterResponse,
)
from tests.blocks import wire
from tests.blocks.library import built

from driveblocks.reference.reply import Answer
from driveblocks.reference.request import Asked, body
from structured_text.engines.engine import Engine

ECHO: Callable[..., ModbusPDU] = ReturnQueryDataResponse
WORDS = st.integers(0, 0xFFFF)
UNITS = st.integers(1, 247)
MODES = st.booleans()
FIXTURE = HealthCheck.function_scoped_fixture
"""An engine is the same for all examples: the fixture only looks new for each test."""
FEW = settings(max_examples=60, suppress_health_check=[*settings().suppress_health_check, FIXTURE])


def framer(in_ascii: bool, server: bool) -> FramerBase:
    """pymodbus's framer with the decoder of a server (requests) or of a client (replies)."""
    return (FramerAscii if in_ascii else FramerRTU)(DecodePDU(server))


def understood(data: bytes, in_ascii: bool, *, server: bool) -> ModbusPDU:
    """The one PDU in a frame."""
    used, pdu = framer(in_ascii, server).handleFrame(data, 0, 0)
    assert used == len(data)
    assert pdu is not None
    return pdu


@st.composite
def asked(draw: st.DrawFn) -> Asked:
    """Any request that the generic builders make."""
    function = draw(st.sampled_from((3, 4, 6, 8, 16)))
    count = draw(st.integers(1, 123 if function == 16 else 125)) if function in {3, 4, 16} else 1
    return Asked(
        function=function,
        unit=draw(UNITS),
        address=draw(st.integers(0, 0x10000 - count)) if function != 8 else 0,
        quantity=count,
        value=draw(WORDS) if function in {6, 8} else 0,
        words=tuple(draw(st.lists(WORDS, min_size=count, max_size=count))) if function == 16 else (),
        ascii=draw(MODES),
    )


def theirs(ask: Asked) -> ModbusPDU:
    """The same request as pymodbus's client would make it."""
    common: Any = {"dev_id": ask.unit}
    makers: dict[int, Callable[[], ModbusPDU]] = {
        3: lambda: ReadHoldingRegistersRequest(address=ask.address, count=ask.quantity, **common),
        4: lambda: ReadInputRegistersRequest(address=ask.address, count=ask.quantity, **common),
        6: lambda: WriteSingleRegisterRequest(address=ask.address, registers=[ask.value], **common),
        8: lambda: ReturnQueryDataRequest(ask.value.to_bytes(2, "big"), **common),
        16: lambda: WriteMultipleRegistersRequest(address=ask.address, registers=list(ask.words), **common),
    }
    return makers[ask.function]()


def answer(ask: Asked, registers: list[int]) -> ModbusPDU:
    """What pymodbus's server answers."""
    common: Any = {"dev_id": ask.unit}
    makers: dict[int, Callable[[], ModbusPDU]] = {
        3: lambda: ReadHoldingRegistersResponse(registers=registers, **common),
        4: lambda: ReadInputRegistersResponse(registers=registers, **common),
        6: lambda: WriteSingleRegisterResponse(address=ask.address, registers=[ask.value], **common),
        8: lambda: ECHO(ask.value.to_bytes(2, "big"), **common),
        16: lambda: WriteMultipleRegistersResponse(address=ask.address, count=ask.quantity, **common),
    }
    return makers[ask.function]()


BUILDERS = {
    3: "MB_BuildRead",
    4: "MB_BuildRead",
    6: "MB_BuildWriteSingle",
    8: "MB_BuildDiagnostics",
    16: "MB_BuildWriteMultiple",
}
PINS = {
    "MB_BuildRead": ("UnitAddress", "FunctionCode", "Address", "Quantity"),
    "MB_BuildWriteSingle": ("UnitAddress", "Address", "Value"),
    "MB_BuildDiagnostics": ("UnitAddress", "SubFunction", "Value"),
    "MB_BuildWriteMultiple": ("UnitAddress", "Address", "Quantity", "Words"),
}


def sent(engine: Engine, ask: Asked) -> tuple[bytes, bytes]:
    """Body and frame of a request by the generic builders."""
    blocks, block = built(engine), BUILDERS[ask.function]
    pins = {name: value for name, value in wire.pins(ask).items() if name in PINS[block]}
    most = {"MaxWords": 125 if ask.function != 16 else 123} if ask.function in {3, 4, 16} else {}
    done = blocks.run(block, {**pins, **most})
    assert done["ErrorID"] == 0, ask
    length = done["Length"]
    assert isinstance(length, int)
    data = done["Adu"]
    assert isinstance(data, list)
    made = bytes(data[:length])  # type: ignore[arg-type]
    return made, wire.frame(blocks, made, ascii_mode=ask.ascii)


@FEW
@given(ask=asked())
def test_pymodbus_understands_every_request(engine: Engine, ask: Asked) -> None:
    made, frame = sent(engine, ask)
    assert made == body(ask)
    pdu = understood(frame, ask.ascii, server=True)
    assert (pdu.dev_id, pdu.function_code) == (ask.unit, ask.function)
    if ask.function == 8:
        assert pdu.encode() == made[2:]
    elif ask.function == 6:
        assert (pdu.address, pdu.registers) == (ask.address, [ask.value])
    else:
        assert pdu.address == ask.address
        assert pdu.registers == list(ask.words) if ask.function == 16 else pdu.count == ask.quantity


@FEW
@given(ask=asked())
def test_requests_are_those_of_the_pymodbus_client(engine: Engine, ask: Asked) -> None:
    assert sent(engine, ask)[1] == framer(ask.ascii, False).buildFrame(theirs(ask))


@FEW
@given(ask=asked(), data=st.data())
def test_every_answer_of_the_pymodbus_server_is_believed(engine: Engine, ask: Asked, data: st.DataObject) -> None:
    registers = data.draw(st.lists(WORDS, min_size=ask.quantity, max_size=ask.quantity))
    frame = framer(ask.ascii, True).buildFrame(answer(ask, registers))
    found = received(engine, ask, frame)
    assert found == Answer("OK", tuple(registers) if ask.function in {3, 4} else ())


@FEW
@given(ask=asked(), reason=st.integers(1, 255))
def test_every_exception_of_the_pymodbus_server_is_a_refusal(engine: Engine, ask: Asked, reason: int) -> None:
    exception = ExceptionResponse(ask.function, exception_code=reason, device_id=ask.unit)
    assert received(engine, ask, framer(ask.ascii, True).buildFrame(exception)) == Answer("REFUSED", reason=reason)


def received(engine: Engine, ask: Asked, frame: bytes) -> Answer:
    """A frame through framing and the generic parser."""
    opened = wire.unframe(built(engine), frame, ascii_mode=ask.ascii)
    assert opened.result == "OK"
    return wire.parse(built(engine), "MB_ParseReply", wire.opened(ask), opened.body)


@FEW
@given(ask=asked(), data=st.data())
def test_a_single_changed_bit_of_any_answer_is_noticed(engine: Engine, ask: Asked, data: st.DataObject) -> None:
    frame = framer(ask.ascii, True).buildFrame(answer(ask, [0x1234] * ask.quantity))
    at = data.draw(st.integers(0, 8 * len(frame) - 1))
    changed = frame[: at // 8] + bytes([frame[at // 8] ^ 1 << at % 8]) + frame[at // 8 + 1 :]
    assert wire.unframe(built(engine), changed, ascii_mode=ask.ascii).result != "OK"


@FEW
@given(ask=asked(), data=st.data())
def test_an_answer_cut_or_extended_is_not_believed(engine: Engine, ask: Asked, data: st.DataObject) -> None:
    frame = framer(ask.ascii, True).buildFrame(answer(ask, [0x1234] * ask.quantity))
    cut = frame[: data.draw(st.integers(0, len(frame) - 1))]
    longer = frame + data.draw(st.binary(min_size=1, max_size=4))
    for changed in (cut, longer):
        opened = wire.unframe(built(engine), changed, ascii_mode=ask.ascii)
        if opened.result == "OK":
            found = wire.parse(built(engine), "MB_ParseReply", wire.opened(ask), opened.body)
            assert found.result not in {"OK", "REFUSED"}, changed


@FEW
@given(ask=asked(), data=st.data())
def test_what_was_built_comes_back_when_parsed_as_an_echo(engine: Engine, ask: Asked, data: st.DataObject) -> None:
    one = replace(ask, function=data.draw(st.sampled_from((6, 8))), address=ask.address, value=data.draw(WORDS))
    made, _ = sent(engine, one)
    assert wire.parse(built(engine), "MB_ParseReply", wire.opened(one), made) == Answer("OK")
    other = replace(one, value=one.value ^ data.draw(st.integers(1, 0xFFFF)))
    assert wire.parse(built(engine), "MB_ParseReply", wire.opened(other), made) == Answer("OTHER_VALUE")


@pytest.mark.parametrize("in_ascii", [False, True], ids=["rtu", "ascii"])
@pytest.mark.parametrize("asked_", [Asked(3, 1, 0x2000, 2), Asked(6, 1, 0x1000, value=1)], ids=["read", "write"])
def test_a_frame_of_one_mode_is_none_of_the_other(engine: Engine, in_ascii: bool, asked_: Asked) -> None:
    frame = framer(in_ascii, True).buildFrame(answer(asked_, [1, 2]))
    wanted = "CHECKSUM" if in_ascii else "NO_START"
    assert wire.unframe(built(engine), frame, ascii_mode=not in_ascii).result == wanted
