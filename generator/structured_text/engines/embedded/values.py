"""Values at the face of the engine: what a user reads, and what a user may write.

Inside, a structure is an object; outside it is a dict (see `host.engine`).
"""

from typing import Any

from structured_text.engines.embedded.certainty import known
from structured_text.engines.embedded.compiler import KEPT, kept
from structured_text.engines.embedded.reals import single
from structured_text.engines.embedded.shapes import is_scalar
from structured_text.engines.engine import Value
from structured_text.language.tree import Array, Block, Enum, Struct
from structured_text.language.types import ELEMENTARY, REAL, TEMPORAL, Elementary, Kind, String, Subrange, Type, plain

_TAKE_BYTES = frozenset({ELEMENTARY["BYTE"], ELEMENTARY["USINT"], ELEMENTARY["WORD"], ELEMENTARY["UINT"]})
"""Types of elements into which every byte fits."""


def members(kind: Type) -> dict[str, Type]:
    """The fields of a structure, or the variables of an instance, by upper-case name in order of declaration."""
    if isinstance(kind, Struct):
        return {name: each.type for name, each in kind.fields.items()}
    if isinstance(kind, Block):
        if kind.declaration is None:
            return {name: each.type for name, each in kind.parameters.items()}
        return {each.name.upper(): each.type for each in kept(kind.declaration)}
    return {}


def member(kind: Type, name: str) -> Type | None:
    """The type of one of these by its upper-case name, without a look at the others; None: there is none."""
    if isinstance(kind, Struct):
        field = kind.fields.get(name)
        return field.type if field else None
    if not isinstance(kind, Block):
        return None
    if kind.declaration is None:
        return kind.parameters[name].type if name in kind.parameters else None
    variable = kind.declaration.symbols.get(name)
    return variable.type if variable and variable.kind in KEPT else None


def read(kind: Type, value: Any) -> Value:
    """The value as the user sees it."""
    kind = plain(kind)
    if isinstance(kind, Array):
        return _read_list(value, kind, len(kind.bounds))
    if isinstance(kind, Struct | Block):
        return {name: read(each, getattr(value, name)) for name, each in members(kind).items()}
    outside: Value = value
    return outside


def _read_list(value: list[Any], kind: Array, dimensions: int) -> Value:
    if dimensions > 1:
        return [_read_list(each, kind, dimensions - 1) for each in value]
    if is_scalar(kind.element):
        return list(value)
    return [read(kind.element, each) for each in value]


def written(kind: Type, current: Any, value: Value) -> Any:
    """What to store for a value of the user's. ValueError.

    Arrays and structures are filled in place and given back; a list or bytes shorter than the array, or a dict
    that lacks fields, keeps the rest.
    """
    if isinstance(kind, Array):
        _fill(kind, current, value, 0)
        return current
    if isinstance(kind, Struct | Block):
        return _write_members(kind, current, value)
    return _scalar(kind, value)


def _write_members(kind: Type, current: Any, value: Value) -> Any:
    if not isinstance(value, dict):
        raise ValueError(f"{kind} takes a dict, not {value!r}")
    known = members(kind)
    for name, each in value.items():
        slot = name.upper()
        if slot not in known:
            raise ValueError(f"{kind} has no {name}")
        setattr(current, slot, written(known[slot], getattr(current, slot), each))
    return current


def _fill(kind: Array, current: list[Any], value: Value, dimension: int) -> None:
    if not isinstance(value, list | tuple | bytes | bytearray):
        raise ValueError(f"{kind} takes a list or bytes, not {value!r}")
    if len(value) > len(current):
        raise ValueError(f"{len(value)} values do not fit into the {len(current)} elements of {kind}")
    last = dimension + 1 == len(kind.bounds)
    # Checked first and stored afterwards, so that with a wrong value in the middle nothing is half written.
    made = _elements(kind.element, current, value) if last else []
    current[: len(made)] = made
    for place, each in enumerate(() if last else value):
        _fill(kind, current[place], each, dimension + 1)


def _elements(kind: Type, current: list[Any], value: list[Value] | tuple[Value, ...] | bytes | bytearray) -> list[Any]:
    """What to store for the first elements of an array. ValueError."""
    if isinstance(value, bytes | bytearray) and kind in _TAKE_BYTES:
        return list(value)  # nothing to check, and every frame comes this way
    return [written(kind, current[place], each) for place, each in enumerate(value)]


def _scalar(kind: Type, value: Value) -> Any:
    if kind.kind is Kind.BOOL:
        return _bool(value)
    if kind.kind is Kind.REAL:
        return _real(kind, value)
    if isinstance(kind, String):
        return _string(kind, value)
    if isinstance(kind, Enum):
        return _enumerated(kind, value)
    return _whole(kind, value)


def _whole(kind: Type, value: Value) -> int:
    kind = known(kind, Elementary)
    if not isinstance(value, int):
        raise ValueError(f"{kind} takes an int, not {value!r}")
    low, high = (kind.first, kind.last) if isinstance(kind, Subrange) else (kind.low, kind.high)
    if kind.kind in TEMPORAL:
        low, high = -(1 << 63), (1 << 63) - 1
    if not low <= value <= high:
        raise ValueError(f"{value} does not fit {kind}, which is {low}..{high}")
    return int(value)


def _bool(value: Value) -> bool:
    if not isinstance(value, int) or value not in (0, 1):
        raise ValueError(f"BOOL takes True or False, not {value!r}")
    return bool(value)


def _real(kind: Type, value: Value) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{kind} takes a number, not {value!r}")
    return single(float(value)) if plain(kind) is REAL else float(value)


def _string(kind: String, value: Value) -> bytes:
    if not isinstance(value, bytes | bytearray):
        raise ValueError(f"{kind} takes bytes, not {value!r}")
    if len(value) > kind.length:
        raise ValueError(f"{len(value)} characters do not fit {kind}, which holds {kind.length}")
    return bytes(value)


def _enumerated(kind: Enum, value: Value) -> int:
    numbers = [each.number for each in kind.values.values()]
    if not isinstance(value, int) or value not in numbers:
        raise ValueError(f"{kind} takes one of {numbers}, not {value!r}")
    return int(value)
