"""`blocks/README.md`: every block with its purpose, pins, memory and loops, and an example of use per drive."""

import re
from collections.abc import Iterator

from driveblocks.maps.model import Drive
from driveblocks.render import context
from driveblocks.render.environment import render
from driveblocks.render.library import File
from driveblocks.st.checker import check
from driveblocks.st.parser import parse
from driveblocks.st.tree import Function, FunctionBlock, VarKind
from driveblocks.st.types import Type

_TITLE = re.compile(r"\(\* \w+: (.*?)\n\s+-{20,}", re.DOTALL)
_LOOPS = re.compile(r"^ {3}Loops {4}(.*?)\n {3}Made by", re.DOTALL | re.MULTILINE)
_PINS = {VarKind.INPUT: "in", VarKind.IN_OUT: "in-out", VarKind.OUTPUT: "out"}


def overview(files: list[File], drives: list[Drive]) -> str:
    """The page's text; reads names, pins and sizes from the blocks themselves."""
    checked = check([parse("\n".join(file.text for file in files), "library")])
    rows: dict[str, list[dict[str, object]]] = {}
    for file in files:
        block = checked.blocks.get(file.name.upper()) or checked.functions.get(file.name.upper())
        if block is not None:
            rows.setdefault(file.folder, []).append(_row(file, block))
    types = {file.name: checked.types[file.name.upper()] for file in files if file.folder == "types"}
    return render(
        "README.md.j2",
        groups={_heading(folder, drives, files): found for folder, found in rows.items()},
        types=[_type(file, types) for file in files if file.name in types],
        examples=[_example(drive, checked.blocks) for drive in drives],
    )


def _heading(folder: str, drives: list[Drive], files: list[File]) -> str:
    """The family whose blocks stand in a folder, by the prefix of their names."""
    if folder == "line":
        return "The line: one block per RS-485 port"
    prefix = next(file.name.partition("_")[0] for file in files if file.folder == folder)
    drive = next((drive for drive in drives if drive.prefix == prefix), None)
    return context.identity(drive).family if drive else "Blocks that every drive shares"


def _example(drive: Drive, blocks: dict[str, FunctionBlock]) -> dict[str, object]:
    """Values for the example of use: read what proves standstill, one register at a time, and decode it."""
    proof = context.standstill(drive)
    decoders = [one for one in context.decoders(drive) if one["name"].upper() in blocks]
    decoder = next((one for one in decoders if one["address_text"] == proof["words"][0]["address_text"]), None)
    return {"drive": context.identity(drive), "word": proof["words"][0], "decoder": decoder}


def _row(file: File, block: Function | FunctionBlock) -> dict[str, object]:
    return {
        "name": file.name,
        "path": f"iec61131/{file.path}",
        "title": _found(_TITLE, file.text),
        "kind": "FB" if isinstance(block, FunctionBlock) else "function",
        "pins": list(_pins(block)),
        "bytes": block.type.size if isinstance(block, FunctionBlock) and block.type else 0,
        "loops": _found(_LOOPS, file.text),
    }


def _found(pattern: re.Pattern[str], text: str) -> str:
    match = pattern.search(text)
    return " ".join(match[1].split()) if match else ""


def _type(file: File, types: dict[str, Type]) -> dict[str, object]:
    title = _found(_TITLE, file.text)
    return {"name": file.name, "path": f"iec61131/{file.path}", "title": title, "bytes": types[file.name].size}


def _pins(block: Function | FunctionBlock) -> Iterator[dict[str, str]]:
    for group in block.blocks:
        for variable in group.variables if group.kind in _PINS else ():
            yield {"kind": _PINS[group.kind], "name": variable.name, "type": str(variable.type)}
