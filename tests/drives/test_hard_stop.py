"""The contact of the hard stop: it latches, it closes by a person, and in no mode is it kept from closing."""

import pytest
from tests.drives.words import stops
from tests.second.line import Bench
from tests.second.station import simulated


class Machine:
    """A drive fed by a contactor that HardStopOk holds; its auxiliary contact says when the supply is off."""

    def __init__(self, kind: str, *, auxiliary: bool = True) -> None:
        """Power up with the contactor open."""
        self.bench = Bench(kind, start=False)
        self.latch = simulated().instance("VFD_HardStop")
        self.auxiliary, self.dead, self.closed, self.changes = auxiliary, False, False, 0
        self.bench.watch.append(self._scan)
        self.feed()
        self.bench.restart()

    def feed(self) -> None:
        """What the contactor does."""
        self.bench.drives[0].power(on=self.closed)
        self.bench.deaf = set() if self.closed and not self.dead else {1}
        if self.auxiliary:
            self.bench.put(SupplyOff=not self.closed)

    def _scan(self, bench: Bench) -> None:
        self.latch["Overdue"] = bench.block["TheLine.StopOverdue"]
        self.latch["Restart"] = bool(bench.line_pins.get("Restart"))
        self.latch.scan()
        closed = bool(self.latch["HardStopOk"])
        if closed is not self.closed:
            self.closed, self.changes = closed, self.changes + 1
            self.feed()

    def press(self) -> "Machine":
        """A person presses Reset, and lets go."""
        for down in (True, False):
            self.latch["Reset"] = down
            self.bench.run(100)
        return self


def test_a_silent_drive_opens_the_contact_once_for_each_press() -> None:
    """Without a latch: 664 changes in ten seconds."""
    machine = Machine("CHF").press()
    machine.bench.until(lambda: machine.bench.shows("StopConfirmed"), 12_000)
    machine.bench.put(RunForward=True).run(3000)
    machine.dead, machine.changes = True, 0
    machine.feed()
    machine.bench.wait(30_000)
    assert (machine.closed, machine.changes) == (False, 1)
    machine.press().bench.run(9000)
    assert (machine.closed, machine.changes) == (True, 2)  # it may boot
    machine.bench.run(6000)
    assert (machine.closed, machine.changes) == (False, 3)
    machine.dead = False
    machine.press().bench.put(RunForward=False).run(20_000)
    assert (machine.closed, machine.changes) == (True, 4)
    machine.bench.running()


def test_with_an_auxiliary_contact_it_closes_whenever_a_person_comes() -> None:
    machine = Machine("JSCC")
    machine.bench.wait(60_000)
    assert not machine.bench.block["TheLine.StopOverdue"]
    machine.press().bench.run(15_000)
    assert machine.closed


def test_the_latch_alone() -> None:
    latch = simulated().instance("VFD_HardStop")

    def scan(**pins: bool) -> bool:
        for name in ("Overdue", "Restart", "Reset"):
            latch[name] = pins.get(name, False)
        latch.scan()
        return bool(latch["HardStopOk"])

    assert not scan(Reset=True)  # the first call acts like a restart
    assert not scan(Reset=True)  # held since before
    assert not scan()
    assert scan(Reset=True)
    assert scan()
    assert not scan(Overdue=True)
    assert not scan()
    assert not scan(Overdue=True, Reset=True)
    assert not scan(Reset=True)  # pressed while it was overdue
    assert not scan()
    assert scan(Reset=True)
    assert not scan(Restart=True)
    assert not scan()


@pytest.mark.parametrize("boot_ms", [0, 3000])
def test_silence_is_no_alarm_while_it_boots(boot_ms: int) -> None:
    bench = Bench("CHF", start=False).put(BootMs=boot_ms)
    bench.deaf = {1}
    bench.restart()
    bench.run((boot_ms or 10_000) - 100)
    assert not bench.shows("StopOverdue")
    bench.run(1500)
    assert bench.shows("StopOverdue")
    bench.deaf = set()
    bench.stopped().run(40)
    assert not bench.shows("StopOverdue")


def test_the_first_reply_ends_the_boot() -> None:
    bench = Bench("CHF", start=False).restart()
    bench.run(500)
    bench.deaf = {1}
    bench.put(Enable=False).run(5000)
    bench.put(Enable=True, RunForward=True).run(1000)
    assert bench.shows("StopOverdue")


def test_without_supply_a_drive_that_answers_owes_its_stop() -> None:
    bench = Bench("CHF").put(StopWithinMs=3000).running()
    bench.drives[0].keeps_running = True
    bench.put(SupplyOff=True)
    assert stops(bench, bench.run(4000))
    assert bench.shows("StopOverdue")


def test_without_supply_a_silent_drive_gets_one_read_in_ten_seconds() -> None:
    bench = Bench("CHF").stopped().put(SupplyOff=True)
    bench.deaf = {1}
    bench.wait(20_000)
    frames = bench.wait(60_000)
    assert not [each for each in frames if not each.read]
    assert 5 <= len(frames) <= 7
    assert not bench.shows("StopOverdue")
    bench.deaf = set()
    bench.put(SupplyOff=False).stopped()
    bench.running()
