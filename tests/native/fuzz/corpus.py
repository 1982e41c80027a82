"""Inputs of the fuzz targets as text: a line of hexadecimal digits and, after `#`, the ErrorID that it gives and why.

`corpus/` holds what libFuzzer kept as the fewest inputs that reach everything it reached; `regressions/` what once
went wrong, or would have if it had been tried.
"""

import subprocess
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from driveblocks.render.results import RESULTS

HERE = Path(__file__).parent
CORPUS = HERE / "corpus"
REGRESSIONS = HERE / "regressions"
_TEXTS = {each.code: each.en for each in RESULTS}


@dataclass(frozen=True)
class Input:
    """The bytes, the ErrorID of the last block that they reach, and why they are kept."""

    data: bytes
    code: int
    why: str


def read(file: Path) -> list[Input]:
    """The inputs of a file, without its empty lines and comments. Raises ValueError for a line of another form."""
    return list(_read(file.read_text(encoding="utf-8"))) if file.is_file() else []


def _read(text: str) -> Iterator[Input]:
    for line in text.splitlines():
        if line.strip() and not line.startswith("#"):
            digits, mark, words = line.partition(" # ")
            code, _, why = words.partition(" ")
            if not mark:
                raise ValueError(f"no ErrorID after the bytes: {line}")
            yield Input(bytes.fromhex(digits.strip("-")), int(code), why)


def write(file: Path, head: str, inputs: Iterable[Input]) -> None:
    """Write a file with a comment of one line; no bytes at all are a dash."""
    rows = (f"{each.data.hex() or '-'} # {each.code} {each.why}" for each in inputs)
    file.parent.mkdir(exist_ok=True)
    file.write_text("\n".join([f"# {head}", *rows, ""]), encoding="utf-8")


def described(data: Sequence[bytes], codes: Sequence[int]) -> list[Input]:
    """Inputs with what their ErrorIDs mean, by ErrorID and length."""
    found = [Input(one, code, _TEXTS[code]) for one, code in zip(data, codes, strict=True)]
    return sorted(found, key=lambda each: (each.code, len(each.data), each.data))


def replay(program: Path, target: str, data: Sequence[bytes], seconds: float = 600.0) -> list[int]:
    """The ErrorID of each input. Raises AssertionError with the input and what was said when the program is stopped."""
    lines = "".join(f"{each.hex()}\n" for each in data)
    command = [str(program), target]
    done = subprocess.run(command, input=lines, capture_output=True, text=True, timeout=seconds, check=False)
    if done.returncode:
        count = sum(line.isdigit() for line in done.stdout.splitlines())
        culprit = data[count].hex() if count < len(data) else "none"
        raise AssertionError(f"{target} stops at {culprit}: {done.stdout[-2000:]}{done.stderr[:4000]}")
    return [int(line) for line in done.stdout.split()]
