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
        "OR ((Next.Best > RANK_STOP) AND (Times.DrainMs = 0) AND (Next.After >= MAX(PollAfter, 1))",
        "OR ((Times.DrainMs = 0) AND (Next.After >= MAX(PollAfter, 1))",
    ),
    Planted("a scan is forgotten per transaction", "OnTop := UINT_TO_UDINT(ScanMs) + ", "OnTop := "),
    Planted(
        "the port's delay is forgotten",
        "UINT_TO_UDINT(SilenceMs) + UINT_TO_UDINT(PortLateMs)\n      + UINT_TO_UDINT(PortLateMs) + 2",
        "UINT_TO_UDINT(SilenceMs) + 2",
    ),
    Planted(
        "a stop waits for late replies",
        "IF (Next.Best > RANK_AGAIN) AND (Times.DrainMs > 0) THEN",
        "IF (Next.Best < RANK_NONE) AND (Times.DrainMs > 0) THEN",
    ),
    Planted(
        "an echo is believed",
        "Open.Mirrors AND (Echo <> ECHO_NONE) AND NOT Talk.OwnHeard",
        "Open.Mirrors AND (Echo > ECHO_HEARD) AND NOT Talk.OwnHeard",
    ),
    Planted(
        "a stop is given up after its retries",
        "      IF NOT (Open.Own OR Stop.Accepted) THEN\n",
        "      IF Track[Slot].Stop.Lost THEN\n        Slots[Slot].Answer[0].Number := Talk.Asked;\n      END_IF;\n"
        "      IF NOT (Open.Own OR Stop.Accepted) THEN\n",
    ),
    Planted(
        "a stop is acknowledged when it is sent",
        "      Stop(Event := EVENT_SENT, Track := Track[Next.Chosen].Stop);\n",
        "      Slots[Next.Chosen].Answer[0].Number := Talk.Asked;\n"
        "      Stop(Event := EVENT_SENT, Track := Track[Next.Chosen].Stop);\n",
    ),
    Planted(
        "the turn of stops never moves",
        "      Next.TurnStop := (Next.Chosen + 1) MOD ",
        "      Next.TurnStop := 0 MOD ",
    ),
    Planted(
        "the line keeps no silence",
        "(NOT Promise.LineKeeps OR (Times.QuietMs > Promise.SilenceMs))",
        "(Times.QuietMs < 65535)",
        "timing",
    ),
    Planted(
        "silence is a millisecond short",
        "(Times.QuietMs > Promise.SilenceMs))",
        "(Times.QuietMs >= Promise.SilenceMs))",
        "timing",
    ),
    Planted(
        "the turn-round is forgotten",
        "Open.DueMs := MIN(MB_Plus(Number := Open.PlainMs, More := Slots[Next.Chosen].TurnRoundMs), 65534);",
        "Open.DueMs := Open.PlainMs;",
        "timing",
    ),
    Planted(
        "time runs before the port has the request",
        "    Times.SinceMs := Times.Passed;\n    Times.QuietMs := Times.Passed;\n",
        "    Times.SinceMs := MB_Plus(Number := Times.SinceMs, More := 20);\n    Times.QuietMs := Times.Passed;\n",
        "timing",
    ),
    Planted(
        "late replies are not waited out",
        "IF (Next.Best > RANK_AGAIN) AND (Times.DrainMs > 0) THEN",
        "IF (Next.Best > RANK_NONE) AND (Times.DrainMs > 0) THEN",
        "late",
    ),
    Planted(
        "the checksum is not checked",
        "    IF Heard.Check <> WORD#16#0000 THEN",
        "    IF Heard.Check <> Heard.Check THEN",
        "stops",
    ),
    Planted(
        "an adapter that keeps requests back is forgotten in the timeout",
        "  Open.PlainMs := MB_Plus(Number := Open.PlainMs, More := Port.LateMs);\n",
        "",
        "timing",
    ),
    Planted(
        "a request that nobody answers passes for silence",
        "    Times.SinceMs := Times.Passed;\n    Times.QuietMs := Times.Passed;\n",
        "    Times.SinceMs := Times.Passed;\n    Times.QuietMs := 0;\n",
    ),
    Planted(
        "the port's silence, rounded up, passes for the drive's",
        "(SlotSilence) >= Sums.NextSilence THEN",
        "(SlotSilence) > Sums.NextSilence THEN",
        "timing",
    ),
    Planted(
        "a parameter is sent without its drive block",
        "Passes := ParameterCleared AND ",
        "Passes := ",
    ),
    Planted(
        "a fault reset is repeated",
        "        Talk.More := 0;\n        Talk.BusyReason := 0;\n",
        "        Talk.More := CommandMost;\n        Talk.BusyReason := 0;\n",
    ),
)
