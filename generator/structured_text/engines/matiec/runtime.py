"""The C file of our own that makes a library out of what iec2c wrote: ways in, and a table of sizes and offsets."""

from collections.abc import Iterable, Mapping
from importlib.resources import files

from structured_text.engines.matiec.header import ConfigurationC, Function

UNIT = "driveblocks_unit.c"
# Each Resource.c includes POUS.c; the text moves, so that it is compiled once however many resources there are.
POUS_MOVED = "driveblocks_pous.c"

_OURS = files("structured_text.engines.matiec")
UNIT_TEXT = (_OURS / "unit.h").read_text(encoding="utf-8")


def unit(
    blocks: Iterable[str],
    functions: Iterable[Function],
    expressions: Iterable[str],
    configuration: ConfigurationC,
    locations: Mapping[str, str],
) -> str:
    """Write the C file. `expressions` go into the table `dbk_sizes`, in order."""
    lines = ["#include <stddef.h>", '#include "iec_std_lib.h"', '#include "accessor.h"', '#include "POUS.h"', UNIT_TEXT]
    lines += [f"static {kind} {name}_place; {kind} *{name} = &{name}_place;" for name, kind in locations.items()]
    lines += [f"extern {kind} *__GET_GLOBAL_{name}(void);" for name, kind in configuration.globals.items()]
    lines += [f'#include "{POUS_MOVED}"', *(f"DBK_BLOCK({name})" for name in blocks)]
    lines += [_call(function) for function in functions]
    table = ", ".join(expressions) or "0"
    return "\n".join([*lines, f"const int64_t dbk_sizes[] = {{{table}}};", ""])


def _call(function: Function) -> str:
    """A way in to a function: its arguments in the order of the C call, after EN and ENO."""
    arguments = ["1", "NULL"]
    for place, (type_name, _, by_pointer) in enumerate(function.parameters, start=1):
        arguments.append(f"{'' if by_pointer else '*'}({type_name} *)cells[{place}]")
    return f"DBK_FUNCTION({function.name}, {function.result}, {', '.join(arguments)})"
