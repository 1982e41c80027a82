"""The C file of our own that makes a library out of what iec2c wrote: ways in, and a table of sizes and offsets."""

from collections.abc import Iterable, Iterator, Mapping
from importlib.resources import files

from structured_text.engines.matiec.header import ConfigurationC, Function, Storage

UNIT = "driveblocks_unit.c"
# Each Resource.c includes POUS.c; the text moves, so that it is compiled once however many resources there are.
POUS_MOVED = "driveblocks_pous.c"

_OURS = files("structured_text.engines.matiec")
UNIT_TEXT = (_OURS / "unit.h").read_text(encoding="utf-8")

# How the C declares a variable; `{0}` is the type, `{1}` the name.
_DECLARED = {
    Storage.VALUE: "extern __IEC_{0}_t {1};",
    Storage.LOCATED: "extern __IEC_{0}_p {1};",
    Storage.BLOCK: "extern {0} {1};",
}
_ADDRESS = {Storage.VALUE: "&{0}.value", Storage.LOCATED: "&{0}.value", Storage.BLOCK: "&{0}"}


def unit(
    blocks: Iterable[str],
    functions: Iterable[Function],
    expressions: Iterable[str],
    configuration: ConfigurationC | None,
    locations: Mapping[str, str],
) -> str:
    """Write the C file. `expressions` go into the table `dbk_sizes`, in order."""
    lines = ["#include <stddef.h>", '#include "iec_std_lib.h"', '#include "accessor.h"', '#include "POUS.h"', UNIT_TEXT]
    lines += [f"static {kind} {name}_place; {kind} *{name} = &{name}_place;" for name, kind in locations.items()]
    if configuration is not None:
        lines += [f"extern {each.type} *__GET_GLOBAL_{each.name}(void);" for each in configuration.globals]
    lines += [f'#include "{POUS_MOVED}"', *(f"DBK_BLOCK({name})" for name in blocks)]
    lines += [_call(function) for function in functions]
    if configuration is not None:
        lines += [*_places(configuration), "DBK_CONFIGURATION"]
    table = ", ".join(expressions) or "0"
    return "\n".join([*lines, f"const int64_t dbk_sizes[] = {{{table}}};", ""])


def _call(function: Function) -> str:
    """A way in to a function: its arguments in the order of the C call, after EN and ENO."""
    arguments = ["1", "NULL"]
    for place, (type_name, _, by_pointer) in enumerate(function.parameters, start=1):
        arguments.append(f"{'' if by_pointer else '*'}({type_name} *)cells[{place}]")
    return f"DBK_FUNCTION({function.name}, {function.result}, {', '.join(arguments)})"


def _places(configuration: ConfigurationC) -> Iterator[str]:
    """Declare what the CONFIGURATION holds, and the table of its addresses: globals, then programs."""
    addresses = []
    for each in configuration.globals:
        name = f"{each.owner}__{each.name}"
        yield _DECLARED[each.storage].format(each.type, name)
        addresses.append(_ADDRESS[each.storage].format(name))
    for owner, name, type_name in configuration.programs:
        yield f"extern {type_name} {owner}__{name};"
        addresses.append(f"&{owner}__{name}")
    yield f"void *const dbk_places[] = {{{', '.join(addresses) or 'NULL'}}};"
