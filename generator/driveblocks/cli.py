"""The `driveblocks` command: every sub-command is one module of `driveblocks.commands`."""

import importlib
import sys

import typer

COMMANDS = ("check", "list", "show", "lint", "doctor")

app = typer.Typer(
    help="Structured Text function blocks for variable-frequency drives, from one YAML map per family.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _utf8(stream: object) -> None:
    """Chinese must come out whole under a C locale too, where Python would choose ASCII."""
    if hasattr(stream, "reconfigure"):
        stream.reconfigure(encoding="utf-8", errors="replace")


def main() -> None:
    """Run the command line; the exit status is 0 for good, 1 for a failed test, 2 for bad input."""
    _utf8(sys.stdout)
    _utf8(sys.stderr)
    for name in COMMANDS:
        module = importlib.import_module(f"driveblocks.commands.{name}")
        app.command(name)(module.run)
    app()


if __name__ == "__main__":
    main()
