"""A fixed typical input for every block and function of the library, so that a count of instructions means something.

A program reads ten registers of unit 1 by function 03H and gets its reply; the drive runs forward without a fault.
"""

from tests.shipped import drives

from driveblocks.reference.checksum import crc16
from structured_text.language.tree import Function, FunctionBlock, VarDecl, VarKind

Pin = bool | int | float | bytes | list[int] | dict[str, int]

WORDS = [1000 + 17 * index for index in range(10)]
ASKED = bytes((1, 3, 0, 0, 0, 10))
BODY = bytes((1, 3, 20)) + b"".join(word.to_bytes(2, "big") for word in WORDS)
ASKED_RTU, REPLY_RTU = (body + crc16(body).to_bytes(2, "little") for body in (ASKED, BODY))
REPLY_ASCII = b":" + (BODY + bytes((-sum(BODY) % 256,))).hex().upper().encode() + b"\r\n"
REQUEST = {"UnitAddress": 1, "FunctionCode": 3, "Address": 0, "Quantity": 10, "SubFunction": 0, "Value": 0}

USUAL: dict[str, Pin] = {
    "Counted": {},
    "Member": {},
    "Members": {},
    "Number": 10,
    "Character": 0x41,
    "Length": len(BODY),
    "AduLength": len(REPLY_RTU),
    "CharCount": len(ASKED_RTU),
    "Adu": REPLY_RTU,
    "Chars": REPLY_ASCII,
    "Words": WORDS,
    "Registers": [*ASKED_RTU],
    "Request": REQUEST,
    "UnitAddress": 1,
    "FunctionCode": 3,
    "Address": 0,
    "Quantity": 10,
    "MaxWords": 123,
    "SubFunction": 0,
    "Ascii": False,
    "ExceptionAdd": 128,
    "ErrorFunction": 0,
    "ErrorAddress": 0,
    "TwoByteCount": False,
    "Enable": True,
    "RunForward": True,
    "SpeedReferenceHz": 42.5,
    "MaximumHz": 50.0,
    "FullScaleHz": 60.0,
    "ReferenceScale": 100.0,
    "FaultContents1Word": 0x0040,
    "Value": 1,
    "Raw": 5000,
    "Code": 2,
}
"""Pin -> its value in every block that has it and does not say otherwise; 0 or FALSE for all others."""

SPECIAL: dict[str, dict[str, Pin]] = {
    "MB_RtuSeal": {"Length": len(ASKED), "Adu": ASKED},
    "MB_AsciiEncode": {"Length": len(ASKED), "Adu": ASKED},
    "MB_AsciiDecode": {"CharCount": len(REPLY_ASCII)},
    "MB_PackAdu8": {"Adu": ASKED_RTU},
    "MB_PackAdu16": {"Adu": ASKED_RTU},
    "MB_PackChars8": {"CharCount": 17},
    "MB_PackChars16": {"CharCount": 17},
    "MB_UnpackChars8": {"CharCount": 17},
    "MB_UnpackChars16": {"CharCount": 17},
    "MB_ResultTextEn": {"Code": 23},
    "MB_ResultTextZh": {"Code": 23},
    "CHF_Request": {"Address": 0x1000, "Quantity": 2},
    "CHF_CanRead": {"Address": 0x1000, "Quantity": 2},
    "CHF_CanWrite": {"Address": 0x1000, "Quantity": 1},
    "CHF_ValueTextEn": {"Address": 0x1000},
    "CHF_ValueTextZh": {"Address": 0x1000},
    "GD200A_Request": {"Address": 0x2000, "Quantity": 2},
    **{
        f"{prefix}_Request": {"Address": 0x2100, "Quantity": 1} for prefix in ("PF4", "PF400", "PF40P", "PF4M", "PF525")
    },
    "ATV312_Request": {"Address": 0x0C81, "Quantity": 6},
    "ATV312_CanRead": {"Address": 0x0C81, "Quantity": 6},
    "ATV312_CanWrite": {"Address": 0x2135, "Quantity": 1},
    "ATV312_BitTextEn": {"Address": 0x0C81},
    "MX2_Request": {"Address": 0x1000, "Quantity": 3},
    "MX2_CanRead": {"Address": 0x1000, "Quantity": 3},
    "MX2_CanWrite": {"Address": 0x0000, "Quantity": 2},
    "MX2_ValueTextEn": {"Address": 0x0002},
    "GD200A_CanRead": {"Address": 0x2100, "Quantity": 2},
    "GD200A_CanWrite": {"Address": 0x2000, "Quantity": 1},
    "GD200A_ValueTextEn": {"Address": 0x2000},
    "GD200A_BitTextEn": {"Address": 0x2101},
    "JSCC_ValueTextEn": {"Address": 0x1000},
    "JSCC_ValueTextZh": {"Address": 0x1000},
    "SN300G5_BitTextEn": {"Address": 0x0010},
    "SN300G5_BitTextZh": {"Address": 0x0010},
    "SN300G5_Request": {"Address": 0x0020},
    "SN300G5_CanRead": {"Address": 0x0020},
    "SN300G5_CanWrite": {"Address": 0x0001, "Quantity": 1},
}
"""Block -> what is special in it: the addresses that a drive has, the frame that goes the other way."""


def pins(block: Function | FunctionBlock) -> dict[str, Pin]:
    """The typical input of a block: a value for every input and in-out, in the order of their declaration."""
    declared = [
        variable
        for group in block.blocks
        if group.kind in {VarKind.INPUT, VarKind.IN_OUT}
        for variable in group.variables
    ]
    return {variable.name: _value(block.name, variable) for variable in declared}


def _value(block: str, variable: VarDecl) -> Pin:
    special = SPECIAL.get(block) or _of_drive(block)
    return special.get(variable.name, USUAL.get(variable.name, 0))


def _of_drive(block: str) -> dict[str, Pin]:
    """Of a drive block that is not listed: its status word for what reads, its command word for what writes."""
    prefix, _, kind = block.partition("_")
    if prefix not in drives() or not kind.startswith(("Request", "Can", "BitText", "ValueText")):
        return {}
    operation = drives()[prefix].operation
    register = operation.commands[0].register if kind == "CanWrite" else operation.status[0].any[0].register
    return {"Address": register, "Quantity": 1}
