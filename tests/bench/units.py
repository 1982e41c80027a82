"""Every block and function of the library with its typical input, as one program in C: timed, counted, weighed."""

import functools

from tests.bench.forms import driver
from tests.bench.inputs import Pin, pins
from tests.blocks.library import alone, sources
from tests.native.driver import Driver

from structured_text.language.checker import check
from structured_text.language.parser import parse
from structured_text.language.tree import Checked, Function, FunctionBlock

MAIN = """
#if defined __has_include
#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#endif
#endif

static void (*volatile nothing_body)(void *) = nothing;
static void run_nothing(void) { nothing_body(NULL); }

/* One scan of each between two dumps of callgrind, after a scan that is not counted; first a call of nothing. */
static int count_all(void)
{
#ifdef CALLGRIND_ZERO_STATS
    run_nothing();
    CALLGRIND_ZERO_STATS;
    run_nothing();
    CALLGRIND_DUMP_STATS_AT("nothing");
    for (int at = 0; at < UNITS; at++) {
        forms[at].work();
        CALLGRIND_ZERO_STATS;
        forms[at].work();
        CALLGRIND_DUMP_STATS_AT(forms[at].name);
    }
    return 0;
#else
    fputs("there is no valgrind/callgrind.h", stderr);
    return 3;
#endif
}

int main(int count, char **arguments)
{
    start_all();
    if (count == 2 && strcmp(arguments[1], "count") == 0)
        return count_all();
    for (int at = 0; count == 1 && at < UNITS; at++)
        if (sizes[at] > 0)
            printf("%s\\t%zu\\n", forms[at].name, sizes[at]);
    if (count == 2)
        measure(forms, UNITS, atoi(arguments[1]));
    return 0;
}
"""
"""Without arguments: bytes of one instance of each block; `count`: for callgrind; a number of rounds: timed."""


@functools.cache
def library() -> Checked:
    """The library of the shipped drives, checked."""
    return check([parse("\n".join(source.text for source in sources()), "library")])


def units() -> list[Function | FunctionBlock]:
    """Every block and function that is called by itself, in the order of the library."""
    checked = library()
    found: dict[str, Function | FunctionBlock] = {}
    found.update(checked.functions)
    found.update(checked.blocks)
    names = [source.path.rpartition("/")[2].removesuffix(".st").upper() for source in alone()]
    return [found[name] for name in names if name in found]


def program() -> Driver:
    """The program of all of them."""
    all_ = units()
    starts = "\n".join(f"    start_{unit.name}();" for unit in all_)
    rows = ",\n".join(f'    {{"{unit.name}", run_{unit.name}}}' for unit in all_)
    sizes = ", ".join(f"sizeof({unit.name.upper()})" if isinstance(unit, FunctionBlock) else "0" for unit in all_)
    return driver(
        "static __attribute__((noinline)) void nothing(void *instance) { (void)instance; }\n"
        + "".join(_block(unit) if isinstance(unit, FunctionBlock) else _function(unit) for unit in all_)
        + f"enum {{ UNITS = {len(all_)} }};\nstatic void start_all(void)\n{{\n{starts}\n}}\n"
        + f"static const Form forms[] = {{\n{rows}\n}};\nstatic const size_t sizes[] = {{{sizes}}};\n{MAIN}"
    )


def _block(unit: FunctionBlock) -> str:
    name, type_ = unit.name, unit.name.upper()
    given = "".join(_given(f"the_{name}.{pin.upper()}.value", value) for pin, value in pins(unit).items())
    return (
        f"static {type_} the_{name};\nstatic void (*volatile body_{name})({type_} *) = {type_}_body__;\n"
        f"static void run_{name}(void) {{ body_{name}(&the_{name}); }}\n"
        f"static void start_{name}(void)\n{{\n    START({type_}, the_{name});\n{given}}}\n"
    )


def _function(unit: Function) -> str:
    name, arguments = unit.name, "".join(f", {_number(value)}" for value in pins(unit).values())
    return (
        f"static __typeof__({name.upper()}) *volatile body_{name} = {name.upper()};\n"
        f"static void run_{name}(void) {{ (void)body_{name}(1, NULL{arguments}); }}\n"
        f"static void start_{name}(void) {{}}\n"
    )


def _given(place: str, value: Pin) -> str:
    if isinstance(value, dict):
        return "".join(f"    {place}.{field.upper()} = {number};\n" for field, number in value.items())
    if isinstance(value, bytes | list):
        return "".join(f"    {place}.table[{at}] = {number};\n" for at, number in enumerate(value))
    return f"    {place} = {_number(value)};\n"


def _number(value: Pin) -> str:
    return str(int(value) if isinstance(value, bool) else value)
