"""`python -m structured_text`: lint, run and test plain files."""

import sys

from structured_text.cli import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
