"""Random walks keep every rule, reach all of the line's text, and stay within the loops that it states."""

import re
from functools import cache

from tests.blocks.library import sources
from tests.line.drives import KINDS
from tests.line.vline import PARAMETER, STOP, Bench, Config, Drive, line_sources
from tests.line.walk import walk

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.embedded.library import EmbeddedLibrary

SEEDS = (*range(14), 21, 29)
COILS = next(index for index, kind in enumerate(KINDS) if kind.stop_function == 5)


def long_dead(bench: Bench) -> None:
    """A drive that is dead for long, the last of eight; its stop, whose attempts take long, too."""
    bench.drives[7].alive = False
    bench.run(20_000)
    bench.put(7, TurnRoundMs=500)
    bench.stop(7)
    bench.run(2000)


def idle(bench: Bench) -> Bench:
    """Wait until nothing is open or near."""
    while bench["Phase"] or bench["Times.QuietMs"] < 100:
        bench.scan()
    return bench


def strangers(bench: Bench) -> None:
    """Frames of another master, too many at last; a late reply after a stop that did not wait for it."""
    bench.set(ForeignMost=1)
    bench.put(0, PollEveryMs=400)
    bench.ready()
    for function, pause in ((6, 11_000), (3, 300), (6, 300)):
        idle(bench).foreign(bytes([99, function, 0, 1, 0, 2]))
        bench.run(pause)
    bench.put(0, Begins=True)
    bench.command(0)
    bench.run(100)
    for longest in (0, 60_000):
        bench.block["Slots[0].LongestReplyMs"] = longest
        bench.drives[0].turn_us = 80_000
        before = bench["Timeouts"]
        while bench["Timeouts"] == before:
            bench.scan()
        bench.drives[0].turn_us = None
        bench.stop(0)
        bench.run(100)
    bench.foreign(bytes([99, 3, 4, 1, 2, 3, 4]))
    idle(bench).set(Restart=True, BitRate=0)
    bench.scan()
    bench.foreign(bytes([99, 3, 4, 1, 2, 3, 4]))
    bench.run(200)


def odd_replies(bench: Bench) -> None:
    """A write reply to a read; an ASCII reply that does not end."""
    bench.ready().drives[0].answer = lambda _: bytes([1, 6, 0, 0, 0, 0])
    bench.run(100)
    bench.drives[0].answer = lambda _: bytes([1, 3, 12]) + bytes(60)
    bench.run(300)


def full_counts(bench: Bench) -> None:
    """Attempts, and the time since a store, at the end of their count; then a port that takes no stop."""
    bench.ready().drives[0].alive = False
    bench.stop(0)
    bench.run(1500)
    for count in ("Slots[0].Answer[0].Tries", "Track[0].Stop.Tries", "LineTries"):
        bench.block[count] = 255
    bench.block["Slots[0].SinceStoreMs"] = 65_535
    bench.run(3000)
    bench.port_takes = False
    bench.set(StopAll=True)
    bench.run(3000)
    bench.drives[0].alive = bench.port_takes = True
    bench.run(300)
    bench.port_takes = False
    bench.stop(0)
    bench.run(3000)


def own_stops(bench: Bench) -> None:
    """Stops of the line's own: one, two, in either order, refused; a drive whose block writes none; calm at last."""
    register, reply = bench.kind.stop_address, Drive(1, bench.kind).reply
    words = {"StopRegister": register, "StopWord": 5, "JogStopRegister": register, "JogStopWord": 8}
    for jog_stop, refused in ((0, 0), (1, 8), (2, 8), (1, 5)):
        bench.put(0, JogStop=jog_stop, **words)
        bench.drives[0].answer = lambda frame, refused=refused: (
            bytes([1, 0x86, 3]) if frame[4:6] == bytes([0, refused]) and frame[1] == 6 else reply(frame)
        )
        bench.run(100)
        bench.attended = set()
        bench.run(2500)
        bench.attended = {0}
        bench.drives[0].answer = None
        bench.run(1500)
    bench.put(0, JogStop=0, HasStop=False)
    bench.run(100)
    bench.set(StopAll=True)
    bench.run(31_000)


def unset(bench: Bench) -> None:
    """Nothing is wired; then no retries; then all is said."""
    usual = ("CharacterBits", "MaxScanMs", "RestartMs", "OfflineMs", "AttendMs", "ForeignMost")
    retries = [f"{what}Retries" for what in ("Command", "Parameter", "Poll")]
    bench.set(**dict.fromkeys((*usual, *retries), 0))
    bench.run(300)
    bench.set(**dict.fromkeys(retries, 255))
    bench.ready().run(5000)
    bench.set(**dict.fromkeys(usual[2:5], 65_535), **dict.fromkeys(retries, 2))
    bench.run(100)


def supplies(bench: Bench) -> None:
    """A drive boots in silence, refuses a stop that may end so, loses its supply on purpose, and gets it back."""
    bench.put(0, BootMs=300, StopWithinMs=500)
    bench.drives[0].alive = False
    bench.stop(0)
    bench.run(1000)
    bench.drives[0].alive = True
    bench.ready().put(0, EndsByAnswer=True)
    bench.drives[0].answer = lambda request: bytes([request[0], request[1] + 0x80, 5])
    bench.stop(0)
    bench.run(500)
    bench.drives[0].answer, bench.drives[0].alive = None, False
    bench.put(0, SupplyOff=True)
    bench.stop(0)
    bench.run(12_000)
    bench.put(0, SupplyOff=False)
    bench.run(100)


def late(bench: Bench) -> None:
    """Two late replies with nothing sent between, the second one sooner."""
    bench.put(0, PollEveryMs=400)
    for turn_us in (120_000, 60_000):
        idle(bench.ready()).drives[0].turn_us = turn_us
        before = bench["Timeouts"]
        while bench["Timeouts"] == before:
            bench.scan()
        bench.drives[0].turn_us = None
        bench.run(300)


def late_of_two(bench: Bench) -> None:
    """A late reply to a stop that is not repeated, while that of another drive may still come."""
    bench.set(CommandRetries=255)
    bench.ready().drives[0].alive = False
    before = bench["Timeouts"]
    while bench["Timeouts"] == before:
        bench.scan()
    bench.drives[1].turn_us = 60_000
    bench.stop(1)
    bench.run(200)


def stalls(bench: Bench) -> None:
    """A store; a late scan while a reply is awaited; a port that takes no poll; an address that two slots have."""
    bench.ready().ask(0, PARAMETER, 6, 0x0123)
    bench.block["Slots[0].Ask[2].Words[3]"] = 2
    bench.run(200)
    bench.drives[0].turn_us = 100_000
    for _ in range(20):
        bench.run(30)
        bench.scan(took=200_000)
    bench.drives[0].turn_us = None
    bench.port_takes = False
    bench.run(2500)
    bench.port_takes = True
    bench.put(1, StopConfirmed=True)
    bench.run(100)
    bench.put(1, UnitAddress=1)
    bench.run(1500)


def once(bench: Bench) -> None:
    """A run that nobody answers."""
    bench.ready().put(0, Once=True)
    bench.drives[0].alive = False
    bench.command(0)
    bench.run(300)


def echo_ends(bench: Bench) -> None:
    """A port that no longer hears itself, without an error."""
    bench.ready().echoes = False
    bench.run(300)


def falls_silent(bench: Bench) -> None:
    """All eight at once, and are stopped: those that nobody has asked yet stay online until they are."""
    bench.ready().run(500)
    for drive in bench.drives:
        drive.alive = False
    bench.run(10_000)
    bench.stop(0)
    bench.run(3000)
    assert bench["OnlineCount"] == 0


def no_motor(bench: Bench) -> None:
    """A unit that has none, beside a drive."""
    bench.fill(1, STOP, 3, 0, quantity=0)
    bench.ready().set(StopAll=True)
    bench.run(100)


def learns(bench: Bench) -> None:
    """A reply time, while a request is open that waits for longer; then the unit is taken out, while it is asked."""
    bench.put(0, TurnRoundMs=500, StopConfirmed=True)
    bench.ready().drives[0].alive = False
    bench.run(600)
    bench.put(0, TurnRoundMs=20)
    bench.run(200)
    bench.put(0, TurnRoundMs=500)
    while not (bench["Slot"] == 0 and bench["Open.DueMs"] > 500 and bench["Phase"] == 2):
        bench.scan()
    bench.put(0, UnitAddress=0)
    bench.run(200)


def two_lines(bench: Bench) -> None:
    """Another line has the same slots."""
    bench.ready()
    for _ in range(30):
        bench.put(0, TimeMs=(bench.slot(0, "TimeMs") + 1) % 60_000)
        bench.scan()
    assert bench["ErrorID"] == 56


def reads_a_coil(bench: Bench) -> None:
    """A parameter that is a coil, while nothing else is due."""
    bench.put(0, PollEveryMs=1000)
    bench.ready().run(100)
    bench.ask(0, PARAMETER, 1, 0x0020, quantity=1)
    bench.run(100)
    assert bench.answer(0, PARAMETER) == "OK"


TOURS = (
    (falls_silent, Config(drives=8, turn_ms=400, longest_ms=400)),
    (long_dead, Config(drives=8)),
    (strangers, Config(drives=1, longest_ms=300)),
    (unset, Config(drives=1)),
    (supplies, Config(drives=1)),
    (late, Config(drives=1, longest_ms=300)),
    (late_of_two, Config(drives=2, longest_ms=300)),
    (once, Config(drives=1)),
    (learns, Config(drives=2)),
    (two_lines, Config(drives=1)),
    (echo_ends, Config(drives=1, echo=True)),
    (odd_replies, Config(drives=1, kind=2)),
    (odd_replies, Config(drives=1, kind=2, ascii=True)),
    (full_counts, Config(drives=1)),
    (own_stops, Config(drives=1)),
    (stalls, Config(drives=2)),
    (no_motor, Config(drives=2)),
    (reads_a_coil, Config(drives=1, kind=COILS)),
)
"""What chance seldom finds."""


@cache
def walked() -> EmbeddedLibrary:
    """A line of eight slots with counters, after its walks."""
    library = EmbeddedEngine(coverage=True).build(line_sources())
    for tour, config in TOURS:
        tour(Bench(config, block=library.instance("MB_Line8")))
    for seed in SEEDS:
        walk(seed, 1000, block=library.instance("MB_Line8"))
    for function, argument in (("MB_Plus", "More"), ("MB_Minus", "Less"), ("MB_Sixteen", "")):
        for number in (0, 1, 65534, 65535):
            library.call(function, {"Number": number, argument: 1} if argument else {"Number": number + 1})
    return library


def test_walks_keep_the_rules_and_reach_everything() -> None:
    texts = {each.path: each.text.splitlines() for each in line_sources()}
    library = walked()
    lines = {(path, line) for path, hits in library.coverage().items() for line in hits if not hits[line]}
    for path, outcomes in library.branches().items():
        lines |= {(path, one.line) for one, hits in outcomes.items() if not hits and one.text != "WHILE without a turn"}
    mine = {each for each in lines if each[0].startswith("line/") and not re.search("Line32|ByteLine", each[0])}
    never = [f"{path}:{line}: {texts[path][line - 1].strip()}" for path, line in sorted(mine)]
    assert never == []  # but for loops that always have something to do


def test_both_sizes_are_one_text() -> None:
    texts = {each.path: each.text for each in sources()}
    for block in ("Line", "ByteLine"):
        small, large = texts[f"line/MB_{block}8.st"], texts[f"line/MB_{block}32.st"]
        bodies = [re.sub(" +", " ", text.partition("END_VAR")[2].replace("32", "8")) for text in (small, large)]
        assert bodies[0] == bodies[1]


def test_no_call_exceeds_the_loops_that_its_head_states() -> None:
    """As many characters as a ring can hold beside those that come, and a request to make."""
    library = EmbeddedEngine(coverage=True).build(line_sources())
    bench = Bench(block=library.instance("MB_Line8")).ready()
    before = turns(library)
    bench.block["Port.RxIn"] = (bench["Port.RxOut"] + 200) % 256
    bench.scan()
    rounds = turns(library) - before
    text = next(each.text for each in line_sources() if each.path == "line/MB_Line8.st")
    stated = re.search(r"Loops .*?(\d+)\n {3}Body", text, re.DOTALL)
    assert stated is not None
    assert 200 < rounds <= int(stated[1])


def turns(library: EmbeddedLibrary) -> int:
    """How often the first statement in a loop has run."""
    total = 0
    for source in line_sources():
        hits = library.coverage().get(source.path, {})
        starts = [n for n, text in enumerate(source.text.splitlines(), start=1) if text.endswith(" DO")]
        total += sum(hits[min(line for line in hits if line > start)] for start in starts if hits)
    return total
