"""`driveblocks build`: vendor maps -> Structured Text."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from driveblocks.render.text import Language


def run(
    maps: Annotated[
        list[str] | None,
        typer.Argument(metavar="MAP", help="Maps by path, or shipped ones by name; all shipped ones without it."),
    ] = None,
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder to write to.")] = Path("blocks"),
    lang: Annotated[str, typer.Option(help="Languages of the texts: en, zh or en,zh.")] = "en,zh",
    encoding: Annotated[str, typer.Option(help="Bytes of Chinese texts: utf-8 or gb18030.")] = "utf-8",
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; exit 1 when the folder is not current.")
    ] = False,
) -> None:
    """Write the function blocks of the drives. The old output stays whole when anything is wrong.

    Example: driveblocks build my_drive.yaml -o my_blocks
    """
    from driveblocks.maps.catalog import UnknownDrive
    from driveblocks.maps.problem import MapError
    from driveblocks.render import build
    from driveblocks.render.text import missing

    languages = _languages(lang, encoding)
    try:
        sources = build.read(_paths(maps))
        wanted = build.files(sources, languages)
        stale = build.stale(output, wanted)
        if stale and not check:
            build.write(output, wanted)
    except (MapError, UnknownDrive) as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(2) from None
    except OSError as error:
        typer.echo(f"{error.filename}: cannot be written: {error.strerror}; the old output is untouched", err=True)
        raise typer.Exit(2) from None
    if stale and check:
        shown = "\n".join(f"  {output / name}" for name in stale)
        typer.echo(f"not current:\n{shown}\nrun: driveblocks build{_again(maps, output)}", err=True)
        raise typer.Exit(1)
    drives = ", ".join(source.drive.prefix for source in sources)
    typer.echo(f"{output}: {len(wanted)} files for {drives}, {len(stale)} changed")
    for note in filter(None, (missing(source.drive, languages) for source in sources)):
        typer.echo(note)


def _again(maps: list[str] | None, output: Path) -> str:
    named = "".join(f" {name}" for name in maps or ())
    return named + (f" -o {output}" if output != Path("blocks") else "")


def _paths(maps: list[str] | None) -> list[Path]:
    from driveblocks.maps import catalog

    return [catalog.resolve(name) for name in maps] if maps else list(catalog.shipped())


def _languages(lang: str, encoding: str) -> "list[Language]":
    from driveblocks.render.text import languages

    codes = [code.strip() for code in lang.split(",") if code.strip()]
    unknown = [code for code in codes if code not in ("en", "zh")]
    if unknown or not codes:
        raise typer.BadParameter(f"`{lang}` is no list of languages; write en, zh or en,zh", param_hint="--lang")
    if encoding not in ("utf-8", "gb18030"):
        raise typer.BadParameter(f"`{encoding}` is not possible; write utf-8 or gb18030", param_hint="--encoding")
    return languages(sorted(set(codes)), encoding)
