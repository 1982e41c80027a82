"""What is known of a platform in one place."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Platform:
    """A platform: the name of its folder, whom its files are for, and its serial port.

    Without a `title` it is a port that others use, and nothing is built for it alone.
    """

    name: str
    order: int
    title: str = ""
    where: str = "any serial port"
    """What its line is at."""
    prefix: str = "MB"
    """Of the blocks of its port; MB: it has none, and the program gives and takes the bytes."""
    port: str = ""
    """The platform whose port a first motor has, if it is not its own."""
    parity: bool = False
    """Parity is a pin of its line; else it is set up elsewhere, and the line is told the bits of a character."""
    busy: bool = True
    """Its port says when it is at work."""
    drawn: str = ""
    """What the ladder is drawn in, where the files hold none."""
    yours: str = "yours/"
    """The folder of what is the user's: what has been edited there is kept."""
    quote: str = ""
    """Around the name of a block."""
    member: str = ""
    """Before the name of a variable of the block that is written."""
    comment: str = ""
    """What begins a line of comment; empty: (* *) around it."""

    @property
    def line(self) -> str:
        """The block of a line at its port, without the number of slots."""
        return f"{self.prefix}_{'ByteLine' if self.prefix == 'MB' else 'Line'}"
