"""What a machine does is read off its map by the room of meanings, and by no room above it but those that show maps."""

import re

from tests.rooms import ROOT

ROOMS = ("render", "prove", "bench", "docs", "desk", "platforms", "commands", "output")
"""`show`, `diff` and `counts` may read maps; `reference` stands apart, to say what is right."""
RAW = re.compile(
    r"operation\.(commands|status|standstill|states|measures|reference|own_maximum|commanded_by)\b"
    r"|\bdrive\.(serial|watchdog|identity|settings)\b|\.scale\.(factor|when|otherwise|choices)\b"
)
SHOWN = {
    "bench/register.py": "the scales of all rows, beside what the reference says they give",
    "bench/scenes/told.py": "the stops of a map, for the reference to say their words",
}


def test_no_room_reads_line_settings_commands_status_measures_reference_or_watchdog_off_a_map() -> None:
    found = [
        f"{path.relative_to(ROOT)}: {one[0]}"
        for room in ROOMS
        for end in ("*.py", "*.j2")
        for path in sorted((ROOT / room).rglob(end))
        if str(path.relative_to(ROOT)) not in SHOWN
        for one in RAW.finditer(path.read_text("utf-8"))
    ]
    assert not found
