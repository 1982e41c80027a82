"""Families that the library does not know, each one YAML file: other refusals, limits, functions, fields and words.

What holds for the shipped drives holds for them without any code: check, build, lint, compile, behave.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.blocks import asking, driving, meanings, vectors, wire
from tests.blocks.library import Blocks, built
from tests.blocks.test_reply import check_by_chance

from driveblocks.host.engine import Engine, Source
from driveblocks.maps.model import Drive
from driveblocks.reference.reply import Answer
from driveblocks.reference.request import Asked
from driveblocks.render import build
from driveblocks.render import text as texts
from driveblocks.st.lint import lint_sources

MAPS = sorted((Path(__file__).parent / "fourth_drive").glob("*.yaml"))
SOURCES = build.read(MAPS)
DRIVES = {source.drive.prefix: source.drive for source in SOURCES}
EVERY = pytest.mark.parametrize("drive", DRIVES.values(), ids=list(DRIVES))


def library() -> list[Source]:
    """The files of the library that these maps become, in order."""
    made = build.files(SOURCES, texts.languages(["en", "zh"], "utf-8"))
    names = made[f"{build.PLATFORM}/order.txt"].split()
    return [Source(name, made[f"{build.PLATFORM}/{name}"]) for name in names]


LIBRARY = library()


def fourth(engine: Engine) -> Blocks:
    """The library on an engine."""
    return built(engine, "fourth", LIBRARY)


def test_blocks_pass_the_linter() -> None:
    assert [str(problem) for problem in lint_sources([(source.path, source.text) for source in LIBRARY])] == []


@EVERY
def test_frames(engine: Engine, drive: Drive) -> None:
    for frame in drive.frames:
        if frame.direction == "request":
            vectors.check_request(fourth(engine), drive, frame)
        else:
            vectors.check_reply(fourth(engine), drive, frame)
            vectors.check_quantities(fourth(engine), drive, frame)
        if frame.plc is not None:
            vectors.check_table(fourth(engine), frame)


@EVERY
def test_requests(engine: Engine, drive: Drive) -> None:
    draw = asking.Asking(drive)
    limits = {asking.check_request(fourth(engine), draw, asked) for asked in draw.limits()}
    chance = {asking.check_request(fourth(engine), draw, draw.any()) for _ in range(500)}
    assert {"OK", "MODE", "UNIT", "QUANTITY", "WRAP", "NOT_READABLE", "FUNCTION"} <= limits | chance


@EVERY
def test_replies(engine: Engine, drive: Drive) -> None:
    assert {"OK", "REFUSED"} <= check_by_chance(fourth(engine), drive, 800)


@EVERY
def test_meanings(engine: Engine, drive: Drive) -> None:
    blocks = fourth(engine)
    for row in meanings.decoded(drive):
        meanings.check_decoder(blocks, drive, row)
    for row in meanings.scaled(drive):
        meanings.check_scale(blocks, drive, row)
    meanings.check_standstill(blocks, drive)
    if drive.faults.bits is not None:
        meanings.check_fault_number(blocks, drive)
    meanings.check_code_texts(blocks, drive)
    meanings.check_bit_texts(blocks, drive)
    meanings.check_value_texts(blocks, drive)


@EVERY
def test_driving(engine: Engine, drive: Drive) -> None:
    driving.check_commands(fourth(engine), drive, driving.all_pins())
    driving.check_commands(fourth(engine), drive, driving.motions())
    for given in driving.references(drive):
        driving.check_reference(fourth(engine), drive, *given)


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


def test_a_reset_goes_to_its_own_register_and_never_into_the_command_register(engine: Engine) -> None:
    done = fourth(engine).run("BH_Command", {"Enable": True, "FaultReset": True, "KeepWord": 0xFFFF})
    assert (done["Address"], done["Value"]) == (0x8002, 16)


def test_there_is_no_reverse_where_the_map_has_none(engine: Engine) -> None:
    done = fourth(engine).run("NW7_Command", {"Enable": True, "RunReverse": True})
    assert (done["Value"], done["Stopping"], done["ErrorID"]) == (51, True, 16)


def test_two_and_a_half_newton_metres_per_count(engine: Engine) -> None:
    values = [fourth(engine).call("NW7_ShaftTorqueNm", {"Raw": word}) for word in (0, 1, 0xFFF6, 0x8000)]
    assert values == [0.0, 2.5, -25.0, -81920.0]
