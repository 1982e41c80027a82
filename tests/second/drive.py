"""What the drives share: power, motor, keypad, terminals, faults, the lost line, and how replies are given.

Nothing of it comes from a vendor map. What a manual leaves open is an `Options` field; lines are those of the manuals'
texts. Times are microseconds of the caller's; nothing happens by itself, and chance comes from `seed` alone.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from random import Random
from struct import unpack
from typing import Any, ClassVar, Literal

from tests.second.frames import ascii_, ascii_opened, opened, rtu
from tests.second.motor import NEVER, Motor

Source = Literal["bus", "keypad", "terminals"]
Fault = int | str
WORD = 0xFFFF
STOPS = {"stop": "ramp", "jog_stop": "ramp", "quick": "quick", "coast": "coast"}
"""Stops by the bus, and how they stop."""
RUNS = {"run_forward": (1, False), "run_reverse": (-1, False), "jog_forward": (1, True), "jog_reverse": (-1, True)}
"""Starts by the bus: direction, and whether it jogs."""
STORE_US = 100_000
"""How long a store keeps a drive busy."""
NO_REPLY: list[tuple[int, bytes]] = []


class Refusal(Exception):  # noqa: N818  (an answer, no error of the program)
    """A request that is refused for a reason, a key of `Drive.CODES`."""


@dataclass(frozen=True, kw_only=True)
class Options:
    """What no manual says of its drive, and what its user has set. A Literal or bool lists what is possible."""

    # the motor, and settings whose registers or scales are not printed
    maximum_hz: float = 50.0  # CHF P0.04 (line 332), SN300G5 E1-04 (line 654): what 100 % is, set by the user alone
    own_hz: float = 20.0  # the keypad's own frequency
    jog_hz: float = 5.0
    up_hz_s: float = 10.0
    down_hz_s: float = 10.0
    quick_hz_s: float = 50.0
    coast_hz_s: float = 5.0
    start_us: int = 0  # from run to the first turn
    stop_mode: Literal["ramp", "coast"] = "ramp"  # what a stop does: SN300G5 B1-03 (line 511); CHF and JSCC are silent
    # the wire
    ascii: bool = False
    char_us: int = 573  # 11 bits at 19,200 bit/s
    silence_us: int = 2005  # before a frame: 3.5 characters (SN300G5 line 69, CHF line 72)
    reply_us: tuple[int, int] = (5000, 5000)  # from the end of a request to the start of its reply
    late_per_1000: int = 0
    late_us: int = 0  # how much later than that a late reply is
    seed: int = 0
    broadcast: bool = True  # unit 0 is obeyed: SN300G5 line 78, CHF line 80; JSCC prints nothing
    # who commands
    settings_act: Literal["power cycle", "at once"] = "at once"
    stop_key: bool = True  # the keypad's stop key stops what the bus runs: SN300G5 O2-02 (line 812)
    start_key: bool = False  # ... and its start key starts, while the bus commands
    stop_key_holds: bool = False  # after it the bus starts nothing until it has sent a stop
    terminals_act: bool = False  # a run terminal starts and stops while the bus commands
    bus_stop_ends_others: bool = False  # a stop of the bus ends what keypad or terminals run
    not_in_command: Literal["acknowledges", "refuses"] = "acknowledges"  # a command while others command
    resumes_remote: bool = False  # back in REMOTE, a run command that stands acts: SN300G5 B1-07 (line 532)
    ignores: frozenset[str] = frozenset()  # commands that it acknowledges and does not carry out
    # what it shows
    signed_monitors: bool = False
    coast_shows: Literal["zero", "shaft"] = "zero"  # the output frequency while the motor coasts
    running_in_ramp: bool = True  # the status says running until the ramp's end; else stopped
    code_after_reset: Literal["zero", "last"] = "zero"
    # faults
    trip_output: Literal["coast", "ramp"] = "coast"
    latched: bool = True  # a fault stays when its cause goes
    power_cycle_only: frozenset[Fault] = frozenset()  # faults that no reset clears
    reset_needs_stop: bool = False  # no reset while a run command stands
    resumes_after_reset: bool = False  # a run command that stands acts after the reset
    resumes_after_inhibit: bool = False  # ... when an interlock lets go
    retry_us: int | None = None  # after that it resets itself and goes on: SN300G5 L5-01, L5-03 (lines 785 to 787)
    resumes_after_power: bool = False  # it keeps command and reference without power, and goes on
    ride_us: int = 0  # a dip as short as this is ridden through: SN300G5 L2-01, L2-02 (lines 751, 752)
    dip_trips: bool = False  # power that returns finds a fault of low voltage
    # the lost line
    comm_us: int | None = None  # until it finds the line lost; None: never
    comm_action: Literal["ramp", "quick", "coast", "goes on"] = "coast"
    comm_trips: bool = True
    fed_by: Literal["any", "own", "writes"] = "own"  # the frames that count
    comm_when: Literal["running", "always"] = "running"
    # refusals
    forbidden: frozenset[int] = frozenset()  # addresses whose reading it refuses
    holes: Literal["refused", "refused alone", "zero"] = "refused"  # unlisted addresses among listed ones
    busy_refuses: Literal["parameters", "writes", "all"] = "parameters"


class Drive:
    """A drive at a unit address. Its families fill in registers, codes and settings."""

    CODES: ClassVar[dict[str, int]]
    MOST: ClassVar[dict[int, int]]
    """Words by function; other functions are refused."""
    LIVE: ClassVar[dict[int, Callable[[Any, int], int]]] = {}
    """Registers that are reckoned when they are read."""
    MEASURES: ClassVar[dict[str, tuple[int, float]]] = {}
    """Measured values but the frequency, by pin: register, and units of a count, which some manuals do not print."""
    IDS: ClassVar[tuple[str, str, str]]
    """Settings: unit address, source of run, source of frequency."""
    RUN_SOURCES: ClassVar[dict[int, Source]]
    SPEED_FROM_BUS: ClassVar[int]
    BROADCASTS: ClassVar[tuple[int, ...]] = ()
    """Where a broadcast may begin; none: anywhere."""
    LOW_VOLTAGE: ClassVar[Fault]
    LINE_LOST: ClassVar[Fault]

    def __init__(self, unit: int, options: Options, at_us: int = 0, **settings: int) -> None:
        """Power up at a time, standing; settings by the manual's id with _ for its dot or hyphen, as `b1_02=1`."""
        self.o = options
        self.ram: dict[int, int] = {}
        self.settings = self._factory() | {self.IDS[0]: unit} | settings
        """As stored; `force` are those that act."""
        self.force: dict[str, int] = {}
        self.maximum_hz = options.maximum_hz
        self.motor = Motor()
        self.powered, self.output, self.by = False, False, ""
        """`output`: whether it drives the motor; `by`: who, one of bus, keypad, terminals, or nobody."""
        self.stopping, self.direction, self.jogging = "", 1, False
        self.itself = False
        """It runs by a command of the bus that it has taken up again: after a dip, a retry, an interlock, or LOCAL."""
        self.turned = False
        """Somebody has turned its direction round while the bus ran it."""
        self.reference_hz = 0.0
        self.commanded: str | None = None
        """The run or jog of the bus that stands, carried out or not."""
        self.local = self.held = self.contact = self.cut = self.cause = self.warned = self.inhibited = False
        self.fault: Fault | None = None
        self.last_fault: Fault | None = None
        self.stores: list[tuple[int, int, int]] = []
        """Writes that reached EEPROM: time, address, word."""
        self.refusals: list[tuple[int, bytes, str]] = []
        self.unheard = 0
        """Requests to it that came without the silence before them."""
        self.line_us, self.sending, self.heard_us, self.good_us = -NEVER, (-NEVER, -NEVER), at_us, at_us
        self.busy_us, self.deaf_us, self.off_us = at_us, at_us, at_us
        self.strict_us = -NEVER
        self.hold_us = self.retry_us = self.due = NEVER
        self._chance = Random(options.seed)
        self.power(True, at_us)

    # ------------------------------------------------------------ true state, for who watches

    def shaft_hz(self, now_us: int) -> float:
        """The true speed of the shaft, reverse negative."""
        self.advance(now_us)
        return self.motor.hz(now_us)

    def state(self, now_us: int) -> str:
        """Off, tripped, local, at standstill, coasting, starting, at speed or ramping down."""
        hz = abs(self.shaft_hz(now_us))
        if not self.powered:
            return "off"
        if self.fault is not None:
            return "tripped"
        if self.local or self.by in ("keypad", "terminals"):
            return "local"
        if not self.output:
            return "coasting" if hz else "standstill"
        if self.stopping or abs(self._goal()) < hz:
            return "ramping down"
        return "at speed" if hz and abs(self._goal()) == hz else "starting"

    # ------------------------------------------------------------ the wire

    def receive(self, frame: bytes, now_us: int) -> list[tuple[int, bytes]]:
        """A frame whose last character arrives now; replies with the time of their first character.

        Give it everything that it hears but its own replies, other drives' replies, too: silence is reckoned from it.
        """
        if now_us >= self.due:
            self.advance(now_us)
        o, begins = self.o, now_us - len(frame) * self.o.char_us
        at, end = self.sending
        before, self.line_us = self.line_us, now_us
        if not self.powered or self.cut or now_us < self.deaf_us or not frame:
            return NO_REPLY
        if begins < end and now_us > at:
            return NO_REPLY
        if not o.ascii and begins - (max(before, end) if end <= begins else before) < o.silence_us:
            self.unheard += frame[0] in (self.unit, 0)
            return NO_REPLY
        if not o.ascii and frame[0] not in (self.unit, 0) and o.fed_by != "any":
            return NO_REPLY
        body = ascii_opened(frame) if o.ascii else opened(frame)
        reply = None if body is None else self._reply(body, now_us)
        if reply is None:
            return NO_REPLY
        least, most = o.reply_us
        wait = least if least == most else self._chance.randint(least, most)
        if o.late_per_1000 and self._chance.randrange(1000) < o.late_per_1000:
            wait += o.late_us
        text = ascii_(reply) if o.ascii else rtu(reply)
        self.sending = (now_us + wait, now_us + wait + len(text) * o.char_us)
        return [(now_us + wait, text)]

    def _reply(self, body: bytes, now_us: int) -> bytes | None:
        o, everyone = self.o, body[0] == 0
        if o.fed_by == "any":
            self.heard_us = now_us
        if not (body[0] == self.unit or (everyone and o.broadcast)):
            return None
        self.good_us = now_us
        if o.fed_by == "own":
            self.heard_us = now_us
        try:
            reply = self._serve(body, now_us)
        except Refusal as refusal:
            reason = str(refusal)
            self.refusals.append((now_us, body, reason))
            reply = self._refused(body, self.CODES[reason])
        self.warned = False  # the line is back, and this reply may still show that it was not
        self._plan()
        return None if everyone else reply

    def _serve(self, body: bytes, now_us: int) -> bytes | None:
        """The reply without checksum; None where the request's length is not that of its function. Raises Refusal."""
        most = self.MOST.get(body[1])
        if most is None:
            raise Refusal("function")
        if len(body) < 6 or (body[1] in (3, 6) and len(body) != 6):
            return None
        first, number = unpack(">HH", body[2:6])
        if body[1] == 8:
            if first:
                raise Refusal("function")
            return body
        self._refuse(body, now_us, reads=3)
        short = body[1] == 16 and (len(body) != 7 + 2 * number or body[6] != 2 * number)
        if short or (body[1] != 6 and not 1 <= number <= most):
            raise Refusal("count")
        if body[1] == 3:
            words = b"".join(word.to_bytes(2, "big") for word in self._words(first, number, now_us))
            return body[:2] + self._count_bytes(len(words)) + words
        if body[0] == 0 and self.BROADCASTS and first not in self.BROADCASTS:
            raise Refusal("address")
        data = [number] if body[1] == 6 else list(unpack(f">{number}H", body[7:]))
        self._write(dict(zip(range(first, first + len(data)), data, strict=True)), now_us)
        if self.o.fed_by == "writes":
            self.heard_us = now_us
        return body[:6]

    def _refuse(self, body: bytes, now_us: int, *, reads: int) -> None:
        """What it refuses for a time. Raises Refusal."""
        if now_us < self.busy_us and self.o.busy_refuses in (("all",) if body[1] == reads else ("all", "writes")):
            raise Refusal("busy")
        if now_us < self.strict_us and body[1] != reads:
            raise Refusal("address")

    def _words(self, first: int, number: int, now_us: int) -> Iterable[int]:
        addresses = range(first, first + number)
        listed = self._listed(addresses)
        if self.o.forbidden and not self.o.forbidden.isdisjoint(addresses):
            raise Refusal("address")
        return [self._word(address, now_us) if address in listed else 0 for address in addresses]

    def _listed(self, addresses: Iterable[int]) -> set[int]:
        """Those that the manual lists. Raises Refusal where `holes` asks for it."""
        listed = {each for each in addresses if each in self.ram or each in self.LIVE}
        whole = listed if self.o.holes == "refused alone" else listed.issuperset(addresses)
        if self.o.holes != "zero" and not whole:
            raise Refusal("address")
        return listed

    def _word(self, address: int, now_us: int) -> int:
        live = self.LIVE.get(address)
        return live(self, now_us) & WORD if live else self.ram[address]

    def _count_bytes(self, length: int) -> bytes:
        return bytes([length])

    def _refused(self, body: bytes, code: int) -> bytes | None:
        return bytes([body[0], body[1] | 0x80, code])

    def _write(self, words: dict[int, int], now_us: int) -> None:
        """Write words by address. Raises Refusal."""
        raise NotImplementedError

    # ------------------------------------------------------------ time

    def advance(self, now_us: int) -> None:
        """Let time pass; costs one comparison while nothing happens."""
        while now_us >= self.due:
            at = self.due
            if at >= self.motor.end_us:
                self.motor.settle()
                self._arrived(at)
            if at >= self.hold_us:
                self.hold_us = NEVER
                self._aim(at)
            if at >= self.retry_us:
                self.retry_us = NEVER
                self._clear(at, resumes=True, itself=True)
            if self._lost_at() <= at:
                self._line_lost(at)
            self._plan()

    def _plan(self) -> None:
        self.due = min(self.motor.end_us, self.hold_us, self.retry_us, self._lost_at())

    def _lost_at(self) -> int:
        wait = self._line_watch()[0]
        watched = self.powered and (self.o.comm_when == "always" or self.by == "bus")
        return NEVER if wait is None or not watched or self.warned or self.fault is not None else self.heard_us + wait

    def _line_watch(self) -> tuple[int | None, str, bool]:
        """How long the line may be silent, what is done then, and whether it is a fault."""
        return self.o.comm_us, self.o.comm_action, self.o.comm_trips

    def _line_lost(self, now_us: int) -> None:
        _, action, trips = self._line_watch()
        if action == "goes on":
            self.warned = True
        elif trips:
            self._trip(self.LINE_LOST, now_us, action)
        else:
            self.warned = True
            self._stop(action, now_us)

    # ------------------------------------------------------------ the motor

    def _goal(self) -> float:
        if self.jogging:
            hz = self.o.jog_hz
        elif self.speed_from_bus and not (self.local and self.by == "keypad"):
            hz = self.reference_hz
        else:
            hz = self.o.own_hz
        return self.direction * max(-self.maximum_hz, min(self.maximum_hz, hz))

    def _aim(self, now_us: int) -> None:
        o = self.o
        if not self.output:
            self.motor.aim(now_us, 0.0, o.coast_hz_s, o.coast_hz_s)
        elif self.stopping or now_us < self.hold_us < NEVER:
            self.motor.aim(now_us, 0.0, o.up_hz_s, o.quick_hz_s if self.stopping == "quick" else o.down_hz_s)
            if self.stopping and self.motor.end_us == NEVER:
                self._release(now_us)
        else:
            self.motor.aim(now_us, self._goal(), o.up_hz_s, o.down_hz_s)
        self._plan()

    def _arrived(self, now_us: int) -> None:
        if self.output and self.stopping:
            self._release(now_us)
        elif self.output:
            self._aim(now_us)  # a change of direction goes on

    def _run(self, direction: int, jogging: bool, by: str, now_us: int) -> None:
        if self.fault is not None or not self.powered or self.inhibited:
            return
        if not self.output and self.o.start_us:
            self.hold_us = now_us + self.o.start_us
        self.output, self.by, self.stopping, self.direction, self.jogging = True, by, "", direction, jogging
        self.turned = False
        self._aim(now_us)

    def _stop(self, how: str, now_us: int) -> None:
        if not self.output:
            return
        if how == "coast" or (how == "ramp" and self.o.stop_mode == "coast"):
            self._release(now_us)
        elif self.stopping != "quick":
            self.stopping = how
            self._aim(now_us)

    def _release(self, now_us: int) -> None:
        self.output, self.by, self.stopping, self.jogging, self.hold_us = False, "", "", False, NEVER
        self._aim(now_us)

    # ------------------------------------------------------------ who commands

    def _bus(self, what: str, now_us: int) -> None:
        """A command of the bus: one of STOPS or RUNS, or reset. Raises Refusal."""
        if what in self.o.ignores:
            return
        mine = self.run_source == "bus" and not self.local
        if not mine and self.o.not_in_command == "refuses":
            raise Refusal("mode")
        if what in STOPS:
            self.held, self.commanded = False, None
            if mine or self.o.bus_stop_ends_others:
                self._stop(STOPS[what], now_us)
        elif what == "reset":
            self.reset(now_us)
        else:
            self.commanded = what
            self._obey(now_us)

    def _obey(self, now_us: int, *, itself: bool = False) -> None:
        if self.commanded and self.run_source == "bus" and not self.local and not self.held:
            self.itself = itself
            self._run(*RUNS[self.commanded], "bus", now_us)

    def _refer(self, hz: float, now_us: int) -> None:
        self.reference_hz = hz
        if self.output and not self.stopping:
            self._aim(now_us)

    def press(self, key: Literal["start", "stop", "reset", "local"], now_us: int) -> None:
        """A key of the drive's own keypad."""
        self.advance(now_us)
        o = self.o
        if key == "start" and self.powered and (self.run_source == "keypad" or self.local or o.start_key):
            self._run(1, False, "keypad", now_us)
        elif key == "stop" and self.output and (self.by == "keypad" or o.stop_key):
            self.held = self.by == "bus" and o.stop_key_holds
            self.commanded = None
            self._stop("ramp", now_us)
        elif key == "reset":
            self.reset(now_us)
        elif key == "local" and not self.output:
            self.local = not self.local
            if not self.local and o.resumes_remote:
                self._obey(now_us, itself=True)

    def terminal(self, closed: bool, now_us: int) -> None:
        """The wired run-forward terminal."""
        self.advance(now_us)
        acts = (self.run_source == "terminals" or self.o.terminals_act) and not self.local and closed != self.contact
        self.contact = closed
        if acts and closed:
            self._run(1, False, "terminals", now_us)
        elif acts and self.by == "terminals":
            self._stop("ramp", now_us)

    def turn_round(self, now_us: int) -> None:
        """Somebody turns the direction of what the bus runs."""
        self.advance(now_us)
        if self.output and not self.stopping and self.by == "bus":
            self.direction, self.turned = -self.direction, True
            self._aim(now_us)

    def set(self, name: str, word: int, now_us: int) -> None:
        """Somebody sets a parameter at the keypad, which stores it: SN300G5 line 826."""
        self.settings[name] = word
        if self.o.settings_act == "at once":
            self._take_up(self.settings, now_us)

    def _factory(self) -> dict[str, int]:
        """Settings as commissioned: the bus commands."""
        raise NotImplementedError

    def _take_up(self, settings: dict[str, int], now_us: int) -> None:
        unit, run, speed = self.IDS
        self.force = dict(settings)
        self.unit = self.force[unit]
        self.run_source = self.RUN_SOURCES[self.force[run]]
        self.speed_from_bus = self.force[speed] == self.SPEED_FROM_BUS
        if self.output:
            self._aim(now_us)

    def be_busy(self, now_us: int, lasts_us: int) -> None:
        """It processes parameters for a time."""
        self.busy_us = now_us + lasts_us

    def be_strict(self, now_us: int, lasts_us: int) -> None:
        """It refuses what is written to it for a time, for a reason that is none of a busy drive."""
        self.busy_us = self.strict_us = now_us + lasts_us

    # ------------------------------------------------------------ power and faults

    def power(self, on: bool, now_us: int) -> None:
        """Supply on or off; off, the motor coasts and what is not stored is lost."""
        self.advance(now_us)
        if on == self.powered:
            return
        self.powered = on
        if not on:
            self.off_us, self.retry_us = now_us, NEVER
            self._release(now_us)
            return
        rides = bool(self.force) and now_us - self.off_us < self.o.ride_us
        self.heard_us = now_us
        if not rides:
            self._power_up(now_us, kept=self.o.resumes_after_power)
        if self.o.dip_trips and not rides and now_us > self.off_us:
            self._trip(self.LOW_VOLTAGE, now_us, "coast")
        elif rides or self.o.resumes_after_power:
            self._obey(now_us, itself=True)
        self._plan()

    def _power_up(self, now_us: int, *, kept: bool) -> None:
        self.deaf_us = now_us
        self.busy_us = now_us
        self.local = self.held = self.cut = self.warned = False
        if not self.cause:
            self.fault = None
        self._take_up(self.settings, now_us)
        if not kept:
            self.commanded, self.reference_hz = None, 0.0

    def trip(self, fault: Fault, now_us: int, *, cause: bool = False) -> None:
        """A fault; with a cause that stays until `clear_cause`, no reset works before."""
        self.advance(now_us)
        if self.powered and self.fault is None:
            self._trip(fault, now_us, self.o.trip_output)
            self.cause = cause
            if self.o.retry_us is not None:
                self.retry_us = now_us + self.o.retry_us
            self._plan()

    def inhibit(self, on: bool, now_us: int) -> None:
        """A safe torque off or another interlock: no output while it is on; SN300G5's BB (line 358)."""
        self.advance(now_us)
        self.inhibited = on
        if on:
            self._release(now_us)
        elif self.o.resumes_after_inhibit:
            self._obey(now_us, itself=True)

    def _trip(self, fault: Fault, now_us: int, how: str) -> None:
        self.fault = self.last_fault = fault
        self._stop(how, now_us)

    def clear_cause(self, now_us: int) -> None:
        """The cause of a fault goes."""
        self.advance(now_us)
        self.cause = False
        if not self.o.latched:
            self._clear(now_us, resumes=self.o.resumes_after_reset)

    def reset(self, now_us: int) -> None:
        """A reset signal, from wherever."""
        blocked = not self.powered or self.cause or self.fault in self.o.power_cycle_only or not self._may_reset(now_us)
        if not (blocked or (self.o.reset_needs_stop and self.commanded)):
            self._clear(now_us, resumes=self.o.resumes_after_reset)

    def _may_reset(self, _now_us: int) -> bool:
        return True

    def _clear(self, now_us: int, *, resumes: bool, itself: bool = False) -> None:
        if self.fault is not None and not self.cause:
            self.fault, self.heard_us = None, now_us
            if resumes:
                self._obey(now_us, itself=itself or bool(self.o.ignores))  # what it should have stopped
        self.warned = False
        self._plan()

    # ------------------------------------------------------------ what registers show

    def shown_hz(self, now_us: int) -> float:
        """The output frequency that it shows."""
        if not self.output and self.o.coast_shows == "zero":
            return 0.0
        hz = self.motor.hz(now_us)
        return hz if self.o.signed_monitors else abs(hz)

    def _counts(self, now_us: int, hz_per_count: float) -> int:
        return int(self.shown_hz(now_us) / hz_per_count + (1e-9 if self.shown_hz(now_us) >= 0 else -1e-9))

    @property
    def runs(self) -> bool:
        """Whether the status says running."""
        return self.output and (not self.stopping or self.o.running_in_ramp)

    def reverse(self, now_us: int) -> bool:
        """Whether it drives the motor in reverse, or is about to."""
        hz = self.motor.hz(now_us)
        return self.output and (hz < 0 or (hz == 0 and self._goal() < 0))

    @property
    def code(self) -> Fault | None:
        """The fault that the register of the present fault shows."""
        return self.last_fault if self.fault is None and self.o.code_after_reset == "last" else self.fault

    def store(self, address: int, word: int, now_us: int) -> None:
        """A write reaches EEPROM."""
        self.stores.append((now_us, address, word))
        self.busy_us = now_us + STORE_US
