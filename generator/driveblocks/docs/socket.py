"""An RJ45 socket as one looks into it, latch at the top: pin 8 is left, pin 1 right, and each has its wire."""

from driveblocks.docs.canvas import Canvas
from driveblocks.maps.model import Pin
from driveblocks.meaning.plug import Plug

WIDTH, LEFT, PITCH, TOP, ROW, TEXT = 680, 40, 20, 56, 26, 250
CONTACTS = 8
SAYS = {
    "positive": "+  (D1, B of TIA-485)", "negative": "-  (D0, A of TIA-485)",
    "common": "common", "shield": "shield", "supply": "a supply: leave it free",
    "reserved": "something else: leave it free", "unconnected": "not connected", "": "leave it free",
}  # fmt: skip
KINDS = {"positive": "go", "negative": "line", "common": "dashed", "shield": "dashed"}
"""How a wire is drawn, as in the picture of the line."""


def picture(title: str, plug: Plug) -> str:
    """The picture of a socket."""
    inside = {one.pin: one for one in plug.pins}
    beside = [one for one in plug.pins if not one.pin.isdecimal()]
    first = TOP + 86
    canvas = Canvas(title, WIDTH, first + ROW * (CONTACTS + len(beside)) + 8)
    canvas.text(LEFT, 28, "Looking into the socket of the drive, latch at the top", "head")
    wide = PITCH * CONTACTS
    canvas.box(LEFT + wide / 2 - 30, TOP - 14, 60, 24)
    canvas.box(LEFT - 10, TOP, wide + 20, 56)
    for number in range(1, CONTACTS + 1):
        x, y = LEFT + PITCH * (CONTACTS - number) + PITCH / 2, first + ROW * (number - 1)
        one = inside.get(str(number))
        canvas.box(x - 3, TOP + 6, 6, 28, "rail")
        canvas.text(x, TOP + 50, str(number), "mono", "middle")
        if one is not None and one.wire in KINDS:
            canvas.path([(x, TOP + 56), (x, y), (TEXT - 8, y)], KINDS[one.wire])
        _row(canvas, y, str(number), one)
    for row, each in enumerate(beside, CONTACTS):
        _row(canvas, first + ROW * row, "", each)
    return canvas.svg()


def _row(canvas: Canvas, y: float, number: str, one: Pin | None) -> None:
    """What a contact, or a terminal beside the socket, is."""
    wire = one.wire if one else ""
    canvas.text(TEXT, y + 4, number or "-", "mono")
    canvas.text(TEXT + 22, y + 4, SAYS[wire], "head" if wire in KINDS else "small")
    if one is not None:
        own = one.label if number else ", ".join(filter(None, (one.pin, one.label)))
        canvas.text(TEXT + 190, y + 4, own or "", "small")
