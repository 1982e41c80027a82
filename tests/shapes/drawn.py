"""Maps drawn at random: each is a drive that nobody has built, and that `check` calls good.

`python -m tests.shapes.drawn SEED` prints one. tests/shapes/life.py plays a life of each.
"""

import re
import sys
from collections.abc import Sequence
from random import Random
from typing import Any

import yaml
from tests.shapes import seldom
from tests.shapes.sheet import Row, Sheet, bit, hexadecimal

BASES = (0x0100, 0x1000, 0x2000, 0x2100, 0x3000, 0x5000, 0x7000, 0x9000)
UNITS = {
    "output_current": ("Output current", "A", 0.1), "output_voltage": ("Output voltage", "V", 0.1),
    "dc_bus_voltage": ("DC bus voltage", "V", 1), "output_power": ("Output power", "kW", 0.01),
    "output_speed": ("Output speed", "r/min", 1), "output_torque": ("Output torque", "%", 0.1),
    "relative_power": ("Relative power", "%", 0.1), "drive_temperature": ("Temperature of the drive", "°C", 1),
    "motor_temperature": ("Temperature of the motor", "°C", 0.1), "operating_time": ("Hours", "h", 1),
    "energy": ("Energy", "kWh", 0.1),
}  # fmt: skip
SCALED_BY_SETTING = ("output_current", "output_voltage", "dc_bus_voltage", "output_power")
LOOKED_FOR = (
    "serial", "identity", "watchdog", "warnings", "commanded_by", "own_maximum", "lower_limit", "trip_output",
)  # fmt: skip
"""What a map has, or says that it is absent."""
LANGUAGES = ("en", "en", "zh", "de")
TIMES = {"trips": "Trip", "coast_stop": "Coast stop", "stop": "Stop by the ramp", "runs_on": "Run on"}


# ---------------------------------------------------------------- commands


def by_values(sheet: Sheet, at: int) -> None:
    """One word, one value for each command."""
    kinds = {"run_forward": ("Run forward", ["starts"]), "run_reverse": ("Run reverse", ["starts", "reverses"]),
             "stop": ("Stop", ["stops"])}  # fmt: skip
    if sheet.maybe():
        kinds |= {"jog_forward": ("Jog forward", ["jogs"]), "jog_reverse": ("Jog reverse", ["jogs", "reverses"]),
                  "jog_stop": ("End of the jog", ["ends_jog"])}  # fmt: skip
    kinds |= some(sheet, {
        "quick_stop": ("Quick stop", ["quick_stops"]), "coast_stop": ("Coast stop", ["coasts"]),
        "fault_reset": ("Fault reset", ["resets"]),
    })  # fmt: skip
    values = sheet.chance.sample(range(1, 40), len(kinds))
    listed = [sheet.named(name, value=value, does=does) | seldom.counting(sheet, does)
              for value, (name, does) in zip(values, kinds.values(), strict=True)]  # fmt: skip
    sheet.words.append(sheet.named("Run command", address=sheet.place(at), values=listed))
    sheet.commands += [{"does": does, "register": sheet.place(at), "value": value, "source": "table 1"}
                       for does, value in zip(kinds, values, strict=True)]  # fmt: skip


def some(sheet: Sheet, of: dict[str, Any], part: float = 0.6) -> dict[str, Any]:
    """Some of these."""
    return {name: each for name, each in of.items() if sheet.maybe(part)}


def by_bits(sheet: Sheet, at: int) -> None:
    """A run bit by its level, a bit for the direction; perhaps active low, perhaps stops and a reset of their own."""
    run, back, reset, quick, coast = sheet.bits(5)
    low = sheet.maybe(0.3)
    rows: list[Row] = [{"bit": bit(run), **({"does": ["stops"], "at_0": ["starts"], "symbol": "NoRun"} if low else
                                 {"does": ["starts"], "at_0": ["stops"]})} | sheet.named("Run"),
            {"bit": bit(back), "does": ["reverses"]} | sheet.named("Reverse")]  # fmt: skip
    off = "set" if low else "clear"
    word = sheet.place(at)
    ways: dict[str, dict[str, list[int]]] = {
        "run_forward": {"set": [run], "clear": [back]}, "run_reverse": {"set": [run, back]}, "stop": {off: [run]},
    }  # fmt: skip
    if low:
        ways |= {"run_forward": {"clear": [run, back]}, "run_reverse": {"clear": [run], "set": [back]}}
    if sheet.maybe():
        rows.append({"bit": bit(reset), "does": ["resets"]} | sheet.named("Fault reset"))
        ways["fault_reset"] = {"set": [reset]} | ({"set": [reset, run]} if low else {"clear": [run]})
    if sheet.maybe(0.4):
        rows.append({"bit": bit(quick), "does": ["quick_stops"], "holds": True} | sheet.named("Quick stop"))
        ways["quick_stop"] = {"set": [quick, run]} if low else {"set": [quick], "clear": [run]}
    if sheet.maybe(0.4):
        rows.append({"bit": bit(coast), "does": ["coasts"], "holds": True} | sheet.named("Coast stop"))
        ways["coast_stop"] = {"set": [coast, run]} if low else {"set": [coast], "clear": [run]}
    used = {each for row in rows for each in (int(str(row["bit"]), 16),)}
    stops = {"quick_stop": quick, "coast_stop": coast}
    for does, way in ways.items():
        own = way.get("set", [])
        others = [each for name, each in stops.items() if name in ways and each not in own]
        others += [reset] if "fault_reset" in ways and reset not in own else []
        way["clear"] = sorted({*way.get("clear", []), *others} & used)
        hexed = {key: [bit(each) for each in numbers] for key, numbers in way.items() if numbers}
        sheet.commands.append({"does": does, "register": word, **hexed, "source": "table 1"})
    sheet.words.append(sheet.named("Run command", address=word, bits=rows))


def by_pulse(sheet: Sheet, at: int) -> None:
    """Start and stop by edges, each bit back at 0 after a pulse."""
    forward, reverse, stop, reset = sheet.bits(4)
    word, table = sheet.place(at), {"source": "table 1"}
    rows = [sheet.named("Start forward", bit=bit(forward), does=["starts"], by="edge"),
            sheet.named("Start reverse", bit=bit(reverse), does=["starts", "reverses"], by="edge"),
            sheet.named("Stop", bit=bit(stop), does=["stops"]),
            sheet.named("Fault reset", bit=bit(reset), does=["resets"])]  # fmt: skip
    sheet.words.append(sheet.named("Run command", address=word, bits=rows))
    every = {forward, reverse, stop}
    for does, own in (("run_forward", forward), ("run_reverse", reverse)):
        others = [bit(each) for each in every - {own}]
        pulse = {"register": word, "set": [bit(own)], "clear": others, "for_ms": sheet.chance.choice((50, 100, 250))}
        sheet.commands.append({"does": does, "register": word, "clear": [bit(each) for each in every], "first": [pulse],
                               **table})  # fmt: skip
    sheet.commands.append({"does": "stop", "register": word, "set": [bit(stop)],
                           "clear": [bit(forward), bit(reverse)], **table})  # fmt: skip
    pulse = {"register": word, "set": [bit(reset)], "for_ms": 50}
    sheet.commands.append({"does": "fault_reset", "register": word, "clear": [bit(reset)], "first": [pulse], **table})


def by_path(sheet: Sheet, at: int) -> None:
    """The states of PROFIdrive, its bits in their places."""
    word, because = sheet.place(at), "the ramp stays enabled"
    held = {"holds": True}
    rows = [sheet.named("Switch on", bit=0, does=["starts"], by="edge", at_0=["stops"]),
            sheet.named("No coast stop", bit=1, does=["enables"], at_0=["coasts"], **held),
            sheet.named("No quick stop", bit=2, does=["enables"], at_0=["quick_stops"], **held),
            sheet.named("Enable operation", bit=3, does=["enables"], at_0=["coasts"], **held),
            *(sheet.named(name, bit=number, does=["enables"]) for number, name in enumerate(
                ("Enable ramp", "Release ramp", "Enable setpoint"), start=4)),
            sheet.named("Acknowledge fault", bit=7, does=["resets"], by="edge"),
            sheet.named("Control by PLC", bit="A", does=["enables"], at_0=["hands_over"]),
            sheet.named("Reverse", bit="B", does=["reverses"])]  # fmt: skip
    sheet.words.append(sheet.named("Control word", address=word, bits=rows))
    step: Row = {"register": word, "value": "047EH", "until": "ready_to_switch_on"}
    if sheet.maybe(0.3):
        step["for_ms"] = 100
    ways: dict[str, tuple[str, list[Row]]] = {
        "run_forward": ("047FH", [step]),
        "run_reverse": ("0C7FH", [step]),
        "stop": ("047EH", []),
    }
    ways |= some(sheet, {"quick_stop": ("047AH", []), "coast_stop": ("047CH", []),
                         "fault_reset": ("04FEH", [{"register": word, "value": "047EH"}])})  # fmt: skip
    for does, (value, first) in ways.items():
        sheet.commands.append({"does": does, "register": word, "value": value, "because": because, "source": "table 1"}
                              | ({"first": first} if first else {}))  # fmt: skip


def by_two(sheet: Sheet, at: int) -> None:
    """The direction has a register of its own."""
    turns, run = sheet.place(at + 2), sheet.place(at)
    values = sheet.chance.sample(range(1, 9), 3)
    sheet.words.append(
        sheet.named(
            "Direction",
            address=turns,
            values=[
                sheet.named("Forward", value=0, does=["forward"]),
                sheet.named("Reverse", value=1, does=["reverses"]),
            ],
        )
    )
    kinds = [("Stop", 0, "stops"), ("Run", values[0], "starts"), ("Coast", values[1], "coasts"),
             ("Reset", values[2], "resets")]  # fmt: skip
    sheet.words.append(
        sheet.named(
            "Run command",
            address=run,
            values=[sheet.named(name, value=value, does=[does]) for name, value, does in kinds],
        )
    )
    for does, value, way in (("run_forward", values[0], 0), ("run_reverse", values[0], 1), ("stop", 0, None),
                             ("coast_stop", values[1], None), ("fault_reset", values[2], None)):  # fmt: skip
        first = [] if way is None else [{"register": turns, "value": way}]
        sheet.commands.append({"does": does, "register": run, "value": value, "source": "table 1"}
                              | ({"first": first} if first else {}))  # fmt: skip


def by_coils(sheet: Sheet, _: int) -> None:
    """A coil runs, another one turns round, a third resets."""
    run, turns, again = (sheet.place(0x0100 + number, "coil") for number in range(3))
    kinds = {run: ("Run command", ("Stop", "stops"), ("Run", "starts")),
             turns: ("Direction", ("Forward", "forward"), ("Reverse", "reverses")),
             again: ("Fault reset", ("Nothing", "nothing"), ("Reset", "resets"))}  # fmt: skip
    for place, (name, *values) in kinds.items():
        listed = [sheet.named(own, value=value, does=[does]) for value, (own, does) in enumerate(values)]
        sheet.coils.append(sheet.named(name, address=place, values=listed))
    for does, value, way in (("run_forward", 1, 0), ("run_reverse", 1, 1), ("stop", 0, None)):
        first = [] if way is None else [{"register": turns, "value": way}]
        sheet.commands.append({"does": does, "register": run, "value": value, "source": "table 1"}
                              | ({"first": first} if first else {}))  # fmt: skip
    pulse = {"register": again, "value": 1, "for_ms": 50}
    sheet.commands.append({"does": "fault_reset", "register": again, "value": 0, "source": "table 1", "first": [pulse]})


SHAPES = (by_values, by_values, by_bits, by_bits, by_pulse, by_path, by_two, by_coils)


# ---------------------------------------------------------------- reference, status, measures


def reference(sheet: Sheet, at: int) -> Row:
    """How the speed is given; where its sign reverses, no other command does."""
    means = sheet.chance.choice(("frequency", "frequency", "percent_of_maximum", "fraction_of_full_scale", "speed"))
    row = sheet.named("Speed reference", address=sheet.place(at))
    said: Row = {"register": row["address"], "means": means, "source": "table 1"}
    if means == "fraction_of_full_scale":
        said |= {"full_scale": hexadecimal(sheet.chance.choice((0x4000, 10000, 0x2000)))}
        said |= {"full_scale_hz": 50} if sheet.maybe() else {"maximum": "P1.01"}
    else:
        unit, factor = {"frequency": ("Hz", sheet.chance.choice((0.01, 0.1))), "percent_of_maximum": ("%", 0.01),
                        "speed": ("r/min", sheet.chance.choice((1, 0.5)))}[means]  # fmt: skip
        row |= {"unit": unit, "scale": {"factor": factor, "source": "table 1"}}
        if means == "percent_of_maximum":
            said["maximum"] = "P1.01"
        if sheet.maybe(0.2):
            needed = {"value": 1, "why": "the scale of the reference rests on it"}
            unit = sheet.setting(11, "Unit of the reference", values=sheet.listed("Small", "Large"), needed=needed)
            row["scale"]["needs"] = {"setting": unit, "value": 1}
    sheet.words.append(row)
    if sheet.maybe(0.2):
        back = next(each for each in sheet.commands if each["does"] == "run_reverse")
        forward = next(each for each in sheet.commands if each["does"] == "run_forward")
        back.clear()
        back |= forward | {"does": "run_reverse", "negative": True}
        row["signed"], said["negative_reverses"] = True, True
    return said


def status_inputs(sheet: Sheet, _: int) -> None:
    """Discrete inputs, each a sign of its own."""
    kinds = {"running": "Running", "reverse": "Turns in reverse"} | some(sheet, {"fault": "Fault", "ready": "Ready"})
    for number, (kind, name) in enumerate(kinds.items()):
        place = sheet.place(0x0200 + number, "discrete")
        sheet.inputs.append(sheet.named(name, address=place))
        sheet.status[kind] = {"register": place, "equals": 1}
    sheet.status["standstill"] = sheet.status["running"] | {"equals": 0}


def status_word(sheet: Sheet, at: int) -> None:
    """Bits in any place; what pins show of them."""
    word = sheet.place(at)
    if any("until" in step for one in sheet.commands for step in one.get("first", ())):
        names = {"Ready to switch on": 0, "Ready to operate": 1, "Operation enabled": 2, "Fault": 3,
                 "Switching on inhibited": 6, "Warning": 7, "Speed reached": 8, "Turns in reverse": 14}  # fmt: skip
        sheet.states.append({"name": "ready_to_switch_on", "register": word, "mask": "0045H", "equals": "0001H",
                             "source": "table 2"})  # fmt: skip
        running = {"register": word, "mask": "0007H", "equals": "0007H"}
        sheet.status |= {"running": running, "ready": {"register": word, "mask": "0041H", "equals": "0001H"}}
        shown = {"reverse": 14, "fault": 3, "warning": 7, "at_speed": 8}
        still = {"register": word, "bit": 2, "equals": 0}
    else:
        kinds = {"running": "Running", "reverse": "Turns in reverse"} | some(sheet, {
            "fault": "Fault", "ready": "Ready", "at_speed": "Speed reached", "warning": "Warning",
            "limit": "Limit reached"})  # fmt: skip
        shown = dict(zip(kinds, sheet.bits(len(kinds)), strict=True))
        names = {name: shown[kind] for kind, name in kinds.items()}
        still = {"register": word, "bit": bit(shown["running"]), "equals": 0}
    sheet.status |= {kind: {"register": word, "bit": bit(number), "equals": 1} for kind, number in shown.items()
                     if kind not in sheet.status}  # fmt: skip
    sheet.status["standstill"] = still
    rows = [sheet.named(name, bit=bit(number)) for name, number in names.items()]
    free = sorted({*range(16)} - {*names.values()})
    if sheet.maybe(0.3):
        rows.append({"bit": bit(free[0]), "unused": True})
    sheet.shown.append(sheet.named("Drive status", address=word, bits=rows))


def measures(sheet: Sheet, at: int) -> list[Row]:
    """The output frequency, and some others, in any order."""
    found, place = [], at
    kinds = ["output_frequency", *sheet.chance.sample(sorted(UNITS), min(sheet.chance.randint(0, 6), 5))]
    sheet.chance.shuffle(kinds)
    for kind in kinds:
        name, unit, factor = UNITS.get(kind, ("Output frequency", "Hz", sheet.chance.choice((0.01, 0.1))))
        wide = kind in ("energy", "operating_time") and sheet.maybe()
        row = sheet.named(name, address=sheet.place(place), unit=unit)
        if wide:
            row |= {"address": f"{sheet.place(place)}-{sheet.place(place + 1)}", "words": 2}
            row |= {"order": "low_first"} if sheet.maybe() else {}
        if not (kind in SCALED_BY_SETTING and sheet.maybe(0.2)):
            row["scale"] = {"factor": factor, "source": "table 2"}
            if kind == "output_current" and sheet.maybe(0.4):
                row["scale"] |= decimals(sheet, at + 0x40, factor)
        if kind in ("output_torque", "output_speed") and sheet.maybe():
            row["signed"] = True
        if sheet.maybe(0.1):
            row["note"] = "the mean of a second"
        sheet.shown.append(row)
        found.append({"shows": kind, "register": sheet.place(place), "source": "table 2"})
        place += 1 + wide + (sheet.maybe(0.3) and sheet.chance.randint(1, 9))
    return found


def decimals(sheet: Sheet, at: int, factor: float) -> Row:
    """A register says how many decimals a measure has."""
    sheet.shown.append(
        sheet.named(
            "Decimals",
            address=sheet.place(at),
            bits=[{"bit": "0-7", "unused": True}, sheet.named("Decimals of the current", bit="8-F")],
        )
    )
    when = [{"register": sheet.place(at), "bit": "8-F", "equals": number} for number in (1, 2)]
    return {"when": when[0], "otherwise": [{"factor": factor / 10, "when": when[1], "source": "table 2"}]}


# ---------------------------------------------------------------- faults, serial line, settings


def faults(sheet: Sheet, at: int) -> Row:
    """Codes in a register; perhaps with warnings in its other half, or in a register of their own."""
    codes = sheet.chance.sample(range(1, 120), sheet.chance.randint(1, 12))
    half = sheet.maybe(0.2)
    row = sheet.named("Present fault", address=sheet.place(at))
    if half:
        row["bits"] = [sheet.named("Fault code", bit="0-7"), sheet.named("Other code", bit="8-F")]
    sheet.shown.append(row)
    made: Row = {"source": "table 3", "registers": [sheet.place(at)], "present": sheet.place(at)}
    made |= {"present_bits": "0-7"} if half else {}
    made["codes"] = [sheet.named(f"Trouble {code}", code=f"{code:02X}H", id=f"E{code}") for code in codes]
    if sheet.maybe(0.4):
        motor = sheet.chance.choice(("coasts", "ramps", "differs"))
        made["trip_output"] = {"motor": motor, "source": "table 3"} | (
            {"note": "by the fault"} if motor == "differs" else {}
        )
    return made


def warnings(sheet: Sheet, at: int, faults: Row) -> Row:
    """Warning codes in a register of their own, or in the other half of the present fault."""
    half = "present_bits" in faults and sheet.maybe(0.7)
    if not half:
        sheet.shown.append(sheet.named("Present warning", address=sheet.place(at)))
    where = {"register": faults["present"], "bits": "8-F"} if half else {"register": sheet.place(at)}
    return {"source": "table 4", **where,
            "codes": [sheet.named(f"Care {code}", code=f"{code:02X}H") for code in (5, 9)]}  # fmt: skip


def serial(sheet: Sheet) -> Row:
    """Rates, formats, addresses; some fixed, some chosen by settings."""
    made: Row = {"interface": sheet.text("RS-485"), "mode": {"modes": ["rtu"], "source": "section 1"}}
    why: Row = {"why": "as the PLC has it"}
    source: Row = {"source": "section 1"}
    if sheet.maybe(0.7):
        rates = sorted(sheet.chance.sample((4800, 9600, 19200, 38400, 57600, 115200), 3))
        rows = [{"code": code, "baud": rate} for code, rate in enumerate(rates)]
        setting = sheet.setting(2, "Bit rate", default="1", needed=why, range={"min": 0, "max": 2})
        made["baud"] = {"setting": setting, "default": 1, "codes": rows} | source
    if sheet.maybe(0.7):
        forms = enumerate((("none", 2), ("even", 1), ("odd", 1), ("none", 1)))
        codes = [
            {"code": code, "parity": parity, "data_bits": 8, "stop_bits": stops} for code, (parity, stops) in forms
        ]
        setting = sheet.setting(3, "Format", needed=why, range={"min": 0, "max": 3})
        made["format"] = {"setting": setting, "default": sheet.chance.randint(0, 3), "codes": codes} | source
    made["unit"] = source | {"min": 1, "max": sheet.chance.choice((32, 99, 247))}
    if sheet.maybe():
        first = sheet.chance.choice((0, 1))
        limits: Row = {"min": 0, "max": made["unit"]["max"]}
        setting = sheet.setting(0, "Unit address", needed=why, default=str(first), range=limits)
        made["unit"] |= {"setting": setting, "default": first}
        made["unit"] |= {} if first else {"no_address": 0}
    if sheet.maybe(0.3):
        kinds: tuple[Row, ...] = ({"characters": 3.5}, {"milliseconds": 10}, {"characters": 3.5, "gap_characters": 1.5})
        made["silence"] = source | sheet.chance.choice(kinds)
    if sheet.maybe(0.3):
        setting = sheet.setting(6, "Delay of replies", default="5", range={"min": 0, "max": 50})
        made["reply_delay"] = {"setting": setting, "milliseconds": 1} | source
    if sheet.maybe(0.3):
        made["broadcast"] = source | {"address": 0, "replies": False}
    return made


def watchdog(sheet: Sheet, code: str, speed: str, at: int) -> Row:
    """What the drive does when its line is silent."""
    does = sheet.chance.sample(sorted(TIMES), sheet.chance.randint(1, 3))
    made: Row = {"source": "section 1", "reactions": [{"does": does[0]}]}
    feeds: tuple[Row, ...] = ({"feeds": "any"}, {"feeds": "reads"}, {"feeds": "writes"}, {"fed_by": [speed]}, {})
    made |= sheet.chance.choice(feeds)
    made |= sheet.chance.choice(({}, {"counts": "running"}, {"counts": "always"}, {"counts": "bus_in_command"}))
    if len(does) > 1:
        names = sheet.listed(*(TIMES[each] for each in does))
        made["chosen_by"] = sheet.setting(5, "Reaction to silence", needed={"why": "never run on"}, values=names)
        made["reactions"] = [{"value": at, "does": each} for at, each in enumerate(does)]
    if sheet.maybe(0.7):
        setting = sheet.setting(4, "Time-out", range={"min": 0, "max": 600}, needed={"why": "0 is off"})
        made["time"] = {"setting": setting, "milliseconds": 100, "source": "section 1"}
        made["disabled_by"] = {"setting": setting, "value": 0}
    elif sheet.maybe(0.3):
        sheet.shown.append(sheet.named("Time-out", address=sheet.place(at)))
        made["time"] = {"register": sheet.place(at), "milliseconds": 100, "source": "section 1"}
    if "disabled_by" not in made and made["reactions"] == [{"does": "runs_on"}]:
        made["reactions"] = [{"does": "trips"}]
    if any(each["does"] == "trips" for each in made["reactions"]):
        made["fault"] = code
    return made


def storage(sheet: Sheet, at: int) -> Row:
    """Whether a written parameter is kept."""
    for number, (name, unit) in enumerate((("Maximum frequency", "Hz"), ("Ramp up", "s"), ("Ramp down", "")), start=1):
        keys = {"unit": unit, "scale": {"factor": 0.1, "source": "table 4"}} if unit else {}
        sheet.words.append(sheet.named(name, id=f"P1.0{number}", address=sheet.place(at + number), **keys))
    kind = sheet.chance.choice(("unexplained", "volatile", "enter_register", "ram_twin"))
    made: Row = {"method": kind, "source": "section 4", "note": "as section 4 says"}
    if kind == "enter_register":
        sheet.words.append(sheet.named("Store all", address=sheet.place(at + 0x20)))
        made |= {"register": sheet.place(at + 0x20), "value": 1}
    elif kind == "ram_twin":
        sheet.words.append(sheet.named("Ramp up in RAM", address=sheet.place(at + 0x30)))
        made["twins"] = [{"stored": sheet.place(at + 2), "ram": sheet.place(at + 0x30)}]
    return made


# ---------------------------------------------------------------- the map


def table(name: str, access: str, rows: Sequence[Row], title: Row, space: str = "") -> Row:
    """A table of registers; one of another space names it once."""
    own = [row | {"address": row["address"].removeprefix(f"{space} ")} for row in rows]
    made = {"id": name, "title": title, "source": "table 1", "access": access, "registers": own}
    return made | ({"space": space} if space else {})


def draw(seed: int) -> Row:
    """A map."""
    chance = Random(f"map {seed}")
    sheet = Sheet(chance, chance.choice(LANGUAGES), chance.choice((0, 0, 0, 1, 40001)))
    if sheet.numbers and sheet.maybe():
        sheet.tables = {"coil": 1, "discrete": 10001, "input": 30001}
    commands, shown, values, parameters = chance.sample(BASES, 4)
    chance.choice(SHAPES)(sheet, commands)
    speed = reference(sheet, commands + 1)
    path = any("until" in step for one in sheet.commands for step in one.get("first", ()))
    (status_word if path or sheet.maybe(0.9) else status_inputs)(sheet, shown)
    measured = measures(sheet, values)
    trouble = faults(sheet, values + 0x80)
    memory = storage(sheet, parameters)
    operation: Row = {"commands": sheet.commands, "reference": speed}
    stands = next(each["register"] for each in measured if each["shows"] == "output_frequency")
    operation["standstill"] = {"all": [sheet.status.pop("standstill"), {"register": stands, "equals": 0}],
                               "source": "table 2", "why": "it does not run, and its frequency is 0"}  # fmt: skip
    operation["status"] = [{"shows": kind, "any": [one], "source": "table 2"} for kind, one in sheet.status.items()]
    operation |= {"measures": measured} | ({"states": sheet.states} if sheet.states else {})
    if sheet.maybe(0.3):
        operation["own_maximum"] = {"register": sheet.place(parameters + 1), "source": "table 4"}
    made = head(sheet, seed) | {"serial": serial(sheet)}
    more: Row = {"storage": memory, "operation": operation, "faults": trouble}
    more |= {"warnings": warnings(sheet, values + 0x90, trouble)} if sheet.maybe(0.3) else {}
    if sheet.maybe(0.6):
        more["watchdog"] = watchdog(sheet, trouble["codes"][0]["code"], speed["register"], values + 0xF0)
    if sheet.maybe(0.3):
        sheet.shown.append(sheet.named("Product code", address=sheet.place(values + 0xA0)))
        more["identity"] = {"all": [{"register": sheet.place(values + 0xA0), "equals": hexadecimal(seed % 60000 + 1)}],
                            "source": "table 2", "why": "each family has a code of its own"}  # fmt: skip
    made |= rest(sheet)
    if sheet.maybe():
        operation["lower_limit"] = sheet.setting(8, "Lowest frequency", default="0", range={"min": 0, "max": 500})
    made |= {"settings": sheet.settings, "sections": [], **more}
    seldom.add(sheet, made, (commands, shown, values, parameters))
    made["sections"] = tables(sheet, made["sections"])
    said = {*made, *operation, *(["trip_output"] if "trip_output" in trouble else [])}
    made["absent"].append({"what": "what is missing here", "about": [each for each in LOOKED_FOR if each not in said],
                           "matters": "nobody knows", "find_out": "ask the maker"})  # fmt: skip
    seldom.last(sheet, made, measured)
    return made


def tables(sheet: Sheet, others: Sequence[Row]) -> list[Row]:
    """All tables of registers, each of which has rows."""
    made = [table("commands", "rw", sheet.words, sheet.text("Commands")), *others,
            table("status", "r", sheet.shown, sheet.text("Status")),
            table("coils", "rw", sheet.coils, sheet.text("Coils"), "coil"),
            table("inputs", "r", sheet.inputs, sheet.text("Inputs"), "discrete")]  # fmt: skip
    return [each for each in made if each["registers"]]


def head(sheet: Sheet, seed: int) -> Row:
    """Who makes it, and how its manual numbers registers."""
    made: Row = {"format": 2, "prefix": f"DR{seed % 1000}", "id_forms": ["A9.99"]}
    made |= {"vendor": sheet.text("Drawn"), "family": sheet.text(f"Drawn {seed}")}
    made["manual"] = {"language": sheet.language, "title": sheet.text("Manual"), "publisher": sheet.text("Drawn")}
    if sheet.maybe(0.2):
        made["manual"]["edition"] = "2026"
    if sheet.numbers:
        how = {"says": "less the first is sent", "source": "section 2"}
        made["numbering"] = {"first": sheet.numbers, **how, **sheet.tables}
    return made


def rest(sheet: Sheet) -> Row:
    """Limits, functions, refusals, and what the manual tells in prose."""
    functions = {3: "Read registers", 6: "Write register"} | ({16: "Write registers"} if sheet.maybe() else {})
    functions |= {1: "Read coils", 5: "Write coil"} if sheet.coils else {}
    functions |= {2: "Read discrete inputs"} if sheet.inputs else {}
    most = sheet.chance.choice((2, 8, 16, 100) if any("words" in row for row in sheet.shown) else (1, 2, 8, 16, 100))
    made: Row = {"limits": {"read_words": {"value": most, "source": "section 2"}}}
    made["functions"] = [sheet.named(name, code=f"{code:02X}H", source="section 2") for code, name in functions.items()]
    made["errors"] = {"source": "section 3", "codes": [sheet.named("Illegal address", code="02H")]}
    if sheet.maybe(0.3):
        made["errors"]["codes"].append(sheet.named("Busy", code="06H", busy=True))
    if sheet.maybe(0.3):
        made["errors"]["form"] = {"kind": "exception", "add": "80H", "source": "section 3"}
    made["notices"] = [{"kind": kind, "text": sheet.text("Mind the shaft."), "source": "section 1"}
                       for kind in ("prohibition", "warning", "hazard", "procedure") if sheet.maybe(0.2)]  # fmt: skip
    made |= {"frames": [], "errata": []}
    made["absent"] = [{"what": "how warm it may get", "about": ["serial"], "matters": "it wears out",
                       "find_out": "ask the maker"}]  # fmt: skip
    return made


def sister(seed: int, base: str) -> Row:
    """A map that says only what is different from the one of this seed, which is its base."""
    made = draw(seed)
    own: Row = {key: made[key] for key in ("format", "vendor", "manual")}
    own |= {"base": base, "prefix": f"SI{seed % 1000}", "family": made["family"] | {"en": f"Sister {seed}"}}
    gone = [f"operation > measures > {each['shows']}" for each in made["operation"]["measures"]
            if each["shows"] != "output_frequency"]  # fmt: skip
    return own | ({"without": gone[:1]} if gone else {})


def text(seed: int) -> str:
    """A map as a file."""
    return written(draw(seed))


def written(rows: Row) -> str:
    """A map as a file, row by row."""
    return yaml.dump(rows, Dumper=_Plain, allow_unicode=True, sort_keys=False, width=118)


class _Plain(yaml.SafeDumper):
    """Every row is written out."""

    def ignore_aliases(self, _: object) -> bool:
        """Maps have none."""
        return True


def _quoted(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    """A text that could be read as a number is quoted."""
    style = '"' if re.fullmatch(r"[0-9]+(E[0-9]+)?", text) else None
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=style)


_Plain.add_representer(str, _quoted)


if __name__ == "__main__":
    print(text(int(sys.argv[1])))
