"""The adapter for TwinCAT on the embedded engine, with stand-ins for Beckhoff's blocks: what becomes of bytes and time.

It cannot show that Beckhoff's blocks do what their manuals say.
"""

from pathlib import Path

from tests.platforms.ports import TWINCAT, library
from tests.platforms.stock import made
from tests.platforms.test_openplc import library as needed

from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Instance, Source

TICKS = 10_000
"""Of GETCPUCOUNTER in a millisecond."""


class Bench:
    """A port between two buffers."""

    def __init__(self) -> None:
        """At a time near the wrap of the low word."""
        self.rig = library(TWINCAT).instance("X_Given")
        self.ticks = 0xFFFF_FF00
        self.pass_ms(0)

    def pass_ms(self, ms: float, count: int = 0) -> None:
        """Let time pass, then call it; `count` above 0 sends."""
        self.ticks += int(ms * TICKS)
        clock(self.rig, "Port", self.ticks)
        self.rig["Send"] = count
        self.rig.scan()

    def buffer(self, name: str) -> bytes:
        """What waits in a buffer."""
        return taken(self.rig, name, keep=True)


def clock(instance: Instance, port: str, ticks: int) -> None:
    """Set what GETCPUCOUNTER gives."""
    instance[f"{port}.Clock.cpuCntLoDW"] = ticks & 0xFFFF_FFFF
    instance[f"{port}.Clock.cpuCntHiDW"] = ticks >> 32


def taken(instance: Instance, name: str, *, keep: bool = False) -> bytes:
    """What waits in a ComBuffer, which is empty then."""
    count, text = instance[f"{name}.Count"], instance[f"{name}.Buffer"]
    assert isinstance(count, int)
    assert isinstance(text, list)
    if not keep:
        instance[f"{name}.Count"] = 0
    return bytes(text[:count])  # type: ignore[arg-type]  # an array of BYTE


def test_time_is_measured_without_losing_parts_of_a_millisecond() -> None:
    bench = Bench()
    elapsed = []
    for ms in (9.6, 9.6, 9.6, 0.3, 0.3, 0.6, 70_000, 5):
        bench.pass_ms(ms)
        elapsed.append(bench.rig["Port.ElapsedMs"])
    assert elapsed == [9, 10, 9, 1, 0, 1, 65535, 5]


def test_bytes_that_have_come_are_handed_on_in_order_and_none_is_lost() -> None:
    bench = Bench()
    bench.rig["RxBuffer.Buffer"], bench.rig["RxBuffer.Count"] = bytes(n % 256 for n in range(300)), 300
    bench.pass_ms(10)
    assert (bench.rig["Port.RxCount"], len(bench.buffer("RxBuffer"))) == (255, 45)
    received = bench.rig["Rx"]
    assert isinstance(received, list)
    assert received[:255] == [n % 256 for n in range(255)]
    bench.pass_ms(10)
    assert (bench.rig["Port.RxCount"], bench.rig["Rx[0]"]) == (45, 255)
    bench.pass_ms(10)
    assert bench.rig["Port.RxCount"] == 0


def test_a_frame_is_sent_once_and_the_rest_of_an_older_one_is_not() -> None:
    bench = Bench()
    bench.rig["TxBuffer.Buffer"], bench.rig["TxBuffer.Count"] = b"old", 3
    bench.rig["Tx"] = b"12345678"
    bench.pass_ms(0, count=8)
    assert (bench.buffer("TxBuffer"), bench.rig["Port.TxBusy"]) == (b"12345678", False)
    taken(bench.rig, "TxBuffer")
    for _ in range(5):
        bench.pass_ms(10)
        assert bench.buffer("TxBuffer") == b""


def test_a_blocked_buffer_delays_a_frame_and_a_frame_whose_time_is_over_is_dropped() -> None:
    bench = Bench()
    bench.rig["Tx"], bench.rig["TxBuffer.Blocked"] = b"12345678", True
    bench.pass_ms(0, count=8)
    assert (bench.buffer("TxBuffer"), bench.rig["Port.TxBusy"]) == (b"", True)
    bench.rig["Tx"], bench.rig["TxBuffer.Blocked"] = b"abcdefgh", False  # the caller's own again
    bench.pass_ms(40)
    assert (bench.buffer("TxBuffer"), bench.rig["Port.TxBusy"]) == (b"12345678", False)
    bench.pass_ms(1)  # nobody has emptied it
    assert bench.buffer("TxBuffer") == b""
    bench.rig["TxBuffer.Blocked"] = True
    bench.pass_ms(0, count=8)
    bench.pass_ms(41)
    bench.rig["TxBuffer.Blocked"] = False
    bench.pass_ms(1)
    assert (bench.buffer("TxBuffer"), bench.rig["Port.TxBusy"]) == (b"", False)


def test_errors_are_reported_that_of_the_terminal_too() -> None:
    bench = Bench()
    bench.rig["Port.ControlErrorID"] = 24
    bench.pass_ms(10)
    assert [bench.rig[f"Port.{name}"] for name in ("ErrorID", "SendErrorID")] == [24, 24]
    bench.rig["Port.Receiver.Error"] = 2
    bench.pass_ms(10)
    assert [bench.rig[f"Port.{name}"] for name in ("ErrorID", "SendErrorID")] == [2, 24]
    bench.rig["Port.ControlErrorID"], bench.rig["Port.Receiver.Error"] = 0, 0
    bench.pass_ms(10)
    assert bench.rig["Port.ErrorID"] == 0


def test_the_first_motor_speaks_to_its_drive() -> None:
    """What it does with its buttons is the same on every platform: `test_openplc.py` has it."""
    text = made().motor("twincat", made().drives["invt_chf"]).text.replace("TC_Com.", "Com")
    com = "VAR\n  ComTxBuffer : ComBuffer;\n  ComRxBuffer : ComBuffer;\n  ComErrorID : UINT;\nEND_VAR\nVAR\n"
    port, line = (part.text for part in made().port("twincat")[0].parts)
    stand_ins = (Path(__file__).parent / "com.st").read_text(encoding="utf-8")
    texts = *needed("CHF"), stand_ins, port, line, text.replace("VAR\n", com, 1)  # globals are its own variables
    motor, sent = EmbeddedEngine().build([Source("twincat.st", "\n".join(texts))]).instance("CHF_Motor"), b""
    for at in range(100):
        clock(motor, "Bus.Port", at * 10 * TICKS)
        motor.scan()
        sent = sent or taken(motor, "ComTxBuffer")
    assert sent[:1] == b"\x01"
    assert motor["Bus.ElapsedMs"] == 10
