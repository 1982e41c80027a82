"""A plant's folder: what it is to hold, what of that a person has changed, and all of the rest or nothing."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from driveblocks.maps.problem import Refused
from driveblocks.output import manifest, transaction
from driveblocks.output.manifest import Manifest, State
from driveblocks.plant import yours
from driveblocks.platforms.part import YOURS
from structured_text import files

KIND = "plant"
"""What tells the manifest of a plant from that of a library."""


@dataclass(frozen=True)
class Plan:
    """What is to be written, and what is left."""

    old: Manifest
    texts: Mapping[str, str]
    """Every file, by its path below the folder, with what is the user's in it."""
    states: Mapping[str, State]
    """Path -> why it is to be written or removed."""
    left: Mapping[str, str]
    """Path -> what a person has to be told of a file that is left as it is."""
    changes: Mapping[str, str]
    """Path -> the difference that a program gets."""


def plan(folder: Path, plant: str, target: str, made: Mapping[str, str]) -> Plan:
    """Lay out a folder; `made` are the files without anything of the user's, `plant` names their plant file.

    Raises Refused for a folder that holds something else, and OSError.
    """
    old = manifest.read(folder)
    if old.targets and old.targets != (KIND, target):
        there = old.targets[-1] if old.targets[0] == KIND else "a library"
        raise Refused(f"{folder} is for {there}; write {target} into a folder of its own")
    plain = {name: yours.emptied(text) if _own(name) else text for name, text in made.items()}
    plain[manifest.NAME] = manifest.made([plant], [KIND, target], plain, folder, old).text
    states, left, changes = manifest.compare(folder, old, plain), dict[str, str](), dict[str, str]()
    texts = {**made, manifest.NAME: plain[manifest.NAME]}
    for name in sorted({*made, *old.files}):
        if (here := _read(folder / name)) is None:
            continue
        if _own(name):
            state = manifest.judged(_digest(here), old.files.get(name), _wanted(plain, name))
            states.pop(name, None)
            states |= {name: state} if state else {}
        given = yours.contents(here) if _own(name) else {}
        texts |= {name: yours.filled(texts[name], given)} if name in texts else {}
        why = _why(states.get(name), made.get(name, ""), given)
        if why:
            left[name] = "\n".join([why, *yours.difference(name, here, texts.get(name, ""))] if name in made else [why])
        elif name in states and yours.has_places(texts.get(name, "")):
            changes[name] = "\n".join(yours.difference(name, here, texts[name]))
    return Plan(old, texts, {name: each for name, each in states.items() if name not in left}, left, changes)


def _why(state: State | None, new: str, given: dict[str, str]) -> str:
    """Why a file is left as it is; empty where it is not."""
    if state is State.EDITED:
        return "changed outside of the marks, so it is left as it is; take over what you want of this, or delete it"
    if state is State.LEFT_OVER and given:
        return "not of this plant any more, but with your own logic in it; take that over, then delete it"
    if state and state is not State.FOREIGN and (lost := yours.homeless(new, given)):
        return f"it has no place any more for your own {', '.join(lost)}, so it is left as it is"
    return ""


def write(folder: Path, plan: Plan) -> None:
    """Write all that is not left, or nothing. The folder must be locked. Raises Refused and OSError."""
    foreign = sorted(name for name, state in plan.states.items() if state is State.FOREIGN)
    if foreign:
        lines = [f"{folder / name}: {State.FOREIGN}" for name in foreign]
        raise Refused("\n".join([*lines, "move it away, or write into another folder; nothing was written"]))
    emptied = sorted(set(plan.old.folders) - set(manifest.parents(plan.texts)))
    if plan.states:
        transaction.write(folder, {name: plan.texts.get(name) for name in plan.states}, emptied)


def _own(name: str) -> bool:
    return name.startswith(f"{YOURS}/")


def _wanted(plain: Mapping[str, str], name: str) -> str | None:
    return manifest.text_digest(plain[name]) if name in plain else None


def _digest(text: str) -> str:
    return manifest.text_digest(yours.emptied(text))


def _read(path: Path) -> str | None:
    """The text of a plain file, as it is; None for all else."""
    if path.is_symlink() or not path.is_file():
        return None
    return files.data(path).decode("utf-8", "replace")
