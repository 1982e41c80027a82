"""Lines that a person types, or a pipe brings; no key by itself, which would need another module on each platform."""

import os

from driveblocks.desk.script import Setting, setting
from structured_text.engines.engine import Instance


class Keyboard:
    """Lines of a file descriptor, read without the locks of sys.stdin, which a waiting thread would keep at the end."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        self._rest = b""

    @property
    def echoes(self) -> bool:
        """Whether a terminal shows what is typed."""
        return os.isatty(self._descriptor)

    def line(self) -> str | None:
        """The next line; None at the end."""
        while b"\n" not in self._rest:
            try:
                some = os.read(self._descriptor, 4096)
            except OSError:  # the terminal is gone
                return None
            if not some:
                line, self._rest = self._rest, b""
                return line.decode("utf-8", "replace") if line else None
            self._rest += some
        line, _, self._rest = self._rest.partition(b"\n")
        return line.decode("utf-8", "replace").rstrip("\r")


def is_variable(word: str, program: Instance) -> bool:
    """Whether a line is the name of a variable."""
    try:
        program[word]
    except KeyError:
        return False
    return True


def typed(line: str, inputs: tuple[str, ...], program: Instance) -> Setting:
    """What a line sets: `NAME := VALUE`, or the number or name of a BOOL, which changes. Raises ValueError."""
    word = line.strip()
    if ":=" in word:
        return setting(word, program)
    if word.isdigit():
        if not 1 <= int(word) <= len(inputs):
            raise ValueError(f"there is no input {word}; write NAME := VALUE")
        word = inputs[int(word) - 1]
    if not is_variable(word, program):
        raise ValueError(f"the program has no variable {word}")
    if not isinstance(program[word], bool):
        raise ValueError(f"{word} is no BOOL; write {word} := VALUE")
    return Setting(word, not program[word])
