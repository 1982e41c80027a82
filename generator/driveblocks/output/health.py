"""What runs ST on this machine, what is missing, what that costs, and where to get it: the words of `doctor`."""

import importlib.metadata
import platform
import sys
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import yaml

from structured_text.engines.discovery import EMBEDDED, LINES, NO_COMPILER, Candidate, Examined, Survey
from structured_text.engines.engine import EngineError, Source

_PROBE = Source(
    "probe.st",
    """FUNCTION_BLOCK DoctorProbe
  VAR_INPUT
    Add : INT;
  END_VAR
  VAR_OUTPUT
    Sum : INT;
  END_VAR
  Sum := Sum + Add;
END_FUNCTION_BLOCK
""",
)
# The editors that bring iec2c along, and the sources of iec2c itself.
_HOMES = {
    "beremiz": "Beremiz (https://beremiz.org) brings it; its sources: https://github.com/beremiz/matiec",
    "openplc": "OpenPLC Editor (https://autonomylogic.com) brings it;"
    " its sources: https://github.com/Autonomy-Logic/matiec",
}


@dataclass(frozen=True)
class Part:
    """One thing looked for: `state` is `ok`, `missing` or `broken`; `detail` where it is, or why it does not work."""

    name: str
    state: str
    detail: str


@dataclass(frozen=True)
class Advice:
    """Something missing: what that costs the user, and how to get it."""

    missing: str
    cost: str
    remedy: str


@dataclass(frozen=True)
class Health:
    """All findings; `survey` has the details of every iec2c."""

    survey: Survey
    parts: tuple[Part, ...]
    missing: tuple[Advice, ...]

    @property
    def works(self) -> bool:
        """Whether ST can be run: the embedded engine does what it must."""
        return any(part.name == EMBEDDED and part.state == "ok" for part in self.parts)

    def plain(self) -> dict[str, Any]:
        """Give all as data for JSON."""
        return {
            "works": self.works,
            "parts": [asdict(part) for part in self.parts],
            "matiec": [_plain(each) for each in self.survey.examined],
            "missing": [asdict(each) for each in self.missing],
        }


def examine(found: Survey) -> Health:
    """Try what was found, and say what is missing."""
    return Health(found, tuple(_parts(found)), tuple(_advice(found)))


def _plain(each: Examined) -> dict[str, Any]:
    return {
        "iec2c": each.iec2c,
        "library": each.library,
        "engine": each.engine.name if each.engine else None,
        "behaviour": asdict(each.behaviour) if each.behaviour else None,
        "problem": each.problem,
    }


def _parts(found: Survey) -> Iterator[Part]:
    yield Part("Python", "ok", f"{platform.python_version()} ({sys.executable})")
    yield _yaml()
    yield _engine(found.embedded)
    for line in LINES:
        yield _line(line, found)
    yield from _broken(found)
    compiler = found.compiler
    if compiler is None:
        yield Part("C compiler", "missing", NO_COMPILER)
    else:
        yield Part("C compiler", "ok", f"{' '.join(compiler.command)}: {compiler.version}")
    complaint = found.cache.check()
    yield Part("build cache", "broken" if complaint else "ok", complaint or str(found.cache.root))


def _yaml() -> Part:
    with_c = "with libyaml" if yaml.__with_libyaml__ else "without libyaml"
    return Part("PyYAML", "ok", f"{importlib.metadata.version('pyyaml')}, {with_c}")


def _engine(candidate: Candidate) -> Part:
    """Try the embedded engine on a small block: whoever has Python has it, so it must work."""
    if candidate.engine is None:
        return Part(EMBEDDED, "broken", candidate.note)
    try:
        block = candidate.engine.build([_PROBE]).instance("DoctorProbe")
        block["Add"] = 21
        block.scan(0)
        block.scan(1)
        total = block["Sum"]
    except (EngineError, KeyError) as error:
        return Part(EMBEDDED, "broken", str(error))
    if total != 42:
        return Part(EMBEDDED, "broken", f"21 + 21 gave {total!r}")
    return Part(EMBEDDED, "ok", "runs ST in Python, part of DriveBlocks")


def _line(line: str, found: Survey) -> Part:
    name = f"matiec-{line}"
    here = [each for each in found.examined if each.engine is not None and each.engine.name == name]
    if not here:
        return Part(name, "missing", "no iec2c of this line that works")
    return Part(name, "ok", "; also ".join(_where(each) for each in here))


def _where(each: Examined) -> str:
    mixed = each.behaviour is not None and not each.behaviour.pure
    return f"{each.iec2c} (library {each.library}{', behaves partly as the other line' if mixed else ''})"


def _broken(found: Survey) -> Iterator[Part]:
    for each in found.examined:
        if each.problem is not None:
            yield Part("iec2c", "broken", f"{each.iec2c}: {each.problem}")


def _advice(found: Survey) -> Iterator[Advice]:
    engines = {each.engine.name for each in found.examined if each.engine is not None}
    untold = any(each.problem == NO_COMPILER for each in found.examined)  # a compiler is all that they lack
    for line, home in _HOMES.items():
        if f"matiec-{line}" not in engines and not untold:
            yield Advice(
                f"matiec, line of {line.capitalize().replace('plc', 'PLC')}",
                "tests do not run on this compiler; they compare with traces recorded from it instead",
                f"{home}. Put the folder of iec2c on PATH, or name it in MATIEC_HOME.",
            )
    if found.compiler is None:
        yield Advice(
            "C compiler",
            "matiec cannot be used, since iec2c writes C",
            "Debian, Ubuntu: apt install gcc; macOS: xcode-select --install; Windows: gcc of https://www.msys2.org."
            " Put it on PATH, or name it in CC.",
        )
    if not yaml.__with_libyaml__:
        yield Advice("libyaml", "maps load several times slower", "pip install --force-reinstall pyyaml")
