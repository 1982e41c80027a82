"""Variables by path: reading, writing, and what is refused."""

from __future__ import annotations

import pytest
from tests.structured_text.engines.embedded.snippets import build

from structured_text.engines.embedded import EmbeddedInstance
from structured_text.engines.engine import Value

TEXT = """
TYPE Frame : ARRAY[0..3] OF BYTE; END_TYPE
TYPE Grid : ARRAY[0..1, -1..1] OF INT; END_TYPE
TYPE Colour : (Red, Green); END_TYPE
TYPE Item : STRUCT Crc : WORD; Data : Frame; When : TIME; END_STRUCT; END_TYPE
TYPE Items : ARRAY[1..2] OF Item; END_TYPE
FUNCTION_BLOCK Inner
VAR_INPUT buffer : Items; END_VAR
VAR t : TON; END_VAR
  t(IN := TRUE, PT := T#1s);
END_FUNCTION_BLOCK
FUNCTION_BLOCK Test
VAR_INPUT
  b : BOOL; s8 : SINT; u : UINT; r : REAL; l : LREAL; str : STRING; t : TIME; c : Colour; n : INT(-5..5);
  f : Frame; g : Grid; item : Item; d : DATE;
END_VAR
VAR inner : Inner; END_VAR
  inner();
END_FUNCTION_BLOCK
"""


@pytest.fixture
def made() -> EmbeddedInstance:
    """An instance with a variable of each kind."""
    return build(TEXT).instance("Test")


def test_what_is_written_is_read_in_any_case_of_letters_and_in_the_state(made: EmbeddedInstance) -> None:
    """Dates, subranges, what blocks and standard blocks inside have, and spaces between indices."""
    for path, value in (("d", 86_400 * 10**9), ("n", -5), ("inner.buffer[1].when", 10**18 + 1), ("inner.t.PT", 5)):
        made[path] = value
        assert made[path] == made[path.swapcase()] == made.state()[path.upper()] == value
    made["g[0, 1]"] = 8
    assert made["g[0,1]"] == 8


def test_partial_writes(made: EmbeddedInstance) -> None:
    """A list, bytes or dict that is shorter leaves the rest."""
    made["f"] = b"\x01\x02\x03\x04"
    made["f"] = b"\x09"
    made["g"] = [[1], [2, 3]]
    made["item"] = {"Data": [7]}
    assert made["f"] == [9, 2, 3, 4]
    assert made["g"] == [[1, 0, 0], [2, 3, 0]]
    assert made["item"] == {"CRC": 0, "DATA": [7, 0, 0, 0], "WHEN": 0}
    made["inner.buffer"] = [{}, {"crc": 5}]
    assert made["inner.buffer[2].crc"] == 5


def test_reals_are_rounded_when_written(made: EmbeddedInstance) -> None:
    """A REAL holds a single."""
    made["r"] = 0.1
    assert made["r"] == 0.10000000149011612


@pytest.mark.parametrize(("path", "value"), [("n", 6), ("g", [1]), ("inner.t.IN", 3), ("r", True), ("str", "text")])
def test_wrong_values(made: EmbeddedInstance, path: str, value: Value) -> None:
    """ValueError names the path, and nothing is changed."""
    before = made.state()
    with pytest.raises(ValueError, match=path.split(".", maxsplit=1)[0]):
        made[path] = value
    assert made.state() == before


@pytest.mark.parametrize(
    "path", ["f[-1]", "f.", "f]0", "inner..t", "inner.t.state", "inner.t.previous", "inner.t.__class__", "globals_"]
)
def test_wrong_paths(made: EmbeddedInstance, path: str) -> None:
    """KeyError, for reading and for writing; what the engine keeps for itself is no variable."""
    with pytest.raises(KeyError):
        made[path]
    with pytest.raises(KeyError):
        made[path] = 1


def test_state_is_in_order_of_declaration(made: EmbeddedInstance) -> None:
    """Every scalar, arrays element by element, standard blocks with their parameters only."""
    made.scan(0)
    paths = list(made.state())
    assert paths[9:15] == ["F[0]", "F[1]", "F[2]", "F[3]", "G[0,-1]", "G[0,0]"]
    assert paths[-4:] == ["INNER.T.IN", "INNER.T.PT", "INNER.T.Q", "INNER.T.ET"]


def test_a_state_is_a_copy(made: EmbeddedInstance) -> None:
    """What is read does not change later, and what a reader does to it changes nothing."""
    state, frame = made.state(), made["f"]
    assert isinstance(frame, list)
    frame[0] = 99
    made["f[1]"] = 5
    assert (made["f[0]"], state["F[1]"], frame[1]) == (0, 0, 0)
