"""The adapter for TwinCAT on the embedded engine, with stand-ins for Beckhoff's blocks: what becomes of bytes and time.

It cannot show that Beckhoff's blocks do what their manuals say.
"""

import functools
from pathlib import Path

from tests.export.stock import canon, made
from tests.export.test_openplc import written

from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Instance, Library, Source

TICKS = 10_000
"""Of GETCPUCOUNTER in a millisecond."""
TRIAL = """
FUNCTION_BLOCK Trial
VAR
  Port : TC_Port;
  Rx : MB_Adu;
  Tx : MB_LineFrame;
  TxBuffer : ComBuffer;
  RxBuffer : ComBuffer;
  TxCount : UINT;
  ControlErrorID : UINT;
END_VAR
  Port(ControlErrorID := ControlErrorID, TxCount := TxCount, PortLateMs := 20, Rx := Rx, Tx := Tx, TxBuffer := TxBuffer,
    RxBuffer := RxBuffer);
END_FUNCTION_BLOCK
"""


COM = (Path(__file__).parent / "com.st").read_text(encoding="utf-8")


def engine_library(*texts: str) -> Library:
    """Texts on the embedded engine."""
    return EmbeddedEngine().build([Source("twincat.st", "\n".join(texts))])


@functools.cache
def adapter() -> list[str]:
    """TC_Port, TC_Line8 and TC_Line32."""
    return [part.text for part in made().adapter("twincat")]


@functools.cache
def trial() -> Library:
    """The port between two buffers."""
    return engine_library(canon()["MB_Adu"].text, canon()["MB_LineFrame"].text, COM, adapter()[0], TRIAL)


def first_motor() -> Instance:
    """The first motor of the CHF family, whose globals are its own variables here."""
    text = made().motor("twincat", made().drives["invt_chf"]).text.replace("TC_Com.", "Com")
    com = "VAR\n  ComTxBuffer : ComBuffer;\n  ComRxBuffer : ComBuffer;\n  ComErrorID : UINT;\nEND_VAR\nVAR\n"
    port, line, _ = adapter()
    return engine_library(written()["CHF.st"], COM, port, line, text.replace("VAR\n", com, 1)).instance("CHF_Motor")


class Bench:
    """A port between two buffers."""

    def __init__(self) -> None:
        """At a time near the wrap of the low word."""
        self.trial = trial().instance("Trial")
        self.ticks = 0xFFFF_FF00
        self.pass_ms(0)

    def pass_ms(self, ms: float, count: int = 0) -> None:
        """Let time pass, then call it once; `count` above 0 sends."""
        self.ticks += int(ms * TICKS)
        clock(self.trial, "Port", self.ticks)
        self.trial["TxCount"] = count
        self.trial.scan()

    def buffer(self, name: str) -> bytes:
        """What waits in a buffer."""
        return taken(self.trial, name, keep=True)


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
        elapsed.append(bench.trial["Port.ElapsedMs"])
    assert elapsed == [9, 10, 9, 1, 0, 1, 65535, 5]


def test_bytes_that_have_come_are_handed_on_in_order_and_none_is_lost() -> None:
    bench = Bench()
    bench.trial["RxBuffer.Buffer"], bench.trial["RxBuffer.Count"] = bytes(n % 256 for n in range(300)), 300
    bench.pass_ms(10)
    assert (bench.trial["Port.RxCount"], len(bench.buffer("RxBuffer"))) == (255, 45)
    received = bench.trial["Rx"]
    assert isinstance(received, list)
    assert received[:255] == [n % 256 for n in range(255)]
    bench.pass_ms(10)
    assert (bench.trial["Port.RxCount"], bench.trial["Rx[0]"]) == (45, 255)
    bench.pass_ms(10)
    assert bench.trial["Port.RxCount"] == 0


def test_a_frame_is_sent_once_and_the_rest_of_an_older_one_is_not() -> None:
    bench = Bench()
    bench.trial["TxBuffer.Buffer"], bench.trial["TxBuffer.Count"] = b"old", 3
    bench.trial["Tx"] = b"12345678"
    bench.pass_ms(0, count=8)
    assert (bench.buffer("TxBuffer"), bench.trial["Port.TxBusy"]) == (b"12345678", False)
    taken(bench.trial, "TxBuffer")
    for _ in range(5):
        bench.pass_ms(10)
        assert bench.buffer("TxBuffer") == b""


def test_a_blocked_buffer_delays_a_frame_and_a_frame_whose_time_is_over_is_dropped() -> None:
    bench = Bench()
    bench.trial["Tx"], bench.trial["TxBuffer.Blocked"] = b"12345678", True
    bench.pass_ms(0, count=8)
    assert (bench.buffer("TxBuffer"), bench.trial["Port.TxBusy"]) == (b"", True)
    bench.trial["Tx"], bench.trial["TxBuffer.Blocked"] = b"abcdefgh", False  # the caller's own again
    bench.pass_ms(20)
    assert (bench.buffer("TxBuffer"), bench.trial["Port.TxBusy"]) == (b"12345678", False)
    bench.pass_ms(1)  # nobody has emptied it
    assert bench.buffer("TxBuffer") == b""
    bench.trial["TxBuffer.Blocked"] = True
    bench.pass_ms(0, count=8)
    bench.pass_ms(21)
    bench.trial["TxBuffer.Blocked"] = False
    bench.pass_ms(1)
    assert (bench.buffer("TxBuffer"), bench.trial["Port.TxBusy"]) == (b"", False)


def test_errors_are_reported_that_of_the_terminal_too() -> None:
    bench = Bench()
    bench.trial["ControlErrorID"] = 24
    bench.pass_ms(10)
    assert [bench.trial[f"Port.{name}"] for name in ("ErrorID", "SendErrorID")] == [24, 24]
    bench.trial["Port.Receiver.Error"] = 2
    bench.pass_ms(10)
    assert [bench.trial[f"Port.{name}"] for name in ("ErrorID", "SendErrorID")] == [2, 24]
    bench.trial["ControlErrorID"], bench.trial["Port.Receiver.Error"] = 0, 0
    bench.pass_ms(10)
    assert bench.trial["Port.ErrorID"] == 0


def test_the_first_motor_speaks_to_its_drive() -> None:
    """What it does with its buttons is the same on every platform: `test_openplc.py` has it."""
    motor, sent = first_motor(), b""
    for at in range(100):
        clock(motor, "Bus.Port", at * 10 * TICKS)
        motor.scan()
        sent = sent or taken(motor, "ComTxBuffer")
    assert sent[:1] == b"\x01"
    assert motor["Bus.ElapsedMs"] == 10
