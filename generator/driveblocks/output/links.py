"""Links of pages to files beside them: where they lead, and plain words for those that lead nowhere."""

import posixpath
import re
from collections.abc import Callable, Iterator

_LINK = re.compile(r"(!?)\[([^\]]*)\]\((?!\w+:)([^)#\s]*)(#[^)\s]*)?\)")


def targets(page: str, text: str) -> Iterator[str]:
    """Where the links of a page lead, as paths from where `page` is a path from."""
    yield from (_target(page, found[3]) for found in _LINK.finditer(text))


def live(page: str, text: str, there: Callable[[str], bool]) -> str:
    """The page with its links to what is not there as plain words."""

    def kept(found: re.Match[str]) -> str:
        return found[0] if there(_target(page, found[3])) else found[2]

    return _LINK.sub(kept, text)


def _target(page: str, link: str) -> str:
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), link)) if link else page
