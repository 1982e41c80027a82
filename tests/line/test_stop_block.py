"""The books of one stop alone, by values: what the line may leave out, and that a stop is never given up."""

from functools import cache

from tests.line.vline import library

from structured_text.engines.engine import Instance

CLAIMS = (
    "HasCode", "HasCopy", "StopAgain", "ResetAsked", "BlockIsBack", "Orphan", "Online", "Booting", "Dark", "SupplyBack",
    "SupplyOff", "StopConfirmed", "EndsByAnswer", "ProvedStill", "Tripped", "NobodyAnswers",
)  # fmt: skip
TIMES = ("Passed", "LineFirstMs", "SilentMs", "StopWithinMs", "LongestMs", "WorstStopMs")
KEPT = ("Forced", "Tries", "Busy", "Unsent", "Lost", "AgainMs", "PendingMs")
SCAN, GOOD, REFUSED, DAMAGED, SILENCE, DOUBTED, SENT, WITHDRAWN, IMPOSSIBLE = range(9)


@cache
def block() -> Instance:
    """One for all tests; each sets what it needs."""
    return library().instance("MB_Stop")


def mixed(number: int) -> int:
    """Bits that differ much from one number to the next."""
    return number * 0x9E3779B97F4A7C15 >> 7


def set_inputs(number: int) -> None:
    """Whatever a drive and its block may say, another mixture for each number."""
    bits = mixed(number + 1)
    for place, name in enumerate(CLAIMS):
        block()[name] = bits >> place & 1 == 1
    for place, name in enumerate(TIMES):
        block()[name] = (0, 1, 10, 500, 3000, 65535)[(bits >> (16 + 5 * place)) % 6]
    block()["Retries"] = 3


def track() -> dict[str, object]:
    """What is kept about the stop."""
    return {name: block()[f"Track.{name}"] for name in KEPT}


def test_a_slot_at_rest_may_be_left_out() -> None:
    """Not busy, no stop asked for, none forced, one block: whatever else is said, nothing changes."""
    for name in KEPT:
        block()[f"Track.{name}"] = 0
    for step in range(3000):
        set_inputs(step)
        number = (0, 1, 7)[step % 3]
        for name, value in {"Number": number, "Answered": number, "Tried": (0, 7)[step % 2]}.items():
            block()[name] = value
        for name in ("Begins", "Forces", "Taken", "InMailbox"):
            block()[name] = False
        block()["Event"] = SCAN
        block().scan()
        assert set(track().values()) == {0}
        assert [block()[name] for name in ("Leaves", "TakesBack", "Overdue")] == [False] * 3


def test_a_stop_stays_open_until_it_is_acknowledged() -> None:
    """Any claims, attempts unanswered, refusals: it waits, is due again within a second, and takes the command back."""
    for round_ in range(300):
        for name in (*KEPT, "UnsentMs", "FirstMs"):
            block()[f"Track.{name}"] = 0
        begin = {"Number": 5, "Answered": 4, "Tried": 4, "Begins": False, "Forces": False, "Taken": False}
        for name, value in {**begin, "OwnSent": False, "OtherSent": False, "HasOther": False}.items():
            block()[name] = value
        for number in range(40):
            set_inputs(40 * round_ + number)
            fixed = {
                "HasCode": True,
                "Orphan": False,
                "Dark": False,
                "EndsByAnswer": False,
                "Event": SCAN,
                "Passed": 10,
            }
            for name, value in {**fixed, "StopAgain": False, "InMailbox": False, "DriveBusy": number % 2 == 0}.items():
                block()[name] = value
            block().scan()
            where = f"round {round_}, step {number}"
            assert block()["Track.Busy"], where
            assert block()["Track.PendingMs"] != 0, where
            assert block()["Track.Unsent"] is (block()["Tried"] == 4), where
            if block()["Tried"] == 4:
                assert block()["Leaves"], where
                assert block()["TakesBack"], where
            block()["Event"] = SENT
            block().scan()
            block()["Tried"] = 5
            block()["Event"] = SCAN
            block().scan()
            block()["Event"] = (REFUSED, DAMAGED, SILENCE, DOUBTED)[mixed(40 * round_ + number) % 4]
            block().scan()
            assert not block()["Accepted"], where
            again = block()["Track.AgainMs"]
            assert isinstance(again, int)
            assert again <= 1000, where
            block()["Tried"] = 4 + mixed(40 * round_ + number) // 4 % 2
        block()["Event"] = GOOD
        block().scan()
        assert block()["Accepted"]
