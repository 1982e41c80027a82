"""A ladder as its editor shows it, drawn from the same elements that PLCopen XML carries."""

from collections.abc import Iterator

from driveblocks.docs.canvas import Canvas
from driveblocks.platforms.element import Element

Point = tuple[float, float]
_MARGIN = 24


def picture(title: str, diagram: Element) -> str:
    """The picture of an element LD of TC6: rails, contacts, blocks, values, coils and their wires."""
    boxes = [(*_at(each), _size(each, "width"), _size(each, "height")) for each in diagram.content]
    right, bottom = max(x + wide for x, _, wide, _ in boxes), max(y + high for _, y, _, high in boxes)
    canvas = Canvas(title, int(right) + _MARGIN, int(bottom) + _MARGIN)
    for each in diagram.content:
        for wire in _found(each, "connection"):
            canvas.path([_point(one) for one in wire.content])
    for each in diagram.content:
        _DRAWN[each.tag](canvas, each)
    return canvas.svg()


def _rail(canvas: Canvas, one: Element) -> None:
    x, y = _at(one)
    canvas.box(x, y + _MARGIN / 2, _size(one, "width"), _size(one, "height"), "rail")


def _contact(canvas: Canvas, one: Element) -> None:
    """Two bars with the name of the variable above them."""
    (x, y), wide, high = _at(one), _size(one, "width"), _size(one, "height")
    canvas.box(x, y, wide, high, "gap")
    for edge in (x + 5, x + wide - 5):
        canvas.path([(edge, y), (edge, y + high)])
        canvas.path([(x if edge < x + wide / 2 else x + wide, y + 8), (edge, y + 8)])
    if "negated" in one.attributes:
        canvas.path([(x + 5, y + high), (x + wide - 5, y)])
    canvas.text(x + wide / 2, y - 4, _text(one, "variable"), "mono", "middle")


def _coil(canvas: Canvas, one: Element) -> None:
    """Two arcs, and between them whether it sets or resets."""
    (x, y), wide, high = _at(one), _size(one, "width"), _size(one, "height")
    for begin, bow in ((x + 6, -5), (x + wide - 6, 5)):
        canvas.curve((begin, y), (begin + 2 * bow, y + high / 2), (begin, y + high))
    mark = {"set": "S", "reset": "R"}.get(one.attributes.get("storage", ""), "")
    canvas.text(x + wide / 2, y + 12, mark, "small", "middle")
    canvas.text(x + wide / 2, y - 4, _text(one, "variable"), "mono", "middle")


def _value(canvas: Canvas, one: Element) -> None:
    (x, y), wide, high = _at(one), _size(one, "width"), _size(one, "height")
    canvas.box(x, y, wide, high)
    canvas.text(x + wide / 2, y + high - 6, _text(one, "expression"), "mono", "middle")


def _block(canvas: Canvas, one: Element) -> None:
    """A box with its type inside, its instance above, and its pins left and right."""
    (x, y), wide, high = _at(one), _size(one, "width"), _size(one, "height")
    canvas.box(x, y, wide, high)
    canvas.text(x + wide / 2, y - 5, one.attributes["instanceName"], "mono", "middle")
    canvas.text(x + wide / 2, y + 16, one.attributes["typeName"], "head", "middle")
    for tag, edge, inside, anchor in (("inputVariables", 0.0, 6, "start"), ("outputVariables", wide, -6, "end")):
        for pin in next(each for each in one.content if each.tag == tag).content:
            below = _point(next(_found(pin, "relPosition")))[1]
            canvas.text(x + edge + inside, y + below + 4, pin.attributes["formalParameter"], "mono", anchor)


_DRAWN = {
    "leftPowerRail": _rail, "rightPowerRail": _rail, "contact": _contact, "coil": _coil, "inVariable": _value,
    "outVariable": _value, "block": _block,
}  # fmt: skip
"""Tag -> how it is drawn."""


def _found(one: Element, tag: str) -> Iterator[Element]:
    """Elements of a tag, at any depth."""
    for each in one.content:
        if each.tag == tag:
            yield each
        yield from _found(each, tag)


def _text(one: Element, tag: str) -> str:
    return next(_found(one, tag)).text


def _point(one: Element) -> Point:
    return float(one.attributes["x"]), float(one.attributes["y"])


def _at(one: Element) -> Point:
    return _point(next(each for each in one.content if each.tag == "position"))


def _size(one: Element, name: str) -> float:
    return float(one.attributes[name])
