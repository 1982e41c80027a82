"""How the contact of a machine's VFD_HardStop is wired: in series with the hard stop, never instead of it."""

from driveblocks.docs.canvas import Canvas

WIDTH, HEIGHT, LEFT, RIGHT = 760, 270, 60, 700


def picture(name: str) -> str:
    """Two rungs between 24 V and 0 V: the hard stop with the contact K1 in it, and the PLC's output that closes K1."""
    canvas = Canvas(f"How {name} is wired", WIDTH, HEIGHT)
    for x, words in ((LEFT, "24 V"), (RIGHT, "0 V")):
        canvas.text(x, 26, words, "head", "middle")
        canvas.box(x - 1, 34, 3, 196, "rail")
    _hard_stop(canvas, 84)
    _output(canvas, 180)
    canvas.text(
        LEFT, 254, "In series with the hard stop, never instead of it, never as the only channel of an STO.", "small"
    )
    return canvas.svg()


def _hard_stop(canvas: Canvas, y: float) -> None:
    contact(canvas, 200, y, "hard stop", "emergency stop, guards: wired")
    contact(canvas, 390, y, "K1", "opened by a stop that is overdue")
    coil(canvas, 580, y, "Q1", "power of the machine's drives")
    for begin, end in ((LEFT, 190), (210, 380), (400, 568), (592, RIGHT)):
        canvas.path([(begin, y), (end, y)])


def _output(canvas: Canvas, y: float) -> None:
    canvas.box(120, y - 20, 130, 40)
    canvas.text(185, y + 4, "HardStopOk", "mono", "middle")
    canvas.text(185, y + 36, "output of the PLC", "small", "middle")
    canvas.box(310, y - 20, 160, 40, "dashed")
    canvas.text(390, y + 4, "retriggered relay", "", "middle")
    canvas.text(390, y + 36, "where outputs hold their state in STOP", "small", "middle")
    coil(canvas, 580, y, "K1", "")
    for begin, end in ((LEFT, 120), (250, 310), (470, 568), (592, RIGHT)):
        canvas.path([(begin, y), (end, y)])


def contact(canvas: Canvas, x: float, y: float, above: str, below: str) -> None:
    """A normally open contact with its name, and what opens it."""
    for edge in (x - 10, x + 10):
        canvas.path([(edge, y - 10), (edge, y + 10)])
    canvas.text(x, y - 18, above, "head", "middle")
    canvas.text(x, y + 28, below, "small", "middle")


def coil(canvas: Canvas, x: float, y: float, above: str, below: str) -> None:
    """A coil with its name, and what it switches."""
    for side in (-12, 12):
        canvas.curve((x + side / 2, y - 10), (x + 1.5 * side, y), (x + side / 2, y + 10))
    canvas.text(x, y - 18, above, "head", "middle")
    canvas.text(x, y + 28, below, "small", "middle")
