"""An RS-485 line as it is wired: two wires and a common from unit to unit, terminated at both ends, biased at one."""

from driveblocks.docs.canvas import Canvas

WIDTH, HEIGHT = 780, 330
UNITS = ((40, "PLC", "bias on"), (320, "drive 1", "no termination"), (590, "drive 2", "last on the line"))
ROWS = (("D1 +", 190, "go"), ("D0 -", 214, "line"), ("common", 238, "dashed"))
BOX, LEFT, RIGHT, COMMON = 130, 54, 735, 238
"""Width of a unit, ends of the two wires, and how far down the common is."""


def picture() -> str:
    """A PLC and two drives."""
    canvas = Canvas("An RS-485 line with a PLC and two drives", WIDTH, HEIGHT)
    for words, y, kind in ROWS:
        canvas.path([(LEFT if y < COMMON else LEFT + 76, y), (RIGHT if y < COMMON else RIGHT - 55, y)], kind)
        canvas.text(WIDTH / 2 - 118, y - 4, words, "small", "middle")
    for x, name, says in UNITS:
        _unit(canvas, x, name, says)
    for x in (LEFT, RIGHT):
        _termination(canvas, x)
    canvas.path([(LEFT + 46, 262), (RIGHT - 46, 262)], "thin")
    canvas.text(WIDTH / 2, 280, "shield of the twisted pair, on earth at the entry of each cabinet", "small", "middle")
    rest = "While nobody sends, D1 is at least 0.2 V above D0. Letters differ from maker to maker."
    canvas.text(40, 312, rest, "small")
    return canvas.svg()


def _unit(canvas: Canvas, x: float, name: str, says: str) -> None:
    canvas.box(x, 40, BOX, 90)
    canvas.text(x + BOX / 2, 70, name, "head", "middle")
    canvas.text(x + BOX / 2, 92, says, "small", "middle")
    for at, (words, y, kind) in enumerate(ROWS):
        here = x + 40 + 25 * at
        canvas.path([(here, 130), (here, y)], kind)
        canvas.text(here, 124, words.split()[-1] if at < 2 else "C", "mono", "middle")


def _termination(canvas: Canvas, x: float) -> None:
    """A resistor between the two wires, at their end."""
    canvas.path([(x, ROWS[0][1]), (x, ROWS[1][1])])
    canvas.box(x - 4, ROWS[0][1] + 4, 8, 16)
    canvas.text(x, ROWS[1][1] + 16, "120 ohm", "small", "middle")
