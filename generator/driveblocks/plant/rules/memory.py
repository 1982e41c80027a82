"""Rules on the memory of the controller, by the estimates of docs/memory.md."""

from collections.abc import Collection

from driveblocks.desk.site.line import Line
from driveblocks.maps.decode import nearest
from driveblocks.maps.problem import Report
from driveblocks.plant.model import Plant
from driveblocks.platforms.cost import CODE_KIB, CPU_KB, FAMILY_KIB, kept
from driveblocks.render.library import CHINESE, LINE32, METER, PARAMETERS, PLANT


def check(plant: Plant, report: Report) -> None:
    """Note a controller that nobody has counted for."""
    if plant.cpu is not None and plant.cpu not in CPU_KB:
        near = nearest(plant.cpu.upper(), list(CPU_KB))
        right = f"did you mean `{near}`?" if near else f"write one of {', '.join(CPU_KB)}, or leave it out"
        report.add(plant.place("cpu"), f"the memory of `{plant.cpu}` is not known", right)


def fits(plant: Plant, lines: Collection[Line], report: Report, warnings: Report) -> None:
    """Note a plant that does not fit by any estimate; warn of one that may not."""
    has = 1000 * CPU_KB.get(plant.cpu or "", 0)
    if not has or not lines:
        return
    least, most = needed(plant, lines)
    families = len({each.map.prefix for each in plant.drives.values()})
    said = f"{_kb(least)} to {_kb(most)} kB by estimate, for {len(plant.drives)} drives of {families} families"
    right = "take a larger one, or fewer families; docs/memory.md says how it is counted"
    if least > has:
        report.add(plant.place("cpu"), f"{plant.cpu} has {has // 1000} kB, and the plant takes {said}", right)
    elif most > has:
        warnings.add(plant.place("cpu"), f"{plant.cpu} has {has // 1000} kB, and the plant may take {said}", right)


def needed(plant: Plant, lines: Collection[Line]) -> tuple[int, int]:
    """Bytes of code and data: with the smallest families, and with the largest."""
    families = len({each.map.prefix for each in plant.drives.values()})
    extras = {
        PLANT: True, LINE32: any(each.size > 8 for each in lines), METER: plant.meters, PARAMETERS: plant.meters,
        CHINESE: plant.language == "zh",
    }  # fmt: skip
    code = CODE_KIB[""] + sum(CODE_KIB[each] for each, has in extras.items() if has)
    data = sum(_data(each) for each in lines)
    return tuple(1024 * (code + families * each) + data for each in FAMILY_KIB)  # type: ignore[return-value]


def _data(line: Line) -> int:
    """Bytes of a line, its slots, its buffers and its drives."""
    known = line.library.compiler.checked
    drives = [f"{each.drive.prefix}_Drive" if each.drive else "MB_Device" for each in line.units]
    blocks = (known.blocks[each.upper()].type for each in (f"MB_ByteLine{line.size}", *drives))
    types = (known.types[each.upper()] for each in ("MB_Adu", "MB_LineFrame", f"MB_Slots{line.size}"))
    return sum(kept(each) for each in blocks if each) + sum(each.size for each in types)


def _kb(size: int) -> int:
    return round(size / 1000)
