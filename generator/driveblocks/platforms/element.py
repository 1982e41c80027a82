"""XML as this project writes it: an element to a line, and text exactly as it was given."""

from collections.abc import Mapping
from dataclasses import dataclass

DEEPEST = 4
"""Blanks in front of a line at most: files are large, and what is deeper is short."""
_MARKS = {"&": "&amp;", "<": "&lt;", ">": "&gt;"}
_TEXT = str.maketrans(_MARKS)
_VALUE = str.maketrans({**_MARKS, '"': "&quot;"})


@dataclass(frozen=True)
class Element:
    """An element: tag, attributes, and elements in it or a text that is XML already."""

    tag: str
    attributes: Mapping[str, str]
    content: "tuple[Element, ...]" = ()
    text: str = ""

    def lines(self, indent: str = "") -> list[str]:
        """One element to a line, but for one that is alone in another; a text keeps its own lines."""
        head = self.tag + "".join(f' {name}="{value.translate(_VALUE)}"' for name, value in self.attributes.items())
        inner: list[str] = []
        for each in self.content:
            inner += each.lines(f"{indent} "[:DEEPEST])
        if len(inner) > 1:
            return [f"{indent}<{head}>", *inner, f"{indent}</{self.tag}>"]
        text = self.text or "".join(inner).strip(" ")
        return [f"{indent}<{head}>{text}</{self.tag}>" if text else f"{indent}<{head}/>"]


def element(tag: str, attributes: Mapping[str, str | None] | None = None, *content: Element | None) -> Element:
    given = {name: value for name, value in (attributes or {}).items() if value is not None}
    return Element(tag, given, tuple(each for each in content if each is not None))


def escaped(text: str) -> str:
    """A text whose marks do not pass for XML."""
    return text.translate(_TEXT)


def cdata(text: str) -> str:
    """A text as it is; it must not contain `]]>`."""
    return f"<![CDATA[{text}]]>"
