"""The figures of a line as tables, and as JSON."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from rich.console import RenderableType
from rich.text import Text

from driveblocks.desk.site.line import BROKEN, Aged, Figures, Line, Promised
from driveblocks.maps.rivals import Pair, pairs, warning
from driveblocks.meaning.conduct import reply_delay
from driveblocks.show.layout import facts, table


def tables(tried: Sequence[Figures]) -> Iterator[RenderableType]:
    """What a person reads: the line at its own rate, then every rate."""
    own = next(each for each in tried if each.rate == each.line.rate)
    yield facts(*_said(own))
    yield Text()
    yield _units(own)
    yield Text()
    yield _rates(tried)
    yield Text()
    yield from _warned(own)
    yield from map(warning, mistaken(own.line))
    yield verdict(tried)


def plain(tried: Sequence[Figures]) -> dict[str, Any]:
    """The same for scripts: times in ms, shares in percent."""
    line = tried[0].line
    return {
        "rate": line.rate, "bits": line.bits, "ascii": line.ascii, "scan": line.scan, "max_scan": line.max_scan,
        "reply": line.reply, "port_late": line.port_late, "stop_within": line.within,
        "smallest_rate": next((each.rate for each in tried if not each.broken), None),
        "mistaken": [
            {"block": one.block.prefix, "drive": one.drive.prefix, "means": one.worst.means, "told": one.told or None}
            for one in mistaken(line)
        ],
        "rates": [_at(each) for each in tried],
    }  # fmt: skip


def mistaken(line: Line) -> list[Pair]:
    """The families of a line whose stop does harm at a drive of another one of it, as after a mix-up of addresses."""
    return pairs({each.drive.prefix: each.drive for each in line.units if each.drive}.values())


def verdict(tried: Sequence[Figures]) -> str:
    line, found = tried[0].line, next((each.rate for each in tried if not each.broken), None)
    asked = {"stops": line.within is not None, "status": True, "watchdog": any(each.watchdog_ms for each in line.units)}
    *most, last = (says.format(line.within) for key, says in BROKEN.items() if asked[key])
    what = f"{', '.join(most)} and {last}" if most else last
    return f"The smallest rate at which {what}: {found} bit/s." if found else f"There is no rate at which {what}."


def _warned(own: Figures) -> Iterator[str]:
    """What does not hold at the line's own rate, and what to do about it; drives of which the same is so together."""
    for each, ages in complaints(own).items():
        yield f"{each.what} of {', '.join(map(_name, ages))} {each.said}. What helps: {each.helps}."


class Complaint(NamedTuple):
    """What does not hold of a drive."""

    what: str
    said: str
    helps: str


def complaints(own: Figures) -> dict[Complaint, list[Aged]]:
    """What does not hold at a rate, and of which drives."""
    found: dict[Complaint, list[Aged]] = {}
    for each in own.slow:
        found.setdefault(_complaint(*_aging(each.promised)), []).append(each)
    for each in own.starved:
        said = f"may wait {each.feed} ms, more than two thirds of {each.unit.watchdog_ms} ms: it may trip"
        found.setdefault(_complaint("What feeds the watchdog", said, "a longer watchdog"), []).append(each)
    return found


def _complaint(what: str, said: str, also: str) -> Complaint:
    return Complaint(what, said, f"fewer drives, a higher bit rate, a shorter scan, a shorter TurnRoundMs, {also}")


def _aging(one: Promised) -> tuple[str, str, str]:
    """Of a status that gets too old: what it is, what that does, and what else helps."""
    if one.read > one.stale:
        said = f"would be {one.read} ms old, its StaleMs is {one.stale}: it bars starts (Reason 55)"
        return "The status", said, "a longer StaleMs"
    said = f"may be {one.worst} ms old when other drives fail, its StaleMs is {one.stale}: that stops the motor"
    return "The status", said, "SupplyOff where supplies fail together, a longer StaleMs"


def _name(each: Aged) -> str:
    return f"{each.unit.name} ({each.unit.unit})"


def _said(own: Figures) -> Iterator[tuple[str, object]]:
    line = own.line
    who = "the line" if own.line_keeps else "the port"
    yield "line", f"{own.rate} bit/s, {line.bits} bits per character, {'ASCII' if line.ascii else 'RTU'}"
    yield "scan", f"{line.scan} ms, at most {line.max_scan} ms"
    late = f"; the port delays frames by up to {line.port_late} ms" if line.port_late else ""
    yield "silence", f"{own.silence:.3g} ms, kept by {who}{late}"
    yield "replies", f"begin after {line.reply} ms"
    for name, said in {each.drive.prefix: reply_delay(each.drive) for each in line.units if each.drive}.items():
        if said is not None:
            yield "", f"{name} answers later {said}; give --reply where it is set so"
    yield "one stop", f"sent within {own.alone} ms"
    yield "all stops", f"sent within {own.worst} ms; within {own.unlearned} ms before the drives have replied"
    yield "cut cable", f"StopOverdue after {own.cut} ms at most, where no drive answers any more"
    yield "one round", f"{own.round} ms; a request is open for {own.load} % of it"


def _units(own: Figures) -> RenderableType:
    watched = any(each.feed for each in own.ages)
    heads = "read every", "ReadMs", "WorstReadMs", "StaleMs", "others", *(["feed"] if watched else [])
    made = table("unit", "ms", *heads, numbers=["unit", *heads], wide=("ms",))
    for each in own.ages:
        one = each.promised
        times = each.every, one.read, one.worst, one.stale, each.rest, *([each.feed] if watched else [])
        made.add_row(str(each.unit.unit), each.unit.name, *(str(ms) if ms else "-" for ms in times))
    return made


def _rates(tried: Sequence[Figures]) -> RenderableType:
    numbers = "bit/s", "one round", "open", "one stop", "all stops", "cut cable"
    made = table(*numbers, "holds", numbers=numbers)
    for each in tried:
        times = (f"{ms} ms" for ms in (each.alone, each.worst, each.cut))
        holds = f"no: {' and '.join(each.broken)}" if each.broken else "yes"
        made.add_row(str(each.rate), f"{each.round} ms", f"{each.load} %", *times, holds)
    return made


def _at(each: Figures) -> dict[str, Any]:
    return {
        "rate": each.rate, "silence_kept_by": "line" if each.line_keeps else "port", "silence": round(each.silence, 3),
        "round": each.round, "open_percent": each.load, "one_stop": each.alone, "all_stops": each.worst,
        "all_stops_before_replies": each.unlearned, "cut_to_contact": each.cut, "broken": each.broken,
        "units": [
            {
                "unit": one.unit.unit, "name": one.unit.name,
                "drive": one.unit.drive.prefix if one.unit.drive else None,
                "status_every": one.every, "read": one.promised.read or None, "worst_read": one.promised.worst or None,
                "stale": one.promised.stale or None, "oldest_other": one.rest,
                "watchdog": one.unit.watchdog_ms or None, "worst_feed": one.feed, "watchdog_margin": one.margin,
            }
            for one in each.ages
        ],
    }  # fmt: skip
