"""A block as a ladder editor shows it: inputs left, outputs right, the in-out through both, in groups."""

from driveblocks.docs.canvas import Canvas
from driveblocks.docs.pins import Pin

WIDTH, BOX, LEFT, WIRE, ROW, GAP, TOP = 680, 400, 130, 30, 19, 24, 64


def picture(name: str, instance: str, inputs: list[Pin], in_outs: list[Pin], outputs: list[Pin]) -> str:
    """The picture of a block; a group has its heading, required pins a dot, and pins without use are pale."""
    left, right = _heights(inputs), _heights(outputs)
    deep = TOP + max([0, *left, *right])
    height = deep + ROW * len(in_outs) + 60
    canvas = Canvas(f"{name} in a ladder editor", WIDTH, height)
    canvas.text(LEFT + BOX / 2, 26, instance, "small", "middle")
    canvas.box(LEFT, 34, BOX, height - 70)
    canvas.text(LEFT + BOX / 2, 54, name, "head", "middle")
    for pin, below in zip(inputs, left, strict=True):
        canvas.text(LEFT + 8, TOP + below - ROW + 3, pin.group, "group")
        _left(canvas, pin, TOP + below)
    for pin, below in zip(outputs, right, strict=True):
        canvas.text(LEFT + BOX - 8, TOP + below - ROW + 3, pin.group, "group", "end")
        _right(canvas, pin, TOP + below)
    for row, pin in enumerate(in_outs, 1):
        y = deep + ROW * row + 4
        _left(canvas, pin, y)
        canvas.path([(LEFT + 50, y), (LEFT + BOX, y)], "thin")
        canvas.path([(LEFT + BOX, y), (LEFT + BOX + WIRE, y)])
    canvas.body.append(f'<circle class="mark" cx="{LEFT}" cy="{height - 16}" r="4"/>')
    canvas.text(LEFT + 10, height - 12, "has to be wired. Pins in grey have no use with this family.", "small")
    return canvas.svg()


def _heights(pins: list[Pin]) -> list[int]:
    """How far below the top each pin is: a group begins with room for its heading."""
    found, y = list[int](), 0
    for pin in pins:
        y += ROW + (GAP if pin.group else 0)
        found.append(y)
    return found


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
