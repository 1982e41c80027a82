"""Which outcomes of decisions came about on matiec: derived there, counted on the embedded engine, and the same."""

from dataclasses import replace
from itertools import islice

import pytest
from tests.structured_text.engines.compare.cases import load_cases
from tests.structured_text.engines.compare.lockstep import Run

from structured_text.engines.coverage import Branches, Lines
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import EngineError, Source
from structured_text.engines.matiec import Flags, MatiecEngine
from structured_text.engines.matiec.counters import Counters
from structured_text.engines.matiec.text import Listing

SHAPES = Source(
    "shapes.st",
    """FUNCTION_BLOCK Shapes
  VAR_INPUT
    A : INT;
  END_VAR
  VAR
    X, I : INT;
  END_VAR
  X := 0;
  I := 0;
  IF A = 1 THEN X := 1; ELSIF A = 2 THEN
    X := 2;
  ELSIF A = 3 THEN
    RETURN;
  END_IF;
  FOR I := -4 TO A BY 2 DO
    X := X + 1;
    IF X > 5 THEN EXIT; END_IF;
  END_FOR;
  I := 0;
  REPEAT
    X := X - 1;
    WHILE I < A DO
      WHILE I < 3 DO I := I + 1; IF I = A THEN EXIT; END_IF; END_WHILE;
      I := I + 1;
      IF I = 9 THEN RETURN; END_IF;
    END_WHILE;
  UNTIL X < A
  END_REPEAT;
  CASE A OF
    1, 7..9: X := 5; X := 6;
    2: CASE X OF 1: X := 2; END_CASE;
  END_CASE;
END_FUNCTION_BLOCK
""",
)


def counting(matiec: MatiecEngine) -> tuple[EmbeddedEngine, MatiecEngine]:
    """The embedded engine and a line of matiec, both with counters."""
    return EmbeddedEngine(coverage=True), replace(matiec, flags=Flags(coverage=True))


def test_every_shape_of_decision(matiec: MatiecEngine) -> None:
    found: list[tuple[Lines, Branches]] = []
    for engine in counting(matiec):
        library = engine.build([SHAPES])
        shapes = library.instance("Shapes")
        for a in (-5, -1, 0, 1, 2, 3, 4, 8, 12, 20):
            shapes["A"] = a
            shapes.scan(0)
        found.append((library.coverage(), library.branches()))
    assert found[0] == found[1]
    hits = found[0][1]["shapes.st"]
    assert len(hits) == 28
    assert {each.text for each in hits if each.text.startswith("CASE")} == {
        "CASE 1, 7..9",
        "CASE 2",
        "CASE 1",
        "CASE ELSE",
    }


def test_both_engines_count_the_same_of_the_corpus(matiec: MatiecEngine) -> None:
    case = load_cases()["control_flow"]
    found: list[tuple[Lines, Branches]] = []
    for engine in counting(matiec):
        library = engine.build(case.sources)
        run = Run(engine, case, library=library)
        for stimulus in islice(case.stimuli(11), 100):
            run.scan(stimulus)
        found.append((library.coverage(), library.branches()))
    assert found[0] == found[1]
    assert sum(sum(hits.values()) for hits in found[0][1].values()) > 0


def test_nothing_is_counted_unless_asked(matiec: MatiecEngine) -> None:
    assert matiec.build([SHAPES]).branches() == {}


@pytest.mark.parametrize(
    ("text", "lines", "why"),
    [
        ("FUNCTION F : INT\nVAR_INPUT A : INT; END_VAR\nF := A; F := 1;\nEND_FUNCTION\n", [3], "f.st:3: iec2c has 1"),
        ("FUNCTION F : INT\nVAR_INPUT A : INT; END_VAR\nF := A;\nEND_FUNCTION\n", [3, 4], "f.st:4: iec2c has 1"),
        (
            "FUNCTION F : INT\nVAR_INPUT A : INT; END_VAR\nWHILE F < A DO\nF := A;\nEND_WHILE;\nEND_FUNCTION\n",
            [3, 3],
            "f.st:3: iec2c has 2 statements here, the source 1",
        ),
        ("FUNCTION F : INT\nVAR_INPUT A : INT; END_VAR\nF := ;\nEND_FUNCTION\n", [3], "f.st:3:6: "),
    ],
    ids=["one too few", "one too many", "two for a loop", "not read"],
)
def test_statements_that_do_not_fit_the_source_are_reported_and_lines_are_counted(
    text: str, lines: list[int], why: str
) -> None:
    counters = Counters(Listing([Source("f.st", text)]), lines)
    assert counters.hits([7] * len(lines)) == {"f.st": {line: 7 * lines.count(line) for line in lines}}
    with pytest.raises(EngineError, match=f"branches cannot be counted: {why}"):
        counters.branches([7] * len(lines), [0] * len(lines))
