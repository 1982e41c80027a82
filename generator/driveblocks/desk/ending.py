"""Why what runs ends, and the signals that end it."""

import queue
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import FrameType

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

Bell = queue.SimpleQueue[None]
"""What wakes the watchdog; signals may ring it, since its `put` may interrupt itself."""


@dataclass
class Ending:
    """Why a run ends; set by signals and by whatever else ends it, read by the scan loop."""

    reason: str = ""
    hurry: bool = False
    """Asked a second time: do not wait for the motors."""
    alone: bool = False
    """Nobody is there who could ask a second time."""
    bell: Bell = field(default_factory=Bell)
    """Rings when the end is asked for, and when the scans are over."""

    def ask(self, reason: str, *, insists: bool = False, alone: bool = False) -> None:
        """End the run; who insists while it ends does not wait any longer; `alone`: no person asks.

        A terminal that closes brings a signal, the end of the input and a failing screen at once: these do not insist.
        """
        if self.reason and insists:
            self.hurry = True
        self.alone = self.alone or alone
        self.reason = self.reason or reason
        self.bell.put(None)


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
        ending.ask(REASONS.get(name, name), insists=name in INSISTS, alone=name not in INSISTS)

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
