"""What a drive replies: limits, refusals in the map's form and codes, memory and what is stored."""

from decimal import Decimal

import pytest
from tests import families
from tests.simulator.talk import MAPS, talk

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.bench.simulator.refusal import codes
from driveblocks.maps import catalog
from driveblocks.maps.load import load

CODES = families.said("CODES")


@pytest.mark.parametrize("family", sorted(MAPS))
def test_each_reason_has_the_code_of_its_map(family: str) -> None:
    """In the order function, address, quantity, value, read-only, running, busy."""
    assert tuple(codes(MAPS[family]).values()) == CODES[family]


@pytest.mark.parametrize(
    ("family", "request_", "reply"),
    [
        # function: 06 is none of SN300G5's, 10H none of CHF's, 17H nobody's
        ("SN300G5", "01 06 00 00 00 01", "01 86 01"),
        ("CHF", "01 10 10 00 00 01 02 00 01", "01 06 50 01 00 02"),
        ("JSCC", "01 17", "01 97 01"),
        # sub-function
        ("SN300G5", "01 08 00 01 12 AB", "01 88 01"),
        ("SN300G5", "01 08 00 00 12 AB", "01 08 00 00 12 AB"),
        # address: 001BH is in no table, 1000H cannot be read
        ("SN300G5", "01 03 00 1A 00 02", "01 83 02"),
        ("JSCC", "01 03 10 00 00 01", "01 83 02"),
        ("CHF", "01 03 80 07 00 01", "01 06 50 01 00 04"),
        # quantity: 1 to 16, JSCC 12 and 10 by its 25 bytes
        ("SN300G5", "01 03 01 00 00 00", "01 83 03"),
        ("SN300G5", "01 03 01 00 00 11", "01 83 03"),
        ("JSCC", "01 03 00 00 00 0D", "01 83 03"),
        ("JSCC", "01 10 00 00 00 0B 16" + 22 * " 00", "01 90 03"),
        ("JSCC", "01 10 00 00 00 0A 14" + 20 * " 00", "01 10 00 00 00 0A"),
        ("JSCC", "01 10 00 00 00 02 02 00 00", "01 90 03"),
        ("JSCC", "01 10 00 00 00 00 00", "01 90 03"),
        # value: analog output 1 takes -726 to 726, the communication setting -10000 to 10000
        ("SN300G5", "01 10 00 07 00 01 02 02 D7", "01 90 21"),
        ("SN300G5", "01 10 00 07 00 02 04 FD 2A 02 D6", "01 10 00 07 00 02"),
        ("SN300G5", "01 10 00 07 00 02 04 00 00 FD 29", "01 90 21"),
        ("CHF", "01 06 20 00 D8 F0", "01 06 20 00 D8 F0"),
        ("CHF", "01 06 20 00 D8 EF", "01 06 50 01 00 05"),
        # read-only
        ("SN300G5", "01 10 00 10 00 01 02 00 00", "01 90 22"),
        ("JSCC", "01 06 20 00 00 00", "01 86 02"),
        # cut short, or one byte too long: nobody knows what it was
        ("JSCC", "01", ""),
        ("JSCC", "01 03 20 00 00", ""),
        ("JSCC", "01 03 20 00 00 01 00", ""),
        ("JSCC", "01 10 00 00 00", ""),
        ("JSCC", "01 10 00 00 00 01 02 00", ""),
        # another unit
        ("JSCC", "02 03 20 00 00 01", ""),
    ],
)
def test_refusals(family: str, request_: str, reply: str) -> None:
    assert talk(family).ask(request_) == reply.lower()


def test_a_reply_in_ascii_holds_fewer_words() -> None:
    """CHF: 16 data bytes are 7 words; in RTU 16 words may be read."""
    seven, eight = (bytes.fromhex(f"01 03 30 00 00 0{number}") for number in (7, 8))
    drive = SimulatedDrive(MAPS["CHF"], 1, ascii_mode=True)
    assert len(drive.reply(seven) or b"") == 17
    assert drive.reply(eight) == bytes.fromhex("01 06 50 01 00 05")
    assert len(SimulatedDrive(MAPS["CHF"], 1).reply(eight) or b"") == 19


def test_a_broadcast_reaches_all_where_the_map_has_one_and_nobody_answers() -> None:
    one = talk("SN300G5")
    one.hertz(10)
    assert one.ask("00 10 00 00 00 01 02 00 01") == ""
    assert one.drive.mode == "ramping up"
    # 000FH is no start address of a broadcast, and JSCC's manual has none
    assert one.ask("00 10 00 0F 00 01 02 00 01") == ""
    assert one.read(0x000F) == 0
    # CHF's manual names no start addresses
    chf = talk("CHF")
    assert chf.ask("00 06 20 00 03 E8") == ""
    assert chf.read(0x2000) == 1000
    jscc = talk("JSCC")
    jscc.hertz(10)
    assert jscc.ask("00 06 10 00 00 01") == ""
    assert jscc.drive.mode == "standstill"


def test_sn300g5_stores_with_enter_alone_and_is_busy_then() -> None:
    one = talk("SN300G5", x0200=100)
    one.write(0x0200, 150)
    assert one.drive.stores == 0
    one.drive.power(on=False)
    one.drive.power(on=True)
    assert one.read(0x0200) == 100
    one.write(0x0200, 150)
    one.write(0xFFFD, 1)
    assert one.drive.stores == 0
    one.write(0xFFFD, 0)
    assert one.drive.stores == 1
    assert one.write(0x0200, 160) == bytes.fromhex("01 90 24")
    assert one.write(0x0000, 1) == bytes.fromhex("01 10 00 00 00 01")
    one.write(0x0000, 0)
    one.drive.step(100)
    one.write(0x0200, 160)
    one.drive.power(on=False)
    one.drive.power(on=True)
    assert one.read(0x0200) == 150


def test_sn300g5_refuses_parameters_and_enter_while_it_runs() -> None:
    one = talk("SN300G5").at(20)
    assert one.write(0x0200, 150) == bytes.fromhex("01 90 22")
    assert one.write(0xFFFD, 0) == bytes.fromhex("01 90 22")
    assert one.drive.stores == 0
    # commands and references are no parameters
    assert one.write(0x000F, 0) == bytes.fromhex("01 10 00 0F 00 01")


def test_chf_stores_unless_the_bit_for_ram_is_added() -> None:
    one = talk("CHF")
    one.write(0x8007, 500)
    assert (one.drive.stores, one.read(0x0007)) == (0, 500)
    one.drive.power(on=False)
    one.drive.power(on=True)
    assert one.read(0x0007) == 0
    one.write(0x0007, 500)
    assert one.drive.stores == 1
    one.drive.step(50)
    assert one.write(0x0007, 600) == bytes.fromhex("01 06 50 01 00 08")
    one.drive.step(50)
    one.write(0x8007, 700)
    assert one.read(0x0007) == 700
    one.drive.power(on=False)
    one.drive.power(on=True)
    assert (one.drive.stores, one.read(0x0007)) == (1, 500)
    # neither commands nor references are ever stored
    one.at(20)
    assert one.drive.stores == 1


def test_what_a_manual_does_not_explain_counts_as_stored() -> None:
    one = talk("JSCC").at(20)
    assert one.drive.stores == 0
    one.write(0x0012, 5)
    assert one.drive.stores == 1
    one.drive.step(100)
    one.write(0x1002, 5)
    assert one.drive.stores == 1


def test_a_busy_drive_may_refuse_commands_too() -> None:
    one = talk("CHF", Habits(busy_refuses_all=True))
    one.write(0x0007, 500)
    assert one.write(0x1000, 5) == bytes.fromhex("01 06 50 01 00 08")


def test_the_keypad_sets_parameters_for_good_and_other_bits_of_a_status() -> None:
    one = talk("CHF")
    one.drive.set(0x0007, 9)
    one.drive.set(0x300A, 5)
    one.drive.power(on=False)
    one.drive.power(on=True)
    assert (one.read(0x0007), one.read(0x300A)) == (9, 0)
    # bit 3 of SN300G5's status is the reset signal, which no condition names
    other = talk("SN300G5")
    other.drive.set(0x0010, 0xFF0F)
    assert other.read(0x0010) == 0xFF2A


def test_a_register_of_words_has_another_scale_than_the_rest() -> None:
    one = talk("CHF", Habits(scales={0x3002: Decimal("0.1")}))
    assert one.read(0x3002) == 5400


def test_all_maps_can_be_simulated() -> None:
    """The example with every key has a code without a number, and words that a signed range limits."""
    example = load(catalog.folder().parent / "tests" / "maps" / "example.yaml")
    drive = SimulatedDrive(example, 1)
    assert drive.reply(bytes.fromhex("01 06 00 10 00 00")) == bytes.fromhex("01 86 05")
    # it lists function 17H, which no simulated drive has
    assert drive.reply(bytes.fromhex("01 17 00 00 00 00")) == bytes.fromhex("01 97 01")
