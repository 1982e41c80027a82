"""What a word means in a map, and what is near when it means nothing."""

from pathlib import Path

import pytest

from driveblocks.maps import lookup, references
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive


@pytest.fixture(scope="module")
def drive() -> Drive:
    """The example map."""
    return load(Path(__file__).with_name("example.yaml"))


@pytest.mark.parametrize(
    ("word", "shown"),
    [
        ("0023H", "0023H  U1-04  register  DC bus voltage"),
        ("0023h", "0023H  U1-04  register  DC bus voltage"),
        ("0x0023", "0023H  U1-04  register  DC bus voltage"),
        ("0x23", "0023H  U1-04  register  DC bus voltage"),
        ("0023", "0023H  U1-04  register  DC bus voltage"),
        ("u1-04", "0023H  U1-04  register  DC bus voltage"),
        ("A2-03", "0108H  A2-03  register  User parameter"),
        ("083AH", "083AH  in the area Function code parameters"),
        ("OS", "11H  OS  fault  Overspeed"),
        ("11H", "11H  OS  fault  Overspeed"),
        ("17", "11H  OS  fault  Overspeed"),
        ("run_reply", "run_reply  example frame"),
        ("status", "status  register table  Status"),
    ],
)
def test_a_word_is_found_however_it_is_written(drive: Drive, word: str, shown: str) -> None:
    assert lookup.find(drive, word)[0].shown == shown


def test_an_address_and_a_code_differ_by_their_digits(drive: Drive) -> None:
    as_address = lookup.find(drive, "0001H")
    assert [(match.shown.split("  ")[-2], match.spelled) for match in as_address] == [
        ("register", True),
        ("fault", False),
        ("error code", False),
    ]
    as_code = lookup.find(drive, "01H")
    assert [(match.shown.split("  ")[-2], match.spelled) for match in as_code] == [
        ("fault", True),
        ("error code", True),
        ("register", False),
    ]


def test_a_setting_and_its_register_are_both_found(drive: Drive) -> None:
    assert [match.shown for match in lookup.find(drive, "h5-02")] == [
        "041DH  H5-02  register  Bit rate",
        "H5-02  keypad setting  Bit rate",
    ]


def test_a_function_is_found_by_its_code(drive: Drive) -> None:
    assert lookup.find(drive, "10H")[0].shown == "10H  function  Write several registers"


@pytest.mark.parametrize("word", ["nonsense", "10000H", "0x", "H", "99", ""])
def test_a_word_without_meaning_finds_nothing(drive: Drive, word: str) -> None:
    assert lookup.find(drive, word) == []


@pytest.mark.parametrize(
    ("word", "near"),
    [
        ("U1-05", "0020H  U1-01  Output frequency  输出频率"),
        ("framess", "frames"),
        ("voltage", "0023H  U1-04  DC bus voltage  直流电压"),
        ("直流", "0023H  U1-04  DC bus voltage  直流电压"),
        ("0024H", "0023H  U1-04  DC bus voltage  直流电压"),
        ("read_voltage_rply", "read_voltage_reply  example frame"),
    ],
)
def test_near_entries_are_offered(drive: Drive, word: str, near: str) -> None:
    assert near in lookup.near(drive, word, ("frames", "errata"))


@pytest.mark.parametrize(
    ("ref", "kind", "key", "holds"),
    [
        ("register 0220H", "register", 0x0220, True),
        ("register 0220H", "register", 0x0221, False),
        ("register 0106H-0125H", "register", 0x0110, True),
        ("bit 0015H.7", "register", 0x0015, True),
        ("bit 0015H.8-F", "register", 0x0016, False),
        ("fault 1EH", "fault", 30, True),
        ("fault 30", "fault", 30, True),
        ("error 1EH", "fault", 30, False),
        ("setting H5-01", "setting", "H5-01", True),
        ("serial", "serial", "", True),
        ("prose", "register", 0, False),
    ],
)
def test_a_reference_is_about_what_it_names(ref: str, kind: str, key: int | str, holds: bool) -> None:
    assert references.concerns(ref, kind, key) is holds


def test_all_addresses_of_several_references() -> None:
    lists = [("register 0010H-0012H", "prose"), ("bit 0015H.A", "fault 1EH")]
    assert references.addresses(lists) == {0x10, 0x11, 0x12, 0x15}
