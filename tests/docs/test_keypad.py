"""What the keypad shows, against tables typed from the documents: code, menu, as delivered, what it takes, a count.

A value may carry a word of what the document says of it: `4=19200`. `-` stands for what the document does not print.
Seven drives have 15 settings or more. Fewer have the documents of JSCC (6, all of its chapter), PowerFlex 4M and 400
(6 each: no page of their chapter 3 could be read) and CHF (1: its chapter is on communication alone). Of the MX2, b001
to F003 stand in a list of names and addresses alone; of the SN300G5, b1-03 to C1-02 in its table of addresses alone.
"""

import pytest
from tests import families, shipped

from driveblocks.meaning.setting import Setting, settings

TYPED = families.own("KEYPAD")


def shown(one: Setting) -> list[str]:
    """Code, menu, as delivered, and a count, as the keypad of the map shows them."""
    number, count = one.factory, one.keypad.factor
    delivered = one.default if number is None else one.keypad.shown(number)
    in_unit = f"{count if count is not None else ''} {one.keypad.unit}".strip()
    return [each or "-" for each in (one.keypad.code, one.keypad.menu, delivered, in_unit)]


@pytest.mark.parametrize("prefix", TYPED)
def test_each_setting_is_as_its_keypad_shows_it(prefix: str) -> None:
    typed = [each.split(" | ") for each in TYPED[prefix].strip().splitlines()]
    held = settings(shipped.drives()[prefix])
    assert sorted(map(shown, held)) == sorted([*each[:3], each[4]] for each in typed)
    takes = {each[0]: each[3] for each in typed}
    for one in held:
        wanted = takes[one.keypad.code]
        if not one.values:
            assert (one.allowed or "-") == wanted, one.id
            continue
        values = [each.split("=") for each in wanted.split(" ")]
        assert [one.keypad.shown(number) for number, _ in one.values] == [text for text, *_ in values], one.id
        for (_, name), (text, *said) in zip(one.values, values, strict=True):
            assert all(word.replace("_", " ") in name.lower() for word in said), (one.id, text)


def test_every_drive_is_typed() -> None:
    assert TYPED.keys() == shipped.drives().keys()
    assert sum(len(each.strip().splitlines()) >= 15 for each in TYPED.values()) >= 7
