"""`driveblocks explain`: status, words, JSON for scripts, standard input, and pages that fit any width."""

import json
from collections.abc import Iterator

import pytest
from click.testing import CliRunner, Result
from tests.commands.test_show import assert_fits, squeezed
from tests.shipped import drives

from driveblocks.cli import app
from driveblocks.maps import catalog

READ = "01 03 20 00 00 01 8F CA"
REPLY = "01 03 02 01 F4 B8 53"
FAULTS = "01 03 0C 00 A3 00 18 00 00 00 00 00 42 20 00 8D E2"
MAPS = dict(zip((path.stem for path in catalog.shipped()), drives().values(), strict=True))


def explain(*words: str, columns: int = 80, stdin: str | bytes | None = None) -> Result:
    """Run `driveblocks explain` as if in a terminal of some width."""
    return CliRunner().invoke(app, ["explain", *words], input=stdin, env={"COLUMNS": str(columns)})


def examples() -> Iterator[tuple[str, ...]]:
    """Words of the command for every example frame of the shipped maps, and for frames that are wrong."""
    for stem, drive in MAPS.items():
        frames = {frame.id: frame for frame in drive.frames}
        for frame in frames.values():
            request = ("--request", frames[frame.answers].correct.hex()) if frame.answers else ()
            yield (frame.correct.hex(), "--drive", stem, *request)
    for wrong in ("01 03 20 00 00 01 CA 8F", READ + REPLY, "01 03", ":010320000001DC", "01 10 FF FF 00 02 04 00 00"):
        yield (wrong, "--drive", "jscc")
    yield (FAULTS, "--drive", "sn300", "--request", "01 03 00 10 00 06 C4 0D")
    yield (FAULTS,)


def test_the_first_example_of_the_readme() -> None:
    result = explain(REPLY, "--drive", "jscc", "--request", READ)
    assert result.exit_code == 0
    shown = squeezed(result.stdout)
    for words in (
        "Good RTU reply of unit 1: 1 register read",
        "frame 01 03 02 01 F4 B8 53",
        "length 7 bytes",
        "request 01 03 20 00 00 01 8F CA",
        "drive JSCC series inverters",
        "function 03 03H Read registers 读寄存器内容",
        "byte count 02 2 bytes, 1 register",
        "CRC B8 53 right",
        "2000H 01F4H Output frequency 实时输出频率读取 500 = 50.0 Hz",
    ):
        assert words in shown


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("01 0G",), "frame:1:5: `G` is no hexadecimal digit; is the digit 6 meant?\n"),
        (("01 03 244",), "frame:1:7: `244` has 3 digits; a byte is two hexadecimal digits, and decimal 244 is F4\n"),
        ((REPLY, "--request", "01 0G"), "request:1:5: `G` is no hexadecimal digit; is the digit 6 meant?\n"),
        ((REPLY, "--request", REPLY), "request:1:1: this is no good request: it reads as a reply; paste the request"),
        ((REPLY, "--drive", "jscd"), "there is no drive `jscd`; did you mean jscc?"),
        ((REPLY, "--drive", "nowhere.yaml"), "nowhere.yaml:1:1: "),
    ],
)
def test_unusable_input(words: tuple[str, ...], message: str) -> None:
    result = explain(*words)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr.startswith(message)


@pytest.mark.parametrize(
    ("text", "status"),
    [
        (REPLY + "\n", 0),
        ("00000000  01 03 02 01 f4 b8 53                              |......S|\n00000007\n", 0),
        (":010320000001DB\r\n", 0),
        ("\ufeff01 03 02 01 F4 B8 53", 0),
        ("01 03 02 01 F4 B8 54", 1),
        ("", 2),
        (b"\xff\xfe0\x001\x00", 2),
        ("0" * 100_001, 2),
    ],
)
def test_standard_input(text: str | bytes, status: int) -> None:
    result = explain("-", stdin=text)
    assert result.exit_code == status
    assert result.stderr.startswith("stdin:1:") if status == 2 else result.stderr == ""


def test_json_of_a_good_frame() -> None:
    result = explain(REPLY, "--drive", "jscc", "--request", READ, "--json")
    assert result.exit_code == 0
    made = json.loads(result.stdout)
    assert [made[key] for key in ("drive", "good", "mode", "frame", "request")] == ["jscc", True, "rtu", REPLY, READ]
    assert made["checksum"] == {"kind": "CRC", "found": "B8 53", "expected": "B8 53", "right": True}
    assert made["wrong"] == []
    (reading,) = made["readings"]
    assert reading["direction"] == "reply"
    assert [field["name"] for field in reading["fields"]] == ["unit", "function", "byte count", "data", "CRC"]
    (register,) = reading["registers"]
    expected = {"address": 0x2000, "name": "Output frequency", "name_zh": "实时输出频率读取", "word": 500}
    assert expected.items() <= register.items()
    assert (register["value"], register["unit"]) == (50, "Hz")


def test_json_of_a_wrong_frame() -> None:
    result = explain(READ + REPLY, "--json")
    assert result.exit_code == 1
    made = json.loads(result.stdout)
    assert (made["drive"], made["good"]) == (None, False)
    assert made["wrong"][0]["what"] == "the request comes before the reply: bytes 1 to 8"
    assert [one["good"] for one in made["inside"]] == [True, True]


def test_json_of_bits() -> None:
    result = explain(FAULTS, "--drive", "sn300", "--request", "01 03 00 10 00 06 C4 0D", "--json")
    registers = json.loads(result.stdout)["readings"][0]["registers"]
    assert registers[5]["parts"] == [
        {"mark": ".D", "id": "OPR", "name": "Operator disconnected", "name_zh": "操作器拔出", "value": 1}
    ]


@pytest.mark.parametrize("words", list(examples()), ids=lambda words: f"{words[2:3]}{words[0]}"[:40])
def test_an_explanation_fits_any_terminal_and_folding_loses_no_character(words: tuple[str, ...]) -> None:
    assert_fits(lambda columns: explain(*words, columns=columns))
