"""ST that goes wrong on purpose: an index beside its array, a number beside its type, blocks with a fault in each."""

from pathlib import Path

from tests.blocks.library import BLOCKS, alone
from tests.native.driver import Driver
from tests.native.sanitize.sanitizers import Checked

from structured_text.engines.engine import Source
from structured_text.engines.matiec import MatiecEngine

ACCESSES = ("read_own", "write_own", "read_inout", "write_inout", "read_field", "write_field")
LENGTHS = {"own": 5, "inout": 256, "field": 3}
"""Elements of each array."""
TEXT = """
TYPE PL_Table : ARRAY[0..4] OF WORD; END_TYPE
TYPE PL_Few : ARRAY[0..2] OF BYTE; END_TYPE
TYPE PL_Record : STRUCT Before : WORD; Few : PL_Few; Behind : WORD; END_STRUCT; END_TYPE
FUNCTION_BLOCK PL_Index
VAR_INPUT
  Access : INT;
  Index : DINT;
END_VAR
VAR_IN_OUT
  Adu : MB_Adu;
END_VAR
VAR
  Before : PL_Table;
  Table : PL_Table;
  Behind : PL_Table;
  Rec : PL_Record;
  Seen : WORD;
END_VAR

  CASE Access OF
    0: Seen := Table[Index];
    1: Table[Index] := Seen;
    2: Seen := BYTE_TO_WORD(Adu[Index]);
    3: Adu[Index] := BYTE#16#01;
    4: Seen := BYTE_TO_WORD(Rec.Few[Index]);
    5: Rec.Few[Index] := BYTE#16#01;
  ELSE
    Seen := WORD#16#0000;
  END_CASE;
END_FUNCTION_BLOCK
FUNCTION_BLOCK PL_Number
VAR_INPUT
  Way : INT;
  Big : UINT;
  Number : REAL;
END_VAR
VAR
  Sum : UINT;
  Whole : DINT;
END_VAR

  CASE Way OF
    0: Sum := Big + Big;
    1: Whole := REAL_TO_DINT(Number);
    2: Whole := 2147483647; Whole := Whole + UINT_TO_DINT(Big);
  ELSE
    Sum := 0;
  END_CASE;
END_FUNCTION_BLOCK
"""

MAIN = """
static PL_INDEX index_block;
static PL_NUMBER number_block;
int main(int argc, char **argv)
{
    START(PL_INDEX, index_block);
    START(PL_NUMBER, number_block);
    if (argc == 3) {
        index_block.ACCESS.value = atoi(argv[1]);
        index_block.INDEX.value = atoi(argv[2]);
        PL_INDEX_body__(&index_block);
    } else {
        number_block.WAY.value = atoi(argv[1]);
        number_block.BIG.value = 40000;
        number_block.NUMBER.value = 3.0e30f;
        PL_NUMBER_body__(&number_block);
    }
    printf("went on\\n");
    return 0;
}
"""


def build(engine: MatiecEngine, checked: Checked) -> Path:
    """Compile the blocks that go wrong. Raises what Driver.build raises."""
    adu = Source("adu.st", (BLOCKS / "types" / "MB_Adu.st").read_text(encoding="utf-8"))
    return Driver(MAIN, checked.options, checked.command).build(engine, [adu, Source("planted.st", TEXT)])


FAULTS = {
    "MB_RtuOpen": ("ELSIF AduLength > 256 THEN", "ELSIF AduLength > 257 THEN", "out of bounds"),
    "MB_AsciiDecode": ("ELSIF CharCount > 513 THEN", "ELSIF CharCount > 515 THEN", "out of bounds"),
    "MB_UnpackChars16": ("Last := 513;", "Last := 514;", "out of bounds"),
    "MB_ParseReply": ("AND (Length = 6) AND", "AND", "what is no refusal is taken for one"),
    "MB_Crc16Compact": ("Crc := WORD#16#FFFF;", "Crc := WORD#16#FFFE;", "the checksum is wrong"),
    "MB_AsciiEncode": ("CharCount := 0;", "CharCount := CharCount;", "CHARCOUNT in spite of an error"),
    "MB_BuildRead": ("UINT_TO_BYTE(Quantity)", "UINT_TO_BYTE(MaxWords)", "the frame is wrong"),
    "MB_PackAdu16": ("Position + 1 < Last", "Position + 1 <= Last", "the low byte of the last register is not empty"),
    "JSCC_Reply": ("WordCount := Parse.WordCount;", "WordCount := 0;", "the number of words is wrong"),
    "JSCC_Reference": ("NOT Number THEN", "NOT Number AND (MaximumHz < 0.0) THEN", "what is no number is taken"),
    "CHF_Reference": ("(MaximumHz >= LEAST)", "(MaximumHz >= 0.0)", "there is no maximum"),
    "SN300G5_Reference": ("NOT Full AND NOT Without THEN", "FALSE THEN", "there is no full scale"),
    "JSCC_Command": ("Halted := Stop OR QuickStop", "Halted := Stop", "a stop does not win"),
    "CHF_DriveStatus": ("Fault := Value", "Fault := Fault OR Value", "FAULT depends on the past"),
    "SN300G5_FaultNumber": ("Rest := SHR(Rest, 1) AND WORD#16#7FFF;", "Count := 0;", "a scan does not end"),
}
"""By block: what is changed, into what, and what must be said of it."""


def spoilt() -> list[Source]:
    """The library with all faults at once, each in a block of its own."""
    texts = []
    for each in alone():
        good, bad, _ = FAULTS.get(Path(each.path).stem, ("", "", ""))
        assert good in each.text, each.path
        texts.append(Source(each.path, each.text.replace(good, bad) if good else each.text))
    return texts
