"""Changes of one token or fact, drawn by a seed: of Python, of templates of blocks, of maps."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from io import StringIO
from itertools import islice
from pathlib import Path
from random import Random
from tokenize import NAME, NUMBER, OP, generate_tokens

from tests.maps import mutate
from tests.planted.checkout import ROOT

KINDS = ("python", "template", "map")
PYTHON = {
    "and": "or", "or": "and", "True": "False", "False": "True", "not": "", "<": "<=", "<=": "<", ">": ">=",
    ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "min": "max", "max": "min", "any": "all", "all": "any",
}  # fmt: skip
ST = {
    "AND": "OR", "OR": "AND", "TRUE": "FALSE", "FALSE": "TRUE", "NOT": "", "<": "<=", "<=": "<", ">": ">=",
    ">=": ">", "=": "<>", "<>": "=", "+": "-", "-": "+", "MAX": "MIN", "MIN": "MAX",
}  # fmt: skip
_TOKEN = re.compile(r":=|=>|<=|>=|<>|==|!=|[<>=+-]|\b\w+#\w+\b|\b[A-Za-z_]\w*\b|\b\d+\b")
_QUIET = re.compile(r"\(\*.*?\*\)|\{#.*?#\}|'[^'\n]*'|\"[^\"\n]*\"", re.DOTALL)
_TAG = re.compile(r"\{[%{]-?|-?[%}]\}")


@dataclass(frozen=True)
class Change:
    """A change: its file, where in the text, what was there, and what is there now."""

    file: str
    at: int
    old: str
    new: str

    def edit(self, text: str) -> str:
        """The text with the change."""
        return text[: self.at] + self.new + text[self.at + len(self.old) :]

    def says(self, text: str) -> str:
        """The line with the change in it."""
        begin, end = text.rfind("\n", 0, self.at) + 1, text.find("\n", self.at + len(self.old))
        line = f"{text[begin : self.at]}[{self.old} -> {self.new}]{text[self.at + len(self.old) : end]}"
        return " ".join(line.split())


def drawn(kind: str, seed: int, count: int) -> list[Change]:
    """So many changes of a kind, always the same for a seed and a text."""
    chance = Random(f"{seed} {kind}")
    if kind == "map":
        return list(islice(_maps(chance), count))
    every = [one for path in _files(kind) for one in (_python if kind == "python" else _template)(path)]
    chance.shuffle(every)
    return list(islice((one for one in every if kind != "python" or _compiles(one)), count))


def _files(kind: str) -> list[Path]:
    """The files of a kind, in their order; pages are no blocks."""
    folder = ROOT / "generator"
    if kind == "python":
        return sorted([*(folder / "driveblocks").rglob("*.py"), *(folder / "structured_text").rglob("*.py")])
    blocks = (folder / "driveblocks").rglob("*.j2"), (folder / "driveblocks").rglob("*.st")
    return sorted(path for paths in blocks for path in paths if ".md" not in path.name and ".html" not in path.name)


def _text(path: Path) -> str:
    return path.read_bytes().decode()


def _python(path: Path) -> Iterator[Change]:
    text = _text(path)
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    for token in generate_tokens(StringIO(text).readline):
        old = token.string
        whole = token.type == NUMBER and old.isdigit()
        new = str(int(old) + 1) if whole else PYTHON.get(old) if token.type in (NAME, OP) else None
        if new is not None:
            yield Change(str(path.relative_to(ROOT)), starts[token.start[0] - 1] + token.start[1], old, new)


def _template(path: Path) -> Iterator[Change]:
    """Tokens of ST, and those of Jinja within its tags; comments and texts stay."""
    text = _QUIET.sub(lambda each: re.sub(r"[^\n]", " ", each[0]), _text(path))
    tags = list(_TAG.finditer(text))
    plain = _TAG.sub(lambda each: " " * len(each[0]), text)
    for token in _TOKEN.finditer(plain):
        old, at = token[0], token.start()
        inside = sum(tag.start() < at for tag in tags) % 2
        new = str(int(old) + 1) if old.isdigit() else (PYTHON if inside else ST).get(old)
        if new is not None:
            yield Change(str(path.relative_to(ROOT)), at, old, new)


def _maps(chance: Random) -> Iterator[Change]:
    texts = [mutate.Text(path.name, _text(path)) for path in sorted((ROOT / "vendor_maps").glob("*.yaml"))]
    while True:
        text = chance.choice(texts)
        fact = mutate.change_a_fact(text, chance)
        leaf = next(each for each in text.leaves if each.path == fact.path)
        yield Change(f"vendor_maps/{text.name}", text.offset(leaf.scalar), leaf.scalar.text, fact.new)


def _compiles(one: Change) -> bool:
    try:
        compile(one.edit(_text(ROOT / one.file)), one.file, "exec")
    except SyntaxError:
        return False
    return True
