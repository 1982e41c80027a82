"""The requests of a program for one motor where the PLC's own master has a channel for each."""

from driveblocks.maps.model import Drive
from driveblocks.render import context
from driveblocks.render.context import Context
from driveblocks.render.drive import drive_block
from driveblocks.render.motor import motor


def channels(drive: Drive) -> Context:
    """For codesys/Master: the requests with the words that matter, and the blocks that make and read them."""
    block = drive_block(drive)
    stop = next(one for one in drive.operation.commands if one.does == "stop")
    decoders = {one["address_text"]: one["name"] for one in context.decoders(drive)}
    scales = {one["address_text"]: one["name"] for one in context.scales(drive)}
    needed = {one.name for one in block["proof"]} | {one.pin for one in block["verify"]}
    reads = [
        {
            "read": one["read"],
            "words": [
                {**vars(each), "decoder": decoders.get(each.address_text), "scale": scales.get(each.address_text)}
                for each in one["words"]
                if each.name in needed or each.address_text in decoders.keys() | scales.keys()
            ],
        }
        for one in block["reads"]
    ]
    reads = [one for one in reads if one["words"]]
    pins = {one.pin for one in block["verify"]}
    checks = [turn for turn, one in enumerate(reads, 2) if pins & {each["name"] for each in one["words"]}]
    return {**block, **motor(drive), "command": stop.register, "reads": reads, "checks": checks}
