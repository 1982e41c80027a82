"""The exit status of a judge that is a module: 0 nothing is wrong, 1 found, 2 it could not judge."""

import traceback
from collections.abc import Callable

from structured_text.engines.engine import EngineError


def ended(found: Callable[[], bool]) -> int:
    """The status of a judge; blocks that an engine refuses are found."""
    try:
        return int(found())
    except EngineError:
        return 1
    except Exception:
        traceback.print_exc()
        return 2
