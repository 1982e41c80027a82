"""Text that is no frame in any spelling."""


class Spot(Exception):  # noqa: N818  (a place in a text, on its way to a message)
    """A place in a text that cannot be read; `at` counts characters from its start."""

    def __init__(self, at: int, wrong: str, right: str) -> None:
        super().__init__(wrong)
        self.at, self.wrong, self.right = at, wrong, right

    def told(self, text: str, name: str) -> str:
        """The whole message, with line and column counted from 1."""
        before = text[: self.at]
        line = before.count("\n") + 1
        column = self.at - (before.rfind("\n") + 1) + 1
        return f"{name}:{line}:{column}: {self.wrong}; {self.right}"
