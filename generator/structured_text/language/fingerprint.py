"""What a body says, apart from how it is laid out: its tokens, and a short hash of them.

Words are in upper case, comments and white space are gone, literals are as written. Every form in which a block is
handed out has the same tokens, so that the hash in its head shows whether a copy is whole.
"""

import hashlib
import re
from collections.abc import Sequence

from structured_text.language.lexer import END, tokenize
from structured_text.language.reserved import KEYWORDS

_LAST_VAR = re.compile(r".*^[ \t]*END_VAR\b", re.DOTALL | re.MULTILINE | re.IGNORECASE)
_CLOSE = re.compile(r"^[ \t]*(?:END_FUNCTION_BLOCK|END_FUNCTION|END_PROGRAM)\b", re.MULTILINE | re.IGNORECASE)


def body(text: str) -> str:
    """What is between the last END_VAR of a function, block or program and its end; empty for a type."""
    close = _CLOSE.search(text)
    if close is None:
        return ""
    declared = _LAST_VAR.match(text, 0, close.start())
    return text[declared.end() : close.start()] if declared else ""


def stream(text: str) -> tuple[str, ...]:
    """The tokens of a body: `Speed := 16#ff;` -> (`SPEED`, `:=`, `16#ff`, `;`)."""
    tokens = tokenize(text)
    words = zip(tokens.kinds, tokens.texts, strict=True)
    return tuple(word.upper() if kind == "name" or kind in KEYWORDS else word for kind, word in words if kind != END)


def fingerprint(tokens: Sequence[str]) -> str:
    """Eight hexadecimal digits: the beginning of the SHA-256 of the tokens, one to a line, in UTF-8."""
    return hashlib.sha256("\n".join(tokens).encode("utf-8")).hexdigest()[:8].upper()
