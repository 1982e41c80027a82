"""`driveblocks build`: vendor maps -> Structured Text."""

import contextlib
import sys
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.core import ParameterSource

from driveblocks import console
from driveblocks.commands import FILE, MAPS, refuse
from driveblocks.platforms import TARGETS

if TYPE_CHECKING:
    from driveblocks.docs.page import Measured
    from driveblocks.output.build import Plan, Wanted
    from driveblocks.render.text import Language


@click.command()
@MAPS
@click.option("-o", "--output", metavar="FOLDER", default="blocks", help="Folder to write to.")
@click.option("--lang", metavar="LIST", default="en,zh", help="Languages of the texts: en, zh or en,zh.")
@click.option("--encoding", metavar="NAME", default="utf-8", help="Bytes of Chinese texts: utf-8 or gb18030.")
@click.option("--to", "target", metavar="LIST", default="all", help=f"Platforms: {', '.join(TARGETS)} or all.")
@click.option("--families", metavar="LIST", help="Shipped families, such as chf,pf525, as if named as maps.")
@click.option("--check", is_flag=True, help="Write nothing; exit 1 when the folder is not current.")
@click.option("--only", is_flag=True, help="Remove the blocks of drives and targets that are not named.")
@click.option("--site", type=FILE, metavar="FILE", help="Show on the pages what `commission` found of single drives.")
@click.option("--force", is_flag=True, help="Also replace files of an earlier build that you have edited.")
def run(  # noqa: PLR0913, PLR0917 - one parameter per option of the command line
    maps: tuple[str, ...],
    output: str,
    lang: str,
    encoding: str,
    target: str,
    families: str | None,
    site: Path | None,
    check: bool,
    only: bool,
    force: bool,
) -> None:
    """Write the function blocks of the drives. The old output stays whole when anything is wrong.

    Drives and targets that are built one after another into one folder join: each build brings all of them up to date,
    in the languages asked for. What was written is listed in .driveblocks.json there. Only files of that list are
    replaced or removed, and none that you have edited since, unless with --force. --site changes pages, and no block.

    Example: driveblocks build my_drive.yaml -o my_blocks
    """
    from driveblocks.output import build, transaction
    from driveblocks.output.manifest import NAME
    from driveblocks.render.text import missing

    folder = _folder(output)
    maps = (*maps, *_families(families))
    asked = build.Wanted(_languages(lang, encoding), _targets(target), only, _measured(site))
    plan = _planned(folder, maps, asked) if check else _carried_out(folder, maps, asked, force)
    wrong = [f"{folder / name}: {state}" for name, state in plan.states.items()]
    if check and transaction.interrupted(folder):
        wrong.insert(0, f"{folder}: another build is at work, or was interrupted")
    if check and wrong:
        options = {"-o": output, "--lang": lang, "--encoding": encoding, "--to": target, "--site": site}
        again = _again(options, maps, only)
        click.echo("\n  ".join(["not current:", *wrong]) + f"\nrun: driveblocks build{again}", err=True)
        sys.exit(1)
    drives = ", ".join(source.drive.prefix for source in plan.sources)
    changed = len(plan.states.keys() - {NAME})
    click.echo(f"{folder}: {len(plan.texts) - 1} files for {drives}, {changed} changed")
    for name in plan.kept:
        click.echo(f"{folder / name}: yours, kept as you edited it; build into another folder to see the new one")
    given = click.get_current_context().get_parameter_source("lang") is not ParameterSource.DEFAULT
    for note in filter(None, (missing(source.drive, asked.languages) for source in plan.sources if given)):
        click.echo(note)
    for stem in sorted(asked.measured.keys() - {source.path.stem for source in plan.sources}):
        click.echo(f"{site}: {stem} is not built here, and no page shows its drives")


def _planned(folder: Path, maps: tuple[str, ...], asked: "Wanted") -> "Plan":
    from driveblocks.maps import catalog
    from driveblocks.output import build

    made = click.get_current_context().obj  # another output, as a test may want it
    steps = ["the maps", build.BLOCKS, build.PAGES, *asked.targets]
    with _told(folder), contextlib.closing(console.Bar(console.terminal("stderr"))) as bar:

        def tell(name: str) -> None:
            if name not in steps:  # a target that the folder was built for before
                steps.append(name)
            bar.show(steps.index(name), len(steps), name)

        tell(steps[0])
        return build.plan(folder, catalog.chosen(maps), asked, made or partial(build.files, tell=tell))


def _carried_out(folder: Path, maps: tuple[str, ...], asked: "Wanted", force: bool) -> "Plan":
    from driveblocks.output import build, transaction

    with _told(folder), transaction.locked(folder):
        if transaction.recover(folder):
            click.echo(f"{folder}: took back a build that was interrupted", err=True)
        plan = _planned(folder, maps, asked)
        build.write(folder, plan, force=force)
        return plan


@contextlib.contextmanager
def _told(folder: Path) -> Iterator[None]:
    """Say what is wrong with maps or folder, and end with status 2."""
    from driveblocks.maps.problem import Refused
    from driveblocks.output.transaction import interrupted
    from driveblocks.platforms.problem import ExportError

    try:
        yield
    except (ExportError, Refused) as error:
        refuse("\n".join([str(error), *getattr(error, "__notes__", ())]))
    except OSError as error:
        left = "the next build puts the old output back" if interrupted(folder) else "nothing was changed"
        refuse(f"{error.filename or folder}: {error.strerror}; {left}")


def _folder(output: str) -> Path:
    if not output:
        raise click.BadParameter("an empty name is no folder; write . for the one you are in", param_hint="--output")
    return Path(output)


def _measured(site: Path | None) -> Mapping[str, "Sequence[Measured]"]:
    """What was found of single drives, by the name of their map. Raises Refused for a bad file."""
    if site is None:
        return {}
    from driveblocks.desk.site import kept, sheet

    return sheet.measured(kept.read(site))


def _again(options: "Mapping[str, str | Path | None]", maps: tuple[str, ...], only: bool) -> str:
    """The words of the command line that are not the usual ones."""
    usual = {"-o": "blocks", "--lang": "en,zh", "--encoding": "utf-8", "--to": "all", "--site": None}
    given = [f"{name} {value}" for name, value in options.items() if value != usual[name]]
    return "".join(f" {word}" for word in [*maps, *given, *(["--only"] if only else ())])


def _families(families: str | None) -> list[str]:
    names = [name for each in (families or "").split(",") if (name := each.strip())]
    if families is not None and not names:
        raise click.BadParameter("an empty list names no family; write chf,pf525", param_hint="--families")
    return names


def _targets(target: str) -> list[str]:
    names = [name.strip() for name in target.split(",") if name.strip()]
    unknown = [name for name in names if name not in (*TARGETS, "all")]
    if unknown or not names:
        wrong = f"`{target}` is no list of platforms; write {', '.join(TARGETS)} or all"
        raise click.BadParameter(wrong, param_hint="--to")
    return list(TARGETS) if "all" in names else names


def _languages(lang: str, encoding: str) -> "list[Language]":
    from driveblocks.maps.rules.name import ENCODINGS
    from driveblocks.render.text import languages

    codes = [code.strip() for code in lang.split(",") if code.strip()]
    unknown = [code for code in codes if code not in ("en", "zh")]
    if unknown or not codes:
        raise click.BadParameter(f"`{lang}` is no list of languages; write en, zh or en,zh", param_hint="--lang")
    if encoding not in ENCODINGS:
        right = " or ".join(ENCODINGS)
        raise click.BadParameter(f"`{encoding}` is not possible; write {right}", param_hint="--encoding")
    return languages(sorted(set(codes)), encoding)
