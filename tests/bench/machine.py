"""Description of the machine by what a figure depends on: processor, compiler, Python; no name of a host, no path."""

import platform
import re
import shutil
import subprocess
from importlib import metadata
from pathlib import Path

from structured_text.engines.discovery import survey

CPUINFO = Path("/proc/cpuinfo")


def describe() -> dict[str, str]:
    """What `lscpu`, the compiler and Python say of themselves."""
    compiler = survey().compiler
    return {
        "processor": _processor(),
        "system": f"{platform.system()} {platform.machine()}",
        "C compiler": _version(compiler.version) if compiler else "none",
        "Python": platform.python_version(),
        "pymodbus": _pymodbus(),
        "valgrind": _valgrind(),
    }


def _processor() -> str:
    """Model, and family and number in it, since a virtual machine may not tell the model's name."""
    text = CPUINFO.read_text("utf-8") if CPUINFO.is_file() else ""
    found = dict(re.findall(r"^(model name|cpu family|model)\s*: (.*)$", text, re.MULTILINE))
    if "model name" not in found:
        return platform.processor() or "unknown"
    return f"{found['model name']}, family {found.get('cpu family', '?')}, model {found.get('model', '?')}"


def _pymodbus() -> str:
    try:
        return metadata.version("pymodbus")
    except metadata.PackageNotFoundError:
        return "none"


def _valgrind() -> str:
    found = shutil.which("valgrind")
    if found is None:
        return "none"
    return _version(subprocess.run([found, "--version"], capture_output=True, text=True, check=False).stdout or "?")


def _version(said: str) -> str:
    return said.splitlines()[0].strip()
