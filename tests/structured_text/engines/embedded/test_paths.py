"""Variables by path: reading, writing, and what is refused."""

from __future__ import annotations

import math

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


@pytest.mark.parametrize(
    ("path", "value"),
    [
        *[("b", True), ("s8", -128), ("u", 65535), ("r", 0.5), ("l", 0.1), ("str", b"abc"), ("t", -1_500_000_001)],
        *[("c", 1), ("n", -5), ("d", 86_400_000_000_000), ("f[3]", 255), ("g[1,-1]", 7), ("g[0, 1]", 8)],
        *[("item.Crc", 0xA001), ("item.data[2]", 3), ("item.When", 5), ("r", math.inf), ("f", [1, 2, 3, 4])],
        ("INNER.Buffer[2].Data[0]", 9),
        ("inner.buffer[1].when", 10**18 + 1),
        ("g", [[1, 2, 3], [4, 5, 6]]),
        ("item", {"CRC": 1, "DATA": [1, 2, 3, 4], "WHEN": 6}),
        ("inner.t.PT", 5),
    ],
)
def test_what_is_written_is_read(made: EmbeddedInstance, path: str, value: Value) -> None:
    """In any case of letters; the same from the state."""
    made[path] = value
    assert made[path] == value
    assert made[path.swapcase()] == value
    if not isinstance(value, list | dict):
        assert made.state()[path.upper().replace(" ", "")] == value


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


@pytest.mark.parametrize(
    ("path", "value"),
    [
        *[("b", 2), ("b", "x"), ("s8", 128), ("s8", 1.0), ("u", -1), ("r", b"1"), ("r", True), ("str", "text")],
        *[("str", b"x" * 127), ("t", 1.5), ("c", 2), ("n", 6), ("f", [1, 2, 3, 4, 5]), ("f", 5), ("f[0]", 256)],
        *[("f", [1, 256]), ("g", [1]), ("item", {"absent": 1}), ("item", 5), ("item.Crc", -1), ("inner.t.IN", 3)],
    ],
)
def test_wrong_values(made: EmbeddedInstance, path: str, value: Value) -> None:
    """ValueError names the path, and nothing is changed."""
    before = made.state()
    with pytest.raises(ValueError, match=path.replace("[", r"\[").split(".")[0]):
        made[path] = value
    assert made.state() == before


@pytest.mark.parametrize(
    "path",
    [
        *["", "absent", "b.x", "b[0]", "f[4]", "f[-1]", "f[0,1]", "f[x]", "g[0]", "g[2,0]", "item.absent", ".b", "f."],
        *["inner.buffer[0]", "inner.buffer[3]", "inner.t.state", "inner.t.previous", "f[", "f]0", "b b", "inner..t"],
        *["inner.t.__class__", "__class__", "globals_"],
    ],
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
    assert paths[:13] == ["B", "S8", "U", "R", "L", "STR", "T", "C", "N", "F[0]", "F[1]", "F[2]", "F[3]"]
    assert paths[13:19] == ["G[0,-1]", "G[0,0]", "G[0,1]", "G[1,-1]", "G[1,0]", "G[1,1]"]
    assert paths[19:27] == [
        *["ITEM.CRC", "ITEM.DATA[0]", "ITEM.DATA[1]", "ITEM.DATA[2]", "ITEM.DATA[3]", "ITEM.WHEN", "D"],
        paths[26],
    ]
    assert paths[26:28] == ["INNER.BUFFER[1].CRC", "INNER.BUFFER[1].DATA[0]"]
    assert paths[-4:] == ["INNER.T.IN", "INNER.T.PT", "INNER.T.Q", "INNER.T.ET"]


def test_a_state_is_a_copy(made: EmbeddedInstance) -> None:
    """What is read does not change later, and what a reader does to it changes nothing."""
    state, frame = made.state(), made["f"]
    assert isinstance(frame, list)
    frame[0] = 99
    made["f[1]"] = 5
    assert (made["f[0]"], state["F[1]"], frame[1]) == (0, 0, 0)
