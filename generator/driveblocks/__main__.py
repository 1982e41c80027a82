"""Where the command starts: Ctrl-C ends it without a word, also while the program is being loaded."""

import sys


def main() -> None:
    """Run the command line; ends with its exit status, or 130 as shells do for Ctrl-C."""
    if getattr(sys, "frozen", False):  # packed into one file, which Windows starts again for each process of `test`
        import multiprocessing

        multiprocessing.freeze_support()
    try:
        from driveblocks import cli

        cli.main()
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
