"""Families that the library does not know, each one YAML file: other refusals, limits, functions, fields and words.

What holds for the shipped drives holds for them without any code: check, build, lint, compile, behave.
"""

import functools
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.blocks import asking, driving, meanings, vectors, wire
from tests.blocks.library import Blocks, built, scan
from tests.blocks.test_reply import assert_by_chance

from driveblocks.maps import collection
from driveblocks.maps.load import loads
from driveblocks.maps.model import Drive
from driveblocks.reference.reply import Answer
from driveblocks.reference.request import Asked
from driveblocks.render import library as library_of
from driveblocks.render import text as texts
from structured_text.engines.engine import Engine, Instance, Source, Value
from structured_text.language.lint import lint_sources

MAPS = sorted((Path(__file__).parent / "fourth_drive").glob("*.yaml"))
SOURCES = collection.read(MAPS)
DRIVES = {source.drive.prefix: source.drive for source in SOURCES}
EVERY = pytest.mark.parametrize("drive", DRIVES.values(), ids=list(DRIVES))


@functools.cache
def library() -> list[Source]:
    """The files of the library that these maps become, in order."""
    both = texts.languages(["en", "zh"], "utf-8")
    made = [*library_of.generic(both)]
    for source in SOURCES:
        made += library_of.drive(source.path.stem, texts.told(source.drive, both), both)
    return [Source(file.path, file.text) for file in made]


def fourth(engine: Engine) -> Blocks:
    """The library on an engine."""
    return built(engine, "fourth", library())


def test_blocks_pass_the_linter() -> None:
    assert [str(problem) for problem in lint_sources([(source.path, source.text) for source in library()])] == []


@EVERY
def test_frames(engine: Engine, drive: Drive) -> None:
    for frame in drive.frames:
        if frame.direction == "request":
            vectors.assert_request(fourth(engine), drive, frame)
        else:
            vectors.assert_reply(fourth(engine), drive, frame)
            vectors.assert_quantities(fourth(engine), drive, frame)
        if frame.plc is not None:
            vectors.assert_table(fourth(engine), frame)


@EVERY
def test_requests(engine: Engine, drive: Drive) -> None:
    draw = asking.Asking(drive)
    limits = {asking.assert_request(fourth(engine), draw, asked) for asked in draw.limits()}
    chance = {asking.assert_request(fourth(engine), draw, draw.any()) for _ in range(500)}
    assert {"OK", "MODE", "UNIT", "QUANTITY", "WRAP", "NOT_READABLE", "FUNCTION"} <= limits | chance


@EVERY
def test_replies(engine: Engine, drive: Drive) -> None:
    assert {"OK", "REFUSED"} <= assert_by_chance(fourth(engine), drive, 800)


@EVERY
def test_meanings(engine: Engine, drive: Drive) -> None:
    blocks = fourth(engine)
    for row in meanings.decoded(drive):
        meanings.assert_decoder(blocks, drive, row)
    for row in meanings.scaled(drive):
        meanings.assert_scale(blocks, drive, row)
    meanings.assert_standstill(blocks, drive)
    if drive.faults.bits is not None:
        meanings.assert_fault_number(blocks, drive)
    meanings.assert_code_texts(blocks, drive)
    meanings.assert_bit_texts(blocks, drive)
    meanings.assert_value_texts(blocks, drive)


@EVERY
def test_driving(engine: Engine, drive: Drive) -> None:
    driving.assert_commands(fourth(engine), drive, driving.all_pins())
    driving.assert_commands(fourth(engine), drive, driving.motions())
    driving.assert_commands(fourth(engine), drive, driving.resets())
    for given in driving.references(drive):
        driving.assert_reference(fourth(engine), drive, given)


def requests() -> Iterator[tuple[str, Asked, str]]:
    """Requests at the limits, as the maps' text has them."""
    yield "NW7", Asked(4, 2, 0x0300, 4), "OK"
    yield "NW7", Asked(4, 2, 0x0300, 5), "QUANTITY"
    yield "NW7", Asked(3, 2, 0x0300, 1), "FUNCTION"
    yield "NW7", Asked(6, 2, 0x0200), "FUNCTION"
    yield "NW7", Asked(16, 2, 0x0210, 3, words=(1, 2, 3)), "OK"
    yield "NW7", Asked(16, 2, 0x0210, 4, words=(1, 2, 3, 4)), "QUANTITY"
    yield "NW7", Asked(16, 2, 0x0213, 2, words=(1, 2)), "NOT_WRITABLE"
    yield "NW7", Asked(4, 2, 0x0213, 2), "OK"
    yield "NW7", Asked(16, 0, 0x0200, 1, words=(1,)), "OK"
    yield "NW7", Asked(16, 0, 0x0210, 1, words=(1,)), "NO_BROADCAST"
    yield "NW7", Asked(8, 2, sub_function=0x00A5), "OK"
    yield "NW7", Asked(8, 2, sub_function=0x00A6), "SUB_FUNCTION"
    yield "NW7", Asked(4, 1, 0x0300, 1), "UNIT"
    yield "NW7", Asked(4, 2, 0x0300, 1, ascii=True), "MODE"
    yield "BH", Asked(3, 31, 0x0000, 9, ascii=True), "OK"
    yield "BH", Asked(3, 31, 0x0000, 10, ascii=True), "ASCII_LIMIT"
    yield "BH", Asked(16, 31, 0x0000, 7, words=(0,) * 7, ascii=True), "OK"
    yield "BH", Asked(16, 31, 0x0000, 8, words=(0,) * 8, ascii=True), "ASCII_LIMIT"
    yield "BH", Asked(3, 32, 0x0000, 1, ascii=True), "UNIT"
    yield "BH", Asked(3, 1, 0x0000, 1), "MODE"
    yield "BH", Asked(6, 1, 0x4028, ascii=True), "OK"
    yield "BH", Asked(3, 1, 0x4028, 1, ascii=True), "NOT_READABLE"


@pytest.mark.parametrize(("prefix", "asked", "wanted"), list(requests()))
def test_limits_that_no_shipped_drive_has(engine: Engine, prefix: str, asked: Asked, wanted: str) -> None:
    assert wire.build(fourth(engine), prefix, asked).built.result == wanted


REFUSALS = [
    ("NW7", Asked(4, 2, 0x0300, 1), "02 44 FE", Answer("REFUSED", reason=0xFE)),
    ("NW7", Asked(4, 2, 0x0300, 1), "02 84 02", Answer("OTHER_FUNCTION")),
    ("BH", Asked(3, 2, 0x9000, 1), "02 06 9F FF 1B 58", Answer("REFUSED", reason=7000)),
    ("BH", Asked(3, 2, 0x9000, 1), "02 06 50 01 1B 58", Answer("OTHER_FUNCTION")),
]


@pytest.mark.parametrize(("prefix", "asked", "body", "wanted"), REFUSALS)
def test_refusals_that_no_shipped_drive_has(
    engine: Engine, prefix: str, asked: Asked, body: str, wanted: Answer
) -> None:
    assert wire.parse(fourth(engine), f"{prefix}_Reply", wire.opened(asked), bytes.fromhex(body)) == wanted


def assert_steps(instance: Instance, *calls: tuple[str, tuple[int, int]], **always: Value) -> None:
    """Calls with the pins that are TRUE beside Enable, and the register and word that must be reported."""
    pins = ("RunForward", "RunReverse", "QuickStop", "CoastStop", "FaultReset", "StopAcknowledged", "ResetAcknowledged")
    for asked, telegram in calls:
        scan(instance, {"Enable": True, **{pin: pin in asked.split() for pin in pins}, **always})
        assert (instance["Address"], instance["Value"]) == telegram, asked


def test_a_reset_is_written_to_its_own_register_and_never_to_the_command_register(engine: Engine) -> None:
    """Before it a stop is acknowledged: a run bit that stands would start the motor that is reset."""
    running, stopped, reset = (0x8000, 0x0011), (0x8000, 0x0001), (0x8002, 16)
    calls = [("RunForward", running), ("RunForward FaultReset", stopped), ("StopAcknowledged", reset)]
    instance = fourth(engine).library.instance("BH_Command")
    assert_steps(instance, *calls, ("", reset), ("ResetAcknowledged", stopped), KeepWord=0xFFFF)


def edited(engine: Engine, *edits: tuple[str, str]) -> tuple[Drive, Blocks]:
    """Baumhof's drive with other commands."""
    text = MAPS[0].read_text(encoding="utf-8")
    for old, new in edits:
        assert old in text
        text = text.replace(old, new)
    drive = loads(text, "edited.yaml")
    block = next(file for file in library_of.drive("edited", drive, []) if file.name == "BH_Command")
    return drive, Blocks(engine.build([Source(block.name, block.text)]))


RESET_BIT = (
    (
        "{bit: 8-F, unused: true}",
        '{bit: 8, name: Clear trip, zh: "1: 复位", does: [resets]}\n          - {bit: 9-F, unused: true}',
    ),
    ("{does: fault_reset, register: 8002H, value: 16,", "{does: fault_reset, register: 8000H, set: [8],"),
)
TWO_REGISTERS = (
    (
        "{address: 8002H, name: Reset, zh: 故障复位, access: w, does: [resets], range: {min: 16, max: 16}}",
        "{address: 8002H, name: More control bits, zh: 控制字2, bits: ["
        "{bit: 0, name: Outer fault, zh: 外部故障, does: [nothing]},"
        ' {bit: 1, name: Fast stop, zh: "1: 快速停车", does: [quick_stops]},'
        ' {bit: 2, name: Clear trip, zh: "1: 复位", does: [resets]},'
        " {bit: 3, name: Fan, zh: 风扇, does: [nothing]}, {bit: 4-F, unused: true}]}",
    ),
    ("{does: quick_stop, register: 8000H, set: [6], clear: [4, 5],", "{does: quick_stop, register: 8002H, set: [1],"),
    ("{does: fault_reset, register: 8002H, value: 16,", "{does: fault_reset, register: 8002H, set: [2], clear: [1],"),
)


@pytest.mark.parametrize("edits", [RESET_BIT, TWO_REGISTERS], ids=["beside the run bits", "in two registers"])
def test_commands_by_bits_in_other_places(engine: Engine, edits: tuple[tuple[str, str], ...]) -> None:
    drive, blocks = edited(engine, *edits)
    for walk in (driving.all_pins(), driving.motions(), driving.resets()):
        driving.assert_commands(blocks, drive, walk)


def test_a_reset_by_a_bit_beside_the_run_bits_is_a_stop_as_well(engine: Engine) -> None:
    instance = edited(engine, *RESET_BIT)[1].library.instance("BH_Command")
    calls = [("RunForward", 0x0011), ("RunForward FaultReset", 0x0001), ("RunForward StopAcknowledged", 0x0101)]
    more = [("RunForward ResetAcknowledged", 0x0001), ("", 0x0001), ("RunReverse", 0x0021)]
    assert_steps(instance, *((asked, (0x8000, word)) for asked, word in (*calls, *more)), KeepWord=0xFFFF)


def test_each_command_register_keeps_its_own_bits_and_passes_no_unused_one(engine: Engine) -> None:
    instance = edited(engine, *TWO_REGISTERS)[1].library.instance("BH_Command")
    kept: dict[str, Value] = {"KeepWord": 0xFFFF, "KeepWord8002H": 0xFFFE}
    quick = ("QuickStop", (0x8002, 0x000A))
    assert_steps(instance, ("RunForward", (0x8000, 0x0011)), quick, ("StopAcknowledged", (0x8000, 0x0001)), **kept)
    reset = [("FaultReset", (0x8000, 0x0001)), ("StopAcknowledged", (0x8002, 0x000C))]
    assert_steps(instance, *reset, ("ResetAcknowledged", (0x8000, 0x0001)), **kept)
    swapped: dict[str, Value] = {"KeepWord": 0xFFFE, "KeepWord8002H": 0x0001}
    assert_steps(instance, ("RunForward", (0x8000, 0x0010)), ("QuickStop", (0x8002, 0x0003)), **swapped)


def test_there_is_no_reverse_where_the_map_has_none(engine: Engine) -> None:
    done = fourth(engine).run("NW7_Command", {"Enable": True, "RunReverse": True})
    assert (done["Value"], done["Stopping"], done["ErrorID"]) == (51, True, 16)


def test_two_and_a_half_newton_metres_per_count(engine: Engine) -> None:
    values = [fourth(engine).call("NW7_ShaftTorqueNm", {"Raw": word}) for word in (0, 1, 0xFFF6, 0x8000)]
    assert values == [0.0, 2.5, -25.0, -81920.0]
