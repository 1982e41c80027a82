"""The `driveblocks` command: every sub-command is the `run` of one module of `driveblocks.commands`."""

import importlib
import pkgutil
import sys
from typing import Annotated

import typer

from driveblocks import __version__, commands, console

app = typer.Typer(
    help="Structured Text function blocks for variable-frequency drives, from one YAML map per family.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    # `color` keeps typer from taking escape codes out of what does not go to a terminal: the streams write them out.
    context_settings={"help_option_names": ["-h", "--help"], "color": True},
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"driveblocks {__version__}")
        raise typer.Exit


Version = Annotated[
    bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
]


@app.callback()
def options(version: Version = False) -> None:
    """Structured Text function blocks for variable-frequency drives, from one YAML map per family.

    Example: driveblocks check my_drive.yaml
    """


for _module in pkgutil.iter_modules(commands.__path__):
    # A command's module imports little; what it needs to run it imports when it runs.
    app.command(_module.name)(importlib.import_module(f"{commands.__name__}.{_module.name}").run)


def main() -> None:
    """Run the command line; the exit status is 0 for good, 1 for a failed test, 2 for bad input."""
    console.use_safe_utf8()
    try:
        app()
    except OSError as error:  # a command reports on its files itself; what is left is a full disk under its output
        typer.echo(f"{error.filename or 'standard output'}: {error.strerror or error}", err=True)
        console.give_up_output()
        sys.exit(2)


if __name__ == "__main__":
    main()
