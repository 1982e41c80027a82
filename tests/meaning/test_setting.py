"""Keypad settings, and the watchdog whose time one of them may hold."""

from dataclasses import replace

from tests import shipped

from driveblocks.meaning.setting import setting, settings
from driveblocks.meaning.watchdog import feeds, watchdog

GD200A = shipped.drives()["GD200A"]


def test_a_setting_has_its_values_by_name_and_the_number_as_delivered() -> None:
    one = replace(settings(GD200A)[0], default="3 (9600 bit/s)", values=((3, "9600 bit/s"),))
    assert (one.factory, one.named(3), one.named(4), one.named(None)) == (3, "9600 bit/s", "", "")
    assert replace(one, default="by rating").factory is None


def test_a_setting_is_found_by_its_id() -> None:
    first = settings(GD200A)[0]
    assert setting(GD200A, first.id) is first
    assert setting(GD200A, "nothing") is setting(GD200A, None) is None


def test_the_watchdog_has_its_time_by_the_range_of_its_setting() -> None:
    found = 0
    for drive in shipped.drives().values():
        own = watchdog(drive)
        by = setting(drive, own.time.setting) if own and own.time else None
        if own and own.time and by and by.bounds:
            most = by.bounds[1] * own.time.count_ms
            assert (own.time.most_ms, own.time.said.place > (0, 0)) == (most, True)
            found += 1
    assert found


def test_a_drive_without_a_watchdog_is_fed_by_nothing() -> None:
    assert feeds(replace(GD200A, watchdog=None)) is None
