"""What a name means across parts, and what the target cannot say, collected with its place."""

from dataclasses import dataclass, field

from driveblocks.platforms.part import Part
from structured_text.language.problems import Problem
from structured_text.language.tree import ArraySpec, TypeDecl


@dataclass
class Names:
    """All parts that are written, by upper-case name, and the problems found so far."""

    parts: dict[str, Part]
    problems: list[Problem] = field(default_factory=list)

    def refuse(self, part: Part, at: int, text: str) -> None:
        """Note what a part says at an offset and SCL cannot."""
        line, column = part.unit.place(at)
        self.problems.append(Problem(part.unit.path, line, column, text, "siemens"))

    def find(self, name: str) -> Part | None:
        """The part with this name, in capital or small letters."""
        return self.parts.get(name.upper())

    def array(self, name: str) -> ArraySpec | None:
        """The array that a name means, if it is the type of one."""
        part = self.find(name)
        if part is None or not isinstance(part.element, TypeDecl):
            return None
        return part.element.spec if isinstance(part.element.spec, ArraySpec) else None
