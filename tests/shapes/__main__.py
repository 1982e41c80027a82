"""Print the made-up maps of these names, or all names."""

import sys

from tests.shapes import texts

print("\n".join(texts()[name] for name in sys.argv[1:]) or "\n".join(texts()))
