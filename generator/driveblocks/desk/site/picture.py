"""A picture of one round of a line: who speaks when, and what is lost to whole scans."""

from driveblocks.desk.site.line import Figures
from driveblocks.docs.canvas import Canvas

LEFT, RIGHT, TOP, LANE, WIDTH = 170, 30, 78, 26, 1000
LEGEND = ("mark", "request"), ("band", "until the reply begins"), ("rail", "reply")
MOST_MARKS = 60
"""Of scans that are drawn each; of more, every tenth or hundredth."""


def drawn(figures: Figures) -> str:
    """The text of the SVG file: a lane for each unit, time in ms from left to right, a line for each scan."""
    line, count = figures.line, len(figures.spent)
    title = f"One round of polls: {count} {'units' if count > 1 else 'unit'}, {figures.rate} bit/s, {figures.round} ms"
    bottom = TOP + LANE * count
    canvas = Canvas(title, WIDTH, bottom + 46)
    canvas.text(LEFT, 26, title, "head")
    for at, (kind, text) in enumerate(LEGEND):
        canvas.box(LEFT + 180 * at, 40, 14, 12, kind)
        canvas.text(LEFT + 180 * at + 20, 51, text, "small")
    scale = (WIDTH - LEFT - RIGHT) / figures.round
    scans = figures.round // line.scan
    step = next(each for each in (1, 10, 100, 1000) if scans / each <= MOST_MARKS)
    for scan in range(0, scans + 1, step):
        x = LEFT + scan * line.scan * scale
        canvas.path([(x, TOP - 6), (x, bottom)], "thin")
    for scan in dict.fromkeys((0, scans // 2, scans)):
        canvas.text(LEFT + scan * line.scan * scale, bottom + 16, f"{scan * line.scan} ms", "small", "middle")
    every = "each scan" if step == 1 else f"every {step} scans"
    canvas.text(LEFT, bottom + 34, f"A line for {every} of {line.scan} ms. A request is sent in a scan.", "small")
    begin = 0
    for lane, each in enumerate(figures.spent):
        y = TOP + LANE * lane
        canvas.text(LEFT - 12, y + 15, f"{each.unit.name} ({each.unit.unit})", "small", "end")
        x = LEFT + (begin + line.port_late / 2) * scale  # half of the delay before the request, half after the reply
        for kind, ms in (("mark", each.request), ("band", float(line.reply)), ("rail", each.reply)):
            canvas.box(round(x, 2), y + 4, round(ms * scale, 2), LANE - 10, kind)
            x += ms * scale
        begin += each.scans * line.scan
    return canvas.svg()
