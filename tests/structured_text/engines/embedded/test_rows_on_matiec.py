"""What the rows of these tests say of C is what matiec and a C compiler do."""

from __future__ import annotations

import math

from tests.structured_text.engines.embedded import test_conversions, test_overflow, test_shifts, test_strings_and_times
from tests.structured_text.engines.embedded.snippets import FAULT, Row

from structured_text.engines.engine import Engine, Source

# matiec declares these and has no C for them.
ABSENT = ("SHL(q", "ROL(q")
# Where OpenPLC's line is not like Beremiz', which the rows follow: the shorter string decides, and FIND is at sea.
OPENPLC = {
    "FIND(s, z) {'s': b'aab', 'z': b'ab'}": 4,
    "FIND(s, z) {'s': b'abc', 'z': b''}": 1,
    "s = z {'s': b'', 'z': b'x'}": True,
    "s < z {'s': b'ab', 'z': b'abc'}": False,
}
ROWS = [*test_overflow.ROWS, *test_shifts.ROWS, *test_conversions.ROWS, *test_strings_and_times.ALL]


def source(number: int, row: Row) -> str:
    """A block for one row."""
    expression, result, inputs, *_ = row
    declared = f"VAR_INPUT\n  {inputs}\nEND_VAR\nVAR_OUTPUT\n  Answer : {result};\nEND_VAR"
    return f"FUNCTION_BLOCK Row{number}\n{declared}\n  Answer := {expression};\nEND_FUNCTION_BLOCK\n"


def test_c_column(matiec: Engine) -> None:
    """All rows in one build; those at which the processor would trap are left out."""
    rows = [row for row in ROWS if row[4] != FAULT and not row[0].startswith(ABSENT)]
    library = matiec.build([Source("rows.st", "".join(source(number, row) for number, row in enumerate(rows)))])
    wrong = []
    for number, row in enumerate(rows):
        instance = library.instance(f"Row{number}")
        for name, value in row[3].items():
            instance[name] = value
        instance.scan(0)
        found, expected = instance["Answer"], row[4]
        if matiec.name == "matiec-openplc":
            expected = OPENPLC.get(f"{row[0]} {row[3]}", expected)
        if found != expected and not (isinstance(found, float) and math.isnan(found)):
            wrong.append((row[0], row[3], expected, found))
    assert not wrong
