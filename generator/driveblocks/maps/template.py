"""A device template of wb-mqtt-serial, as JSON, as a register table: its channels, each with its line.

What a channel leaves out is as the README of https://github.com/wirenboard/wb-mqtt-serial has it: holding registers,
u16, high word and high byte first; a scale multiplies what is read.
"""

import json
import re
from collections.abc import Iterator
from typing import Any

from driveblocks.maps.problem import Refused

HEADS = ("address", "name", "unit", "scale", "access", "table", "type", "word order")
_CHANNELS = re.compile(r'"channels"\s*:\s*\[')
_DECODER = json.JSONDecoder(parse_float=str)


def is_template(text: str) -> bool:
    """Whether a text is JSON, and no table."""
    return text.lstrip().startswith("{")


def lines(text: str, name: str) -> list[tuple[int, list[str]]]:
    """Heads, then a line for each address of a channel. Raises Refused for what is no template."""
    try:
        device = json.loads(text, parse_float=str).get("device")
    except (json.JSONDecodeError, RecursionError) as error:
        place = f"{error.lineno}:{error.colno}" if isinstance(error, json.JSONDecodeError) else "1:1"
        raise Refused(f"{name}:{place}: this is no JSON; name a template without {{{{ }}}}, or a table") from None
    wanted = device.get("channels") if isinstance(device, dict) else None
    for start in _CHANNELS.finditer(text):
        found = list(_channels(text, start.end()))
        if wanted and [each for _, each in found] == wanted:
            return [(1, list(HEADS)), *((line, cells) for line, each in found for cells in _rows(each))]
    raise Refused(f"{name}:1:1: no channels; a template of wb-mqtt-serial has them under `device`")


def _channels(text: str, at: int) -> Iterator[tuple[int, Any]]:
    """The entries of a list of good JSON, each with its line."""
    while (at := at + len(text[at:]) - len(text[at:].lstrip(" \t\r\n,"))) < len(text) and text[at] != "]":
        entry, end = _DECODER.raw_decode(text, at)
        yield text.count("\n", 0, at) + 1, entry
        at = end


def _rows(channel: Any) -> Iterator[list[str]]:
    """The cells of a channel; of one that is written elsewhere than read, of both."""
    said = {key: each for key, each in channel.items() if each is not None} if isinstance(channel, dict) else {}
    table = re.sub("_(single|multi)$", "", str(said.get("reg_type", "holding")))
    bit, elsewhere = table in ("coil", "discrete"), "write_address" in said
    kind, backwards, offset = (
        said.get("format", "u16"),
        said.get("byte_order", "big_endian"),
        str(said.get("offset", 0)),
    )
    rest = [
        table,
        "" if bit else str(kind) if backwards == "big_endian" else f"{kind} {backwards}",
        {"big_endian": "high", "little_endian": "low"}.get(said.get("word_order", "big_endian"), "?"),
    ]
    scale = str(said.get("scale", "")) + f" + {offset}" * (offset not in ("0", "0.0"))
    head = [str(said.get("name", "")), str(said.get("units", "")), scale]
    read_only = said.get("readonly") is True or table in ("discrete", "input")
    if "address" in said or not elsewhere:
        yield [str(said.get("address", "")), *head, "r" if read_only or elsewhere else "rw", *rest]
    if elsewhere:
        yield [str(said["write_address"]), *head, "w", *rest]
