"""String functions and comparisons; durations and dates."""

from __future__ import annotations

import pytest
from tests.structured_text.engines.embedded.snippets import FAULT, Row, assert_row, block

S = "s, z : STRING; n : INT;"
LONG = b"x" * 126
ROWS: list[Row] = [
    ("LEN(s)", "INT", S, {"s": b"abc"}, 3, 3),
    ("LEFT(s, 2)", "STRING", S, {"s": b"abc"}, b"ab", b"ab"),
    ("LEFT(s, 5)", "STRING", S, {"s": b"abc"}, b"abc", FAULT),
    ("LEFT(s, n)", "STRING", S, {"s": b"abc", "n": -1}, b"", FAULT),
    ("RIGHT(s, 2)", "STRING", S, {"s": b"abc"}, b"bc", b"bc"),
    ("RIGHT(s, 0)", "STRING", S, {"s": b"abc"}, b"", b""),
    ("MID(s, 2, 2)", "STRING", S, {"s": b"abcd"}, b"bc", b"bc"),
    ("MID(s, 9, 2)", "STRING", S, {"s": b"abcd"}, b"bcd", FAULT),
    ("MID(s, 1, 5)", "STRING", S, {"s": b"abcd"}, b"", FAULT),
    ("CONCAT(s, '-', z)", "STRING", S, {"s": b"a", "z": b"b"}, b"a-b", b"a-b"),
    ("CONCAT(s, 'y')", "STRING", S, {"s": LONG}, LONG, FAULT),
    ("INSERT(s, z, 1)", "STRING", S, {"s": b"ad", "z": b"bc"}, b"abcd", b"abcd"),
    ("INSERT(s, z, 3)", "STRING", S, {"s": b"ad", "z": b"bc"}, b"adbc", FAULT),
    ("DELETE(s, 2, 2)", "STRING", S, {"s": b"abcd"}, b"ad", b"ad"),
    ("DELETE(s, 2, 4)", "STRING", S, {"s": b"abcd"}, b"abc", FAULT),
    ("REPLACE(s, z, 2, 2)", "STRING", S, {"s": b"abcd", "z": b"XY"}, b"aXYd", b"aXYd"),
    ("REPLACE(s, z, 1, 2)", "STRING", S, {"s": b"abcd", "z": b"XY"}, b"aXcd", FAULT),
    ("FIND(s, z)", "INT", S, {"s": b"abcbc", "z": b"bc"}, 2, 2),
    ("FIND(s, z)", "INT", S, {"s": b"aab", "z": b"ab"}, 0, FAULT),
    ("FIND(s, z)", "INT", S, {"s": b"abc", "z": b""}, 0, FAULT),
    ("s = z", "BOOL", S, {"s": b"ab", "z": b"ab"}, True, True),
    ("s = z", "BOOL", S, {"s": b"ab", "z": b"ac"}, False, False),
    ("s < z", "BOOL", S, {"s": b"ab", "z": b"b"}, True, True),
    # OpenPLC's compiler compares no more characters than the shorter one has.
    ("s = z", "BOOL", S, {"s": b"", "z": b"x"}, False, FAULT),
    ("s < z", "BOOL", S, {"s": b"ab", "z": b"abc"}, True, FAULT),
    ("SEL(n > 0, s, z)", "STRING", S, {"s": b"a", "z": b"b", "n": 1}, b"b", b"b"),
    ("MUX(n, s, z)", "STRING", S, {"s": b"a", "z": b"b", "n": 1}, b"b", b"b"),
    ("MUX(n, s, z)", "STRING", S, {"s": b"a", "z": b"b", "n": 2}, b"", FAULT),
]

T = "t, v : TIME; n : INT; r : REAL;"
MS = 1_000_000
TIME_ROWS: list[Row] = [
    ("t + v", "TIME", T, {"t": 300 * MS, "v": 800 * MS}, 1100 * MS, 1100 * MS),
    ("t - v", "TIME", T, {"t": 300 * MS, "v": 800 * MS}, -500 * MS, -500 * MS),
    # 500 ms + 500 ms is 0 s and 1000000000 ns on matiec, which is no 1 s.
    ("t + v", "TIME", T, {"t": 500 * MS, "v": 500 * MS}, 1000 * MS, FAULT),
    ("t + v = T#1s", "BOOL", T, {"t": 500 * MS, "v": 500 * MS}, False, FAULT),
    ("t > v", "BOOL", T, {"t": 1500 * MS, "v": 900 * MS}, True, True),
    ("t * n", "TIME", T, {"t": 250 * MS, "n": 3}, 750 * MS, 750 * MS),
    ("t * n", "TIME", T, {"t": 100 * MS, "n": 32767}, -2147483648, FAULT),
    ("t / n", "TIME", T, {"t": 1000 * MS, "n": 4}, 250 * MS, 250 * MS),
    ("t / n", "TIME", T, {"t": 1000 * MS, "n": 0}, 9223372036854775807 * 10**9 - 2**63 + 10**9, FAULT),
    ("t * r", "TIME", T, {"t": 1000 * MS, "r": 0.25}, 250 * MS, 250 * MS),
    ("ADD_TIME(t, v)", "TIME", T, {"t": MS, "v": MS}, 2 * MS, 2 * MS),
    ("MULTIME(t, n)", "TIME", T, {"t": MS, "n": 5}, 5 * MS, 5 * MS),
    ("MAX(t, v)", "TIME", T, {"t": MS, "v": 2 * MS}, 2 * MS, 2 * MS),
    ("LIMIT(T#0s, t, v)", "TIME", T, {"t": 3 * MS, "v": 2 * MS}, 2 * MS, 2 * MS),
    ("STRING_TO_TIME('T#-1m30.5s')", "TIME", T, {}, 0, FAULT),
    ("STRING_TO_TIME('12')", "TIME", T, {}, 12_000 * MS, FAULT),
    ("TIME_TO_STRING(t)", "STRING", T, {"t": 90_061_500 * MS}, b"T#1d1h1m1s500ms", FAULT),
]

DAY = 86_400 * 10**9
DATES = "dt1, dt2 : DT; d1 : DATE; tod1 : TOD;"
MOMENT = 5 * DAY + 3_600 * 10**9
DATE_ROWS: list[Row] = [
    ("dt1 - dt2", "TIME", DATES, {"dt1": MOMENT, "dt2": MOMENT - 7 * 10**9}, 7 * 10**9, 7 * 10**9),
    ("dt1 + T#2s", "DT", DATES, {"dt1": MOMENT}, MOMENT + 2 * 10**9, MOMENT + 2 * 10**9),
    ("DT_TO_DATE(dt1)", "DATE", DATES, {"dt1": MOMENT}, 5 * DAY, 5 * DAY),
    ("DT_TO_TOD(dt1)", "TOD", DATES, {"dt1": MOMENT}, 3_600 * 10**9, 3_600 * 10**9),
    ("CONCAT_DATE_TOD(d1, tod1)", "DT", DATES, {"d1": 5 * DAY, "tod1": 3_600 * 10**9}, MOMENT, MOMENT),
    ("DT#1970-01-06-01:00:00", "DT", DATES, {}, MOMENT, MOMENT),
    ("DATE_TO_STRING(d1)", "STRING", DATES, {"d1": 5294 * DAY}, b"D#1984-06-30", FAULT),
    ("TOD_TO_STRING(tod1)", "STRING", DATES, {"tod1": 56_215 * 10**9}, b"TOD#15:36:55", FAULT),
    (
        "TOD_TO_STRING(tod1)",
        "STRING",
        DATES,
        {"tod1": 55_360_000_000},
        b"TOD#00:00:55.360000",
        FAULT,
    ),
    (
        "DT_TO_STRING(dt1)",
        "STRING",
        DATES,
        {"dt1": MOMENT},
        b"DT#1970-01-06-01:00:00",
        FAULT,
    ),
    ("dt1 > dt2", "BOOL", DATES, {"dt1": 2, "dt2": 1}, True, True),
]


ALL = [*ROWS, *TIME_ROWS, *DATE_ROWS]


@pytest.mark.parametrize("row", ALL, ids=lambda row: f"{row[0]} {row[3]}")
def test_each_row(row: Row) -> None:
    """One row: what C makes of it, or a fault."""
    assert_row(row)


def test_strings_are_cut_at_their_length() -> None:
    """STRING[n] holds n characters."""
    made = block("VAR_INPUT s : STRING; END_VAR VAR y : STRING[3]; z : STRING := 'abc'; END_VAR", "y := s; z := 'xy';")
    made["s"] = b"abcdef"
    made.scan()
    assert (made["y"], made["z"]) == (b"abc", b"xy")
