"""Which names a portable source must not use, and why."""

import re
from collections.abc import Iterable
from functools import lru_cache

from structured_text.language.reserved import (
    C_MACROS,
    ELEMENTARY_NAMES,
    KEYWORDS,
    LIBRARY_VARIABLES,
    OTHER_KEYWORDS,
    STANDARD_NAMES,
    TARGET_WORDS,
)
from structured_text.language.standard import BLOCKS, FUNCTIONS, conversion_of

# Limits of C's own types, which its headers define in many spellings.
_C_LIMIT = re.compile(
    r"(U?INT(8|16|32|64|MAX|PTR|_FAST\d+|_LEAST\d+)?|S?CHAR|UCHAR|U?SHRT|U?LONG|U?LLONG|SIZE|SSIZE|PTRDIFF|WCHAR|"
    r"WINT|SIG_ATOMIC)_(MIN|MAX)|(DBL|FLT|LDBL)_[A-Z0-9_]+|FP_[A-Z]+|M_[A-Z0-9_]+|CLOCK_[A-Z_]+|SEEK_[A-Z]+"
)


@lru_cache(maxsize=4096)
def reserved(name: str) -> str | None:
    """Why a name is reserved somewhere, or None."""
    upper = name.upper()
    if upper in KEYWORDS or upper in OTHER_KEYWORDS:
        return "a keyword"
    if upper in ELEMENTARY_NAMES:
        return "the name of a type"
    if upper in FUNCTIONS or upper in STANDARD_NAMES or conversion_of(upper):
        return "the name of a standard function"
    if upper in BLOCKS:
        return "the name of a standard block"
    if upper in C_MACROS or _C_LIMIT.fullmatch(upper):
        return "a macro of the C that matiec writes"
    return None


def reserved_outside(name: str) -> str | None:
    """Why a type, function, block or program cannot have a name, or None."""
    if name.upper() in LIBRARY_VARIABLES:
        return "the name of a variable in matiec's own library"
    return reserved(name)


def kept(name: str, targets: Iterable[str]) -> list[str]:
    """Those of some targets that keep a name for themselves."""
    return [target for target in targets if name.upper() in TARGET_WORDS[target]]


def badly_underscored(name: str) -> bool:
    """Whether a name has the underscores on which matiec crashes."""
    return "__" in name or name.endswith("_")
