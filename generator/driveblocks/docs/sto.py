"""The contact of a machine's VFD_HardStop with an STO: in each channel after the safety relay, never instead of it."""

from driveblocks.docs.canvas import Canvas
from driveblocks.docs.chain import coil, contact

WIDTH, HEIGHT, LEFT, RIGHT = 760, 330, 60, 700


def picture() -> str:
    """Two channels from 24 V to the drive, each with a contact of the safety relay and one of K1."""
    canvas = Canvas("K1 in both channels of an STO, after the safety relay", WIDTH, HEIGHT)
    for x, words in ((LEFT, "24 V"), (RIGHT, "0 V")):
        canvas.text(x, 26, words, "head", "middle")
        canvas.box(x - 1, 34, 3, 262, "rail")
    canvas.box(540, 54, 110, 142)
    canvas.text(595, 74, "drive", "head", "middle")
    for y, name in ((104, "STO 1"), (174, "STO 2")):
        contact(canvas, 210, y, "S1", "safety relay")
        contact(canvas, 400, y, "K1", "a stop is overdue: open")
        canvas.text(550, y + 4, name, "mono")
        for begin, end in ((LEFT, 200), (220, 390), (410, 540), (650, RIGHT)):
            canvas.path([(begin, y), (end, y)])
    canvas.box(120, 226, 130, 40)
    canvas.text(185, 250, "HardStopOk", "mono", "middle")
    canvas.text(185, 282, "output of the PLC", "small", "middle")
    coil(canvas, 400, 246, "K1", "two normally open contacts")
    for begin, end in ((LEFT, 120), (250, 388), (412, RIGHT)):
        canvas.path([(begin, 246), (end, 246)])
    canvas.text(
        LEFT, 316, "S1 stays in both channels: K1 is an addition, and counts for no performance level.", "small"
    )
    return canvas.svg()
