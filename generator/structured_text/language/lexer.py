"""Text -> tokens, by one compiled expression. Comments and pragmas are kept beside the tokens, with their places."""

import re
from dataclasses import dataclass, field

from structured_text.language.reserved import KEYWORDS
from structured_text.language.tree import Comment

# A comment of a form that the second edition has; `(*` inside it is checked afterwards. Possessive: never quadratic.
_COMMENT = r"\(\*[^*]*+\*++(?:[^)*][^*]*+\*++)*+\)"
_DATE = r"\d{4}-\d\d?-\d\d?(?:-\d\d?:\d\d?(?::[\d.]+)?)?|\d\d?:\d\d?(?::\d+(?:\.\d+)?)?"
_TYPED_NUMBER = r"[+-]?(?:\d[\d_]*\#\w+|\d[\d_]*(?:\.\d[\d_]*)?[eE][+-]?\d+(?!\w)|\w+(?:\.\d\w*)*)"
_QUOTED = r"'[^'$\n]*+(?:\$[^\n][^'$\n]*+)*+'"
_WIDE_QUOTED = r'"[^"$\n]*+(?:\$[^\n][^"$\n]*+)*+"'

_PATTERN = re.compile(
    rf"""(?:
      ( [^\W\d]\w*+(?!\#) | :=? | ; | , | \((?!\*) | \) | =>? | \[ | \] | <[=>]? | >=? | \.\.?
        | \+ | - | \*\*? | /(?![/*]) | & | \^ )                               # 1 words and operators
    | ( 0[xX][0-9a-fA-F]+ | \d[\d_]*(?:\#\w+ | (?:\.\d[\d_]*)?(?:[eE][+-]?\d+)?(?!\w)) )   # 2 numbers
    | ( {_COMMENT} | //[^\n]* | /\*(?:[^*]|\*(?!/))*+\*/ | \{{[^}}]*+\}} )    # 3 comments and pragmas
    | ( [^\W\d]\w*+\#(?:{_DATE}|{_TYPED_NUMBER}|{_QUOTED}|{_WIDE_QUOTED}) )   # 4 typed literals, T#1s, E#V
    | ( {_QUOTED} )                                                           # 5 strings
    | ( {_WIDE_QUOTED} )                                                      # 6 wide strings
    | ( %[A-Za-z]*(?:\d+(?:\.\d+)*|\*)? )                                     # 7 direct addresses
    | ( \ufeff )                                                              # 8 byte order mark
    | ( [^\s] )                                                               # 9 anything else
    )\s*+""",
    re.VERBOSE,
)
_SPACE = re.compile(r"\s*+")
_NUMBER_LIKE = re.compile(r"\d[\w#.]*")
_COMMENT_MARK = re.compile(r"\(\*|\*\)")
_LITERAL_KINDS = {2: "number", 4: "typed", 5: "string", 6: "wstring", 7: "direct"}
# After this number a file is no Structured Text, and more of them help nobody.
MOST_PROBLEMS = 50
# An end of file that is never reached by accident: every list of tokens ends with it.
END = "end of file"
# Enough of them for a parser to look ahead without asking whether there is anything.
LOOKAHEAD = 4


class _Kinds(dict[str, str]):
    """Spelling -> kind: a keyword in upper case, `name`, or the operator itself. Fills itself."""

    def __missing__(self, text: str) -> str:
        """Classify a spelling that was not seen before."""
        upper = text.upper()
        kind = upper if upper in KEYWORDS or not (text[0].isalpha() or text[0] == "_") else "name"
        self[text] = kind
        return kind


@dataclass(slots=True)
class Tokens:
    """Parallel lists of kind, text and offset; the last `LOOKAHEAD` are `END`.

    `before` gives the comments in front of a token by its index. `problems` are (offset, text) of what is no token.
    `unpaired`: the marks of nested comments do not pair, so that comments are taken as not nesting.
    """

    kinds: list[str] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)
    ats: list[int] = field(default_factory=list)
    comments: list[Comment] = field(default_factory=list)
    before: dict[int, list[Comment]] = field(default_factory=dict)
    problems: list[tuple[int, str]] = field(default_factory=list)
    notes: list[tuple[str, int]] = field(default_factory=list)
    unpaired: bool = False


def tokenize(text: str) -> Tokens:
    """Split a whole file. Never raises: what is no token is skipped and listed in `problems`."""
    tokens = Tokens()
    here: int | None = _skip_space(text, 0)
    while here is not None:
        here = _run(text, here, tokens)
    tokens.kinds.extend([END] * LOOKAHEAD)
    tokens.texts.extend([""] * LOOKAHEAD)
    tokens.ats.extend([len(text)] * LOOKAHEAD)
    return tokens


def _run(text: str, start: int, tokens: Tokens) -> int | None:
    """Take tokens until the end (None), or until something needs a jump (the offset where to go on)."""
    kinds, texts, ats, kind_of = tokens.kinds, tokens.texts, tokens.ats, _Kinds()
    add_kind, add_text, add_at = kinds.append, texts.append, ats.append
    for match in _PATTERN.finditer(text, start):
        group = match.lastindex or 9
        word = match[group]
        if group == 1:
            add_kind(kind_of[word])
        elif group in _LITERAL_KINDS:
            add_kind(_LITERAL_KINDS[group])
        else:
            jump = _other(text, group, match.start(), word, tokens)
            if jump is not None:
                return jump
            continue
        add_text(word)
        add_at(match.start())
    return None


def _other(text: str, group: int, at: int, word: str, tokens: Tokens) -> int | None:
    """Keep a comment or report a character that is no token; the offset to continue at, if not right after it."""
    if group == 3:
        return _comment(text, at, word, tokens)
    if group == 8:
        tokens.notes.append(("byte-order-mark", at))
        return None
    if len(tokens.problems) >= MOST_PROBLEMS:
        return len(text)
    return _stray(text, at, word, tokens)


def _stray(text: str, at: int, word: str, tokens: Tokens) -> int | None:
    """Say what is wrong with a character that starts no token, and where to go on."""
    if text.startswith(("(*", "/*", "{"), at):
        tokens.problems.append((at, "expected the end of this comment, found the end of the file"))
        return len(text)
    if word in "'\"":
        found = "expected the closing {} of this string on the same line, found the end of the line"
        tokens.problems.append((at, found.format(word)))
        return _line_end(text, at)
    run = _NUMBER_LIKE.match(text, at)
    if run:
        tokens.problems.append((at, f"expected a number, found {run.group()[:40]}"))
        return _skip_space(text, run.end())
    shown = word if word.isprintable() else f"the character U+{ord(word):04X}"
    tokens.problems.append((at, f"expected Structured Text, found {shown}"))
    return None


def _skip_space(text: str, at: int) -> int:
    """The offset of the next character that is no white space."""
    match = _SPACE.match(text, at)
    return match.end() if match else at


def _line_end(text: str, at: int) -> int:
    """The offset of the end of the line, or of the file."""
    end = text.find("\n", at)
    return len(text) if end < 0 else end + 1


def _comment(text: str, at: int, word: str, tokens: Tokens) -> int | None:
    """Keep a comment; one that holds `(*` is followed through its nesting if that closes."""
    end = at + len(word)
    style = "{" if word[0] == "{" else word[:2]
    jump = None
    if style == "(*" and "(*" in word[2:]:
        tokens.notes.append(("nested-comment", at))
        jump = end = end if tokens.unpaired else _nested_end(text, at, tokens) or end
    inner = text[at + len(style) : end if style == "//" else end - len(style)]
    comment = Comment(at, end, inner.strip(), style, _own_line(text, at, tokens))
    tokens.comments.append(comment)
    tokens.before.setdefault(len(tokens.kinds), []).append(comment)
    return None if jump is None else _skip_space(text, jump)


def _own_line(text: str, at: int, tokens: Tokens) -> bool:
    """Whether the last token or comment before a comment ends on an earlier line."""
    behind = tokens.ats[-1] + len(tokens.texts[-1]) if tokens.ats else 0
    if tokens.comments:
        behind = max(behind, tokens.comments[-1].end)
    return behind == 0 or "\n" in text[behind:at]


def _nested_end(text: str, at: int, tokens: Tokens) -> int | None:
    """Where a nested comment ends; None if its inner marks do not pair up to the end of the file."""
    depth = 0
    for mark in _COMMENT_MARK.finditer(text, at):
        depth += 1 if mark.group() == "(*" else -1
        if depth == 0:
            return mark.end()
    tokens.unpaired = True
    return None
