"""Mistakes that templates once had, each by the least that showed it."""

import pytest
from tests.blocks.library import built, result
from tests.blocks.test_fourth_drive import fourth

from structured_text.engines.engine import Engine, Value


@pytest.mark.parametrize(("word", "unknown"), [(0x0004, False), (0x0005, False), (0x0014, True), (0, True)])
def test_a_bit_that_the_manual_does_not_list_is_unknown_beside_one_that_it_lists(
    engine: Engine, word: int, unknown: bool
) -> None:
    """One listed bit was enough to call the whole word known."""
    assert built(engine).run("JSCC_DriveStatus", {"Value": word})["Unknown"] is unknown


def test_a_percentage_without_a_scale_counts_per_hertz_as_its_pin_says(engine: Engine) -> None:
    """The setting was multiplied with the percentage, twice the speed for a maximum of 50 Hz."""
    pins = {"SpeedReferenceHz": 25.0, "MaximumHz": 50.0, "ReferenceScale": 200.0}
    done = fourth(engine).run("BH_Reference", pins)
    assert (done["Value"], result(done)) == (5000, "OK")


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("prefix", ["SN300G5", "JSCC", "CHF"])
def test_the_end_of_the_numbers_is_the_same_reference_everywhere(engine: Engine, prefix: str, sign: int) -> None:
    """The REAL nearest to 1.0E30 is above it: C compared with the literal as a double, and took it for no number."""
    scale = {"ReferenceScale": 10.0} if prefix == "JSCC" else {}
    pins: dict[str, Value] = {"SpeedReferenceHz": sign * 1.0e30, "MaximumHz": 50.0, "FullScaleHz": 50.0, **scale}
    done = built(engine).run(f"{prefix}_Reference", pins)
    assert result(done) == ("OK" if sign > 0 else "NEGATIVE")


@pytest.mark.parametrize(("function", "add", "answered"), [(65408, 128, 0), (65411, 128, 3), (8, 65531, 3)])
def test_a_refusal_is_never_recognised_by_a_sum_that_wraps(
    engine: Engine, function: int, add: int, answered: int
) -> None:
    """The function code of a refusal was a sum in 16 bits: 65408 + 128 was 0, the function of a damaged reply."""
    request = {"Request.UnitAddress": 1, "Request.FunctionCode": function, "Request.Quantity": 1}
    pins: dict[str, Value] = {"Length": 3, "ExceptionAdd": add, "Adu": bytes([1, answered, 2]), **request}
    assert result(built(engine).run("MB_ParseReply", pins)) == "OTHER_FUNCTION"


LONGEST = bytes([0x55, 0xAA]) * 125
BY_WRITE = {"ErrorFunction": 6, "ErrorAddress": 0x5001}
"""How a drive refuses by the frame of a write."""


@pytest.mark.parametrize(
    ("pins", "request_", "body", "error"),
    [
        ({"ExceptionAdd": 128}, (3, 0, 125, 0), b"\1\3\xfa" + LONGEST, "OK"),
        ({**BY_WRITE, "TwoByteCount": True}, (3, 0, 125, 0), b"\1\3\0\xfa" + LONGEST, "OK"),
        ({**BY_WRITE, "TwoByteCount": True}, (3, 0, 124, 0), b"\1\3\0\xf8" + LONGEST[:248], "OK"),
        ({"ExceptionAdd": 128, "Length": 65535}, (3, 0, 125, 0), b"\1\3\xfa" + LONGEST, "LONG"),
        (BY_WRITE, (6, 0x5001, 1, 7), b"\1\6\x50\1\0\7", "OK"),
        (BY_WRITE, (3, 0, 1, 0), b"\1\6\x50\1\0\7\0", "OTHER_FUNCTION"),
        (BY_WRITE, (3, 0, 1, 0), b"\1\6\x50\1\0", "OTHER_FUNCTION"),
    ],
)
def test_the_longest_replies_and_what_is_nearly_a_refusal(
    engine: Engine, pins: dict[str, Value], request_: tuple[int, ...], body: bytes, error: str
) -> None:
    """The echo of a write to the address of refusals is an answer; a refusal with a byte more or less is none."""
    names = ("FunctionCode", "Address", "Quantity", "Value")
    asked = {f"Request.{name}": value for name, value in zip(names, request_, strict=True)}
    given: dict[str, Value] = {"Length": len(body), "Adu": body, "Request.UnitAddress": 1, **asked, **pins}
    assert result(built(engine).run("MB_ParseReply", given)) == error


@pytest.mark.parametrize("use", ["Read", "Write"])
@pytest.mark.parametrize("address", [0x0000, 0x01FF, 0x0200, 0x0201, 0x1000])
def test_no_register_at_all_is_not_permitted(engine: Engine, use: str, address: int) -> None:
    """None from an address in a permitted area or just after one was permitted, none from elsewhere was not."""
    assert built(engine).call(f"CHF_Can{use}", {"Address": address, "Quantity": 0}) is False
    assert built(engine).call(f"CHF_Can{use}", {"Address": 0x1000, "Quantity": 1}) is True


def test_a_text_is_whole(engine: Engine) -> None:
    """It ended after the 80 bytes of a STRING, in the middle of what the bit's second value means."""
    text = built(engine).call("SN300G5_BitTextZh", {"Address": 0x000F, "BitNumber": 1})
    assert text == "总线 PID 目标值: 0 无效 1 有效".encode()
