"""A second model by the name of its family."""

from typing import Any

from tests.second.atv312 import Atv312, Atv312Options
from tests.second.chf import Chf, ChfOptions
from tests.second.drive import Drive
from tests.second.gd200a import Gd200a, Gd200aOptions
from tests.second.jscc import Jscc, JsccOptions
from tests.second.mx2 import Mx2, Mx2Options
from tests.second.pf4 import LaterOptions, Pf4, Pf4m, Pf4Options, Pf40p, Pf400, Pf525
from tests.second.profiles import V20, Acs355, ProfileOptions
from tests.second.sn300g5 import Sn300g5, Sn300g5Options

KINDS: dict[str, tuple[Any, Any]] = {
    "sn": (Sn300g5, Sn300g5Options), "jscc": (Jscc, JsccOptions), "chf": (Chf, ChfOptions),
    "atv": (Atv312, Atv312Options), "mx": (Mx2, Mx2Options),
    "pf": (Pf4, Pf4Options), "gd": (Gd200a, Gd200aOptions), "pf40p": (Pf40p, LaterOptions),
    "pf4m": (Pf4m, LaterOptions), "pf400": (Pf400, LaterOptions), "pf525": (Pf525, LaterOptions),
    "v20": (V20, ProfileOptions), "acs355": (Acs355, ProfileOptions),
}  # fmt: skip


def drive(kind: str, unit: int = 1, **given: Any) -> Drive:
    """A drive of a family with options, and settings in `settings`."""
    settings = given.pop("settings", {})
    made, options = KINDS[kind]
    found: Drive = made(unit, options(**given), **settings)
    return found
