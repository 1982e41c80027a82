"""Coverage-guided fuzzing of parsers, frame decoders and request blocks by libFuzzer, under the sanitizers.

Begins with the corpus and the regressions of the repository and with the manuals' frames. Exit status 1 with the input
in hexadecimal on a find, 2 without clang, libFuzzer and matiec, and for an unknown name.

    python -m tests.native.fuzz [--seconds 60] [--target NAME,..] [--line LINE] [--keep]
"""

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from tests.native.driver import told_lines
from tests.native.fuzz.corpus import CORPUS, REGRESSIONS, described, read, replay, write
from tests.native.fuzz.program import fuzzer, libfuzzer, replayer, targets
from tests.native.fuzz.seeds import seeds
from tests.native.sanitize.sanitizers import Checked, found_lines

from structured_text.engines.discovery import MATIEC_NAMES
from structured_text.engines.matiec import MatiecEngine

LONGEST = 600
"""Bytes of an input: a little more than the longest frame of characters with what stands before it."""
HEAD = "hexadecimal # ErrorID and what it means; written by python -m tests.native.fuzz --keep"


@dataclass(frozen=True)
class Fuzzing:
    """One target on one line: the programs, and the folder that takes what is found."""

    line: str
    target: str
    program: Path
    replayer: Path
    folder: Path

    def run(self, seconds: int, seed: int) -> subprocess.CompletedProcess[str]:
        """Begin with what is kept, and go on for some seconds."""
        inputs = self.folder / "inputs"
        inputs.mkdir(parents=True)
        kept = read(CORPUS / f"{self.target}.txt") + read(REGRESSIONS / f"{self.target}.txt")
        for number, data in enumerate([*(each.data for each in kept), *seeds(self.target)]):
            (inputs / f"kept{number}").write_bytes(data)
        limits = [
            f"-max_total_time={seconds}",
            f"-max_len={LONGEST}",
            f"-seed={seed}",
            "-timeout=20",
            "-print_final_stats=1",
            "-use_value_profile=1",
        ]
        return self._call([*limits, f"-artifact_prefix={self.folder}/", str(inputs)], seconds + 300)

    def fewest(self) -> list[bytes]:
        """The fewest inputs that reach what all of them reach."""
        chosen = self.folder / "chosen"
        chosen.mkdir()
        self._call(["-set_cover_merge=1", f"-max_len={LONGEST}", str(chosen), str(self.folder / "inputs")], 600)
        return [file.read_bytes() for file in sorted(chosen.iterdir())]

    def finds(self) -> list[bytes]:
        """Inputs that stopped the program, or took too long."""
        files = (file for file in sorted(self.folder.iterdir()) if file.is_file())
        return [file.read_bytes() for file in files]

    def _call(self, arguments: list[str], seconds: int) -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "DRIVEBLOCKS_TARGET": self.target}
        return subprocess.run(
            [str(self.program), *arguments],
            env=environment,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=seconds,
            check=False,
        )


def work(given: argparse.Namespace, checked: Checked, folder: Path) -> Iterator[Fuzzing]:
    """Every target that is asked for, on every line that is asked for; only the first line's inputs can be kept."""
    chosen = given.target or list(targets())
    for engine in found_lines():
        if given.line in ("", engine.name):
            yield from _targets(engine, checked, chosen, folder)


def _targets(engine: MatiecEngine, checked: Checked, chosen: list[str], folder: Path) -> Iterator[Fuzzing]:
    plain = Checked(checked.name, checked.command, tuple(each.replace("fuzzer,", "") for each in checked.options[:-1]))
    programs = fuzzer(engine, checked), replayer(engine, plain)
    for target in chosen:
        yield Fuzzing(engine.name, target, *programs, folder / f"{engine.name}-{target}")


def report(each: Fuzzing, done: subprocess.CompletedProcess[str]) -> int:
    """Say what a run did; the number of finds."""
    stats = dict(
        line.removeprefix("stat::").split(":") for line in done.stderr.splitlines() if line.startswith("stat::")
    )
    inputs = len(list((each.folder / "inputs").iterdir()))
    finds = each.finds()
    executed = int(stats.get("number_of_executed_units", 0))
    print(f"{each.line:16} {each.target:18} {executed:>10,} inputs, {inputs} kept, {len(finds)} finds", flush=True)
    for data in finds:
        said = "\n".join(line for line in done.stderr.splitlines() if not line.startswith("#"))
        print(f"FOUND {data.hex()}\n{done.stdout[-2000:]}{said[-4000:]}")
    if done.returncode and not finds:
        print(f"libFuzzer ended with status {done.returncode}: {done.stderr[-2000:]}")
    return len(finds) or int(done.returncode != 0)


def names(text: str) -> list[str]:
    """Targets by name. Raises ArgumentTypeError for one that there is not."""
    asked = [name.strip() for name in text.split(",") if name.strip()]
    if unknown := [name for name in asked if name not in targets()]:
        raise argparse.ArgumentTypeError(f"there is no target {', '.join(unknown)}")
    return asked


def keep(each: Fuzzing) -> None:
    """Write the fewest inputs into the repository."""
    data = each.fewest()
    write(CORPUS / f"{each.target}.txt", HEAD, described(data, replay(each.replayer, each.target, data)))


def main(arguments: Sequence[str] | None = None) -> int:
    """Fuzz what is asked for. Exit status 1 on a find, 2 if nothing could run."""
    parser = argparse.ArgumentParser(description="Fuzzing by libFuzzer.")
    parser.add_argument("--seconds", type=int, default=60, help="per target and line")
    parser.add_argument("--target", type=names, default=[], help=", ".join(targets()))
    parser.add_argument("--line", default="", choices=["", *MATIEC_NAMES], help="both without it")
    parser.add_argument("--keep", action="store_true", help="write the corpus anew, from one line")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args(arguments)
    checked, finds = libfuzzer(), 0
    print(told_lines(), flush=True)
    if checked is None or not any(given.line in ("", engine.name) for engine in found_lines()):
        print("needs clang with libFuzzer (compiler-rt) and iec2c; `driveblocks doctor` says what is missing")
        return 2
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        everything = list(work(given, checked, Path(folder)))
        runs = [pool.submit(each.run, given.seconds, given.seed) for each in everything]
        for each, running in zip(everything, runs, strict=True):
            finds += report(each, running.result())
            if given.keep and each.line == everything[0].line:
                keep(each)
    return 1 if finds else 0


if __name__ == "__main__":
    sys.exit(main())
