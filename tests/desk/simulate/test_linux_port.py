"""LX_Port by matiec on a system that fails as it is reported: what it sends, reports, gives up and opens again.

`linuxport.c` takes the place of the system's functions; its head says the commands. Error numbers are errno's.
"""

import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from errno import EAGAIN, EBADF, EBUSY, EINTR, EIO, ENOENT, ENOTSUP, ENOTTY
from itertools import pairwise
from pathlib import Path

import pytest
from tests.blocks.toolchains import FOUND
from tests.desk.simulate.softplc import WHY_NOT, built

pytestmark = pytest.mark.skipif(bool(WHY_NOT), reason=WHY_NOT)
FRAME = "0102030405060708"
"""What `send 8` asks for."""
OPENED = "receive"
"""The first call: it opens the port, and nothing has come."""


@dataclass(frozen=True)
class Call:
    """What a call of the block shows: errno, bytes heard, ms since the last, bytes sent in hex, what it called."""

    error: int
    heard: int
    elapsed: int
    sent: str
    did: list[str]


Told = Callable[..., list[Call]]


def _call(line: str) -> Call:
    error, heard, elapsed, sent, did = line.split()
    return Call(int(error), int(heard), int(elapsed), sent.strip("-"), did.strip("-").split(","))


@pytest.fixture(scope="module", params=range(max(1, len(FOUND))))
def program(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The block by each line of matiec, on that system."""
    return built(tmp_path_factory.mktemp("linuxport"), FOUND[request.param], "linuxport.c")


@pytest.fixture
def port(program: Path) -> Told:
    """Commands to the block -> what each of its calls shows."""

    def told(*commands: str) -> list[Call]:
        done = subprocess.run([program], input="\n".join(commands), capture_output=True, text=True, check=True)
        return [_call(line) for line in done.stdout.splitlines()]

    return told


@pytest.mark.parametrize(
    "results",
    [[-EINTR], [-EINTR] * 20, [3], [3, -EINTR, 2], [1] * 8, [-EINTR, 7]],
    ids=["interrupted", "often", "in part", "in part, interrupted", "byte by byte", "interrupted, in part"],
)
def test_an_interrupted_write_is_repeated_and_a_partial_one_finished(port: Told, results: list[int]) -> None:
    _, sent, after = port(OPENED, *(f"next write {each}" for each in results), "send 8", "receive")
    assert (sent.error, sent.sent, after.error) == (0, FRAME, 0)
    assert "close" not in sent.did + after.did
    assert len(sent.did) >= len(results)


def test_a_write_that_is_interrupted_for_ever_ends(port: Told) -> None:
    _, sent, after = port(OPENED, f"always write -{EINTR}", "send 8", "receive")
    assert (sent.error, sent.sent, after.error) == (EAGAIN, "", 0)
    assert 40 <= sent.did.count("write") <= 100
    assert "close" not in sent.did


@pytest.mark.parametrize("taken", [0, 3])
@pytest.mark.parametrize("why", [-EAGAIN, 0])
def test_a_frame_for_which_there_is_no_room_is_given_up_and_reported_and_the_port_stays(
    port: Told, taken: int, why: int
) -> None:
    part = [f"next write {taken}"] if taken else []
    _, sent, after, again = port(OPENED, *part, f"next write {why}", "send 8", "receive", "send 8")
    assert (sent.error, sent.sent) == (EAGAIN, FRAME[: 2 * taken])
    assert sent.did[-1] == "flush1"  # what the driver still holds of it does not go
    assert after.did == ["read"]
    assert (after.error, again.error, again.sent) == (0, 0, FRAME)


def test_no_frame_follows_one_that_the_driver_still_holds(port: Told) -> None:
    _, sent, after, again = port(OPENED, "next queue 5", "send 8", "receive", "send 8")
    assert (sent.error, sent.sent, sent.did) == (EAGAIN, "", ["flush1"])
    assert (after.error, again.error, again.sent) == (0, 0, FRAME)


def test_a_read_that_is_interrupted_is_repeated(port: Told) -> None:
    _, heard = port(OPENED, f"next read -{EINTR}", "next read 7", "receive")
    assert (heard.error, heard.heard, heard.did) == (0, 7, ["read", "read"])


def test_an_open_that_is_interrupted_is_repeated(port: Told) -> None:
    (opened,) = port(f"next open -{EINTR}", OPENED)
    assert (opened.error, opened.did[:2]) == (0, ["open", "open"])


@pytest.mark.parametrize(("result", "error"), [(-EIO, EIO), (0, EIO)], ids=["error", "end"])
def test_a_port_that_vanishes_is_opened_in_the_next_call_and_then_once_a_second(
    port: Told, result: int, error: int
) -> None:
    calls = ["next read -11", OPENED, "now 5000", f"always read {result}", "receive"]
    calls += [f"now {now}\nreceive" for now in (5010, 5020, 6009, 6010, 6020, 7010)]
    seen = port(*calls)[1:]
    assert [call.error for call in seen] == [error] * 7
    assert [call.did.count("open") for call in seen] == [0, 1, 0, 0, 1, 0, 1]
    assert [call.did.count("close") for call in seen] == [1, 1, 0, 0, 1, 0, 1]


def test_a_port_that_was_away_works_again(port: Told) -> None:
    seen = port(
        OPENED, "now 5000", f"next read -{EIO}", "receive", f"next open -{ENOENT}", "now 5010", "receive",
        "now 6009", "send 8", "now 6010", "send 8", "next read 7", "receive",
    )  # fmt: skip
    assert [call.error for call in seen] == [0, EIO, ENOENT, ENOENT, ENOENT, 0]
    assert [call.sent for call in seen] == ["", "", "", "", FRAME, ""]
    assert seen[-1].heard == 7


def test_a_write_that_fails_closes_the_port_and_the_next_call_opens_it(port: Told) -> None:
    _, sent, after = port(OPENED, "now 5000", f"next write -{EIO}", "send 8", "now 5010", "receive")
    assert (sent.error, sent.did[-1]) == (EIO, "close")
    assert (after.error, after.did[0]) == (0, "open")


def test_a_descriptor_that_is_closed_is_reported_and_left(port: Told) -> None:
    _, lost, after = port(OPENED, "handle 78", "now 5000", "receive", "now 5010", "receive")
    assert lost.error == EBADF
    assert (after.error, after.did[0], after.did[-1]) == (0, "open", "read")


def test_the_error_of_receiving_stays_when_sending_opens_the_port(port: Told) -> None:
    _, lost, sent, after = port(OPENED, "now 5000", f"next read -{EIO}", "receive", "send 8", "receive")
    assert (lost.error, sent.error, sent.sent, after.error) == (EIO, EIO, FRAME, 0)


def test_the_line_shows_an_error_of_any_scan_for_a_second(port: Told) -> None:
    for failing in range(100, 160):
        scans = [f"now {10 * each}" + f"\nnext read -{EIO}" * (each == failing) + "\nscan" for each in range(300)]
        shown = [each for each, call in enumerate(port(*scans)) if call.error == EIO]
        assert shown[:1] == [failing]
        assert 100 <= len(shown) <= 102


@pytest.mark.parametrize(
    ("asked", "granted", "error"),
    [
        (19200, 9600, ENOTSUP), (19200, 0, 0), (19200, 19584, 0), (19200, 19585, ENOTSUP), (19200, 18816, 0),
        (19200, 18815, ENOTSUP), (115200, 115384, 0), (4000000000, 3000000000, ENOTSUP),
    ],
)  # fmt: skip
def test_a_rate_is_granted_within_two_percent_or_refused(port: Told, asked: int, granted: int, error: int) -> None:
    (opened,) = port(f"rate {asked}", f"granted {granted}", OPENED)
    assert (opened.error, "close" in opened.did) == (error, bool(error))


def test_the_port_is_locked_against_others(port: Told) -> None:
    (opened,) = port(OPENED)
    assert {"lock6", "exclusive"} <= set(opened.did)
    (refused,) = port(f"next lock -{EAGAIN}", OPENED)
    assert (refused.error, refused.did[-1], "flush2" in refused.did) == (EBUSY, "close", False)


def test_a_plc_that_starts_again_in_the_same_process_closes_what_it_had_open(port: Told) -> None:
    first, again, after = port(OPENED, "again", "receive", "receive")
    assert first.did[0] == "open"
    assert again.did[:2] == ["close", "open"]
    assert (again.error, after.did) == (0, ["read"])


def test_a_plc_that_is_unloaded_closes_what_is_open_and_nothing_else(port: Told) -> None:
    assert port(OPENED, "unload")[1].did == ["close"]
    assert port(OPENED, f"next read -{EIO}", "receive", "unload")[2].did == [""]
    assert port("unload")[0].did == [""]


def test_a_pseudo_terminal_which_would_stay_exclusive_after_its_program_is_not_made_so(port: Told) -> None:
    (opened,) = port(f"next modem -{ENOTTY}", OPENED)
    assert opened.error == 0
    assert "lock6" in opened.did
    assert "exclusive" not in opened.did


def test_settings_that_are_refused_close_the_port(port: Told) -> None:
    (refused,) = port("next set -22", OPENED)
    assert (refused.error, refused.did[-1]) == (22, "close")


def test_the_time_between_two_receiving_calls_is_measured(port: Told) -> None:
    seen = port("now 999", "receive", "now 1001", "send 8", "now 2005", "receive", "now 80000", "receive")
    assert [call.elapsed for call in seen] == [0, 0, 1006, 65535]


def _will(place: int, count: int = 2, wait: int = 30) -> str:
    return f"will {place} {count} {wait}\nreceive"


def _ended(call: Call) -> tuple[list[int], bool]:
    """When the end of a program has written, in ms, and whether it has closed the port at its end."""
    return [int(each.removeprefix("write")) for each in call.did if each.startswith("write")], call.did[-1] == "close"


def test_a_program_that_ends_sends_every_will_twice_with_the_time_for_a_reply_before_each(port: Told) -> None:
    *_, end = port("rate 9600", OPENED, "now 1000", _will(0), _will(40, 3, 60), "unload")
    times, closed = _ended(end)
    assert end.sent == "0101" + "292929" + "0101" + "292929"
    first, second, third, fourth = times
    assert (first, closed) == (1060, True)  # the longest of them: what was under way may be answered until then
    assert second >= first + 30 + 2 * 10000 // 9600
    assert third >= second + 60 + 3 * 10000 // 9600
    assert fourth - third == second - first
    assert "flush1" in end.did[:1]  # nothing that waits goes before


def test_a_will_that_was_taken_back_or_replaced_is_not_sent(port: Told) -> None:
    *_, end = port(OPENED, _will(0), _will(1), _will(1, 3), _will(0, 0), "unload")
    assert end.sent == "020202" * 2
    assert _ended(end)[1]


def test_without_a_will_nothing_is_sent(port: Told) -> None:
    assert port(OPENED, "unload")[1].did == ["close"]


@pytest.mark.parametrize(("wills", "most"), [(1, 2000), (8, 2000), (32, 8000), (64, 16000)])
@pytest.mark.parametrize("stuck", [False, True])
def test_a_program_that_ends_takes_no_longer_than_its_bound(port: Told, wills: int, most: int, stuck: bool) -> None:
    stands = ["always queue 8"] if stuck else []
    *_, end = port(OPENED, *(_will(place, 8, 60000) for place in range(wills)), *stands, "unload")
    times, closed = _ended(end)
    assert (len(times), closed) == (2 * wills, True)
    assert times[-1] <= most
    assert min(later - before for before, later in pairwise(times)) >= most // (2 * wills + 1) - 1


def test_a_restart_takes_back_what_the_program_before_has_willed(port: Told) -> None:
    *_, end = port(OPENED, _will(0), "again", _will(1), "unload")
    assert end.sent == "0202" * 2


def test_a_copy_of_the_process_leaves_the_drives_alone(port: Told) -> None:
    *_, end = port(OPENED, _will(0), "process 2", "unload")
    assert (end.sent, end.did) == ("", ["close"])


def test_a_port_that_another_has_or_that_is_gone_gets_no_will(port: Told) -> None:
    *_, end = port(f"next lock -{EAGAIN}", _will(0), "unload")
    assert (end.sent, end.did) == ("", [""])
    *_, end = port(OPENED, _will(0), f"next read -{EIO}", "receive", "unload")
    assert end.sent == ""


@pytest.mark.parametrize("result", [-EINTR, -EAGAIN, -EIO, 0, 1])
def test_a_will_that_the_driver_does_not_take_at_once_ends_all_the_same(port: Told, result: int) -> None:
    *_, end = port(OPENED, _will(0, 8), f"next write {result}", "unload")
    assert end.sent == "01" * 16
    *_, end = port(OPENED, _will(0, 8), f"always write {result}", "unload")
    assert (end.sent, end.did[-1]) == ("01" * 16 if result == 1 else "", "close")


def test_the_end_of_the_thread_that_calls_sends_the_will_and_the_next_call_opens_the_port_again(port: Told) -> None:
    ended, after, unloaded = port(
        "will 0 2 30", "thread 200", "now 9000", "receive", "will 0 0 0", "receive", "unload"
    )[:3]
    assert (ended.sent, ended.did[-1]) == ("0101" * 2, "close")
    assert after.did[0] == "open"
    assert unloaded.error == 0


def test_a_thread_for_every_scan_ends_no_program(port: Told) -> None:
    ended = port(_will(0), *["thread 1"] * 200)
    assert {call.sent for call in ended} == {""}
    assert all("close" not in call.did for call in ended)


@pytest.mark.thorough
def test_a_will_that_is_being_written_when_a_signal_ends_the_program_is_not_sent_in_parts(program: Path) -> None:
    done = subprocess.run([program], input="torn 1000\n", capture_output=True, text=True, check=True)
    sent = done.stdout.split()
    assert len(sent) == 1000
    for wire in sent:
        assert len(wire) == 2 * 2 * 40
        assert wire == wire[:2] * 80
