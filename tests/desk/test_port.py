"""Ports of the machine: a connection that comes and goes, and a serial port as it is asked for."""

import socket
from typing import Any

import pytest
import serial

from driveblocks.desk import port
from driveblocks.desk.clock import RealClock, VirtualClock


def test_a_connection_carries_bytes_and_says_when_it_has_gone() -> None:
    clock = VirtualClock()
    with socket.create_server(("127.0.0.1", 0)) as server:
        number = server.getsockname()[1]
        made = port.tcp("127.0.0.1", number, clock)
        peer, _ = server.accept()
        assert (made.receive(), made.error) == (b"", "")
        made.send(b"asked")
        assert peer.recv(5) == b"asked"
        peer.sendall(b"said")
        heard = b""
        while len(heard) < 4:
            heard += made.receive()
        assert heard == b"said"
        peer.close()
        while not made.error:
            made.receive()
        assert made.error == "the other side has closed the connection"
        made.send(b"lost")
        clock.sleep_until(port.AGAIN_US)
        assert (made.receive(), made.error) == (b"", "")
        server.accept()[0].close()
    made.close()
    with pytest.raises(OSError, match="refused"):
        port.tcp("127.0.0.1", number, clock)


def test_a_name_is_looked_up_once_and_its_address_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, real, asked = VirtualClock(), socket.getaddrinfo, list[Any]()

    def slow(*words: Any, **options: Any) -> Any:
        asked.append(words)
        dead = (socket.AF_INET, socket.SOCK_STREAM, 0, "", ("127.0.0.1", 1))
        return [dead, *real("127.0.0.1", *words[1:], **options)]

    monkeypatch.setattr(socket, "getaddrinfo", slow)
    with socket.create_server(("127.0.0.1", 0)) as server:
        made = port.tcp("a.name", server.getsockname()[1], clock)
        server.accept()[0].close()
        while not made.error:
            made.receive()
        clock.sleep_until(port.AGAIN_US)
        assert (made.receive(), made.error) == (b"", "")
        made.close()
    first, *others = (words[0] for words in asked)
    assert (first, set(others)) == ("a.name", {"127.0.0.1"})


class Fake:
    """A serial port that is no port."""

    asked: tuple[Any, ...] = ()

    def __init__(self, *words: Any, **options: Any) -> None:
        Fake.asked = words
        assert (options["timeout"], options["write_timeout"]) == (0, 0)
        if words[2] == 7:
            raise RuntimeError("an error of this platform alone")

    def write(self, data: bytes) -> None:
        self.data = data

    def read(self, _: int) -> bytes:
        return self.data

    def close(self) -> None:
        self.data = b""


def test_a_serial_port_is_opened_as_the_program_says(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(serial, "Serial", Fake)
    made = port.serial_port("COM3", 19200, "8E1", VirtualClock())
    assert Fake.asked == ("COM3", 19200, 8, "E", 1)
    made.send(b"frame")
    assert made.receive() == b"frame"
    made.close()
    with pytest.raises(OSError, match="the port refuses 9600 bit/s 7E1"):
        port.serial_port("COM3", 9600, "7E1", VirtualClock())


def test_the_clock_of_the_machine_goes_on() -> None:
    clock = RealClock()
    begun = clock.now_us()
    clock.sleep_until(begun + 1)
    assert clock.now_us() > begun
