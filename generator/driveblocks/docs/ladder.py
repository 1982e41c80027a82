"""A block as a ladder editor shows it: inputs left, outputs right, the in-out through both."""

from driveblocks.docs.canvas import Canvas
from driveblocks.docs.pins import Pin

WIDTH, BOX, LEFT, WIRE, ROW, TOP = 640, 380, 130, 30, 19, 70


def picture(name: str, inputs: list[Pin], in_outs: list[Pin], outputs: list[Pin]) -> str:
    """The picture of a block; pins without use are left pale, required ones have a dot."""
    rows = max(len(inputs), len(outputs)) + len(in_outs)
    height = TOP + ROW * rows + 62
    canvas = Canvas(f"{name} in a ladder editor", WIDTH, height)
    canvas.text(LEFT + BOX / 2, 26, "Motor1", "small", "middle")
    canvas.box(LEFT, 34, BOX, height - 66)
    canvas.text(LEFT + BOX / 2, 54, name, "head", "middle")
    for row, pin in enumerate(inputs):
        _left(canvas, pin, TOP + ROW * row + 10)
    for row, pin in enumerate(outputs):
        _right(canvas, pin, TOP + ROW * row + 10)
    for row, pin in enumerate(in_outs, rows - len(in_outs)):
        y = TOP + ROW * row + 10
        _left(canvas, pin, y)
        canvas.path([(LEFT + 50, y), (LEFT + BOX, y)], "thin")
        canvas.path([(LEFT + BOX, y), (LEFT + BOX + WIRE, y)])
    canvas.body.append(f'<circle class="mark" cx="{LEFT}" cy="{height - 16}" r="4"/>')
    canvas.text(LEFT + 10, height - 12, "has to be wired. Pins in grey have no use with this family.", "small")
    return canvas.svg()


def _left(canvas: Canvas, pin: Pin, y: float) -> None:
    canvas.path([(LEFT - WIRE, y), (LEFT, y)], "thin" if pin.idle else "line")
    canvas.text(LEFT + 8, y + 4, pin.name, "small" if pin.idle else "mono")
    canvas.text(LEFT - WIRE - 6, y + 4, pin.type, "type", "end")
    if pin.required:
        canvas.body.append(f'<circle class="mark" cx="{LEFT}" cy="{y:g}" r="4"/>')


def _right(canvas: Canvas, pin: Pin, y: float) -> None:
    edge = LEFT + BOX
    canvas.path([(edge, y), (edge + WIRE, y)], "thin" if pin.idle else "line")
    canvas.text(edge - 8, y + 4, pin.name, "small" if pin.idle else "mono", "end")
    canvas.text(edge + WIRE + 6, y + 4, pin.type, "type")
