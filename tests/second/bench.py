"""A line with the second models on its wire, and a judge that looks after every scan."""

from collections.abc import Callable, Mapping
from typing import Any

from tests.second import atv312, chf, gd200a, jscc, mx2, pf4, profiles, sn300g5
from tests.second.drive import Drive
from tests.second.figures import CHAR_US
from tests.second.frames import ascii_ as ascii_frame
from tests.second.frames import rtu, runs
from tests.second.judge import VALUES, Asked, Judge
from tests.second.kinds import drive as model
from tests.second.line import RUNS, Bench
from tests.second.observer import Figures, Pins
from tests.second.station import IN_SEEN, RIVALS, SIZES, library, maps
from tests.second.wire import Exchange

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.maps.revision import checked
from structured_text.engines.engine import Library, Value

KIND = {"ATV312": "atv", "CHF": "chf", "GD200A": "gd", "JSCC": "jscc", "MX2": "mx", "PF4": "pf", "SN300G5": "sn"}
KIND |= {name: name.lower() for name in (*pf4.VARIANTS, *profiles.FAMILIES)}
MODELS = pf4.alike(
    {"ATV312": atv312, "CHF": chf, "GD200A": gd200a, "JSCC": jscc, "MX2": mx2, "PF4": pf4, "SN300G5": sn300g5}
)
STORES = {family: module.stores for family, module in MODELS.items()} | profiles.STORES
LISTED = 2
"""Rows after `PARAMETER` that each manual lists."""
SHORTEST = 4
"""Characters of a frame."""
METER = 40
"""Unit address of a meter, which shows two registers and has no motor."""
METERED = bytes((METER, 3, 0, 0, 0, 2))
"""What is asked of it, and no more."""
METER_US = 5000
"""How long it takes to answer."""
COUNTS = bytes((METER, 3, 4, 0x12, 0x34, 0x56, 0x78))
"""What it answers."""
STRANGERS = bytes((77, 3, 0, 1, 0, 1)), bytes((77, 3, 2, 0x12, 0x34))
"""A request of another master to a unit of its own, and what that answers, by turns."""
STOP_WITHIN_MS = {1: 7000, 3: 7000, 8: 14_000}
"""By drives on the line: 5 s for the motor, and twice what a round of reads takes."""
STALE_MS = {1: 5000, 3: 5000, 8: 12_000}
"""The same; with 8 drives, 19.2 kbit/s and scans of 40 ms the page of Reason 29 asks for more than the usual value."""
PANEL_US = 31_000_000
"""For how long a panel is remembered: the line forgets its frames after half a minute."""
CONTACT = 1 << (16 + 8 * IN_SEEN + 16)
"""The bit of `seen` that is HardStopOk."""
FOLLOW_US = {1: 2_000_000, 3: 2_000_000, 8: 3_000_000}
"""From a lowered reference to its frame, a lost one included; then the ramp."""
UNSEEN_US = {1: 500_000, 3: 1_200_000, 8: 3_000_000}
"""From one look at the status of a drive to the next."""


def figures(drives: int) -> Figures:
    """The pin's time, and for a block that is not called a second before the line stops its drive; then attempts."""
    return Figures(
        stop_us=1000 * STOP_WITHIN_MS[drives] + 1_800_000,
        coast_us=2_500_000,  # from 50 Hz it coasts for 10 s
        seen_us=1000 * STALE_MS[drives] + 500_000,
        follow_us=FOLLOW_US[drives],
        unseen_us=UNSEEN_US[drives],
    )


class Second(Bench):
    """A line of second models. The first drive is the one that things happen to."""

    def __init__(
        self,
        *types: str,
        options: Mapping[str, Mapping[str, Any]] | None = None,
        settings: Mapping[str, int] | None = None,
        stations: Library | None = None,
        seed: int = 0,
        ms: int = 20,
        ascii_: bool = False,
        pins: Mapping[str, Value] | None = None,
    ) -> None:
        """Power up. `options` of the models by family; `settings` of the first; `pins` of its block."""
        self.mode, self.start_pin, self.was_ms = "", "RunForward", ms
        """What the run that uses this bench is about: for events."""
        self.models: list[Drive] = []
        self.strange = False
        """Another master speaks."""
        self.strange_ms = 0
        """How often; 0: at random."""
        self.strange_us = 0
        """When it spoke last."""
        self.strangers: list[int] = []
        """When it has spoken."""
        self.acknowledged_us = 0
        """When somebody has last acknowledged its frames."""
        self.panel_ms, self.panel_us = 0, -(10**9)
        """How often a panel reads what we read of the first drive, and when it did last; 0: there is none."""
        self.unsaid = False
        """Nobody hears the first drive acknowledge a run."""
        self.mute: int | None = None
        """Nobody hears what it answers to requests about this register."""
        self.noise = 0
        """How often characters of nobody come right before a reply, in 1000."""
        self.lineless = False
        """The line is not called."""
        self.was_slow_port, self.metered = False, False
        """Its port has been one that sends late; a meter is on the line."""
        self.metered_us = 0
        """When it came, or was taken away."""
        self.flicker, self.wavers = "", False
        """A pin of the first drive that changes in every scan, and whether the references of the others do."""
        self.restarts_contact = False
        """The first-scan bit goes to the contact, too, at present."""
        self._later: list[tuple[int, int, bytes]] = []
        super().__init__(*types, stations=stations or library(), seed=seed, ms=ms, ascii_=ascii_, start=False)
        self.pins = [Pins(each) for each in self.pins]
        for index, kind in enumerate(types):
            given = dict((options or {}).get(kind, {}))
            given["settings"] = settings if settings and not index else {}
            if kind == "JSCC":
                given["reference_milli_hz"] = 10
            if kind == "ACS355":
                self.put(index, FrequencyScale=0.1)
            one = model(KIND[kind], index + 1, ascii=ascii_, char_us=CHAR_US, seed=seed + index, **given)
            self.models.append(one)
            if one.o.comm_us is not None:
                self.put(index, WatchdogMs=one.o.comm_us // 1000)
            self.put(index, StopWithinMs=STOP_WITHIN_MS[len(types)], StaleMs=STALE_MS[len(types)])
        self.put(0, **(pins or {})).line(MaxScanMs=60)
        self.judge = Judge(self, {i + 1: STORES[kind] for i, kind in enumerate(types)}, figures(len(types)))
        self.watch.append(lambda _: self._look())
        self.restart()

    def simulated(self, *_: object) -> list[SimulatedDrive]:
        """None: `models` answer."""
        return []

    # ------------------------------------------------------------ pins

    def put(self, drive: int = 0, /, **pins: Value) -> "Second":
        """As there, and for a twin on the first drive's slot."""
        super().put(drive, **pins)
        return self

    def line(self, **pins: Value) -> "Second":
        """As there; what stops all drives is a pin of each for the judge."""
        super().line(**pins)
        for name in {"StopAll", "Restart"} & set(pins):
            for each in self.pins:
                each[name] = pins[name]
        return self

    def leave(self, what: str, *, on: bool = True) -> "Second":
        """As there."""
        super().leave(what, on=on)
        if what == "SkipLine":
            self.lineless = on
        else:
            self.pins[int(what.removeprefix("Skip"))]["Left"] = on
        return self

    def twin(self, on: bool, address: int = 1) -> None:
        """A second block on the slot of the first drive."""
        self.block["UseTwin"] = on
        self.block["Twin.Address"] = address
        self.block["Twin.Enable"] = True
        self.block["Twin.MaximumHz"] = self.block["Twin.FullScaleHz"] = 50.0
        self.block["Twin.StopWithinMs"] = STOP_WITHIN_MS[len(self.types)]
        self.block["Twin.ManualChecked"] = checked(self.maps[0])
        if "KeepWord" in self.pins[0] and self.types[0] == "SN300G5":
            self.block["Twin.Settings.KeepWord"] = self.pins[0]["KeepWord"]
        self.pins[0]["Shared"] = on

    def other(self, *, on: bool, address: int = 1) -> None:
        """A block of another make on the slot of the first drive, where the station has one."""
        if len(self.types) != SIZES[1] or self.types[0] not in RIVALS:
            return
        pins = {"Address": address, "Enable": True, "MaximumHz": 50.0, "FullScaleHz": 50.0, "StopWithinMs": 7000}
        pins["ManualChecked"] = checked(maps()[RIVALS[self.types[0]]])
        for name, value in pins.items():
            self.block[f"Other.{name}"] = value
        self.block["UseOther"] = self.pins[0]["Shared"] = on

    def acknowledge(self) -> None:
        """A person acknowledges frames of others."""
        self.line(Acknowledge=True).run(100)
        self.line(Acknowledge=False)
        self.acknowledged_us = self.now

    def press(self) -> None:
        """A person presses the reset of the contact, and lets go."""
        self.hand = True
        self.block["Contact.Reset"] = True
        self.scan()
        self.block["Contact.Reset"] = self.hand = False

    def ask(
        self, name: str, index: int, address: int, *values: int, permitted: bool = True, commands: bool = False
    ) -> None:
        """A rising edge of a parameter block: where, and what; and whether its user permits what no manual has.

        Nobody can permit words of which one commands the motor.

        One that is at work goes on, and is not asked for anything else.
        """
        if any(each.name == name for each in self.judge.asked):
            return
        reads = name.startswith("Reader")
        if reads:
            self.models[index].ram.update(enumerate(values, address))
        listed = reads and len(values) <= LISTED  # those rows are in every manual, which needs no permission
        pins: dict[str, Value] = {"Address": address, "AllowUnknown": permitted and not listed}
        pins["Quantity"] = len(values)
        pins |= {} if reads else dict(zip(VALUES, values, strict=False))
        for pin, given in pins.items() if not name.startswith("Storer") else ():
            self.block[f"{name}.{pin}"] = given
        self.block[f"{name}.Execute"] = True
        if permitted:
            self.judge.observer.may_store.add(index + 1)
        shown = self.shows("CommOk", index), self.shows("StopConfirmed", index)
        most = min(self.models[index].MOST[3], len(VALUES)) if reads else self.models[index].MOST.get(16, 1)
        may = permitted and len(values) <= most and not commands
        self.judge.asked.append(Asked(name, index, address, values, self.now, len(self.frames), may, *shown))

    hand = False

    @property
    def strangely(self) -> bool:
        """Whether another master speaks, of whatever kind, or has just done."""
        return self.strange or bool(self.panel_ms) or self.now - self.panel_us < PANEL_US

    @property
    def damages(self) -> bool:
        """Whether replies are damaged."""
        return bool(self.faults.garbled or self.faults.truncated or self.noise)

    def deafened(self, drive: int) -> bool:
        """Whether it may count as dead: replies are lost; or, of eight drives, seldom asked, damaged or missing."""
        muted = not drive and self.mute is not None
        seldom = len(self.models) > 3 and (self.damages or muted)
        return bool(self.faults.lost or self.faults.unanswered or seldom)

    @property
    def contact(self) -> bool:
        """Whether the contact of the hard stop is closed."""
        return bool(self.seen & CONTACT)

    @property
    def promised_cut(self) -> int:
        """CutToContactMs."""
        value = self.block["TheLine.CutToContactMs"]
        assert isinstance(value, int)
        return value

    def turn_round(self, drive: int) -> int:
        """How long the line waits for an answer of the drive now, ms."""
        value = self.block[f"Drive{drive}.Diagnosis.TurnRoundMs"]
        assert isinstance(value, int)
        return value

    def characters_ms(self, count: int) -> int:
        """How long bytes of a frame take, in ms."""
        return CHAR_US * (2 * count + 2 if self.ascii else count) // 1000

    def reachable(self, drive: int) -> bool:
        """Whether the drive hears what is sent to the address of its pins."""
        return self.hears(drive) and self.models[drive].unit == self.pins[drive]["Address"]

    def hears(self, drive: int) -> bool:
        """Whether the drive hears what is sent to its own address."""
        one = self.models[drive]
        return one.powered and not one.cut and self.now >= one.deaf_us and drive + 1 not in self.deaf

    # ------------------------------------------------------------ time and wire

    def stall(self, ms: int) -> None:
        """A scan that comes late; beyond RestartMs it is a restart."""
        for each in self.pins if ms > 1000 else []:
            each["Restart"] = True
        self.scan(ms)
        for each in self.pins:
            each["Restart"] = self.line_pins.get("Restart", False)

    def slow_port(self, *, on: bool) -> None:
        """A port that sends a frame one scan after it has found it, and says that it may take two."""
        self.block["SlowPort"] = on
        self.was_slow_port = True
        self.block["Port.LateMs"] = 2 * self.ms if on else 0

    def meter(self, *, on: bool, address: int = METER) -> None:
        """A meter on the line, where there is a slot for it; else it has no address any more."""
        self.metered, self.metered_us = on and len(self.types) < 8, self.now
        self.judge.stores[METER] = lambda _: False
        self.block["Meter.Address"] = address if self.metered else 0
        self.block["Meter.Quantity"], self.block["Meter.TurnRoundMs"], self.block["Meter.LongestMs"] = 2, 30, 30
        self.call_meter(called=self.metered)

    def call_meter(self, *, called: bool) -> None:
        """Whether its block is called."""
        self.block["UseMeter"] = called and len(self.types) < 8

    def waits(self, unit: int) -> bool:
        """Whether a request to a unit waits for the port."""
        begins = b":" + f"{unit:02X}".encode() if self.ascii else bytes([unit])
        mine = self.mailbox(len(begins)) == begins
        return mine and self.block["Port.TxCount"] != 0 and self.block["Port.TxNumber"] != self.block["Port.TxTaken"]

    def _ask_as_panel(self) -> None:
        """A panel repeats our last read of the first drive; it waits until the wire is free, as our port does."""
        reads = (each.data for each in reversed(self.frames[-20:]) if each.unit == 1 and each.read)
        data = next(reads, b"")
        if not data or self.now - self.panel_us < 1000 * self.panel_ms:
            return
        self.panel_us = self.now
        raw = ascii_frame(data) if self.ascii else rtu(data)
        begins = max(self.now, self._free + 4 * CHAR_US)
        self.transmit(raw, begins, None)
        for at, text in self.models[0].receive(raw, begins + CHAR_US * len(raw)) if 1 not in self.deaf else []:
            self.transmit(text, at, None)

    def _look(self) -> None:
        self.judge.scan()
        if self.panel_ms:
            self._ask_as_panel()
        if self.flicker:
            self.put(0, **{self.flicker: not self.pins[0].get(self.flicker, False)})
        if self.wavers:
            for index in range(1, len(self.models)):
                self.put(index, SpeedReferenceHz=25.0 - self.now // 1000 % 7 / 20)  # as one of a potentiometer

    def _send(self) -> None:
        count = self.block["Port.TxCount"]
        assert isinstance(count, int)
        if count >= SHORTEST:
            self.judge.wire.posting()
            super()._send()
        else:
            self.judge.tell(-1, "frame", f"{count} characters")

    def _answer(self, frame: Any, data: bytes, end: int) -> None:
        raw = ascii_frame(data) if self.ascii else rtu(data)
        self.judge.sent(end, raw)
        self._hear_others(end)
        counts = ascii_frame(COUNTS) if self.ascii else rtu(COUNTS)
        if data[0] == METER:
            self.judge.once(0, "meter", bad=data != METERED, seen=(data.hex(),))
            self.transmit(counts, end + METER_US, None)
        replies: list[tuple[int, int, bytes]] = []
        for index, one in enumerate(self.models):
            if index + 1 in self.deaf:
                continue
            for at, text in one.receive(raw, end):
                unsaid = self.unsaid and not index and runs(self.types[0], data)
                muted = not index and int.from_bytes(data[2:4], "big") == self.mute
                if not (unsaid or muted) and not self._happens(self.faults.unanswered):
                    reply = (at, at + CHAR_US * len(text), self.judge.observer.opened(text) or b"")
                    replies.append(reply)
                    self._reply(index, text, at, frame if Exchange(data, end, [reply]).good else None)
        if data[0] == METER:
            replies.append((end + METER_US, end + METER_US + CHAR_US * len(counts), COUNTS))
        self.judge.answered(Exchange(data, end, replies))

    def _reply(self, index: int, text: bytes, at: int, frame: Any) -> None:
        if self._happens(self.faults.garbled):
            text, frame = self._garbled(text), None
        if self._happens(self.faults.truncated):
            text, frame = text[: self.chance.randrange(1, len(text))], None
        if self._happens(self.noise):
            noise = self.chance.randbytes(self.chance.randint(1, 3))
            text, frame = noise + text, None
        self.transmit(text, at, frame)
        self._later.append((at + CHAR_US * len(text), index, text))
        often = self.now - self.strange_us >= 1000 * self.strange_ms if self.strange_ms else self._happens(400)
        if self.strange and often:
            self.strange_us = self.now
            self.strangers.append(self.now)
            frame_of_others = STRANGERS[len(self.strangers) % len(STRANGERS)]
            other = ascii_frame(frame_of_others) if self.ascii else rtu(frame_of_others)
            self.transmit(other, at + CHAR_US * (len(text) + 6), None)
        if self._happens(self.faults.twice):
            self.transmit(text, at + CHAR_US * (len(text) + 6), None)

    def _hear_others(self, end: int) -> None:
        """The models hear each other's replies."""
        self._later.sort()
        while self._later and self._later[0][0] < end:
            at, who, text = self._later.pop(0)
            for index, one in enumerate(self.models):
                if index != who and index + 1 not in self.deaf:
                    one.receive(text, at)

    def told(self, about: int | None = None) -> str:
        """What blocks and models show, for messages: the first drive and another, or all."""
        shown = [
            f"{kind} {round(one.shaft_hz(self.now), 1):g} Hz by {one.by or 'nobody'} {one.state(self.now)},"
            f" block Reason {self.out('Reason', i)!r} State {self.out('State', i)!r}"
            for i, (kind, one) in enumerate(zip(self.types, self.models, strict=True))
            if about is None or i in (0, about)
        ]
        return f"{self.now // 1000} ms: {'; '.join(shown)}"

    def release(self, drive: int = 0) -> "Second":
        """All run and jog pins FALSE."""
        return self.put(drive, **dict.fromkeys(RUNS, False))

    def wait(self, test: Callable[[], object], ms: int) -> bool:  # type: ignore[override]  # until something is so, not for a time
        """Scan until something is so, or for so long."""
        end = self.now + 1000 * ms
        while not test():
            if self.now >= end:
                return False
            self.scan()
        return True
