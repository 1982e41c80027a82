"""What errata, absences and notices are about: `register 0220H`, `bit 0015H.7`, `fault 1EH`, `frame read_speed`."""

from collections.abc import Iterable

from driveblocks.maps import form


def of(address: int, bits: str = "") -> str:
    """What names a register, that of another table than the holding registers by its table; or bits of it."""
    kind = "" if form.wire(address) != address else "bit " if bits else "register "
    shown = form.address_text(address, bits).partition(" (")[0]
    return form.Wired(f"{kind}{form.wire_text(address)}{bits}", f"{kind}{shown}")


def concerns(ref: str, kind: str, key: int | str) -> bool:
    """Whether a reference is about an entry: a register by address, a fault, error or function by code, others by id.

    A reference to a bit is also about its register.
    """
    said, _, name = ref.partition(" ")
    if kind == "register" and said in form.TABLES:
        return key in form.ADDRESSES.parse(form.TABLES[said] + name.partition(".")[0])
    if said != kind:
        return False
    return bool(form.NUMBER.parse(name) == key) if isinstance(key, int) else name == key


def any_concerns(refs: tuple[str, ...], kind: str, key: int | str) -> bool:
    """Whether one of several references is about an entry."""
    return any(concerns(ref, kind, key) for ref in refs)


def addresses(lists: Iterable[tuple[str, ...]]) -> frozenset[int]:
    """Every register address that the references of several entries name, by itself or through a bit."""
    spans = (
        form.ADDRESSES.parse(name.partition(".")[0])
        for refs in lists
        for kind, _, name in (ref.partition(" ") for ref in refs)
        if kind in ("register", "bit")
    )
    return frozenset(address for span in spans for address in span)
