"""A reader of SCL and PLC data types, for what the library uses of them. It shares nothing with what writes them.

It is stricter than TIA Portal where that would guess: every name must be declared above, a local has its `#`, a block
or type its quotes, each parameter of a call is named and known, and what an S7 would not set has no initial value.
Tokens are given back as the canonical text has them.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

_TOKEN = re.compile(
    r"""(?P<space>\s+) | (?P<line>//[^\n]*) | (?P<comment>\(\*.*?\*\)) | (?P<pragma>\{[^}\n]*\})
    | (?P<string>'(?:\$.|[^$'\n])*') | (?P<quoted>"[^"\n]+") | (?P<local>\#(?:[A-Za-z_]\w*|"[^"\n]+"))
    | (?P<literal>[A-Za-z]+\#[-\w#.]+ | \d[\d_]*\#\w+ | \d+\.\d+(?:E[+-]?\d+)? | \d+(?!\w))
    | (?P<word>[A-Za-z_]\w*) | (?P<sign>:=|=>|<=|>=|<>|\.\.|[-+*/=<>()\[\],;:.])""",
    re.VERBOSE | re.DOTALL,
)


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_TYPES = _words("BOOL BYTE WORD DWORD SINT INT DINT USINT UINT UDINT REAL LREAL TIME STRING PORT")
_KEYWORDS = _words("IF THEN ELSIF ELSE END_IF CASE OF END_CASE WHILE DO END_WHILE AND OR XOR NOT MOD TRUE FALSE")
_RESERVED = _KEYWORDS | _TYPES | _words("VERSION NAME TITLE TYPE BEGIN STRUCT ARRAY REGION RETURN EXIT FOR REPEAT")
_OPERATORS = _words("OR XOR AND = <> < > <= >= + - * / MOD")
_STANDARD = {"SHR": ["IN", "N"], "SHL": ["IN", "N"], "MAX": ["IN1", "IN2"], "MIN": ["IN1", "IN2"]}
_PLAIN = re.compile(r"RUNTIME|ABS|(?!REAL_TO_D?WORD)[A-Z]+_TO_[A-Z]+")
"""Standard functions of one parameter without a name."""
_SECTIONS = {
    "TYPE": ("STRUCT",),
    "FUNCTION": ("VAR_INPUT", "VAR_TEMP", "VAR CONSTANT"),
    "FUNCTION_BLOCK": ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR", "VAR RETAIN", "VAR CONSTANT"),
}
_SYSTEM = {
    "SEND_P2P": "REQ:BOOL PORT:PORT BUFFER:* LENGTH:UINT DONE:BOOL ERROR:BOOL STATUS:WORD",
    "RECEIVE_P2P": "PORT:PORT BUFFER:* NDR:BOOL ERROR:BOOL STATUS:WORD LENGTH:UINT",
    "RECEIVE_RESET": "REQ:BOOL PORT:PORT DONE:BOOL ERROR:BOOL STATUS:WORD",
    "MODBUS_COMM_LOAD": "REQ:BOOL PORT:PORT BAUD:UDINT PARITY:UINT RESP_TO:UINT MB_DB:* DONE:BOOL ERROR:BOOL "
    "STATUS:WORD MODE:USINT RETRIES:UINT",
    "TON_TIME": "IN:BOOL PT:TIME Q:BOOL ET:TIME",
    "MODBUS_MASTER": "REQ:BOOL MB_ADDR:UINT MODE:USINT DATA_ADDR:UDINT DATA_LEN:UINT DATA_PTR:* DONE:BOOL BUSY:BOOL "
    "ERROR:BOOL STATUS:WORD MB_DB:*",
}
"""What Siemens' instructions have, by its manuals; `*` is anything."""


class SclError(Exception):
    """What is wrong, and in which line."""


@dataclass(frozen=True)
class Token:
    """A token: its kind, text and line."""

    kind: str
    text: str
    line: int


@dataclass(frozen=True)
class Variable:
    """A declaration. The type is in upper case, quotes gone; the initial value is its tokens."""

    section: str
    name: str
    type: str
    initial: tuple[str, ...]
    comment: str


@dataclass
class Block:
    """A type, function or function block as read; `above` are the lines of comment in front of it."""

    kind: str
    name: str
    above: list[str] = field(default_factory=list)
    returns: str = ""
    head: list[str] = field(default_factory=list)
    variables: list[Variable] = field(default_factory=list)
    tokens: list[str] = field(default_factory=list)
    comments: list[str] = field(default_factory=list)

    def variable(self, name: str) -> Variable | None:
        """The variable of a name."""
        return next((one for one in self.variables if one.name.upper() == name.upper()), None)


@dataclass
class _Call:
    """What is called, and the parameters so far; without a name these are parentheses."""

    name: str
    given: list[str] = field(default_factory=list)


def read(text: str, known: dict[str, Block]) -> list[Block]:
    """The blocks of a file, each entered into `known`. Raises SclError at the first mistake."""
    if not text.startswith("\ufeff") or re.search(r"[^\r]\n|\r[^\n]", text):
        raise SclError("line 1: expected a byte order mark, and CR LF at the end of each line")
    return list(_Reader(text[1:].replace("\r\n", "\n"), known).blocks())


def _tokens(text: str) -> Iterator[Token]:
    at, line = 0, 1
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise SclError(f"line {line}: no token of SCL: {text[at : at + 20]!r}")
        kind = match.lastgroup or ""
        if kind == "comment" and "(*" in match[0][2:]:
            raise SclError(f"line {line}: a comment in a comment, which SCL nests")
        if kind != "space":
            yield Token(kind, match[0], line)
        line += match[0].count("\n")
        at = match.end()
    yield Token("end", "end of file", line)


class _Reader:
    """Goes over the tokens of one file."""

    def __init__(self, text: str, known: dict[str, Block]) -> None:
        self.all = list(_tokens(text))
        self.known, self.i = known, 0
        self.block, self.called = Block("", ""), ""

    def fail(self, wanted: str) -> SclError:
        """What was wanted where the reader stands."""
        return SclError(f"line {self.next.line}: expected {wanted}, found {self.next.text}")

    def skip(self, *kinds: str) -> list[str]:
        """Pass comments; their texts."""
        found = []
        while self.all[self.i].kind in kinds:
            found.append(self.all[self.i].text)
            self.i += 1
        return found

    @property
    def next(self) -> Token:
        """The next token that is no comment."""
        at = self.i
        while self.all[at].kind in ("line", "comment"):
            at += 1
        return self.all[at]

    def take(self, *wanted: str, kind: str = "") -> str:
        """The next token, which must be one of these words or of this kind; comments before it belong to the body."""
        self.block.comments += [" ".join(each.strip("(*)").split()) for each in self.skip("line", "comment")]
        token = self.all[self.i]
        if (kind and token.kind != kind) or (wanted and token.text.upper() not in wanted):
            raise self.fail(kind or " or ".join(wanted))
        self.i += 1
        return token.text

    def put(self, *wanted: str, kind: str = "") -> str:
        """Take a token into the body."""
        text = self.take(*wanted, kind=kind)
        plain = text.removeprefix("#").strip('"')
        self.block.tokens.append(text if text[0] in "'" or plain[:1].isdigit() or "#" in plain else plain.upper())
        return text

    def named(self) -> str:
        """The name of a declaration: with quotes where SCL reserves it."""
        if self.next.kind not in ("word", "quoted") or (self.next.kind == "word" and self.at(*_RESERVED)):
            raise self.fail("a name, in quotes if SCL reserves it")
        return self.take().strip('"').upper()

    def at(self, *words: str) -> bool:
        """Whether one of these words comes next."""
        return self.next.text.upper() in words

    def blocks(self) -> Iterator[Block]:
        """Each block of the file."""
        while self.next.kind != "end":
            above = self.skip("line")
            kind = self.take("TYPE", "FUNCTION", "FUNCTION_BLOCK").upper()
            self.block = Block(kind, self.take(kind="quoted").strip('"'), above)
            if self.block.name.upper() in self.known:
                raise self.fail("another name than that of a block above")
            self.opening(kind)
            self.known[self.block.name.upper()] = self.block
            yield self.block

    def opening(self, kind: str) -> None:
        """From the name of a block to its end."""
        if kind == "FUNCTION":
            self.take(":")
            self.block.returns = self.type()
        access = self.take(kind="pragma") if kind != "TYPE" else ""
        self.take("VERSION")
        self.take(":")
        self.take(kind="literal")
        self.block.head = [each.removeprefix("//").removeprefix(" ") for each in self.skip("line")]
        while self.at("STRUCT" if kind == "TYPE" else "VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP"):
            self.section(kind)
        owns = any(one.type.upper() == "MODBUS_MASTER" for one in self.block.variables)
        if access and access != f"{{ S7_Optimized_Access := '{'FALSE' if owns else 'TRUE'}' }}":
            raise self.fail("optimized access, but for what hands memory to Modbus_Master")
        if kind == "TYPE":
            if not self.block.variables:
                raise self.fail("STRUCT, since nothing else has a type of its own")
        else:
            self.take("BEGIN")
            self.block.comments.clear()
            self.body(f"END_{kind}")
        self.take(f"END_{kind}")

    def section(self, kind: str) -> None:
        """One section of declarations."""
        name = self.take().upper()
        if name == "VAR" and (self.at("CONSTANT") or self.at("RETAIN")):
            name = f"VAR {self.take()}".upper()
        if name not in _SECTIONS[kind] or any(one.section == name for one in self.block.variables):
            raise self.fail(f"no {name} here")
        end = "END_STRUCT" if kind == "TYPE" else "END_VAR"
        while not self.at(end):
            self.variable(name)
        self.take(end)
        if kind == "TYPE":
            self.take(";")

    def variable(self, section: str) -> None:
        """One declaration with the comment after it."""
        written = self.next.text.strip('"')
        name = self.named()
        if self.block.variable(name):
            raise self.fail("a name that is not taken")
        self.take(":")
        kind = self.type()
        initial = self.initial() if self.at(":=") else ()
        if section == "VAR CONSTANT" and (kind.startswith("ARRAY") or not initial):
            raise self.fail("a constant of an elementary type with a value")
        plain = section != "VAR CONSTANT" and self.block.kind == "FUNCTION"
        if initial and (section in ("VAR_TEMP", "VAR_IN_OUT") or plain):
            raise self.fail("no initial value, which nobody would set")
        line = self.next.line
        self.take(";")
        beside = self.all[self.i]
        said = beside.text if beside.kind == "line" and beside.line == line else ""
        self.i += bool(said)
        self.block.variables.append(
            Variable(section, written, kind, initial, " ".join(said.removeprefix("//").split()))
        )

    def type(self) -> str:
        """A type: elementary, in quotes, or an array of one."""
        if self.at("ARRAY"):
            self.take()
            self.take("[")
            bounds = "".join(self.take() for _ in range(3))
            self.take("]")
            self.take("OF")
            if self.at("ARRAY"):
                raise self.fail("no array of arrays")
            return f"ARRAY[{bounds}] OF {self.type()}"
        if self.next.kind == "quoted":
            name = self.take().strip('"').upper()
            if name not in self.known:
                raise self.fail(f"{name} above its use")
            return name
        name = self.take(kind="word").upper()
        if name not in _TYPES | _SYSTEM.keys():
            raise SclError(f"line {self.next.line}: {name} is no type of an S7; a type of ours has quotes")
        return name

    def initial(self) -> tuple[str, ...]:
        """The tokens of an initial value: a literal, or literals in brackets."""
        self.take(":=")
        made = [self.take()]
        while made[0] == "[" and made[-1] != "]":
            made.append(self.take())
        return tuple(made)

    def body(self, end: str) -> None:
        """Tokens up to the end, each in its form; that they are those of the canonical text, a check sees."""
        self.calls, before = list[_Call](), ""
        while not self.at(end):
            token = self.next
            if token.kind == "local":
                self.local(token)
            elif token.kind == "quoted" and before != "." and not self.parameter(token):
                self.known_call(token)
            elif token.kind == "word" and before != "." and not self.parameter(token):
                self.word(token)
            elif token.kind == "word" and before == "." and self.at(*_RESERVED):
                raise self.fail("a member, in quotes if SCL reserves it")
            elif token.kind == "sign":
                self.sign(token)
            elif token.kind in ("line", "pragma", "end"):
                raise self.fail("a part of a statement")
            before = token.text
            if self.next is token:
                self.put()

    def after(self) -> str:
        """The token after the next one."""
        return next(each.text for each in self.all[self.all.index(self.next, self.i) + 1 :] if each.kind != "comment")

    def local(self, token: Token) -> None:
        """A variable of this block, or its result."""
        name = token.text.removeprefix("#")
        if name.upper() in _RESERVED:
            raise self.fail(f"quotes around {name}")
        found = self.block.variable(name.strip('"'))
        if not found and name.upper() != self.block.name.upper():
            raise self.fail(f"{name} among the declarations")
        self.called = found.type if found else ""

    def known_call(self, token: Token) -> None:
        """A function, which is declared above."""
        self.called = token.text.strip('"').upper()
        if self.called not in self.known or self.after() != "(":
            raise self.fail(f"a call of {self.called}, above its use")

    def word(self, token: Token) -> None:
        """A keyword, or a standard function, whose parameters have names that the canonical text lacks."""
        name = token.text.upper()
        if name not in _KEYWORDS | _OPERATORS:
            if self.after() != "(" or not (name in _STANDARD or _PLAIN.fullmatch(name)):
                raise self.fail(f"quotes or # around {name}, or a function of SCL instead of it")
            self.called = name

    def parameter(self, token: Token) -> bool:
        """Whether the next token is the name of a parameter; it is passed over where the canonical text has none."""
        if not self.calls or self.after() not in (":=", "=>"):
            return False
        call, name = self.calls[-1], token.text.strip('"').upper()
        if token.kind == "word" and name in _RESERVED and call.name not in _SYSTEM:
            raise self.fail("a parameter, in quotes if SCL reserves it")
        call.given.append(name)
        if call.name in _STANDARD:
            self.take()
            self.take(":=")
        return True

    def sign(self, token: Token) -> None:
        """Parentheses open and end calls; of a function and a block each parameter is named, known and given once."""
        if token.text == "(":
            self.calls.append(_Call(self.called))
        elif token.text == ")":
            self.judge(self.calls.pop())
        self.called = ""

    def judge(self, call: "_Call") -> None:
        """Whether a call has the parameters that it must have."""
        block, given = self.known.get(call.name), call.given
        wanted = allowed = _STANDARD.get(call.name, [])
        if call.name in _STANDARD and given != wanted:
            raise self.fail(f"the parameters of {call.name} in their order")
        if call.name in _SYSTEM:
            allowed = [each.partition(":")[0] for each in _SYSTEM[call.name].split()]
        elif block:
            must = ("VAR_INPUT", "VAR_IN_OUT") if block.kind == "FUNCTION" else ("VAR_IN_OUT",)
            wanted = [one.name.upper() for one in block.variables if one.section in must]
            allowed = [one.name.upper() for one in block.variables]
        if set(wanted) - set(given) or set(given) - set(allowed) or len(set(given)) < len(given):
            raise self.fail(f"the parameters of {call.name}, each once")
