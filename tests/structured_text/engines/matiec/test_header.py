"""The C that iec2c writes, read without a C compiler."""

from pathlib import Path

from structured_text.engines.matiec.c_lines import take_lines
from structured_text.engines.matiec.header import (
    AliasType,
    ArrayType,
    ConfigurationC,
    EnumType,
    Function,
    Member,
    Storage,
    StructType,
    read_configuration,
    read_header,
    read_locations,
)

HEADER = """#ifndef __POUS_H
__DECLARE_ARRAY_TYPE(__ARRAY_OF_INT_3_2,INT,[3][2])
__DECLARE_STRUCT_TYPE(CELL,
  INT A;
    __ARRAY_OF_INT_3_2 B;
  )
__DECLARE_STRUCT_TYPE(COPY,CELL)
__DECLARE_ENUMERATED_TYPE(KIND,
  KIND__RED,
  KIND__DARK_RED
)
__DECLARE_DERIVED_TYPE(SMALL,INT)
static inline SMALL __CHECK_SMALL(SMALL value) {
  if (value < 0)
    return 0;
}
// FUNCTION
INT SUM(
  BOOL EN,@
  BOOL *__ENO,@
  INT A,@
  CELL *__PLACE);
// FUNCTION_BLOCK WORKER
// Data part
typedef struct {
  // FB Interface - IN, OUT, IN_OUT variables
  __DECLARE_VAR(BOOL,EN)
  __DECLARE_VAR(CELL,FIRST)

  // FB private variables - TEMP, private and located variables
  TON TIMER;
  __DECLARE_EXTERNAL(INT,TOTAL)
  __DECLARE_EXTERNAL_FB(TON,SHARED)
  __DECLARE_LOCATED(BOOL,LAMP)

} WORKER;

void WORKER_init__(WORKER *data__, BOOL retain);
#endif //__POUS_H
""".replace("@", " ")  # iec2c leaves a blank at the end of these lines

CONFIGURATION = """
// CONFIGURATION PLANT
__DECLARE_GLOBAL(INT,PLANT,TOTAL)
__DECLARE_GLOBAL_FB(TON,PLANT,SHARED)
__DECLARE_GLOBAL_LOCATION(INT,__MW1)
__DECLARE_GLOBAL_LOCATED(INT,PLANT,LEVEL)

void CPU_init__(void);

void config_init__(void) {
  BOOL retain;
  __INIT_GLOBAL(INT,TOTAL,__INITIAL_VALUE(2),retain)
  CPU_init__();
}
"""

RESOURCE = """
// RESOURCE CPU
__DECLARE_GLOBAL(BOOL,CPU,OWN)
#include "POUS.c"
BOOL FAST;
WORKER CPU__MAIN;
#define MAIN CPU__MAIN
"""


def test_types_blocks_and_functions() -> None:
    header = read_header(HEADER)
    assert header.types == {
        "__ARRAY_OF_INT_3_2": ArrayType("INT", (3, 2)),
        "CELL": StructType((("INT", "A"), ("__ARRAY_OF_INT_3_2", "B"))),
        "COPY": AliasType("CELL"),
        "KIND": EnumType(("RED", "DARK_RED")),
        "SMALL": AliasType("INT"),
    }
    assert header.functions == {"SUM": Function("SUM", "INT", (("INT", "A", False), ("CELL", "PLACE", True)))}
    assert header.blocks["WORKER"].members == (
        Member("EN", "BOOL", Storage.VALUE, True),
        Member("FIRST", "CELL", Storage.VALUE, True),
        Member("TIMER", "TON", Storage.BLOCK, False),
        Member("TOTAL", "INT", Storage.POINTER, False),
        Member("SHARED", "TON", Storage.BLOCK_POINTER, False),
        Member("LAMP", "BOOL", Storage.LOCATED, False),
    )


def test_configuration(tmp_path: Path) -> None:
    (tmp_path / "POUS.c").touch()
    assert read_configuration(tmp_path) == ConfigurationC((), {})
    (tmp_path / "Plant.c").write_text(CONFIGURATION, encoding="utf-8")
    (tmp_path / "Cpu.c").write_text(RESOURCE, encoding="utf-8")
    found = read_configuration(tmp_path)
    assert found.files == ("Cpu.c", "Plant.c")
    assert found.globals == {"OWN": "BOOL", "TOTAL": "INT", "SHARED": "TON", "LEVEL": "INT"}


def test_locations_between_rubbish(tmp_path: Path) -> None:
    """One line of matiec writes names of variables in between."""
    assert read_locations(tmp_path) == {}
    text = "G1FBX__LOCATED_VAR(INT,__MW10,M,W,10)\nRG__LOCATED_VAR(BOOL,__IX0_1,I,X,0,1)\n"
    (tmp_path / "LOCATED_VARIABLES.h").write_text(text, encoding="utf-8")
    assert read_locations(tmp_path) == {"__MW10": "INT", "__IX0_1": "BOOL"}


def test_lines_of_the_c_lead_to_lines_of_the_st() -> None:
    c_text = (
        '// FUNCTION\nINT SUM(\n  BOOL EN)\n{\n#line 7 "source.st"\n  A = F(\n    1,\n    2);\n#line 8 "source.st"\n'
        "  B = 1;\n}\nvoid WORKER_init__(WORKER *data__, BOOL retain) {\n  X;\n}\n"
        "void WORKER_body__(WORKER *data__) {\n"
        '  Y;\n#line 20 "source.st"\n  Z;\n'
    )
    text, lines = take_lines(c_text, {"SUM": 3, "WORKER": 12})
    assert "#line" not in text
    assert text.count("\n") == c_text.count("\n")
    expected = [0, *[3] * 3, *[7] * 4, *[8] * 3, *[12] * 5, *[20] * 2]
    assert [lines.line(n) for n in range(1, 19)] == expected
