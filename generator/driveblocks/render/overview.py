"""`blocks/README.md`: every block with its purpose, pins, memory and loops, and an example of use per drive."""

import re
from collections.abc import Sequence

from driveblocks.maps.model import Drive
from driveblocks.maps.view import UNPROVED
from driveblocks.render import context
from driveblocks.render.environment import render
from driveblocks.render.library import File
from structured_text.language.tree import Checked, Function, FunctionBlock, VarDecl, VarKind
from structured_text.language.types import Type

_TITLE = re.compile(r"\(\* \w+: (.*?)\n\s+-{20,}", re.DOTALL)
_LOOPS = re.compile(r"^ {3}Loops {4}(.*?)\n {3}Body", re.DOTALL | re.MULTILINE)
PAGES = ("_Drive", "_HardStop")
"""Ends of the names of blocks that have a page."""
_PINS = {VarKind.INPUT: "in", VarKind.IN_OUT: "in-out", VarKind.OUTPUT: "out"}


def overview(
    files: list[File],
    drives: list[Drive],
    checked: Checked,
    platforms: Sequence[tuple[str, str]],
    *,
    linked: bool = True,
) -> str:
    """The page's text; reads names, pins and sizes from the blocks themselves.

    `platforms` are the folders that are built beside it, and whom each is for.

    `linked`: the canonical files are there, so that a name leads to its file.
    """
    rows: dict[str, list[dict[str, object]]] = {}
    for file in files:
        block = checked.blocks.get(file.name.upper()) or checked.functions.get(file.name.upper())
        if block is not None:
            found = rows.setdefault(file.folder, [])
            found.insert(0 if file.name.endswith("_Drive") else len(found), _row(file, block))
    types = {file.name: checked.types[file.name.upper()] for file in files if file.folder == "types"}
    known = {drive.prefix: context.identity(drive) for drive in drives}
    return render(
        "README.md.j2",
        platforms=platforms,
        families=[drive.prefix for drive in drives],
        linked=linked,
        results=_results(files),
        groups={_heading(folder, known, files): found for folder, found in rows.items()},
        unproved={known[drive.prefix].family: UNPROVED for drive in drives if not drive.frames},
        types=[_type(file, types) for file in files if file.name in types],
        texts=next((file.name for file in files if file.name.startswith("MB_ResultText")), "the page above"),
        examples=[
            _example(drive, known[drive.prefix], checked.blocks)
            for drive in drives
            if f"{drive.prefix}_Request".upper() in checked.blocks
        ],
    )


def _results(files: list[File]) -> str:
    """The functions that know the result codes, as the start of a sentence."""
    names = [f"`{file.name}`" for file in files if file.name.startswith("MB_ResultText")]
    return " and ".join(names) + (" turn" if len(names) > 1 else " turns")


def _heading(folder: str, known: dict[str, context.Identity], files: list[File]) -> str:
    """The family whose blocks are in a folder, by the prefix of their names."""
    if folder == "line":
        return "The line: one block per RS-485 port"
    if folder == "device":
        return "A meter or a sensor on the line"
    if folder == "plant":
        return "Several drives: groups, analog inputs, hours and starts"
    if folder == "vfd":
        return "What the drive blocks of all families share"
    prefix = next(file.name.partition("_")[0] for file in files if file.folder == folder)
    return known[prefix].family if prefix in known else "Blocks that every drive shares"


def _example(drive: Drive, known: context.Identity, blocks: dict[str, FunctionBlock]) -> dict[str, object]:
    """Values for the example of use: read what proves standstill, one register at a time, and decode it."""
    proof = context.standstill(drive)
    decoders = [one for one in context.decoders(drive) if one.name.upper() in blocks]
    decoder = next((one for one in decoders if one.address_text == proof.words[0].address_text), None)
    return {"drive": known, "word": proof.words[0], "decoder": decoder}


def _row(file: File, block: Function | FunctionBlock) -> dict[str, object]:
    return {
        "name": file.name,
        "path": f"iec61131/{file.path}",
        "title": _found(_TITLE, file.text),
        "kind": "FB" if isinstance(block, FunctionBlock) else "function",
        "pins": _pins(block),
        "page": f"docs/{file.name}.md" if file.name.endswith(PAGES) else "",
        "bytes": block.type.size if isinstance(block, FunctionBlock) and block.type else 0,
        "loops": _found(_LOOPS, file.text),
    }


def _found(pattern: re.Pattern[str], text: str) -> str:
    match = pattern.search(text)
    return " ".join(match[1].split()) if match else ""


def _type(file: File, types: dict[str, Type]) -> dict[str, object]:
    title = _found(_TITLE, file.text)
    return {"name": file.name, "path": f"iec61131/{file.path}", "title": title, "bytes": types[file.name].size}


def _pins(block: Function | FunctionBlock) -> dict[str, list[VarDecl]]:
    """Inputs, in-outs and outputs, where a block has such."""
    pins = {kind: [one for group in block.blocks if group.kind is kind for one in group.variables] for kind in _PINS}
    return {_PINS[kind]: some for kind, some in pins.items() if some}
