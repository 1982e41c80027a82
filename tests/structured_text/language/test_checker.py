"""The typed tree: every slot filled where the text is right, and a word about it where it is not."""

from pathlib import Path

import pytest

from structured_text.language.checker import analyse, check
from structured_text.language.lint import lint, lint_sources
from structured_text.language.parser import parse
from structured_text.language.problems import CheckError
from structured_text.language.tree import (
    Assign,
    Builtin,
    Call,
    Expression,
    FunctionBlock,
    Literal,
)
from structured_text.language.types import (
    ELEMENTARY,
    INT,
    STRING,
    Kind,
    untyped,
)
from structured_text.language.walk import expressions

HERE = Path(__file__).parent
VARIABLES = """
  b, b2 : BYTE; w, w2 : WORD; dw : DWORD; lw : LWORD;
  si : SINT; i, n : INT; d : DINT; li : LINT; us : USINT; u : UINT; ud : UDINT; ul : ULINT;
  r : REAL; lr : LREAL; x, y : BOOL; t : TIME; t2 : TIME; da, da2 : DATE; td : TOD; dt1, dt2 : DT;
  s, s2 : STRING; a : ARRAY[0..9] OF INT; g : ARRAY[0..2, 1..4] OF WORD; timer : TON; e : E_State; p : T_Pair;
"""
TYPES = """
TYPE E_State : (IDLE, BUSY); END_TYPE
TYPE T_Pair : STRUCT First : INT := 5; Second : T_Row; END_STRUCT; END_TYPE
TYPE T_Row : ARRAY[1..3] OF REAL; END_TYPE
"""


def block(body: str, extra: str = "") -> str:
    """A function block over variables of every kind."""
    return f"{TYPES}{extra}\nFUNCTION_BLOCK Example\nVAR\n{VARIABLES}\nEND_VAR\n{body}\nEND_FUNCTION_BLOCK\n"


def messages(text: str) -> list[str]:
    """The rules and messages about a text."""
    return [f"{each.rule}: {each.text}" for each in analyse([parse(text, "t.st")])[1]]


def value_of(text: str) -> Expression:
    """The typed value of an assignment."""
    checked = check([parse(block(text), "t.st")])
    statement = checked.blocks["EXAMPLE"].body[0]
    assert isinstance(statement, Assign)
    return statement.value


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("i := i + 1", "INT"),
        ("u := 1 + u * 2", "UINT"),
        ("w := w AND 16#FF", "WORD"),
        ("x := i > 3 AND NOT y", "BOOL"),
        ("r := r * 2.0 + 1.0", "REAL"),
        ("lr := 2.0 ** 3", "LREAL"),
        ("t := t + T#1s", "TIME"),
        ("t := t * 3", "TIME"),
        ("t := t / 2.5", "TIME"),
        ("t := dt1 - dt2", "TIME"),
        ("t := da - da2", "TIME"),
        ("td := td + T#1s", "TIME_OF_DAY"),
        ("dt1 := dt2 - t", "DATE_AND_TIME"),
        ("i := -a[2 * n]", "INT"),
        ("w := g[1, 2]", "WORD"),
        ("x := e = IDLE", "BOOL"),
        ("x := s = 'A'", "BOOL"),
        ("x := 1 = 2", "BOOL"),
        ("i := p.First", "INT"),
        ("r := p.Second[2]", "REAL"),
        ("x := timer.Q", "BOOL"),
        ("t := timer.ET", "TIME"),
        ("i := ABS(-5)", "INT"),
        ("i := MAX(i, 3, n, 4)", "INT"),
        ("i := MAX(1, 2)", "INT"),
        ("lr := MAX(1.0, lr)", "LREAL"),
        ("u := LIMIT(MN := 0, IN := u, MX := 100)", "UINT"),
        ("i := SEL(x, 1, 2)", "INT"),
        ("s := SEL(x, 'A', s)", "STRING"),
        ("e := SEL(x, IDLE, BUSY)", "E_State"),
        ("r := MUX(i, 1.0, 2.0, r)", "REAL"),
        ("w := SHL(w, 3)", "WORD"),
        ("b := ROR(IN := b, N := i)", "BYTE"),
        ("w := SHL(16#FF, 8)", "WORD"),
        ("i := LEN(s)", "INT"),
        ("ud := LEN(s)", "UDINT"),
        ("s := MID(s, 2, i)", "STRING"),
        ("s := CONCAT(s, 'A', s2)", "STRING"),
        ("i := FIND(s, 'A')", "INT"),
        ("r := SQRT(r)", "REAL"),
        ("lr := EXPT(lr, i)", "LREAL"),
        ("d := TRUNC(r)", "DINT"),
        ("i := LREAL_TRUNC_INT(lr)", "INT"),
        ("u := WORD_BCD_TO_UINT(w)", "UINT"),
        ("w := UINT_TO_BCD_WORD(u)", "WORD"),
        ("x := GT(3, 2, 1)", "BOOL"),
        ("x := EQ(e, BUSY)", "BOOL"),
        ("x := NOT(y)", "BOOL"),
        ("w := XOR(w, w2, 16#FF)", "WORD"),
        ("t := ADD(t, t2)", "TIME"),
        ("t := MULTIME(t, 3)", "TIME"),
        ("dt1 := CONCAT_DATE_TOD(da, td)", "DATE_AND_TIME"),
        ("da := DT_TO_DATE(dt1)", "DATE"),
        ("i := MOVE(5)", "INT"),
        ("i := DIV(i, 2) + MOD(i, 2)", "INT"),
        ("r := INT_TO_REAL(5)", "REAL"),
        ("x := TRUE", "BOOL"),
        ("x := 1", "BOOL"),
    ],
)
def test_types_of_expressions(text: str, kind: str) -> None:
    value = value_of(text + ";")
    assert value.type.name == kind
    for each in expressions(value):
        assert not untyped(each.type)
        if isinstance(each, Literal) and each.type.kind in (Kind.REAL, Kind.BOOL):
            assert isinstance(each.value, float | bool)


def test_every_conversion_between_elementary_types() -> None:
    types = {each.name: each for each in ELEMENTARY.values()} | {"STRING": STRING}
    for source, have in types.items():
        lines = [f"v{number} := {source}_TO_{target}(v);" for number, target in enumerate(types)]
        variables = "".join(f"v{number} : {target};" for number, target in enumerate(types))
        text = f"FUNCTION_BLOCK E\nVAR v : {source}; {variables} END_VAR\n{' '.join(lines)}\nEND_FUNCTION_BLOCK"
        checked = check([parse(text, "t.st")])
        for statement, wanted in zip(checked.blocks["E"].body, types.values(), strict=True):
            assert isinstance(statement, Assign)
            assert isinstance(statement.value, Call)
            target = statement.value.target
            assert isinstance(target, Builtin)
            assert (target.family, target.parameters[0].type, target.result) == ("CONVERT", have, wanted)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("i := b;", "implicit-conversion: expected INT, found BYTE: write BYTE_TO_INT(...)"),
        ("i := timmer.Q;", "undeclared-name: expected a declared variable, found timmer (did you mean timer?)"),
        ("x := timer.QQ;", "undeclared-name: expected a member of TON, found QQ"),
        ("i := LIMTI(0, i, 9);", "undeclared-name: expected a function or instance, found LIMTI (did you mean LIMIT?)"),
        ("x := i;", "type-mismatch: expected BOOL, found INT"),
        ("p := a;", "type-mismatch: expected T_Pair, found ARRAY[0..9] OF INT"),
        ("i[1] := 3;", "type-mismatch: expected an array before [, found INT"),
        ("i.x := 3;", "type-mismatch: expected a structure or block before .x, found INT"),
        ("t := t * t2;", "type-mismatch: * is not defined for TIME and TIME"),
        ("g[0, 0] := w;", "index-range: expected an index within 1..4, found 0"),
        ("timer := timer;", "not-assignable: expected a variable before :=, found the block timer"),
        ("timer(x, T#1s, TRUE);", "not-assignable: expected a variable for Q"),
        ("i := ABS(1, 2);", "call-arguments: expected at most 1 arguments for ABS, found more"),
        ("i := SHL(i, 1);", "implicit-conversion: expected a bit string for SHL, found INT: write INT_TO_WORD(...)"),
        (
            "FOR r := 1.0 TO 2.0 DO i := 1; END_FOR;",
            "type-mismatch: expected an integer variable to count with, found REAL",
        ),
        ("FOR i := 1 TO 9 BY 0 DO n := 1; END_FOR;", "literal-range: expected a step other than 0"),
        (
            "CASE r OF 1: i := 1; END_CASE;",
            "type-mismatch: expected an integer or an enumeration after CASE, found REAL",
        ),
        ("CASE i OF 5..1: i := 1; END_CASE;", "literal-range: expected the lower limit first, found 5..1"),
        ("us := -1;", "literal-range: expected a value of USINT, 0..255, found -1"),
        ("w := INT_TO_WORD(u);", "implicit-conversion: expected INT, found UINT: write UINT_TO_INT(...)"),
        (
            "Example();",
            "undeclared-name: expected an instance, found the block type Example: declare a variable of it",
        ),
        ("i();", "type-mismatch: expected a function or block instance, found the variable i"),
    ],
)
def test_messages(text: str, said: str) -> None:
    assert any(each.startswith(said) for each in messages(block(text))), messages(block(text))


def test_one_mistake_is_reported_once() -> None:
    found = messages(block("i := missing + missing2 * 3; x := missing3 = 5; a[missing4] := 1; timer(IN := missing5);"))
    assert [each.split(":")[0] for each in found] == ["undeclared-name"] * 5


INNER = """
FUNCTION_BLOCK Inner
VAR_INPUT First : INT; Second : INT := 7; END_VAR
VAR_IN_OUT Total : DINT; END_VAR
VAR_OUTPUT Done : BOOL; END_VAR
Total := Total + INT_TO_DINT(First); Done := TRUE;
END_FUNCTION_BLOCK
FUNCTION Twice : INT
VAR_INPUT Value : INT; Factor : INT := 2; END_VAR
Twice := Value * Factor;
END_FUNCTION
"""


def outer(body: str) -> str:
    """A block with an instance of Inner."""
    variables = "Part : Inner; Sum : DINT; ok : BOOL; n : INT;"
    return f"{INNER}FUNCTION_BLOCK Outer\nVAR {variables} END_VAR\n{body}\nEND_FUNCTION_BLOCK\n"


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("Part(First := 1);", "call-arguments: expected an argument for the in-out Total of Inner"),
        ("Part(Total := 5);", "not-assignable: expected a variable for Total, found a value"),
        ("Part(Total := n);", "implicit-conversion: expected DINT, found INT"),
        ("Part(Total := Sum, Done := ok);", "call-arguments: expected => for the VAR_OUTPUT Done"),
        ("Part(Total := Sum, Totl := Sum);", "call-arguments: expected a parameter of Inner, found Totl (did you mean"),
        (
            "Part(Total := Sum, Whole := Sum);",
            "call-arguments: expected First, Second, Total, Done of Inner, found Whole",
        ),
        ("n := Twice(Number := 1);", "call-arguments: expected Value, Factor of Twice, found Number"),
        ("Part(Total := Sum, Total := Sum);", "call-arguments: expected Total of Inner once, found it twice"),
        ("n := Twice(1);", "call-arguments: expected an argument for Factor of Twice: give all, or name each"),
        ("Part.Total := Sum;", "write-to-output: expected a variable before :=, found Total of a block"),
    ],
)
def test_wrong_calls(body: str, said: str) -> None:
    assert any(each.startswith(said) for each in messages(outer(body))), messages(outer(body))


def test_files_that_belong_together() -> None:
    library = parse(INNER, "library.st")
    user = parse("PROGRAM Go VAR i : Inner; s : DINT; END_VAR i(Total := s); END_PROGRAM", "user.st")
    checked = check([user, library])
    assert list(checked.programs) == ["GO"]
    with pytest.raises(CheckError) as raised:
        check([parse("PROGRAM Go VAR i : Inner; END_VAR i(); END_PROGRAM", "user.st")])
    assert str(raised.value) == "user.st:1:20: expected the name of a type, found Inner"


def test_callees_come_first_whatever_the_order_of_the_text() -> None:
    text = """
    FUNCTION_BLOCK Outer VAR m : Middle; END_VAR m(); END_FUNCTION_BLOCK
    FUNCTION_BLOCK Middle VAR i : ARRAY[0..1] OF INT; k : Deep; END_VAR i[0] := F(n := 1); k(); END_FUNCTION_BLOCK
    FUNCTION F : INT VAR_INPUT n : INT; END_VAR F := G(n := n); END_FUNCTION
    FUNCTION G : INT VAR_INPUT n : INT; END_VAR G := n; END_FUNCTION
    FUNCTION_BLOCK Deep VAR n : INT; END_VAR n := G(n := n); END_FUNCTION_BLOCK
    """
    names = [each.name for each in check([parse(text, "t.st")]).callees_first]
    assert sorted(names) == ["Deep", "F", "G", "Middle", "Outer"]
    for user, used in (("Outer", "Middle"), ("Middle", "F"), ("Middle", "Deep"), ("F", "G"), ("Deep", "G")):
        assert names.index(used) < names.index(user)


def test_recursion_through_another() -> None:
    text = """
    FUNCTION_BLOCK A VAR b : B1; END_VAR b(); END_FUNCTION_BLOCK
    FUNCTION_BLOCK B1 VAR a : A; END_VAR a(); END_FUNCTION_BLOCK
    """
    assert [each.split(":")[0] for each in messages(text)] == ["recursion", "recursion"]


CONFIGURATION = """
PROGRAM Main1 VAR_INPUT Speed : INT; END_VAR VAR_EXTERNAL Level : INT; END_VAR Level := Speed; END_PROGRAM
CONFIGURATION Plant
VAR_GLOBAL Level : INT := 3; END_VAR
RESOURCE Cpu ON PLC
  TASK Fast(INTERVAL := T#10ms, PRIORITY := 1);
  PROGRAM One WITH {task} : {program}(Speed := {value});
END_RESOURCE
END_CONFIGURATION
"""


def configured(task: str = "Fast", program: str = "Main1", value: str = "Level") -> str:
    """A configuration with these words in it."""
    return CONFIGURATION.format(task=task, program=program, value=value)


def test_configurations() -> None:
    checked = check([parse(configured(), "t.st")])
    plant = checked.configurations["PLANT"]
    instance = plant.resources[0].programs[0]
    assert instance.target is checked.programs["MAIN1"]
    assert instance.task_target is plant.resources[0].tasks[0]
    assert plant.symbols["LEVEL"].type is INT
    assert checked.programs["MAIN1"].symbols["LEVEL"].target is plant.symbols["LEVEL"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (configured(task="Slow"), "undeclared-name: expected the name of a task of this resource, found Slow"),
        (configured(program="Main2"), "undeclared-name: expected the name of a program, found Main2"),
        (configured(value="TRUE"), "type-mismatch: expected INT, found BOOL"),
        (
            configured().replace("VAR_EXTERNAL Level : INT", "VAR_EXTERNAL Level : DINT"),
            "type-mismatch: expected INT as",
        ),
        (configured().replace("VAR_EXTERNAL Level", "VAR_EXTERNAL Lvl"), "undeclared-name: expected a VAR_GLOBAL Lvl"),
        (configured().replace("T#10ms", "10"), "type-mismatch: expected TIME, found an integer literal"),
    ],
)
def test_wrong_configurations(text: str, said: str) -> None:
    assert any(each.startswith(said) for each in messages(text)), messages(text)


@pytest.mark.parametrize(
    ("declaration", "rule"),
    [
        ("v : ARRAY[0..2] OF INT := 1;", "type-mismatch"),
        ("v : T_Pair := (First := 1, First := 2);", "duplicate-name"),
        ("v : E_State := 1;", "type-mismatch"),
        ("v : TON := (XX := T#1s);", "undeclared-name"),
        ("v : BYTE := 300;", "literal-range"),
        ("v : ARRAY[5..2] OF INT;", "literal-range"),
        ("v : ARRAY[0..x] OF INT;", "type-mismatch"),
    ],
)
def test_initial_values_and_bounds_that_are_wrong(declaration: str, rule: str) -> None:
    """Those that no program of the accept/reject corpus has."""
    found = messages(
        f"{TYPES}FUNCTION_BLOCK Second1\nVAR {declaration} k : INT; END_VAR\nk := 1;\nEND_FUNCTION_BLOCK\n"
    )
    assert [each.split(":")[0] for each in found] == [rule]


def test_a_function_keeps_no_blocks() -> None:
    text = "FUNCTION F : INT VAR_INPUT n : INT; END_VAR VAR t : TON; END_VAR F := n; END_FUNCTION"
    assert messages(text)[0].startswith("type-mismatch: a function keeps nothing between calls")


def test_functions_and_blocks_of_one_name_in_two_files() -> None:
    first, second = parse(INNER, "one.st"), parse(INNER, "two.st")
    checked, problems = analyse([first, second])
    assert {each.rule for each in problems} == {"duplicate-name"}
    assert {each.path for each in problems} == {"two.st"}
    assert isinstance(checked.blocks["INNER"], FunctionBlock)
    assert checked.blocks["INNER"].unit is first


def test_a_tree_is_analysed_once_however_often_it_is_asked_for() -> None:
    unit = parse(INNER, "one.st")
    checked = check([unit])
    assert lint([unit]) == lint_sources([("one.st", INNER)])
    assert check([unit]) is checked
    assert analyse([unit])[0] is checked


def test_the_problems_of_a_tree_stay_the_same_whoever_asks_again() -> None:
    text = block("i := r; x := b AND TRUE; b := 1; r := 5; i := MISSING(i);")
    unit = parse(text, "t.st")
    first = lint([unit])
    assert first
    assert lint([unit]) == first
    with pytest.raises(CheckError) as raised:
        check([unit])
    assert set(raised.value.problems) <= set(first)
    assert analyse([unit])[1] == list(raised.value.problems)


def test_a_tree_cannot_be_analysed_beside_other_files_later() -> None:
    user = "PROGRAM Go VAR n : INT; END_VAR n := Twice(n, 2); END_PROGRAM"
    first, second = parse(INNER, "one.st"), parse(user, "two.st")
    check([first])
    with pytest.raises(ValueError, match=r"one\.st was analysed with other files already: parse it again"):
        check([first, second])
    assert check([parse(INNER, "one.st"), second]).programs.keys() == {"GO"}


@pytest.mark.parametrize("use", ["x := Part.Now;", "Part.Now := 1;", "Part(x => Part.Now);"])
def test_what_an_instance_does_not_keep_cannot_be_reached_from_outside(use: str) -> None:
    inner = "FUNCTION_BLOCK Inner VAR_OUTPUT x : INT; END_VAR VAR_TEMP Now : INT; END_VAR x := Now; END_FUNCTION_BLOCK"
    text = f"{inner}\nPROGRAM Example VAR x : INT; Part : Inner; END_VAR\n{use}\nEND_PROGRAM"
    said = [each.text for each in lint_sources([("one.st", text)]) if each.rule == "undeclared-name"]
    assert said == ["Now is no part of an instance of Inner, being a VAR_TEMP: make it a VAR_OUTPUT"]
