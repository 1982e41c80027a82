"""One line on several engines at once: what is set is set on all, and their states must be equal after every scan."""

import re
from collections.abc import Iterator, Mapping, Sequence

from structured_text.engines.engine import Instance, Library, Value

_COPY = re.compile(
    r"[\w.]+\.(?:SLOT|SLOTS|PORT|STORES|OPEN|TRACK|TX|(?:READS|PLATE)\.WORDS|GATE\.ASK|REST\.DIAGNOSIS)\b.*"
)
"""Copies of in-outs inside inner instances, which only C keeps."""


class DifferentError(AssertionError):
    """Two engines have come to different states."""


class Twins:
    """Instances of one block that look like one."""

    def __init__(self, instances: Sequence[Instance], every: int = 1) -> None:
        """Compare the states after each `every` scans."""
        self.instances = instances
        self.every = every
        self.scans = 0

    def __getitem__(self, path: str) -> Value:
        """Read from the first."""
        return self.instances[0][path]

    def __setitem__(self, path: str, value: Value) -> None:
        """Write to all."""
        for each in self.instances:
            each[path] = value

    def scan(self, now_ns: int | None = None) -> None:
        """Scan all. Raises DifferentError."""
        for each in self.instances:
            each.scan(now_ns)
        self.scans += 1
        if self.scans % self.every == 0:
            first, *others = map(_state, self.instances)
            for other in others:
                if other != first:
                    unlike = [
                        f"{path}: {first[path]!r}, {other.get(path)!r}"
                        for path in first
                        if first[path] != other.get(path)
                    ]
                    raise DifferentError(f"scan {self.scans}: {unlike[:10]}")

    def state(self) -> dict[str, Value]:
        """The state of the first."""
        return self.instances[0].state()


def _state(instance: Instance) -> dict[str, Value]:
    """What is compared; NaN by its name, since it equals nothing."""
    kept = {path: value for path, value in instance.state().items() if not _COPY.match(path)}
    return {path: value if value == value else b"NaN" for path, value in kept.items()}  # noqa: PLR0124 - NaN alone


class TwinLibrary:
    """Libraries of several engines that look like one."""

    def __init__(self, libraries: Sequence[Library], every: int = 1) -> None:
        """Compare the states after each `every` scans."""
        self.libraries = libraries
        self.every = every

    def instance(self, block: str) -> Twins:
        """One of each engine."""
        return Twins([each.instance(block) for each in self.libraries], self.every)

    def call(self, function: str, arguments: Mapping[str, Value]) -> Value:
        """Call a function of the first."""
        return self.libraries[0].call(function, arguments)

    def blocks(self) -> Iterator[str]:
        """Those of the first."""
        return self.libraries[0].blocks()
