"""The ST programs of the accept/reject corpus: programs/*.yaml written out as whole sources.

An entry is either `text` (the whole source) or the parts of a function block `Probe`: `types` (inside TYPE ...
END_TYPE), `before` (POUs in front), `vars`, `vars_constant`, `body`. `each: {T: [...]}` makes one program per value,
`pairs: [[a, b], ...]` one per pair with {A} and {B}; the name then has the same mark, and gets it in lower case.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

FOLDER = Path(__file__).parent / "programs"


def load_programs() -> dict[str, str]:
    """Every program by its name, in the order of the files; names are unique over all files."""
    programs: dict[str, str] = {}
    for path in sorted(FOLDER.glob("*.yaml")):
        for name, text in _programs(path):
            if name in programs:
                raise ValueError(f"{path.name}: {name} is there twice")
            programs[name] = text
    return programs


def _programs(path: Path) -> Iterator[tuple[str, str]]:
    # Not safe_load: a key that is there twice would silently lose its first program.
    node = yaml.compose(path.read_text(encoding="utf-8"), Loader=yaml.SafeLoader)
    assert isinstance(node, yaml.MappingNode), path
    loader = yaml.SafeLoader("")
    for key, value in node.value:
        entry = loader.construct_mapping(value, deep=True)
        for marks in _marks(entry):
            yield _fill(key.value, {mark: word.lower() for mark, word in marks.items()}), _fill(_text(entry), marks)


def _marks(entry: dict[Any, Any]) -> Iterator[dict[str, str]]:
    if "pairs" in entry:
        yield from ({"A": left, "B": right} for left, right in entry["pairs"])
    elif "each" in entry:
        ((mark, words),) = entry["each"].items()
        yield from ({mark: word} for word in words)
    else:
        yield {}


def _fill(text: str, marks: dict[str, str]) -> str:
    for mark, word in marks.items():
        text = text.replace("{" + mark + "}", word)
    return text


def _text(entry: dict[Any, Any]) -> str:
    if "text" in entry:
        return str(entry["text"])
    parts = [f"TYPE\n  {entry['types']}\nEND_TYPE\n"] if "types" in entry else []
    parts += [entry["before"] + "\n"] if "before" in entry else []
    parts += ["FUNCTION_BLOCK Probe\n"]
    parts += [f"VAR\n  {entry['vars']}\nEND_VAR\n"] if "vars" in entry else []
    parts += [f"VAR CONSTANT\n  {entry['vars_constant']}\nEND_VAR\n"] if "vars_constant" in entry else []
    return "".join(parts) + f"  {entry['body']}\nEND_FUNCTION_BLOCK\n"
