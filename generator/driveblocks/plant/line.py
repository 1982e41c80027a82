"""The figures of the lines of a plant: those of their blocks, as `driveblocks line` computes them."""

from collections.abc import Collection
from dataclasses import replace
from decimal import Decimal

from driveblocks.desk.site import asked
from driveblocks.desk.site.line import Line
from driveblocks.maps.collection import Source
from driveblocks.meaning.serial import character
from driveblocks.plant.model import Motor, Plant
from structured_text.language.writing import real, word


def lines(plant: Plant, names: Collection[str] = ()) -> dict[str, Line]:
    """The lines of a plant, or some of them, without mistakes in what they are made of. Raises Refused."""
    some = {f"Bus_{at}": name for at, name in enumerate(names or plant.lines)}
    text = asked.program({bus: _sketch(plant, bus, name) for bus, name in some.items()})
    found = asked.of_text("line.st", text, sources(plant), plant.scan_ms)
    return {name: _tagged(plant, name, found[bus]) for bus, name in some.items()}


def sources(plant: Plant) -> list[Source]:
    """The maps of its drives, each once."""
    return list({each.path.resolve(): Source(each.path, each.map) for each in plant.drives.values()}.values())


def _sketch(plant: Plant, bus: str, name: str) -> asked.Sketch:
    way = plant.lines[name].way
    return asked.Sketch(
        drives=[
            asked.Typed(f"{bus}_Drive_{at}", each.map, each.unit, _settings(each))
            for at, each in enumerate(plant.on(name))
        ],
        devices=[asked.Device(each.unit, each.words, each.every_ms) for each in plant.meters_on(name)],
        rate=way.rate,
        bits=character(way.form).bits,
        ascii=way.mode == "ascii",
        max_scan=plant.longest_scan_ms,
    )


def _settings(motor: Motor) -> dict[str, object]:
    """What is set, as literals."""
    return {name: _literal(name, each) for name, each in motor.values.items()}


def _literal(name: str, value: Decimal) -> str:
    if name.endswith("Scale"):
        return real(float(value))
    return word(int(value)) if name == "KeepWord" else str(int(value))


def _tagged(plant: Plant, name: str, line: Line) -> Line:
    """A line whose units have their names in the plant."""
    tags = {each.unit: each.name for each in plant.on(name)} | {each.unit: each.name for each in plant.meters_on(name)}
    return replace(line, units=tuple(replace(each, name=tags[each.unit]) for each in line.units))
