"""The way out of the process: bounded, once it is known whether the drives are at standstill."""

import os
import sys
import threading
from contextlib import suppress

ASIDE_S = 0.2
"""For the verdict on the other stream, which may be stuck, too."""


class Departure:
    """Ends the process where what is left to do does not end: a pipe or a terminal that takes nothing."""

    def __init__(self, within_s: float, aside_s: float = ASIDE_S) -> None:
        """Nothing is bounded before `begin`."""
        self._within_s, self._aside_s = within_s, aside_s
        self.done = threading.Event()
        """Set when all that could get stuck is done."""
        self.printed = False
        """Whether the verdict has been printed."""

    def begin(self, status: int, verdict: str) -> None:
        """From now on there is so much time, then this exit status."""
        threading.Thread(target=self._bound, args=(status, verdict), daemon=True).start()

    def _bound(self, status: int, verdict: str) -> None:
        if self.done.wait(self._within_s):
            return
        if not self.printed:
            aside = threading.Thread(target=_say_aside, args=(verdict,), daemon=True)
            aside.start()
            aside.join(self._aside_s)
        os._exit(status)


def _say_aside(text: str) -> None:
    with suppress(OSError, ValueError, AttributeError):
        os.write(sys.stderr.fileno(), text.encode("utf-8", "replace"))
