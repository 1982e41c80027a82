"""A run in real time: scans and their watchdog in threads of their own, screen, keyboard and signals beside them."""

import gc
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

from driveblocks.desk.keyboard import Keyboard
from driveblocks.desk.run.session import Result, Session
from driveblocks.desk.screen import Screen

HELP = (
    "2                 toggle input 2; so does its name",
    "Hertz := 30.0     set a variable",
    "q                 stop every drive and end, as Ctrl-C; a second Ctrl-C does not wait for them",
    "t 1, d 1, r 1     at unit 1: trip the drive, drop its supply, restore it (supply, cause and fault)",
    "trip OC 1         whatever a scenario may say; docs/simulate.md lists it",
)
"""What a person may type; the last two lines are for simulated drives."""
LOOK_S = 0.2
SWITCH_S = 0.0005
"""Longest time for which drawing keeps the scan waiting."""
GRACE_S = 145
"""For the last stop where nobody is there: the longest StopWithinMs and a minute, and what is under way before it."""


def run(
    session: Session, screen: Screen, keyboard: Keyboard | None, for_us: int | None, *, end_of_input: bool
) -> Result:
    """Run until the end, whatever brings it; `end_of_input`: so does the end of the keyboard's lines."""
    with _undisturbed():
        watch = _beside(lambda: session.run(for_us))
        try:
            if keyboard is not None:
                _listen_to(keyboard, session, end_of_input=end_of_input)
            while watch.is_alive():
                watch.join(LOOK_S)
                tell(session, screen)
                if session.view is not None:
                    screen.show(session.view)
        except BaseException as error:  # a lost terminal must not leave drives running
            session.ending.ask(f"the screen has failed: {error or type(error).__name__}", alone=True)
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
    gc.freeze()  # what has been compiled is out of reach of the collector, which would walk over all of it
    try:
        yield
    finally:
        sys.setswitchinterval(switch)
        gc.unfreeze()


def _listen_to(keyboard: Keyboard, session: Session, *, end_of_input: bool) -> None:
    def serve() -> None:
        for line in iter(keyboard.line, None):
            word = line.strip()
            if word == "q":
                session.ending.ask("q")
            elif word == "help":
                for text in HELP if session.play is not None else HELP[:-2]:
                    session.told.put(text)
            elif word:
                session.typed.put(line)
        if end_of_input:
            session.ending.ask("the input has ended", alone=True)

    _beside(serve)


def _beside(work: Callable[[], object]) -> threading.Thread:
    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    return thread


def tell(session: Session, screen: Screen) -> None:
    while not session.told.empty():
        screen.say(session.told.get())
