"""A run in real time: scans and their watchdog in threads of their own, screen, keyboard and signals beside them."""

import gc
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType

from driveblocks.desk.keyboard import Keyboard
from driveblocks.desk.screen import Screen
from driveblocks.plc.ending import Ending
from driveblocks.plc.session import Result, Session

HELP = (
    "2                 toggle input 2; so does its name",
    "Hertz := 30.0     set a variable",
    "q                 stop every drive and end, as Ctrl-C",
    "t 1, d 1, r 1     at unit 1: trip the drive, drop its supply, restore it (supply, cause and fault)",
    "trip OC 1         whatever a scenario may say; docs/simulate.md lists it",
)
"""What a person may type; the last two lines are for simulated drives."""
REASONS = {"SIGINT": "Ctrl-C", "SIGHUP": "SIGHUP: the terminal is gone", "SIGBREAK": "Ctrl-Break"}
"""Why a run ends, where the name of the signal does not say it."""
INSISTS = ("SIGINT", "SIGBREAK")
"""What a person does who does not want to wait."""
PASSED_ON = frozenset({
    "SIGKILL", "SIGSTOP",  # nobody can catch these
    "SIGSEGV", "SIGBUS", "SIGFPE", "SIGILL",  # nothing can go on after these
    "SIGCHLD", "SIGCONT", "SIGINFO", "SIGURG", "SIGWINCH", "SIGPIPE", "SIGXFSZ",  # these end nothing
    "SIGVTALRM",  # the clock by which an engine sees that a scan does not end; Python would not give it back
})  # fmt: skip
SUSPENDS = ("SIGTSTP", "SIGTTIN", "SIGTTOU")
_NAMES = {int(each): each.name for each in signal.Signals}
LOOK_S = 0.2
SWITCH_S = 0.0005
"""Longest time for which drawing keeps the scan waiting."""
GRACE_S = 80
"""For the last stop: the longest StopWithinMs, and what is under way before it. No more than a net."""


def run(
    session: Session, screen: Screen, keyboard: Keyboard | None, for_us: int | None, *, end_of_input: bool
) -> Result:
    """Run until the end, whatever brings it; `end_of_input`: so does the end of the keyboard's lines."""
    with _undisturbed():
        watch = _beside(lambda: session.run(for_us))
        try:
            if keyboard is not None:
                _listen_to(keyboard, session, end_of_input=end_of_input)
            _watch(session, screen, watch)
        except BaseException as error:  # a lost terminal must not leave drives running
            session.ending.ask(f"the screen has failed: {error or type(error).__name__}")
        finally:
            watch.join(GRACE_S)
        with suppress(OSError, ValueError):
            tell(session, screen)
        with suppress(OSError, ValueError):
            screen.close()
    hangs = Result(session.ending.reason, crashed=True, unconfirmed={"every drive": "the thread that stops them hangs"})
    return session.result or hangs


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Let neither drawing nor the collection of garbage keep a scan waiting."""
    switch = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_S)
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        sys.setswitchinterval(switch)
        gc.unfreeze()


def caught() -> dict[int, str]:
    """The signals that end a run, by their numbers; real-time signals have no names."""
    numbers = map(int, signal.valid_signals())
    names = {each: _NAMES.get(each, f"signal {each}") for each in numbers}
    return {number: name for number, name in names.items() if name not in PASSED_ON and name not in SUSPENDS}


@contextmanager
def listening(ending: Ending, suspend: Callable[[], None] | None = None) -> Iterator[None]:
    """Let signals end the run; `suspend` is asked for a suspension, which else is the system's."""

    def ask(number: int, _: FrameType | None) -> None:
        name = names[number]
        ending.ask(REASONS.get(name, name), insists=name in INSISTS)

    names = caught()
    handlers: dict[int, Callable[[int, FrameType | None], None] | signal.Handlers] = dict.fromkeys(names, ask)
    if suspend is not None:
        found = [getattr(signal, name, None) for name in SUSPENDS]
        # From the background, reading the terminal then fails, which is the end of the input, and writing does not.
        handlers |= {number: signal.SIG_IGN for number in found if number is not None}
        if found[0] is not None:
            handlers[found[0]] = lambda _number, _frame: suspend()
    before = [(number, signal.signal(number, handler)) for number, handler in handlers.items()]
    try:
        yield
    finally:
        for number, handler in before:
            signal.signal(number, signal.SIG_DFL if handler is None else handler)


def _listen_to(keyboard: Keyboard, session: Session, *, end_of_input: bool) -> None:
    def taken(line: str) -> None:
        word = line.strip()
        if word == "q":
            session.ending.ask("q")
        elif word == "help":
            for text in HELP if session.play is not None else HELP[:-2]:
                session.told.put(text)
        elif word:
            session.typed.put(line)

    def ended() -> None:
        if end_of_input:
            session.ending.ask("the input has ended")

    _beside(lambda: keyboard.serve(taken, ended))


def _beside(work: Callable[[], object]) -> threading.Thread:
    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    return thread


def _watch(session: Session, screen: Screen, watch: threading.Thread) -> None:
    while watch.is_alive():
        watch.join(LOOK_S)
        tell(session, screen)
        if session.view is not None:
            screen.show(session.view)


def tell(session: Session, screen: Screen) -> None:
    while not session.told.empty():
        screen.say(session.told.get())
