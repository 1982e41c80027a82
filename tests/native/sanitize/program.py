"""One C program that drives every block and function of the library: written here what follows from their pins.

By hand, in `c/`, stands what needs thought: damaged frames, and a second reading of the standard.
"""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from tests.native.sanitize import seeds
from tests.native.sanitize.pins import Pin, Pou, arrays, fields
from tests.shipped import drives

from driveblocks.reference.reply import dialect
from driveblocks.render.results import RESULTS

C = Path(__file__).with_name("c")
INCLUDES = "#include <signal.h>\n#include <sys/time.h>\n#include <unistd.h>\n"

_PACKING = {f"MB_{way}{box}{bits}" for way in ("PACK", "UNPACK") for box in ("ADU", "CHARS") for bits in (8, 16)}
_FRAMING = {"MB_RTUOPEN", "MB_RTUSEAL", "MB_ASCIIDECODE", "MB_ASCIIENCODE", "MB_CRC16", "MB_CRC16COMPACT", "MB_LRC"}
_BUILDING = {"MB_BUILDREAD", "MB_BUILDWRITESINGLE", "MB_BUILDWRITEMULTIPLE", "MB_BUILDDIAGNOSTICS"}
FILLED = frozenset(_PACKING | _FRAMING | {"MB_PARSEREPLY"})
"""Blocks whose input `c/` makes."""
JUDGED = frozenset(FILLED | _BUILDING | {"MB_HEXVALUE", "MB_HEXDIGIT"})
"""Blocks and functions whose result `c/` judges."""
MOST = {"LENGTH": 254, "ADULENGTH": 256, "CHARCOUNT": 513, "WORDCOUNT": 125, "REGISTERCOUNT": 513, "UNPACKED": 513}
"""The highest count that an output may tell: what a frame carries (serial line 1.02, 2.5) and the types hold."""
NOTHING_WITH_ERROR = ("LENGTH", "ADULENGTH", "CHARCOUNT", "WORDCOUNT")
LIKELY = {
    "FUNCTIONCODE": (3, 4, 6, 8, 16),
    "UNITADDRESS": (0, 1, 1, 2, 31, 32, 33, 246, 247, 248),
    "QUANTITY": (1, 1, 2, 3, 4, 6, 7, 8, 10, 12, 16, 17, 123, 124, 125, 126),
    "MAXWORDS": (0, 1, 2, 8, 16, 123, 124, 125, 126, 65535),
    "SUBFUNCTION": (0, 0, 0, 1),
}
"""Values that take a request past the first questions that a block asks."""


def text(pous: Sequence[Pou], library: Sequence[Pou]) -> str:
    """The program for some of a library, to be compiled after prelude.h. It takes a name, a seed and a number."""
    return f"{drivers(pous, library)}\n{_main(pous)}"


def drivers(pous: Sequence[Pou], library: Sequence[Pou]) -> str:
    """All of it but the main function: for each block NAME_general and NAME_right, which judge a scan.

    `c/` names numbers of blocks that may not be among them, so those of the whole library stand there.
    """
    tables, spans = seeds.tables()
    codes = ", ".join(str(each.code) for each in RESULTS)
    parts = [
        INCLUDES + _file("chance"),
        _file("frame"),
        _file("lines"),
        tables,
        f"static const uint16_t KNOWN_RESULTS[] = {{{codes}}};\n",
        *(_telling(pou) for pou in library),
        *map(_file, ("reply", "framing", "packing", "request", "run")),
        *_drives({pou.c_name for pou in pous}, spans),
        *(_block(pou) if pou.result is None else _function(pou) for pou in pous),
    ]
    return "\n".join(parts)


def _file(name: str) -> str:
    return f'#line 1 "{name}.h"\n{(C / name).with_suffix(".h").read_text(encoding="utf-8")}\n'


def _telling(pou: Pou) -> str:
    words = ", ".join(map(str, pou.words)) or "0"
    reals = ", ".join(f"{value!r}f" for value in pou.reals) or "0"
    name = f"{pou.c_name}_telling"
    return (
        f"static const uint16_t {name}_words[] = {{{words}}};\nstatic const float {name}_reals[] = {{{reals}}};\n"
        f"static const Telling {name} = {{{name}_words, {len(pou.words)}, {name}_reals, {len(pou.reals)}}};\n"
    )


def _drives(names: set[str], spans: dict[str, tuple[int, int]]) -> Iterator[str]:
    """The macros of `c/` for what each drive has."""
    for prefix, drive in drives().items():
        spoken = dialect(drive)
        first, count = spans[prefix]
        form = f"{spoken.add or 0}, {spoken.function or 0}, {spoken.address or 0}, {int(spoken.two_byte_count)}"
        calls = {
            "REPLY": f"REPLY({prefix}_REPLY, SET({form}), {first}, {count})",
            "REQUEST": f"REQUEST_BLOCK({prefix}_REQUEST)",
            "REFERENCE": f"REFERENCE_BLOCK({prefix}_REFERENCE)",
            "COMMAND": f"COMMAND_BLOCK({prefix}_COMMAND)",
        }
        yield from (call for name, call in calls.items() if f"{prefix}_{name}" in names)


def _is_filled(pou: Pou) -> bool:
    return pou.c_name in FILLED or pou.c_name.endswith("_REPLY")


def _is_judged(pou: Pou) -> bool:
    return pou.c_name in JUDGED or pou.c_name.endswith(("_REPLY", "_REQUEST", "_REFERENCE", "_COMMAND"))


def _keeps_state(pou: Pou) -> bool:
    """Whether a scan depends on the one before: edges, and whether the word changed."""
    return pou.pin("CHANGED") is not None


def _block(pou: Pou) -> str:
    name = pou.c_name
    given = [pin for pin in pou.pins if pin.direction != "out"]
    told = [pin for pin in pou.pins if pin.direction != "in"]
    compared = [] if _keeps_state(pou) else [_differs("x", "y", pin, f"{pin.name} depends on the past") for pin in told]
    functions = [
        _c(f"static void {name}_pins(const {name} *x)", (_show(f"x->{pin.name}.value", pin) for pin in given)),
        _c(f"static void {name}_give({name} *x, const {name} *y)", (_copy(pin) for pin in given)),
        _c(f"static const char *{name}_same(const {name} *x, const {name} *y)", [*compared, "return NULL;"]),
        _c(f"static const char *{name}_general(const {name} *x, const {name} *was)", _general(pou)),
    ]
    if not _is_filled(pou):
        functions.append(_c(f"static void {name}_fill({name} *x)", _fill(pou, lambda pin: f"x->{pin.name}.value")))
    if not _is_judged(pou):
        functions.append(f"static const char *{name}_right(const {name} *x, const {name} *was) {{ return NULL; }}\n")
    return "".join(functions) + f"DRIVE_BLOCK({name})\n"


def _c(head: str, statements: Iterator[str] | Sequence[str]) -> str:
    body = "".join(f"    {statement}\n" for statement in statements)
    return f"{head}\n{{\n{body}}}\n"


def _general(pou: Pou) -> Iterator[str]:
    """What every block keeps to."""
    flags = " | ".join(f"x->{name}.flags" for name in pou.members)
    yield f'if ({flags}) return "a byte of flags is written";'
    yield 'if (x->EN.value != 1 || x->ENO.value != 1) return "EN or ENO is written";'
    for pin in pou.pins:
        if (pin.direction == "in" and pin.name != "EN") or pin.read_only:
            yield _differs("x", "was", pin, f"{pin.name}, which is read only, is written")
        if pin.direction == "out" and pin.type == "BOOL":
            yield f'if (x->{pin.name}.value > 1) return "{pin.name} is no BOOL";'
        if pin.direction == "out" and pin.name in MOST:
            yield f'if (x->{pin.name}.value > {MOST[pin.name]}) return "{pin.name} is too high";'
    if pou.pin("ERRORID"):
        yield 'if (!known_result(x->ERRORID.value)) return "an unknown ErrorID";'
        yield "results[x->ERRORID.value]++;"
        for pin in pou.pins:
            if pin.direction == "out" and pin.name in NOTHING_WITH_ERROR:
                yield f'if (x->ERRORID.value && x->{pin.name}.value) return "{pin.name} in spite of an error";'
    yield "return NULL;"


def _differs(one: str, other: str, pin: Pin, complaint: str) -> str:
    left, right = f"{one}->{pin.name}.value", f"{other}->{pin.name}.value"
    return f'if (memcmp(&{left}, &{right}, sizeof {left})) return "{complaint}";'


def _copy(pin: Pin) -> str:
    return f"x->{pin.name}.value = y->{pin.name}.value;"


def _fill(pou: Pou, place: Callable[[Pin], str]) -> Iterator[str]:
    """Input at random, by the types and names of the pins."""
    given = [pin for pin in pou.pins if pin.direction != "out"]
    telling = f"&{pou.c_name}_telling"
    bits = [pin for pin in given if pin.type == "BOOL"]
    if bits:
        yield "uint64_t bits = some_bits();"
        yield from (f"{place(pin)} = (BOOL)(bits >> {at} & 1);" for at, pin in enumerate(bits))
    for pin in given:
        if pin.type != "BOOL":
            yield from _chance(pin, place(pin), telling)


def _chance(pin: Pin, place: str, telling: str) -> Iterator[str]:
    """Statements that give a pin a value at random. Raises ValueError for a type that no block of the library has."""
    if array := arrays(pin):
        yield f"noise({place}.table, one_in(4) ? sizeof {place}.table : {min(16, array[1])});"
    elif own := fields(pin):
        yield from (f"{place}.{name} = some_word({telling});" for _, name in own)
    elif pin.type == "REAL":
        yield f"{place} = some_real({telling});"
    elif pin.name in LIKELY:
        values = ", ".join(map(str, LIKELY[pin.name]))
        count = len(LIKELY[pin.name])
        yield f"{{ static const uint16_t likely[] = {{{values}}}; {place} = word_among({telling}, likely, {count}); }}"
    elif pin.type in ("WORD", "UINT", "INT", "BYTE", "USINT"):
        yield f"{place} = ({pin.type})some_word({telling});"
    elif pin.type in ("DWORD", "UDINT", "DINT"):
        yield f"{place} = one_in(2) ? some_word({telling}) : ({pin.type})(chance() >> 32);"
    else:
        raise ValueError(f"nobody has said how to make a {pin.type}")


def _show(place: str, pin: Pin) -> str:
    array = arrays(pin)
    if array and array[0] == "BYTE":
        return f'show_bytes("{pin.name}", {place}.table, {array[1]});'
    if array:
        return f'show_words("{pin.name}", {place}.table, {array[1]});'
    if own := fields(pin):
        return " ".join(f'show_number("{pin.name}.{name}", {place}.{name});' for _, name in own)
    kind = "show_real" if pin.type == "REAL" else "show_number"
    return f'{kind}("{pin.name}", {place});'


def _function(pou: Pou) -> str:
    """A function: its arguments stand in variables, so that they can be shown."""
    name = pou.c_name
    variables = "".join(f"static {pin.type} {name}_{pin.name};\n" for pin in pou.pins)
    arguments = ", ".join(f"{name}_{pin.name}" for pin in pou.pins)
    show = _c(f"static void {name}_show(void)", (_show(f"{name}_{pin.name}", pin) for pin in pou.pins))
    once = [
        *_fill(pou, lambda pin: f"{name}_{pin.name}"),
        f"{pou.result} result = {name}(1, NULL, {arguments});",
        *_judge_result(pou),
        f"return {f'{name}_right({arguments}, result)' if _is_judged(pou) else 'NULL'};",
    ]
    return f"{variables}{show}{_c(f'static const char *{name}_once(void)', once)}DRIVE_FUNCTION({name})\n"


def _judge_result(pou: Pou) -> Iterator[str]:
    """What every result of a type keeps to."""
    match pou.result:
        case "REAL":
            yield 'if (!isfinite(result)) return "the result is no number";'
        case "BOOL":
            yield 'if (result > 1) return "the result is no BOOL";'
        case "STRING":
            yield 'if (result.len < 0 || result.len > STR_MAX_LEN) return "the length of the text is wrong";'
            most = "0xFF" if pou.name.endswith("Zh") else "0x7E"
            yield "for (int at = 0; at < result.len; at++)"
            yield f'    if (result.body[at] < 0x20 || result.body[at] > {most}) return "no text";'
        case _:
            pass


def _main(pous: Sequence[Pou]) -> str:
    rows = ", ".join(f'{{"{pou.name}", {pou.c_name}_run}}' for pou in pous)
    return (
        f"static const Entry ENTRIES[] = {{{rows}}};\n"
        "int main(int argc, char **argv) { return run_entries(ENTRIES, COUNT(ENTRIES), argc, argv); }\n"
    )
