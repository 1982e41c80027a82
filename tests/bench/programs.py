"""Structured Text of the bench's own: the chains of blocks that a program calls, and forms that the library leaves out.

`BN_DriveAskRtu`, `BN_DriveReadRtu`, `..Ascii`: a drive's own request and reply blocks with the framing, as a program
calls them; `BN_Any...`: the same with the blocks that every drive shares.
"""

import re
from pathlib import Path

from tests.blocks.library import sources

from structured_text.engines.engine import Source

FOLDER = Path(__file__).with_name("st")
MODES = ("Rtu", "Ascii")
ASKED = "UnitAddress := UnitAddress, FunctionCode := 3, Address := Address, Quantity := Quantity"
BUILD = {
    "Drive": ("JSCC_Request", f"Ascii := {{ascii}}, {ASKED}, Value := WORD#16#0000, SubFunction := WORD#16#0000,\n"
    "    Words := Words, Adu := Adu, Request := Request"),
    "Any": ("MB_BuildRead", f"{ASKED}, MaxWords := 125,\n    Adu := Adu, Request := Request"),
}  # fmt: skip
PARSE = {
    "Drive": ("JSCC_Reply", "Length := Open.Length,"),
    "Any": ("MB_ParseReply", "Length := Open.Length, ExceptionAdd := 128, ErrorFunction := 0,\n"
    "      ErrorAddress := WORD#16#0000, TwoByteCount := FALSE,"),
}  # fmt: skip
SEAL = {
    "Rtu": ("MB_RtuSeal", "Length := Build.Length, Adu := Adu", "AduLength"),
    "Ascii": ("MB_AsciiEncode", "Length := Build.Length, Adu := Adu, Chars := Chars", "CharCount"),
}
OPEN = {
    "Rtu": ("MB_RtuOpen", "AduLength := Count, Adu := Adu"),
    "Ascii": ("MB_AsciiDecode", "CharCount := Count, Chars := Chars, Adu := Adu"),
}
CHARS = {"Rtu": "", "Ascii": "  Chars : MB_Chars;     (* the frame as characters *)\n"}


def programs() -> list[Source]:
    """The bench's own ST, to be compiled after the library."""
    chains = [make(whose, mode) for whose in BUILD for mode in MODES for make in (_ask, _read)]
    table = re.search(r"  TABLE : .*?\];\n", next(one.text for one in sources() if "TABLE :" in one.text), re.DOTALL)
    assert table is not None
    forms = [path.read_text("utf-8").replace("@TABLE@\n", table[0]) for path in sorted(FOLDER.glob("*.st"))]
    return [Source(f"bench{number}.st", text) for number, text in enumerate([*chains, *forms])]


def _ask(whose: str, mode: str) -> str:
    block, pins = BUILD[whose]
    seal, given, count = SEAL[mode]
    return f"""FUNCTION_BLOCK BN_{whose}Ask{mode}
VAR_INPUT
  UnitAddress : UINT := 1;     (* unit *)
  Address : WORD;              (* first register *)
  Quantity : UINT := 10;       (* registers *)
END_VAR
VAR_OUTPUT
  Count : UINT;   (* bytes or characters to send *)
  ErrorID : UINT; (* 0 or why there is no frame *)
END_VAR
VAR
  Build : {block};  (* the request *)
  Seal : {seal};    (* the frame *)
  Words : MB_Words;     (* not used by a read *)
  Adu : MB_Adu;         (* the frame as bytes *)
{CHARS[mode]}  Request : MB_Request; (* what was asked *)
END_VAR

  Build({pins.format(ascii="TRUE" if mode == "Ascii" else "FALSE")});
  ErrorID := Build.ErrorID;
  Count := 0;
  IF ErrorID = 0 THEN
    Seal({given});
    Count := Seal.{count};
  END_IF;
END_FUNCTION_BLOCK
"""


def _read(whose: str, mode: str) -> str:
    block, pins = PARSE[whose]
    opener, given = OPEN[mode]
    return f"""FUNCTION_BLOCK BN_{whose}Read{mode}
VAR_INPUT
  Count : UINT; (* bytes or characters received *)
END_VAR
VAR_OUTPUT
  WordCount : UINT; (* registers read *)
  ErrorID : UINT;   (* 0 or why the reply is not believed *)
END_VAR
VAR
  Open : {opener};  (* the frame *)
  Parse : {block};  (* the reply *)
  Words : MB_Words;     (* the registers *)
  Adu : MB_Adu;         (* the frame as bytes *)
{CHARS[mode]}  Request : MB_Request; (* what was asked *)
END_VAR

  Request.UnitAddress := 1;
  Request.FunctionCode := 3;
  Request.Address := WORD#16#0000;
  Request.Quantity := 10;
  WordCount := 0;
  Open({given});
  ErrorID := Open.ErrorID;
  IF ErrorID = 0 THEN
    Parse({pins} Adu := Adu, Request := Request, Words := Words);
    ErrorID := Parse.ErrorID;
    WordCount := Parse.WordCount;
  END_IF;
END_FUNCTION_BLOCK
"""
