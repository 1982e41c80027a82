"""What a simulated drive does: its states, what is to be seen of them, and what happens to it."""

from collections.abc import Mapping

from driveblocks.bench.simulator.copies import RPM_OF_ONE_PAIR, Copy
from driveblocks.bench.simulator.face import Situation
from driveblocks.bench.simulator.habits import Habits
from driveblocks.bench.simulator.memory import Memory
from driveblocks.bench.simulator.motor import Motor
from driveblocks.bench.simulator.move import STATE, Move, Need
from driveblocks.bench.simulator.plate import plate
from driveblocks.bench.simulator.table import Gauge, table
from driveblocks.maps.form import SPACES
from driveblocks.maps.model import Drive
from driveblocks.meaning.pattern import WORD
from driveblocks.meaning.words import KINDS, MOTIONS, STOPS, CommandWord, Held


class Machine:
    """A drive of a family at a unit address, powered, at standstill. Time passes by `step` alone."""

    def __init__(
        self,
        drive: Drive,
        unit: int,
        habits: Habits | None = None,
        *,
        words: Mapping[int, int] | None = None,
        ascii_mode: bool = False,
    ) -> None:
        """Begin with these words in registers, and those by which the drive is known; the rest 0."""
        self.habits = habits or Habits()
        self.unit = unit
        self.table = table(drive, self.habits, ascii_mode=ascii_mode)
        self.memory = Memory(self.table.storage, plate(drive, self.habits), words or {})
        self._gauges = {each.register: each for each in self.table.gauges}
        self.motor = Motor()
        self.now = 0
        self.heard_at = 0
        self.busy_until = 0
        self.deaf_until = 0
        self.turn_us = self.habits.turn_us
        self.powered = True
        self.fault = 0
        """Code of the present fault."""
        self.last_fault = 0
        self._at_fault: dict[int, int] = {}
        """What registers show of the moment of the last fault."""
        self.cause = False
        """Whether the fault's cause is still there: no reset works."""
        self.warning = False
        self.inhibited = False
        self.local = False
        """Commands of the bus are acknowledged, and the keypad rules."""
        self.follows = True
        """FALSE: it acknowledges commands and does nothing."""
        self.keeps_running = False
        """TRUE: it acknowledges stops and runs on."""
        self.load = 50
        """Of the motor, in %."""
        self.state: str | None = None
        """The map's named state that it is in; None: in none, as after power-up and while it runs."""
        self._next: tuple[str | None, int] | None = None
        self._after: str | None = None
        self._stopping = False
        self._quick = False
        self._reverse = False
        self._jog = False
        self._own_milli: int | None = None
        self._restart = False

    # ------------------------------------------------------------ what is to be seen

    @property
    def mode(self) -> str:
        """Standstill, ramping up, running, ramping down, coasting, or fault."""
        if self.fault:
            return "fault"
        if not self.motor.driven:
            return "coasting" if self.motor.shaft else "standstill"
        if self.motor.output == self._goal():
            return "running"
        return "ramping down" if abs(self.motor.output) > abs(self._goal()) else "ramping up"

    @property
    def hertz(self) -> float:
        """The speed of the shaft; reverse negative."""
        return self.motor.shaft / 1000

    @property
    def asked_hertz(self) -> float:
        """The speed that it is to reach; 0 while it stops or its output is off."""
        return self._goal() / 1000 if self.motor.driven else 0.0

    @property
    def stores(self) -> int:
        """How often parameters were stored in EEPROM."""
        return self.memory.stores

    def word(self, address: int) -> int:
        if address == self.table.warned:
            mask, code = self.table.warning
            return self._word(address) & ~mask | code * self.warning
        return self._word(address)

    def _word(self, address: int) -> int:
        gauge = self._gauges.get(address)
        if gauge:
            return self._measure(gauge)
        if address == self.table.present:
            others = self._face().get(address, 0) & ~self.table.present_mask
            return others | self._code << self.table.present_shift
        copy = self.table.copies.get(address)
        if copy:
            return self._at_fault.get(address, 0) if copy.at_fault else self._copied(copy)
        home = self.memory.home(address)
        bits = self.table.fault_bits
        if bits and bits[0] <= home <= bits[1]:
            place = self._code - 1 - 16 * (home - bits[0])
            return self.memory[home] | (1 << place if 0 <= place < 16 else 0)
        if home == self.table.own_address and home not in self.memory.words:
            return self.unit
        held = 0 if home in self.table.shared else self.memory[home]
        return held & ~self.table.named.get(home, 0) | self._face().get(home, 0)

    def _copied(self, copy: Copy) -> int:
        if copy.same is not None:
            return self.word(copy.same)
        if copy.shows in ("fault", "last_fault"):
            return self._code if copy.shows == "fault" else self.last_fault
        if copy.shows not in ("asked", "speed"):
            return self._measure(Gauge(copy.register, copy.shows, copy.milli, copy.signed))
        milli = self._asked() if copy.shows == "asked" else RPM_OF_ONE_PAIR * self.motor.shaft // self.habits.pole_pairs
        return _counts(milli if copy.signed else abs(milli), copy.milli)

    @property
    def _code(self) -> int:
        return self.fault or (self.last_fault if self.habits.keeps_fault_code else 0)

    def _face(self) -> dict[int, int]:
        running = self.motor.driven and (self.habits.runs_while_stopping or not self._stopping)
        output = self._shown_output()
        goal = self._goal()
        situation = Situation(
            fault=self.fault != 0,
            running=running,
            reverse=running and (output < 0 or (output == 0 and goal < 0)),
            at_speed=running and output == goal != 0,
            zero_speed=output == 0,
            ready=not self.fault and not self.inhibited,
            warning=self.warning,
        )
        return self.table.faces[situation, self.state]

    def _shown_output(self) -> int:
        return self.motor.output if self.habits.coast_shows_zero else self.motor.shaft

    def _measure(self, gauge: Gauge) -> int:
        habits, output = self.habits, abs(self._shown_output())
        share = output * 100 // (1000 * habits.maximum_hz)
        driven = self.motor.driven
        milli = {
            "output_frequency": self._shown_output() if gauge.signed else output,
            "output_current": 10 * habits.amperes * self.load * driven,
            "output_voltage": 10 * habits.motor_volts * share * driven,
            "dc_bus_voltage": 1000 * habits.bus_volts,
            "output_power": habits.kilowatts * self.load * share * driven // 10,
            "output_speed": self._turns(signed=gauge.signed),
            "output_torque": 1000 * self.load * driven,
            "relative_power": 10 * self.load * share * driven,
            "drive_temperature": 1000 * habits.drive_degrees,
            "motor_temperature": 1000 * habits.motor_degrees,
            "operating_time": 1000 * habits.hours,
            "motor_torque": 100 * self.load * driven,
            "energy": 1000 * habits.kilowatt_hours,
        }[gauge.shows]
        return _counts(milli, gauge.milli, gauge.shift or 0)

    def _turns(self, *, signed: bool) -> int:
        """The speed of the motor in thousandths of r/min."""
        output = self._shown_output()
        milli = RPM_OF_ONE_PAIR * abs(output) // self.habits.pole_pairs
        return -milli if signed and output < 0 else milli

    # ------------------------------------------------------------ time

    def step(self, ms: int) -> None:
        self.now += ms
        habits = self.habits
        ramp = habits.stop_ramp or habits.ramp if self._stopping else habits.ramp
        self.motor.step(ms, self._goal(), habits.quick_ramp if self._quick else ramp, habits.coast_ramp)
        if self._stopping and self.motor.output == 0:
            self._let_go()
        self._settle()
        limit = habits.watchdog_ms
        if limit is not None and self._watches() and self.now - self.heard_at > limit:
            self._lost()

    def hear(self, request: bytes) -> None:
        """A good request to its own address feeds its watchdog, if it is of the kind that does."""
        first, function = int.from_bytes(request[2:4], "big"), request[1]
        count = {5: 1, 6: 1, 16: request[5]}.get(function, 0)
        start = first + SPACES["coil" if function == 5 else "holding"]
        if self.table.watchdog is None or self.table.watchdog.takes(range(start, start + count)):
            self.heard_at = self.now

    def _watches(self) -> bool:
        counts = self.table.watchdog and self.table.watchdog.counts
        return self.motor.driven or counts == "always" or (counts == "bus_in_command" and not self.local)

    def _goal(self) -> int:
        """What the output frequency is to reach, in thousandths of a hertz."""
        return 0 if self._stopping else self._asked()

    def _asked(self) -> int:
        """What is asked of it, whether it runs or not."""
        if self._jog:
            milli = 1000 * self.habits.jog_hz
        elif self._own_milli is not None:
            milli = self._own_milli
        else:
            milli = self._referred()
        most = 1000 * self.habits.maximum_hz
        milli = max(-most, min(most, milli))
        return -milli if self._reverse else milli

    def _referred(self) -> int:
        given = self.table.reference
        word, bits = self.memory[given.register], 16
        if given.above is not None:
            word, bits = word | self.memory[given.above] << 16, 32
        number = word - (1 << bits) if given.signed and word >> bits - 1 else word
        milli = abs(number) * given.times // given.per
        if not all(each.holds(self.memory[each.register]) for each in given.verify):
            milli *= self.habits.misread
        return -milli if number < 0 and given.reverses else milli

    def _lost(self) -> None:
        if self.habits.watchdog == "trip":
            self.trip(self.habits.watchdog_code)
            self.cause = False
        else:
            self._stop("coast_stop" if self.habits.watchdog == "coast" else "stop")

    # ------------------------------------------------------------ what happens to it

    def set(self, address: int, word: int) -> None:
        """Somebody sets a register at the keypad; of a status word, the bits that no condition of the map names."""
        self.memory.words[self.memory.home(address)] = word
        if self.memory.parameter(address):
            self.memory.stored[self.memory.home(address)] = word

    def trip(self, code: int) -> None:
        """A fault, whose cause stays until `clear_cause`."""
        if not self.powered or self.fault:
            return
        self._at_fault = {each.register: self._copied(each) for each in self.table.copies.values() if each.at_fault}
        self.fault = self.last_fault = code
        self.cause = True
        self._let_go()
        self.state = self._next = None

    def clear_cause(self) -> None:
        """The cause of a fault is gone; the fault stays until it is reset."""
        self.cause = False

    def reset(self) -> None:
        """Reset a fault, by bus or keypad; it works only while its cause is gone and the motor is at standstill."""
        if not self.fault or self.cause or self.motor.shaft or not self.powered:
            return
        self.fault, self.heard_at = 0, self.now
        if self.habits.resumes:
            self._hold()

    def keypad_run(self, hz: float | None = None, *, reverse: bool = False) -> None:
        """Keypad or terminals start it, at a frequency of their own or at that of the bus."""
        if self.powered and not self.fault and not self.inhibited:
            self._run(reverse=reverse, own_milli=None if hz is None else round(1000 * hz))

    def keypad_stop(self) -> None:
        """Keypad or terminals stop it."""
        if self.motor.driven:
            self._jog = False
            self._stop("stop")

    def inhibit(self, *, on: bool) -> None:
        """A safe torque off or another interlock: no output, and not ready."""
        self.inhibited = on
        if on:
            self._let_go()

    def power(self, *, on: bool) -> None:
        """Supply on or off; what is in RAM is lost, the motor coasts."""
        if on == self.powered:
            return
        self.powered = on
        if on:
            self.heard_at = self.now
            self.fault = self.fault if self.cause else 0
            if self._restart and not self.fault and not self.inhibited:
                self.motor.start()
            return
        self._restart = self.habits.auto_restart and self.motor.driven and not self._stopping
        told = {move.pattern.register for move in self.table.moves} | {self.table.reference.register}
        self.memory.lose(told if self.habits.auto_restart else ())
        self._let_go()
        self.busy_until = self.now
        self.state = self._next = None

    # ------------------------------------------------------------ commands

    def written(self, before: Mapping[int, tuple[int, int]]) -> None:
        """Act on a write; `before` holds the registers that it touched: their word until then, and since when."""
        for pattern, ms in self.table.silences:
            if pattern.register in before and pattern.holds(self.memory[pattern.register]):
                self.deaf_until = self.now + ms
        if self.local or not self.follows:
            return
        fired = [move for move in self.table.moves if self._fires(move, before)]
        stop = next((move.effect for move in fired if move.effect in STOPS), None)
        led = [move.into for move in fired if move.effect == STATE]
        if stop and not self.keeps_running:
            self._obey(stop, before, led)
        if any(move.effect == "fault_reset" for move in fired):
            self.reset()
        if led and not self.fault and not self.motor.driven:
            self._next = (led[-1], self.now + self.habits.settle_ms)
            self._settle()
        if not stop:
            self._move(fired)
        for word in self.table.words:
            listed = (one for one in self.table.listed if one.register == word.register)
            if word.register in before and not any(one.holds(self.memory[word.register]) for one in listed):
                self._strange(word, before)

    def _strange(self, word: CommandWord, before: Mapping[int, tuple[int, int]]) -> None:
        """A word that is none of the map's own: it does what its bits or its value do, and moves where it may."""
        held, was = Held(WORD, self.memory[word.register]), Held(WORD, before[word.register][0])
        resets, kind = word.gives("resets", held), word.stops(held)
        if resets and (resets.effect.by != "edge" or word.gives("resets", was) is None):
            self.reset()
        if not self._goes(word, was) and kind and not self.keeps_running:
            self._obey(KINDS[kind], before, [])

    def _goes(self, word: CommandWord, was: Held) -> bool:
        """Whether what is in a command register may move the motor; then it does, where the drive's state lets it."""
        moved = word.moves(Held(WORD, self.memory[word.register]), was)
        guards = {move.guard for move in self.table.moves if move.effect in MOTIONS}
        led = self.motor.driven or None in guards or self.state in guards
        if moved and led and not self.fault and not self.inhibited:
            held = [(each, Held(WORD, self.memory[each.register])) for each in self.table.words]
            reverse = any(each.gives("reverses", now) for each, now in held)
            self._run(reverse=reverse, jog="jogs" in moved.effect.acts)
        return moved is not None

    def _fires(self, move: Move, before: Mapping[int, tuple[int, int]]) -> bool:
        touched = {move.pattern.register}
        if not any(need.before for need in move.needs):
            touched.update(need.pattern.register for need in move.needs)
        if touched.isdisjoint(before) or not move.pattern.holds(self.memory[move.pattern.register]):
            return False
        if move.guard not in (None, self.state) and not (move.effect in MOTIONS and self.motor.driven):
            return False
        return all(self._met(need, before) for need in move.needs)

    def _met(self, need: Need, before: Mapping[int, tuple[int, int]]) -> bool:
        register = need.pattern.register
        word, since = self.memory[register], self.memory.changed.get(register, 0)
        if need.before:
            word, since = before[register]
        return need.pattern.holds(word) and self.now - since >= need.for_ms

    def _obey(self, stop: str, before: Mapping[int, tuple[int, int]], led: list[str | None]) -> None:
        """A stop of the bus; its word may lead into a state, too, but not in the wrong order."""
        words = [move for move in self.table.moves if move.effect == STATE and move.pattern.register in before]
        after = [move.into for move in words if move.pattern.holds(self.memory[move.pattern.register])]
        if self.motor.driven:
            self._stop(stop, after[-1] if after else None)
        elif not led and not after and not self.fault:
            self.state = self._next = None

    def _move(self, fired: list[Move]) -> None:
        motions = [move for move in fired if move.effect in MOTIONS]
        if motions and not self.fault and not self.inhibited:
            effect = motions[0].effect
            self._run(reverse=effect.endswith("reverse"), jog=effect.startswith("jog"))

    def _hold(self) -> None:
        """A run word that is still set acts again, where its level counts and no state is asked for."""
        for word in self.table.words:
            self._goes(word, Held(WORD, self.memory[word.register]))

    def _run(self, *, reverse: bool, jog: bool = False, own_milli: int | None = None) -> None:
        self._stopping = self._quick = False
        self._reverse, self._jog, self._own_milli = reverse, jog, own_milli
        self.motor.start()
        self.state = self._next = None

    def _stop(self, effect: str, after: str | None = None) -> None:
        if effect == "jog_stop" and not self._jog:
            return
        if effect == "stop" and self._jog and not self.habits.stop_ends_jog:
            return
        self._after = after
        if effect == "coast_stop":
            self._let_go()
        else:
            self._stopping = True
            self._quick |= effect == "quick_stop"

    def _let_go(self) -> None:
        """No output: the motor coasts."""
        if self.motor.driven:
            self.state = None if self.fault else self._after
        self.motor.release()
        self._stopping = self._quick = self._jog = False

    def _settle(self) -> None:
        if self._next and self.now >= self._next[1]:
            self.state, self._next = self._next[0], None


def _counts(milli: int, per: int, shift: int = 0) -> int:
    """A word, rounded towards 0, as C divides; of 32 bits the high one with a shift of 16."""
    return (milli // per if milli >= 0 else -(-milli // per)) >> shift & WORD
