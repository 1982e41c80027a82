"""One transaction through the blocks as a program would do it: build, frame, open, parse."""

from dataclasses import dataclass

from tests.blocks.library import Blocks, number, octets, result, words

from driveblocks.reference.reply import Answer
from driveblocks.reference.request import Asked, Built
from structured_text.engines.engine import Value

LONGEST = {False: 256, True: 513}
"""Bytes of an RTU frame and characters of an ASCII frame that the types hold."""


@dataclass(frozen=True)
class Sent:
    """What the request block gave: result, body, and the open request."""

    built: Built
    request: dict[str, Value]


def pins(asked: Asked) -> dict[str, Value]:
    """The pins of a request block."""
    return {
        "Ascii": asked.ascii,
        "UnitAddress": asked.unit,
        "FunctionCode": asked.function,
        "Address": asked.address,
        "Quantity": asked.quantity,
        "Value": asked.value,
        "SubFunction": asked.sub_function,
        "Words": [*asked.words[:125]],
    }


def opened(asked: Asked) -> dict[str, Value]:
    """The open request as the structure that builders write."""
    return {
        "UnitAddress": asked.unit,
        "FunctionCode": asked.function,
        "Address": asked.address,
        "Quantity": asked.quantity,
        "SubFunction": asked.sub_function,
        "Value": asked.value,
    }


def build(blocks: Blocks, prefix: str, asked: Asked) -> Sent:
    """Run a drive's request block."""
    done = blocks.run(f"{prefix}_Request", {**pins(asked), "Request.FunctionCode": 99})
    length = number(done, "Length")
    name = result(done)
    assert (length > 0) == (name == "OK"), (name, length)
    request = {name: done[f"Request.{name}"] for name in opened(asked)}
    return Sent(Built(name, octets(done, "Adu", length)), request)


def frame(blocks: Blocks, body: bytes, *, ascii_mode: bool) -> bytes:
    """Body to what goes on the wire; empty with an error."""
    if ascii_mode:
        done = blocks.run("MB_AsciiEncode", {"Length": len(body), "Adu": body})
        return octets(done, "Chars", number(done, "CharCount"))
    done = blocks.run("MB_RtuSeal", {"Length": len(body), "Adu": body})
    return octets(done, "Adu", number(done, "AduLength"))


def unframe(blocks: Blocks, data: bytes, *, ascii_mode: bool) -> Built:
    """What was received to its body."""
    block, count, box = ("MB_AsciiDecode", "CharCount", "Chars") if ascii_mode else ("MB_RtuOpen", "AduLength", "Adu")
    done = blocks.run(block, {count: len(data), box: data[: LONGEST[ascii_mode]]})
    return Built(result(done), octets(done, "Adu", number(done, "Length")))


def parse(blocks: Blocks, block: str, request: dict[str, Value], body: bytes, **settings: Value) -> Answer:
    """Compare a body with the open request; `block` is a drive's or the generic one."""
    given = {f"Request.{name}": value for name, value in request.items()}
    done = blocks.run(block, {"Length": len(body), "Adu": body[:256], **given, **settings})
    found = words(done, "Words", number(done, "WordCount"))
    return Answer(result(done), found, number(done, "Reason"))


def receive(blocks: Blocks, prefix: str, request: dict[str, Value], data: bytes, *, ascii_mode: bool) -> Answer:
    """What was received to an answer, through the framing and the drive's reply block."""
    body = unframe(blocks, data, ascii_mode=ascii_mode)
    return parse(blocks, f"{prefix}_Reply", request, body.body) if body.result == "OK" else Answer(body.result)
