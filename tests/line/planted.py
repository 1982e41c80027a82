"""Mistakes that somebody could make in the line, each as an edit of its text: the virtual line must find every one."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Planted:
    """A mistake: its name, what is in the text, what instead, and the kind of random lines that tells."""

    name: str
    old: str
    new: str
    kind: str = "stops"

    def edit(self, text: str) -> str:
        """The text with the mistake in it, where it belongs there."""
        return text.replace(self.old, self.new)


PLANTED = (
    Planted("a new stop ranks as a command", "    MB_Rank := RANK_STOP;\n", "    MB_Rank := RANK_COMMAND;\n"),
    Planted(
        "a new stop is sent after polls",
        "OR ((Best > RANK_STOP) AND (DrainMs = 0) AND (After >= MAX(PollAfter, 1))",
        "OR ((DrainMs = 0) AND (After >= MAX(PollAfter, 1))",
    ),
    Planted("a scan is forgotten per transaction", "OnTop := UINT_TO_UDINT(ScanMs) + ", "OnTop := "),
    Planted(
        "the port's delay is forgotten",
        "UINT_TO_UDINT(SilenceMs) + UINT_TO_UDINT(PortLateMs)\n      + UINT_TO_UDINT(PortLateMs) + 2",
        "UINT_TO_UDINT(SilenceMs) + 2",
    ),
    Planted(
        "a stop waits for late replies",
        "IF (Best > RANK_AGAIN) AND (DrainMs > 0) THEN",
        "IF (Best < RANK_NONE) AND (DrainMs > 0) THEN",
    ),
    Planted(
        "an echo is believed",
        "Open.Mirrors AND (Echo <> ECHO_NONE) AND NOT OwnHeard",
        "Open.Mirrors AND (Echo > ECHO_HEARD) AND NOT OwnHeard",
    ),
    Planted(
        "a stop is given up after its retries",
        "      IF NOT Stop.Accepted THEN\n",
        "      IF Track[Slot].Stop.Lost THEN\n        Slots[Slot].Answer[0].Number := Asked;\n      END_IF;\n"
        "      IF NOT Stop.Accepted THEN\n",
    ),
    Planted(
        "a stop is acknowledged when it is sent",
        "      Stop(Event := EVENT_SENT, Track := Track[Chosen].Stop);\n",
        "      Slots[Chosen].Answer[0].Number := Asked;\n"
        "      Stop(Event := EVENT_SENT, Track := Track[Chosen].Stop);\n",
    ),
    Planted("the turn of stops never moves", "      TurnStop := (Chosen + 1) MOD ", "      TurnStop := 0 MOD "),
    Planted(
        "the line keeps no silence",
        "(NOT Promise.LineKeeps OR (QuietMs > Promise.SilenceMs))",
        "(QuietMs < 65535)",
        "timing",
    ),
    Planted(
        "silence is a millisecond short", "(QuietMs > Promise.SilenceMs))", "(QuietMs >= Promise.SilenceMs))", "timing"
    ),
    Planted(
        "the turn-round is forgotten",
        "Open.DueMs := MB_Plus(Number := Open.PlainMs, More := TurnRoundMs);",
        "Open.DueMs := Open.PlainMs;",
        "timing",
    ),
    Planted(
        "time runs before the port has the request",
        "    SinceMs := Passed;\n    QuietMs := Passed;\n",
        "    SinceMs := MB_Plus(Number := SinceMs, More := 20);\n    QuietMs := Passed;\n",
        "timing",
    ),
    Planted(
        "late replies are not waited out",
        "IF (Best > RANK_AGAIN) AND (DrainMs > 0) THEN",
        "IF (Best > RANK_NONE) AND (DrainMs > 0) THEN",
        "late",
    ),
    Planted("the checksum is not checked", "    IF Check <> WORD#16#0000 THEN", "    IF Check <> Check THEN", "stops"),
    Planted(
        "an adapter that keeps requests back is forgotten in the timeout",
        "  Open.PlainMs := MB_Plus(Number := Open.PlainMs, More := PortLateMs);\n",
        "",
        "timing",
    ),
    Planted(
        "a request that nobody answers passes for silence",
        "    SinceMs := Passed;\n    QuietMs := Passed;\n",
        "    SinceMs := Passed;\n    QuietMs := 0;\n",
    ),
    Planted(
        "the port's silence, rounded up, passes for the drive's",
        "(SlotSilence) >= NextSilence THEN",
        "(SlotSilence) > NextSilence THEN",
        "timing",
    ),
    Planted(
        "a parameter is sent without its drive block",
        "Passes := ParameterCleared AND ",
        "Passes := ",
    ),
    Planted(
        "a fault reset is repeated",
        "        More := 0;\n        BusyReason := 0;\n",
        "        More := CommandMost;\n        BusyReason := 0;\n",
    ),
)
