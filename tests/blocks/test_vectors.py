"""Every example frame of the manuals on every engine; the frames that are printed wrong are listed, not imitated."""

import pytest
from tests.blocks import vectors, wire
from tests.blocks.library import built
from tests.shipped import drives

from driveblocks.maps.model import Drive, Frame
from structured_text.engines.engine import Engine

pytestmark = pytest.mark.every_family

FRAMES = [(drive, frame) for drive in drives().values() for frame in drive.frames]
IDS = [f"{drive.prefix}-{frame.id}" for drive, frame in FRAMES]
EVERY = pytest.mark.parametrize(("drive", "frame"), FRAMES, ids=IDS)


@EVERY
def test_frame_is_built_and_parsed_byte_for_byte(engine: Engine, drive: Drive, frame: Frame) -> None:
    blocks = built(engine)
    if frame.direction == "request":
        vectors.assert_request(blocks, drive, frame)
    else:
        vectors.assert_reply(blocks, drive, frame)
        vectors.assert_quantities(blocks, drive, frame)
    if frame.plc is not None:
        vectors.assert_table(blocks, frame)


PRINTED_WRONG = {
    ("ATV312", "write_ramps_request"): "CHECKSUM",
    ("ATV312", "write_ramps_reply"): "CHECKSUM",
    ("CHF", "read_rtu_reply"): "CHECKSUM",
    ("GD20", "write_words_rtu_request"): "CHECKSUM",
    ("GD20", "write_words_rtu_reply"): "CHECKSUM",
    ("GD200A", "write_words_rtu_request"): "CHECKSUM",
    ("GD200A", "write_words_rtu_reply"): "CHECKSUM",
}
"""Frames whose printed bytes are no frame, and what the blocks say of them."""

TABLES_PRINTED_WRONG = {("JSCC", "read_frequency_ascii_request"), ("JSCC", "read_frequency_ascii_reply")}
"""Tables of PLC registers that do not hold the frame printed beside them."""


def test_frames_that_are_printed_wrong_are_these() -> None:
    wrong = {(drive.prefix, frame.id) for drive, frame in FRAMES if frame.printed != frame.correct}
    assert wrong == set(PRINTED_WRONG)
    assert wrong == {(drive.prefix, frame.id) for drive, frame in FRAMES if frame.checksum == "wrong"}
    tables = {(drive.prefix, frame.id) for drive, frame in FRAMES if frame.plc and frame.plc.printed}
    assert tables == TABLES_PRINTED_WRONG


@EVERY
def test_printed_bytes_are_refused_where_they_are_wrong_and_taken_where_they_are_right(
    engine: Engine, drive: Drive, frame: Frame
) -> None:
    found = wire.unframe(built(engine), frame.printed, ascii_mode=frame.mode == "ascii")
    assert found.result == PRINTED_WRONG.get((drive.prefix, frame.id), "OK")


@pytest.mark.parametrize(("prefix", "id_"), sorted(TABLES_PRINTED_WRONG))
def test_wrong_tables_unpack_to_something_that_is_no_such_frame(engine: Engine, prefix: str, id_: str) -> None:
    frame = next(frame for drive, frame in FRAMES if (drive.prefix, frame.id) == (prefix, id_))
    assert frame.plc is not None
    registers = [int(text.replace("--", "00"), 16) for text in frame.plc.printed]
    blocks = built(engine)
    done = blocks.run("MB_UnpackChars16", {"CharCount": len(frame.correct), "Registers": list(registers)})
    chars = bytes(done["Chars"][: len(frame.correct)])  # type: ignore[index, arg-type]
    assert chars != frame.correct
    assert wire.unframe(blocks, chars, ascii_mode=True).result == "CHECKSUM"
