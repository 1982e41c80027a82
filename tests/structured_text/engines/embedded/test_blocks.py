"""Function blocks and functions: instances, parameters, copies and references, initial values."""

from __future__ import annotations

import pytest
from tests.structured_text.engines.embedded.snippets import block, build

from structured_text.engines.engine import ScanError

TYPES = """
TYPE Row : ARRAY[0..3] OF INT; END_TYPE
TYPE Point : STRUCT X : INT := 3; Y : INT; Trail : Row; END_STRUCT; END_TYPE
TYPE Points : ARRAY[1..3] OF Point; END_TYPE
TYPE Colour : (Red, Green, Blue); END_TYPE
TYPE Late : (Early, Middle, Last) := Last; END_TYPE
TYPE Grid : ARRAY[0..1, -1..1] OF INT := [1, 2, 3, 4]; END_TYPE
TYPE Filled : ARRAY[1..6] OF INT := [7, 2(1), 9]; END_TYPE
"""


class TestState:
    """What an instance keeps, and what it forgets."""

    def test_variables_live_on(self) -> None:
        """From call to call, and in each instance apart."""
        library = build("FUNCTION_BLOCK B VAR n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK")
        one, other = library.instance("B"), library.instance("b")
        for _ in range(3):
            one.scan()
        other.scan()
        assert (one["n"], other["N"]) == (3, 1)

    def test_temporary_variables_start_anew(self) -> None:
        """IEC 61131-3 table 16: VAR_TEMP; they are no part of the state."""
        text = "VAR y : INT; END_VAR VAR_TEMP t : INT := 5; a : Row; END_VAR"
        made = block(text, "t := t + 1; a[1] := a[1] + t; y := a[1];", types=TYPES)
        made.scan()
        made.scan()
        assert made["y"] == 6
        assert list(made.state()) == ["Y"]

    def test_locals_of_functions_start_anew(self) -> None:
        """Scalars, arrays and structures alike."""
        text = f"""{TYPES}
FUNCTION F : INT
VAR_INPUT step : INT; END_VAR
VAR n : INT := 10; a : Row; p : Point; END_VAR
  n := n + step;
  a[0] := a[0] + n;
  p.X := p.X + a[0];
  F := F + p.X;
END_FUNCTION"""
        library = build(text)
        assert [library.call("F", {"step": 2}) for _ in range(3)] == [15, 15, 15]

    def test_initial_values(self) -> None:
        """Of types and of declarations, with repetitions, in order row by row."""
        declarations = """VAR
  a : Filled; b : Row := [5, 3(6)]; g : Grid; p : Point; q : Point := (Y := 8, Trail := [1, 2]);
  c : Colour; late : Late; ps : Points; s : STRING := 'a$$b'; t : TIME := T#1m30s; r : REAL := 0.1;
  w : WORD := WORD#16#A001; n : INT := -5; e : Colour := Blue; o : BOOL := TRUE;
END_VAR"""
        made = block(declarations, "n := n;", types=TYPES)
        assert made["a"] == [7, 1, 1, 9, 0, 0]
        assert made["b"] == [5, 6, 6, 6]
        assert made["g"] == [[1, 2, 3], [4, 0, 0]]
        assert made["p"] == {"X": 3, "Y": 0, "TRAIL": [0, 0, 0, 0]}
        assert made["q"] == {"X": 3, "Y": 8, "TRAIL": [1, 2, 0, 0]}
        assert made["ps[3]"] == {"X": 3, "Y": 0, "TRAIL": [0, 0, 0, 0]}
        assert [made[name] for name in ("c", "late", "e", "s", "t", "n", "o", "w")] == [
            *(0, 2, 2, b"a$b", 90_000_000_000, -5, True, 0xA001)
        ]
        assert made["r"] == 0.10000000149011612


class TestCopies:
    """Arrays and structures are values."""

    def test_assignment_copies(self) -> None:
        """A later change of one does not touch the other."""
        declarations = "VAR p, q : Point; a, b : Row; ps : Points; END_VAR"
        body = "p.Trail[1] := 5; q := p; p.Trail[1] := 6; p.X := 9; a := q.Trail; q.Trail[1] := 7; ps[2] := p; b := a;"
        made = block(declarations, body, types=TYPES)
        made.scan()
        assert made["q"] == {"X": 3, "Y": 0, "TRAIL": [0, 7, 0, 0]}
        assert (made["a"], made["b"]) == ([0, 5, 0, 0], [0, 5, 0, 0])
        assert made["ps[2].Trail[1]"] == 6
        assert made["ps[1].Trail[1]"] == 0

    def test_arrays_of_arrays_copy_all_the_way(self) -> None:
        """Two dimensions, and structures in an array."""
        made = block(
            "VAR g, h : Grid; x, y : Points; END_VAR", "h := g; g[1, 1] := 9; y := x; x[1].Y := 8;", types=TYPES
        )
        made.scan()
        assert (made["h[1,1]"], made["y[1].Y"]) == (0, 0)

    def test_inputs_are_copies(self) -> None:
        """A block that writes to its input does not write to what was handed in."""
        text = f"""{TYPES}
FUNCTION_BLOCK Inner
VAR_INPUT a : Row; p : Point; END_VAR
VAR_OUTPUT out : Point; END_VAR
  a[0] := 1;
  p.X := 2;
  out := p;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Test
VAR i : Inner; a : Row; p, q : Point; END_VAR
  i(a := a, p := p, out => q);
  i.out.Y := 5;
END_FUNCTION_BLOCK"""
        text = text.replace("  i.out.Y := 5;\n", "  q.Y := 5;\n")
        made = build(text).instance("Test")
        made.scan()
        assert (made["a[0]"], made["p.X"], made["q.X"], made["q.Y"], made["i.out.Y"]) == (0, 3, 2, 5, 0)

    def test_functions_return_structures(self) -> None:
        """Fresh ones on each call."""
        text = f"""{TYPES}
FUNCTION Moved : Point
VAR_INPUT p : Point; step : INT; END_VAR
  p.X := p.X + step;
  Moved := p;
END_FUNCTION
FUNCTION_BLOCK Test
VAR a, b, c : Point; END_VAR
  b := Moved(p := a, step := 1);
  c := Moved(p := b, step := 1);
END_FUNCTION_BLOCK"""
        made = build(text).instance("Test")
        made.scan()
        assert (made["a.X"], made["b.X"], made["c.X"]) == (3, 4, 5)


class TestInOuts:
    """In-outs reach the caller's variable."""

    TEXT = f"""{TYPES}
FUNCTION_BLOCK Adder
VAR_IN_OUT n : INT; a : Row; p : Point; END_VAR
VAR_INPUT step : INT; END_VAR
  n := n + step;
  a[1] := a[1] + step;
  p.X := p.X + step;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Test
VAR_INPUT k : INT := 2; END_VAR
VAR add : Adder; m : INT; a : Row; ps : Points; rows : Row; END_VAR
  add(n := m, a := a, p := ps[k], step := 5);
  add(n := rows[k], a := ps[1].Trail, p := ps[3], step := 1);
END_FUNCTION_BLOCK"""

    def test_scalars_arrays_and_structures(self) -> None:
        """Variables, elements and fields."""
        made = build(self.TEXT).instance("Test")
        made.scan()
        made["k"] = 1
        made.scan()
        assert (made["m"], made["a"], made["rows"]) == (10, [0, 10, 0, 0], [0, 1, 1, 0])
        assert [made[f"ps[{i}].X"] for i in (1, 2, 3)] == [8, 8, 5]
        assert made["ps[1].Trail"] == [0, 2, 0, 0]

    def test_the_state_shows_what_is_bound(self) -> None:
        """An in-out is the caller's variable, although matiec keeps a copy."""
        made = build(self.TEXT).instance("Test")
        made.scan()
        made["ps[1].Trail[1]"] = 99
        assert made["add.a[1]"] == 99

    def test_an_in_out_that_nobody_binds_has_a_place_of_its_own(self) -> None:
        """So that a block can be tested alone."""
        made = build(self.TEXT).instance("Adder")
        made["n"], made["a"], made["step"] = 1, [1, 2], 10
        made.scan()
        assert (made["n"], made["a"], made["p.X"]) == (11, [1, 12, 0, 0], 13)

    ALIASES = f"""{TYPES}
FUNCTION_BLOCK Two
VAR_IN_OUT a, b : Point; END_VAR
  a.X := a.X + 1;
  b.X := b.X + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Test
VAR_INPUT i, k : INT := 1; END_VAR
VAR two : Two; ps : Points; p : Point; END_VAR
  two(a := {{left}}, b := {{right}});
END_FUNCTION_BLOCK"""

    @pytest.mark.parametrize(
        ("left", "right"), [("p", "p"), ("ps[i]", "ps[k]"), ("ps[2]", "ps[2]"), ("ps[i]", "ps[1]")]
    )
    def test_aliases(self, left: str, right: str) -> None:
        """One variable bound twice: counted twice by reference, once by copy, so that it is refused."""
        text = self.ALIASES.replace("{left}", left).replace("{right}", right)
        with pytest.raises(ScanError, match="same variable") as caught:
            build(text).instance("Test").scan()
        assert caught.value.message.line == text.splitlines().index(f"  two(a := {left}, b := {right});") + 1

    @pytest.mark.parametrize(("left", "right"), [("ps[1]", "ps[2]"), ("ps[i]", "p"), ("ps[i]", "ps[k]")])
    def test_no_aliases(self, left: str, right: str) -> None:
        """Different elements of one array are different variables."""
        text = self.ALIASES.replace("{left}", left).replace("{right}", right)
        made = build(text).instance("Test")
        made["k"] = 3
        made.scan()


class TestFunctions:
    """Calls of functions: defaults, outputs, in-outs, arrays."""

    TEXT = f"""{TYPES}
FUNCTION Split : INT
VAR_INPUT n : INT; step : INT := 10; END_VAR
VAR_OUTPUT rest : INT; END_VAR
VAR_IN_OUT calls : INT; log : Row; END_VAR
  Split := n / step;
  rest := n MOD step;
  calls := calls + 1;
  log[0] := n;
END_FUNCTION
FUNCTION_BLOCK Test
VAR_INPUT n : INT; END_VAR
VAR_OUTPUT y, z, r : INT; END_VAR
VAR c : INT; log : Row; END_VAR
  y := Split(n := n, rest => r, calls := c, log := log) + 100;
  z := Split(n := n, step := 7, calls := c, log := log);
END_FUNCTION_BLOCK"""

    def test_outputs_and_in_outs(self) -> None:
        """Inside an expression, too."""
        made = build(self.TEXT).instance("Test")
        made["n"] = 47
        made.scan()
        assert [made[name] for name in ("y", "z", "r", "c", "log[0]")] == [104, 6, 7, 2, 47]

    def test_call_from_python(self) -> None:
        """By formal parameters, in any case; what is left out has its default."""
        library = build(self.TEXT)
        assert library.call("split", {"N": 47, "calls": 0, "log": [1]}) == 4
        assert library.call("SPLIT", {"n": 47, "step": 40}) == 1
        with pytest.raises(KeyError, match="no parameter NN"):
            library.call("Split", {"nn": 1})
        with pytest.raises(KeyError, match="no function"):
            library.call("Absent", {})
        with pytest.raises(ScanError, match="division by zero") as caught:
            library.call("Split", {"n": 1, "step": 0})
        assert caught.value.message.line == TYPES.count("\n") + 6

    def test_enable(self) -> None:
        """EN FALSE: not called, ENO FALSE, the initial value; a block keeps what it had."""
        text = """FUNCTION Twice : INT
VAR_INPUT n : INT; END_VAR
  Twice := 2 * n;
END_FUNCTION
FUNCTION_BLOCK Counter
VAR_OUTPUT n : INT; END_VAR
  n := n + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Test
VAR_INPUT go : BOOL; END_VAR
VAR_OUTPUT y, z : INT; ok, done : BOOL; END_VAR
VAR count : Counter; END_VAR
  y := Twice(EN := go, n := 4, ENO => ok);
  count(EN := go, n => z, ENO => done);
END_FUNCTION_BLOCK"""
        made = build(text).instance("Test")
        seen = []
        for go in (False, True, True, False):
            made["go"] = go
            made.scan()
            seen.append((made["y"], made["ok"], made["z"], made["done"]))
        assert seen == [(0, False, 0, False), (8, True, 1, True), (8, True, 2, True), (0, False, 2, False)]


def test_a_constant_array_is_shared_and_cannot_be_written() -> None:
    """By path neither."""
    made = block(
        "VAR CONSTANT K : INT := 5; a : Row := [1, 2]; END_VAR VAR y : INT; END_VAR", "y := K + a[1];", types=TYPES
    )
    made.scan()
    assert made["y"] == 7
    for path, value in (("K", 6), ("a[1]", 6)):
        with pytest.raises(ValueError, match="CONSTANT"):
            made[path] = value


def test_enumerations() -> None:
    """Assigned, compared, chosen by CASE; their numbers count from 0."""
    declarations = "VAR c : Colour; n : INT; same : BOOL; END_VAR"
    body = "CASE c OF Red: c := Green; Green, Blue: n := n + 1; END_CASE; same := c = Green;"
    made = block(declarations, body, types=TYPES)
    made.scan()
    assert (made["c"], made["n"], made["same"]) == (1, 0, True)
    made["c"] = 2
    made.scan()
    assert (made["n"], made["same"]) == (1, False)
    with pytest.raises(ValueError, match="Colour"):
        made["c"] = 3


def test_globals_are_shared_with_inner_blocks_and_each_instance_has_its_own() -> None:
    """So that a program with VAR_EXTERNAL can be tested without its configuration."""
    text = f"""{TYPES}
FUNCTION_BLOCK Bump VAR_EXTERNAL total : INT; END_VAR total := total + 1; END_FUNCTION_BLOCK
PROGRAM Count
VAR_EXTERNAL total, own : INT; share : Row; END_VAR VAR inner : Bump; seen : INT; END_VAR
  inner();
  share[1] := share[1] + total;
  seen := share[0] + share[1] + own;
END_PROGRAM
CONFIGURATION Plant
VAR_GLOBAL total : INT := 100; share : Row := [5]; END_VAR
RESOURCE Station ON PLC
VAR_GLOBAL own : INT := 1000; END_VAR
TASK Slow(INTERVAL := T#30ms, PRIORITY := 2);
PROGRAM First WITH Slow : Count;
END_RESOURCE
END_CONFIGURATION"""
    library = build(text)
    one, two = library.instance("Count"), library.instance("Count")
    one.scan()
    one.scan()
    two.scan()
    assert (one["seen"], two["seen"], one["total"]) == (1005 + 101 + 102, 1005 + 101, 102)
    one["total"] = 0
    one.scan()
    assert one["seen"] == 1005 + 101 + 102 + 1


def test_blocks_are_listed_in_source_order() -> None:
    """As spelled, functions left out."""
    text = """FUNCTION_BLOCK Zeta VAR n : INT; END_VAR n := 1; END_FUNCTION_BLOCK
FUNCTION F : INT VAR_INPUT n : INT; END_VAR F := n; END_FUNCTION
PROGRAM Alpha VAR z : Zeta; END_VAR z(); END_PROGRAM"""
    library = build(text)
    assert list(library.blocks()) == ["Zeta", "Alpha"]
    with pytest.raises(KeyError, match="no function block or program BETA"):
        library.instance("Beta")
