"""A run in real time: scans in a thread of their own, screen, keyboard and signals beside it."""

import gc
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType

from driveblocks.plc.ending import WITHIN_US, Ending
from driveblocks.plc.keyboard import Keyboard, typed
from driveblocks.plc.screen import Screen
from driveblocks.plc.session import Result, Session

SIGNALS = {"SIGINT": "Ctrl-C", "SIGTERM": "SIGTERM", "SIGHUP": "SIGHUP: the terminal is gone", "SIGBREAK": "Ctrl-Break"}
"""What ends a run, where the platform has it."""
INSISTS = ("SIGINT", "SIGBREAK")
"""What a person does who does not want to wait."""
LOOK_S = 0.2
SWITCH_S = 0.0005
"""Longest time for which drawing keeps the scan waiting."""
GRACE_S = 5


def run(
    session: Session, screen: Screen, keyboard: Keyboard | None, for_us: int | None, *, end_of_input: bool
) -> Result:
    """Run until the end, whatever brings it; `end_of_input`: so does the end of the keyboard's lines."""
    with _undisturbed():
        scans = threading.Thread(target=session.run, args=(for_us,))
        scans.start()
        try:
            if keyboard is not None:
                _listen_to(keyboard, session, end_of_input=end_of_input)
            _watch(session, screen, scans)
        except BaseException as error:  # a lost terminal must not leave drives running
            session.ending.ask(f"the screen has failed: {error or type(error).__name__}")
        finally:
            scans.join(WITHIN_US / 1e6 + GRACE_S)
        with suppress(OSError, ValueError):
            tell(session, screen)
        with suppress(OSError, ValueError):
            screen.close()
    hangs = Result(session.ending.reason, crashed=True, unconfirmed={"every drive": "the scan thread hangs"})
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


@contextmanager
def listening(ending: Ending) -> Iterator[None]:
    """Let signals end the run."""

    def ask(number: int, _: FrameType | None) -> None:
        name = signal.Signals(number).name
        ending.ask(SIGNALS[name], insists=name in INSISTS)

    numbers = [getattr(signal, name) for name in SIGNALS if hasattr(signal, name)]
    before = [(number, signal.signal(number, ask)) for number in numbers]
    try:
        yield
    finally:
        for number, handler in before:
            signal.signal(number, handler)


def _listen_to(keyboard: Keyboard, session: Session, *, end_of_input: bool) -> None:
    inputs, instance = session.controller.wiring.inputs, session.controller.instance

    def taken(line: str) -> None:
        if line.strip():
            try:
                session.settings.put(typed(line, inputs, instance))
            except ValueError as error:
                session.told.put(str(error))

    def ended() -> None:
        if end_of_input:
            session.ending.ask("the input has ended")

    _beside(lambda: keyboard.serve(taken, ended))


def _beside(work: Callable[[], None]) -> None:
    threading.Thread(target=work, daemon=True).start()


def _watch(session: Session, screen: Screen, scans: threading.Thread) -> None:
    while scans.is_alive():
        scans.join(LOOK_S)
        tell(session, screen)
        if session.view is not None:
            screen.show(session.view)


def tell(session: Session, screen: Screen) -> None:
    while not session.told.empty():
        screen.say(session.told.get())
