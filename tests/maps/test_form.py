"""The forms of single values: what each takes, what it makes of it, and that printing and reading are inverse."""

from decimal import Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from driveblocks.maps import form
from driveblocks.maps.form import Form, Span, address_text, bits_text, span_text

TAKEN: list[tuple[Form, str, object]] = [
    (form.ADDRESS, "0026H", 0x26),
    (form.ADDRESS, "FFFFH", 0xFFFF),
    (form.ADDRESSES, "0026H", Span(0x26, 0x26)),
    (form.ADDRESSES, "0106H-0125H", Span(0x106, 0x125)),
    (form.ADDRESSES, "0125H-0106H", Span(0x125, 0x106)),
    (form.BITS, "0", Span(0, 0)),
    (form.BITS, "A", Span(10, 10)),
    (form.BITS, "8-F", Span(8, 15)),
    (form.NUMBER, "0", 0),
    (form.NUMBER, "-10000", -10000),
    (form.NUMBER, "500", 500),
    (form.NUMBER, "01H", 1),
    (form.NUMBER, "12ABH", 0x12AB),
    (form.COUNT, "16", 16),
    (form.DECIMAL, "0.1", Decimal("0.1")),
    (form.DECIMAL, "-3", Decimal(-3)),
    (form.DECIMAL, "50.00", Decimal(50)),
    (form.BYTES, "01", b"\x01"),
    (form.BYTES, "01 03 FF", b"\x01\x03\xff"),
    (form.ADU, "01 03", b"\x01\x03"),
    (form.ADU, ":0103FC CR LF", b":0103FC\r\n"),
    (form.ADU, ":0103FC CR", b":0103FC\r"),
    (form.ADU, ":0103FC LF", b":0103FC\n"),
    (form.ADU, ":", b":"),
    (form.REGISTER_WORD, "3A30", "3A30"),
    (form.REGISTER_WORD, "0A--", "0A--"),
    (form.REGISTER_WORD, "01", "01"),
    (form.ID, "H5-01", "H5-01"),
    (form.ID, "A2-01..A2-32", "A2-01..A2-32"),
    (form.WORD, "read_request", "read_request"),
    (form.PREFIX, "SN300G5", "SN300G5"),
    (form.REFERENCE, "prose", "prose"),
    (form.REFERENCE, "bit 0015H.7", "bit 0015H.7"),
    (form.ID_FORM, "A9-99", "A9-99"),
    *[(form.PLATE, text, text) for text in ("22F-*", "FC-051*", "CIMR-Vx*", "6SL3210-5B*", "GD200A-037G/045P-4")],
    (form.PLC_DEVICE, "D10", "D10"),
    (form.TEXT, "x", "x"),
    (form.TEXT, "two\nlines", "two\nlines"),
]
REFUSED: list[tuple[Form, str]] = [
    *[(form.ADDRESS, text) for text in ("26H", "0026", "0026h", "00026H", "0x26", "38", " 0026H", "0026H ", "002GH")],
    *[(form.ADDRESSES, text) for text in ("0001H-", "-0001H", "0001H - 0002H", "0001H..0002H", "0001H-2")],
    *[(form.BITS, text) for text in ("10", "G", "f", "0-", "0-10", "0,1", "-1", "")],
    *[(form.NUMBER, text) for text in ("01", "-0", "1H", "-01H", "1.0", "1e3", "+1", "12ab", "000000001H")],
    *[(form.COUNT, text) for text in ("0", "-1", "1000000", "01", "10H", "1.5")],
    *[(form.DECIMAL, text) for text in (".5", "5.", "1e3", "0,1", "00.1", "1" * 10, "0." + "1" * 10, "NaN", "inf")],
    *[(form.BYTES, text) for text in ("0103", "01  03", "01 3", "1 03", "0a", "01 03 ", "")],
    *[(form.ADU, text) for text in ("01:03", ":0103 LF CR", ":01 03", ":0g", "01 03 CR LF", "")],
    *[(form.PLATE, text) for text in ("*", "22*", "2xF-*", "22F*-4", "22f-*", "-22F", "22F--*", "")],
    *[(form.REGISTER_WORD, text) for text in ("3A3", "--", "--0A", "3a30", "3A300", "3A-")],
    *[(form.ID, text) for text in ("H5 01", "H5-01,H5-02", "x" * 25, "")],
    *[(form.WORD, text) for text in ("Read", "1st", "a-b", "_a", "")],
    *[(form.PREFIX, text) for text in ("Sn", "1T", "A" * 13, "A_B", "")],
    *[(form.REFERENCE, text) for text in ("Register 0001H", "register  0001H", "register 0001H 0002H", "1", "")],
    *[(form.ID_FORM, text) for text in ("H5-01", "b9", "")],
    *[(form.PLC_DEVICE, text) for text in ("D", "0", "d0", "D0.1")],
    *[(form.TEXT, text) for text in ("", " ", " x", "x ", "x\n")],
]


@pytest.mark.parametrize(("shape", "text", "value"), TAKEN, ids=lambda part: str(getattr(part, "name", part)))
def test_a_form_takes(shape: Form, text: str, value: object) -> None:
    assert shape.pattern.fullmatch(text)
    assert shape.parse(text) == value


@pytest.mark.parametrize(("shape", "text"), REFUSED, ids=lambda part: str(getattr(part, "name", part)))
def test_a_form_refuses(shape: Form, text: str) -> None:
    assert shape.pattern.fullmatch(text) is None


@pytest.mark.parametrize("shape", {shape.name: shape for shape, *_ in TAKEN}.values(), ids=lambda shape: shape.name)
@given(text=st.text(max_size=30))
def test_what_matches_can_be_parsed(shape: Form, text: str) -> None:
    if shape.pattern.fullmatch(text):
        shape.parse(text)


@given(st.integers(0, 0xFFFF))
def test_an_address_is_read_as_it_is_printed(address: int) -> None:
    assert form.ADDRESS.parse(address_text(address)) == address


@given(st.integers(0, 0xFFFF), st.integers(0, 0xFFFF))
def test_a_range_is_read_as_it_is_printed(first: int, last: int) -> None:
    assert form.ADDRESSES.parse(span_text(Span(first, last))) == Span(first, last)


@given(st.integers(0, 15), st.integers(0, 15))
def test_bits_are_read_as_they_are_printed(first: int, last: int) -> None:
    assert form.BITS.parse(bits_text(Span(first, last))) == Span(first, last)


spans = st.builds(Span, st.integers(0, 40), st.integers(0, 40))


@given(spans, spans)
def test_a_span_is_the_set_of_its_numbers(one: Span, other: Span) -> None:
    assert len(one) == len(list(one)) == len(set(one))
    assert bool(one) == bool(list(one))
    assert all(number in one for number in one)
    if one and other:
        assert one.overlaps(other) == bool(set(one) & set(other))


def test_a_span_holds_numbers_only() -> None:
    assert "5" not in Span(0, 9)
    assert 5.0 not in Span(0, 9)


@pytest.mark.parametrize("text", ["频率", "，", "（", "〇", "abc频"])
def test_chinese_is_seen(text: str) -> None:
    assert form.holds_chinese(text)


@pytest.mark.parametrize("text", ["Output frequency", "°C", "±10 V", "Ω", "1–2", ""])
def test_what_is_no_chinese(text: str) -> None:
    assert not form.holds_chinese(text)


@pytest.mark.parametrize(
    ("plate", "number", "fits"),
    [
        *[("22F-*", number, True) for number in ("22F-D2P5N103", "22f d2p5n103", "22FD2P5N103", "22F")],
        *[("22F-*", number, False) for number in ("22A-D2P5N103", "X22F-D2P5N103", "./22F", "22F_D2P5", "")],
        *[("CIMR-Vx4*", number, True) for number in ("CIMR-VU4A0011FAA", "CIMR-VT4A0011FAA")],
        *[("CIMR-Vx4*", number, False) for number in ("CIMR-V4", "CIMR-VU2A0011")],
        ("GD200A-*", "GD200A-037G/045P-4", True),
        ("3G3MX2-*", "3G3MX2-A4150-V1(Q2)", True),
        ("ATV312HU15N4", "ATV312HU15N4S", False),
    ],
)
def test_a_model_number_fits_its_pattern(plate: str, number: str, *, fits: bool) -> None:
    assert form.Plate(plate).fits(number) == fits


@pytest.mark.parametrize(
    ("one", "other", "meet"),
    [
        *[("22F-*", other, True) for other in ("22F-*", "22F-D*", "22F", "22FD2P5N103")],
        *[("22F-*", other, False) for other in ("22A-*", "22", "222F-*")],
        *[("CIMR-Vx2*", other, True) for other in ("CIMR-VU*", "CIMR-VU2A")],
        *[("CIMR-Vx2*", other, False) for other in ("CIMR-VU4*", "CIMR-V")],
        ("ATV312H", "ATV312HU", False),
    ],
)
def test_patterns_that_a_number_may_fit_both_of(one: str, other: str, *, meet: bool) -> None:
    assert form.Plate(one).meets(form.Plate(other)) == form.Plate(other).meets(form.Plate(one)) == meet
