"""What the checker of the front end has made sure, said to the type checker of Python."""

from typing import TypeVar

Known = TypeVar("Known")


def known(value: object, kind: type[Known]) -> Known:
    """A value that is surely of a class. TypeError if the engine is wrong about that."""
    if not isinstance(value, kind):
        raise TypeError(f"expected {kind.__name__}, found {type(value).__name__}")
    return value


def present(value: Known | None) -> Known:
    """A value that is surely there. TypeError if the engine is wrong about that."""
    if value is None:
        raise TypeError("expected a value, found None")
    return value
