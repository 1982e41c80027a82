"""ASCII frames as characters: `:010320000001DB`, with CR and LF as they come or spelled out, or left out."""

import re

_SPELLED = {
    "\r": re.compile(r"<CR>|\[CR\]|\{CR\}|\\r|\\x0d|<0D>|\[0D\]|\$R|\$0D|␍|\^M|(?<=[0-9A-F\s])CR(?![0-9A-Z])", re.I),
    "\n": re.compile(r"<LF>|\[LF\]|\{LF\}|\\n|\\x0a|<0A>|\[0A\]|\$L|\$0A|␊|\^J|(?<=[\r\s])LF(?![0-9A-Z])", re.I),
}
_QUOTES = re.compile(r"^\s*b?[\"'`]|[\"'`][;,\s]*$")
_START = re.compile(r"b?[\"'`]?\s*:")

NOT_SHOWN = "CR and LF at the end are not in the text; they are taken as sent"
BLANKS = "blanks between the characters are left out"

Lines = list[tuple[int, str]]


def fits(lines: list[str]) -> bool:
    """Whether the lines are characters of ASCII frames, and not bytes with colons between them."""
    pieces = [piece.strip() for piece in _bare(lines[0]).strip().split(":")]
    if _START.match(lines[0].lstrip()) is None:
        return False
    return len(pieces) == 2 or any(len(piece) > 2 for piece in pieces[1:])


def read(lines: Lines) -> tuple[bytes, tuple[str, ...]]:
    """The characters as bytes, and what was understood on the way."""
    notes: list[str] = []
    frames = [_frame(piece, notes) for _, line in lines for piece in _pieces(_bare(line))]
    data = "".join(frames).encode("latin-1", "replace")
    return data, tuple(dict.fromkeys(notes))


def _bare(line: str) -> str:
    return _QUOTES.sub("", _QUOTES.sub("", line))


def _pieces(line: str) -> list[str]:
    """The frames of a line: each begins with a colon; whatever comes before the first is kept."""
    return [piece for piece in re.split(r"(?=:)", line) if piece.strip()]


def _frame(piece: str, notes: list[str]) -> str:
    """One frame as it was sent; line ends that are not spelled out are those of the text, not of the frame."""
    text = piece.rstrip("\r\n \t")
    for sign, spelled in _SPELLED.items():
        text = spelled.sub(sign, text)
    ends = "".join(sign for sign in text if sign in "\r\n")
    digits = "".join(sign for sign in text if sign not in "\r\n")
    if re.search(r"\s", digits.strip()):
        notes.append(BLANKS)
    if not ends:
        notes.append(NOT_SHOWN)
    return re.sub(r"\s", "", digits) + (ends or "\r\n")
