"""Text -> tree: shapes, places, comments, and several mistakes told at once."""

import pytest

from structured_text.language.parser import ParseError, parse
from structured_text.language.tree import (
    Assign,
    Binary,
    BitAccess,
    Call,
    Direct,
    Expression,
    Function,
    FunctionBlock,
    Index,
    Literal,
    Member,
    Name,
    Program,
    Statement,
    TypeDecl,
    Unary,
    Unit,
    Unsupported,
    VarBlock,
)


def body_of(text: str) -> list[Statement]:
    """The statements of a program with this body."""
    program = parse(f"PROGRAM Example\n{text}\nEND_PROGRAM\n", "example.st").elements[0]
    assert isinstance(program, Program)
    return program.body


def shown(value: Expression) -> str:
    """An expression with every pair of parentheses that its tree has."""
    if isinstance(value, Binary):
        return f"({shown(value.left)} {value.op} {shown(value.right)})"
    if isinstance(value, Unary):
        return f"({value.op} {shown(value.operand)})"
    if isinstance(value, Index):
        return f"{shown(value.base)}[{', '.join(shown(each) for each in value.indices)}]"
    if isinstance(value, Call):
        return f"{shown(value.callee)}({', '.join(shown(each.value) for each in value.arguments if each.value)})"
    return shown_simple(value)


def shown_simple(value: Expression) -> str:
    """As `shown`, of what has no operands."""
    if isinstance(value, Member):
        return f"{shown(value.base)}.{value.name}"
    if isinstance(value, BitAccess):
        return f"{shown(value.base)}.{value.unit}{value.number}"
    assert isinstance(value, Name | Direct | Literal), value
    return value.name if isinstance(value, Name) else value.text


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("1 + 2 * 3", "(1 + (2 * 3))"),
        ("a - b - c", "((a - b) - c)"),
        ("a / b * c MOD d", "(((a / b) * c) MOD d)"),
        ("a ** b ** c", "((a ** b) ** c)"),
        ("-a ** b", "((- a) ** b)"),
        ("-2 ** b", "(-2 ** b)"),
        ("NOT a AND b", "((NOT a) AND b)"),
        ("a OR b XOR c AND d", "(a OR (b XOR (c AND d)))"),
        ("a & b", "(a AND b)"),
        ("a = b AND c < d OR e", "(((a = b) AND (c < d)) OR e)"),
        ("a = b = c", "((a = b) = c)"),
        ("a < b = c > d", "((a < b) = (c > d))"),
        ("(a + b) * c", "((a + b) * c)"),
        ("3 - -2", "(3 - -2)"),
        ("3 - - a", "(3 - (- a))"),
        ("+a", "(+ a)"),
        ("NOT (a OR b)", "(NOT (a OR b))"),
        ("a.b[1, i + 1].c", "a.b[1, (i + 1)].c"),
        ("F(a, G(b)) + 1", "(F(a, G(b)) + 1)"),
        ("AND(a, b)", "AND(a, b)"),
        ("w.3 OR d.%W1", "(w.X3 OR d.W1)"),
        ("%IX0.0 AND a", "(%IX0.0 AND a)"),
    ],
)
def test_precedence(text: str, tree: str) -> None:
    statement = body_of(f"x := {text};")[0]
    assert isinstance(statement, Assign)
    assert shown(statement.value) == tree


def test_parentheses_are_counted_and_places_point_at_the_first_character() -> None:
    statement = body_of("x := ((a)) + b;")[0]
    assert isinstance(statement, Assign)
    assert isinstance(statement.value, Binary)
    assert statement.value.left.parentheses == 2
    assert statement.value.at == len("PROGRAM Example\nx := ")


def test_words_of_other_languages_are_names_where_no_doubt_is_possible() -> None:
    made = body_of("step := 1; task.name := 2; action[1] := 3; with(a := 1);")
    assert [type(each).__name__ for each in made] == ["Assign", "Assign", "Assign", "CallStatement"]


DECLARATIONS = """
TYPE
  T_Row : ARRAY[0..9, -1..1] OF BYTE; (* a row *)
  T_Pair : STRUCT
    First, Second : INT := 1; (* two *)
    Text : STRING[20];
  END_STRUCT;
  E_Line : (IDLE, (* nothing *) SENDING := 5);
  T_Part : INT (0..9) := 3;
END_TYPE

(* Adds. *)
FUNCTION Add2 : INT
(* Head. *)
VAR_INPUT
  (* the first *)
  a, b : INT; (* summands *)
END_VAR
  (* region *)
  Add2 := a + b; (* the sum *)
END_FUNCTION

FUNCTION_BLOCK Holder
VAR CONSTANT
  TABLE : ARRAY[0..2] OF INT := [1, 2(7)];
END_VAR
VAR RETAIN
  pair : T_Pair := (First := 1, Second := 2);
  lamp AT %QX0.0 : BOOL;
END_VAR
  pair.First := TABLE[1];
END_FUNCTION_BLOCK

CONFIGURATION Plant
VAR_GLOBAL
  Speed : INT;
END_VAR
RESOURCE Cpu ON PLC
  TASK Fast(INTERVAL := T#10ms, PRIORITY := 1);
  PROGRAM Instance WITH Fast : Main(x := Speed);
END_RESOURCE
END_CONFIGURATION
"""


@pytest.fixture
def unit() -> Unit:
    """A file with declarations of every kind."""
    return parse(DECLARATIONS, "declarations.st")


def test_comments_stand_where_they_were_written(unit: Unit) -> None:
    function = next(each for each in unit.elements if isinstance(each, Function))
    assert [each.text for each in function.leading] == ["Adds."]
    assert [each.text for each in function.head] == ["Head."]
    assert function.blocks[0].leading == ()
    a, b = function.blocks[0].variables
    assert [each.text for each in a.leading] == ["the first"]
    assert a.trailing is not None
    assert a.trailing is b.trailing
    assert a.trailing.text == "summands"
    statement = function.body[0]
    assert [each.text for each in statement.leading] == ["region"]
    assert statement.trailing is not None
    assert statement.trailing.text == "the sum"
    assert len(unit.comments) == DECLARATIONS.count("(*")


def test_places(unit: Unit) -> None:
    lines = DECLARATIONS.splitlines()
    for element in unit.elements:
        line, column = unit.place(element.at)
        assert lines[line - 1][column - 1 :].split()[0].upper() in ("FUNCTION", "FUNCTION_BLOCK", "CONFIGURATION") or (
            isinstance(element, TypeDecl) and lines[line - 1][column - 1 :].startswith(element.name)
        )
        assert not isinstance(element, VarBlock | Unsupported)
        assert unit.text[element.at : element.end].endswith((";", "END_FUNCTION", "_BLOCK", "END_CONFIGURATION"))
    assert unit.place(0) == (1, 1)
    assert unit.line(len(DECLARATIONS) - 1) == len(lines)


def test_dialects_parse_so_that_they_can_be_named() -> None:
    text = """
    NAMESPACE Lines
    FUNCTION_BLOCK PUBLIC Holder EXTENDS Base IMPLEMENTS I_One, I_Two
    VAR
      p : POINTER TO INT; q : REF_TO INT; r : REFERENCE TO Lines.Holder; s : STRING(10);
    END_VAR
    VAR_INST a : INT; END_VAR
    METHOD PUBLIC Go : INT VAR_INPUT n : INT; END_VAR Go := n; END_METHOD
    p^ := 1; a S= TRUE; q REF= a; THIS^.a := 2;
    END_FUNCTION_BLOCK
    END_NAMESPACE
    """
    unit = parse(text, "dialects.st")
    outer, block = unit.elements
    assert isinstance(outer, Unsupported)
    assert isinstance(block, FunctionBlock)
    assert block.heritage == "EXTENDS Base IMPLEMENTS I_One , I_Two"
    assert [each.word for each in block.extras] == ["METHOD"]
    assert isinstance(block.blocks[0].variables[2].spec.at, int)
    assert [getattr(each, "op", "") for each in block.body] == [":=", "S=", "REF=", ":="]


def told(text: str) -> list[str]:
    """The messages about a broken text."""
    with pytest.raises(ParseError) as raised:
        parse(text, "broken.st")
    return [str(each) for each in raised.value.problems]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x := ;", "2:6: expected an expression, found ;"),
        ("x = 1;", "2:3: expected `:=` or `(`, found ="),
        ("x := 1", "3:1: expected `;`, found END_PROGRAM"),
        ("IF x y := 1; END_IF;", "2:6: expected THEN, found y"),
        ("x := (1 + 2;", "2:12: expected ), found ;"),
        ("x := a[1;", "2:9: expected ], found ;"),
        ("f(1, 2;", "2:7: expected `,` or `)`, found ;"),
        ("CASE x OF y END_CASE;", "2:11: expected a label, ELSE or END_CASE, found y"),
        ("FOR i = 1 TO 2 DO x := 1; END_FOR;", "2:7: expected :=, found ="),
        ("WHILE x y := 1; END_WHILE;", "2:9: expected DO, found y"),
        ("x := 0x1F;", "2:6: expected a literal as 16#1F, found 0x1F"),
        ("END_IF;", "2:1: expected a statement or END_PROGRAM, found END_IF"),
        ("x := 1 + * 2;", "2:10: expected an expression, found *"),
    ],
)
def test_messages(text: str, message: str) -> None:
    assert told(f"PROGRAM Example\n{text}\nEND_PROGRAM\n")[0] == f"broken.st:{message}"


def test_several_mistakes_are_reported_at_once() -> None:
    text = """PROGRAM Example
VAR
  a : ;
  b INT;
  c : INT
  d : INT;
END_VAR
  a := ;
  IF a THEN
    b := (1;
  END_IF;
  c := 2 3;
END_PROGRAM
FUNCTION F INT
END_FUNCTION
TYPE
  T : ARRAY[0..] OF INT;
  U : INT;
END_TYPE
"""
    lines = [int(each.split(":")[1]) for each in told(text)]
    assert lines == [3, 4, 6, 8, 10, 12, 14, 17]


def test_a_keyword_as_a_name_is_reported_as_such() -> None:
    with pytest.raises(ParseError) as raised:
        parse("FUNCTION_BLOCK A\nVAR\n  by : INT;\n  ok : INT;\nEND_VAR\nok := 1;\nEND_FUNCTION_BLOCK\n", "a.st")
    assert [(each.rule, each.line, each.column) for each in raised.value.problems] == [("reserved-name", 3, 3)]


def test_a_missing_end_is_reported_where_the_next_block_begins() -> None:
    assert told("FUNCTION_BLOCK A\nVAR\n  a : INT;\nEND_VAR\n  a := 1;\nFUNCTION_BLOCK B\nEND_FUNCTION_BLOCK\n") == [
        "broken.st:6:1: expected END_FUNCTION_BLOCK, found FUNCTION_BLOCK"
    ]
