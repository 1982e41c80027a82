"""Frames of a line, one after the other, as `driveblocks explain` says them."""

from collections.abc import Iterator, Mapping

from driveblocks.desk.bus import Frame
from driveblocks.desk.explain import page
from driveblocks.desk.explain.explanation import Explainer
from driveblocks.desk.explain.paste import Paste
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Refused
from driveblocks.modbus.envelope import open_


class Tracer:
    """Explains one frame after the other; a reply by the request before it."""

    def __init__(self, drives: Mapping[int, Drive]) -> None:
        self._explainers = {unit: Explainer(drive) for unit, drive in drives.items()}
        self._anyone = Explainer()
        self._request: Paste | None = None

    def lines(self, frame: Frame) -> Iterator[str]:
        body = open_(frame.data).body
        explainer = self._explainers.get(body[0], self._anyone) if body else self._anyone
        paste = Paste(frame.data, "characters" if frame.data[:1] == b":" else "hexadecimal")
        try:
            made = explainer.explain(paste, self._request if frame.reply else None)
        except Refused:  # the request before it is none
            made = explainer.explain(paste)
        if not frame.reply:
            self._request = None if frame.fate else paste
        fate = f"  ({frame.fate})" if frame.fate else ""
        yield f"{frame.at_us / 1e6:9.3f} s {'<' if frame.reply else '>'} {page.written(made.wire)}{fate}"
        yield from (f"    {line}" for line in page.brief(made))
