"""Load files, each in a process of its own with little memory, and print what became of each.

Arguments: bytes, paths. Prints one line of JSON for each path: its name, the messages, and the traceback of what
should not have happened. A loader that wants more than its bytes beyond what the process has ends in a MemoryError.
"""

import json
import os
import resource
import sys
import traceback
from pathlib import Path

from driveblocks.maps import load
from driveblocks.maps.problem import MapError


def probe(path: Path) -> dict[str, object]:
    """Load `path`; return what became of it."""
    messages: list[str] = []
    trace = ""
    try:
        load.load(path)
    except MapError as error:
        messages = [str(problem) for problem in error.problems]
    except BaseException:
        trace = traceback.format_exc()
    return {"name": path.name, "messages": messages, "trace": trace}


def _limit(most: int) -> None:
    """Bound the address space, where the system says how much is in use."""
    usage = Path("/proc/self/statm")
    if usage.exists():
        most += int(usage.read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def main(most: int, paths: list[str]) -> None:
    """Probe each path in a child, so that none can spend what another saved."""
    for path in paths:
        child = os.fork()
        if child == 0:
            _limit(most)
            print(json.dumps(probe(Path(path))), flush=True)
            os._exit(0)
        os.waitpid(child, 0)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:])
