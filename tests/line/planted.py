"""Mistakes that somebody could make in the line, each as an edit of its text: the virtual line must find every one."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Planted:
    """A mistake: its name, what stands in the text, what instead, and the kind of random lines that tells."""

    name: str
    old: str
    new: str
    kind: str = "stops"

    def edit(self, text: str) -> str:
        """The text with the mistake in it, where it belongs there."""
        return text.replace(self.old, self.new)


PLANTED = (
    Planted("a new stop ranks as a command", "          Rank := RANK_STOP;\n", "          Rank := RANK_COMMAND;\n"),
    Planted(
        "a new stop is sent after polls",
        "OR ((Best > RANK_STOP) AND (DrainMs = 0) AND (Behind >= MAX(PollAfter, 1))",
        "OR ((DrainMs = 0) AND (Behind >= MAX(PollAfter, 1))",
    ),
    Planted("a scan is forgotten per transaction", "OnTop := UINT_TO_UDINT(ScanMost) + ", "OnTop := "),
    Planted(
        "the port's delay is forgotten",
        "UINT_TO_UDINT(SilenceMs) + UINT_TO_UDINT(Port.LateMs)\n        + UINT_TO_UDINT(Port.LateMs) + 2",
        "UINT_TO_UDINT(SilenceMs) + 2",
    ),
    Planted(
        "a stop waits for late replies",
        "IF (Best > RANK_AGAIN) AND (DrainMs > 0) THEN",
        "IF (Best < RANK_NONE) AND (DrainMs > 0) THEN",
    ),
    Planted(
        "an echo is believed", "Mirrors AND (Echo <> 1) AND NOT OwnHeard", "Mirrors AND (Echo > 2) AND NOT OwnHeard"
    ),
    Planted(
        "a stop is given up behind its retries",
        "            Track[Slot].StopLost := TRUE;\n",
        "            Slots[Slot].Answer[0].Number := Asked;\n",
    ),
    Planted(
        "a stop is acknowledged when it leaves",
        "  IF Box = BOX_POLL THEN\n      Track",
        "  IF Box = BOX_STOP THEN\n      Slots[Slot].Answer[0].Number := Asked;\n    END_IF;\n"
        "    IF Box = BOX_POLL THEN\n      Track",
    ),
    Planted("the turn of stops never moves", "      TurnRest := Slot + 1;\n", "      TurnRest := 0;\n"),
    Planted("the line keeps no silence", "(NOT LineKeeps OR (QuietMs > SilenceMs))", "(QuietMs < 65535)", "timing"),
    Planted("silence is a millisecond short", "(QuietMs > SilenceMs))", "(QuietMs >= SilenceMs))", "timing"),
    Planted(
        "the turn-round is forgotten",
        "DueMs := MB_Plus(Number := PlainMs, More := Slots[Slot].TurnRoundMs);",
        "DueMs := PlainMs;",
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
    Planted(
        "the checksum is not looked at", "      IF Check <> WORD#16#0000 THEN", "      IF Check <> Check THEN", "stops"
    ),
    Planted(
        "an adapter that keeps requests back is forgotten in the timeout",
        "    PlainMs := MB_Plus(Number := PlainMs, More := Port.LateMs);\n",
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
        ".SilenceMs) >= NextSilence THEN",
        ".SilenceMs) > NextSilence THEN",
        "timing",
    ),
    Planted(
        "a parameter leaves without its drive block",
        "IF (Slots[Index].ParameterCleared = Asked) AND (Count < 256) THEN",
        "IF Count < 256 THEN",
    ),
    Planted(
        "a fault reset is repeated",
        "        Most := 0;\n        Away := 0;\n",
        "        Most := CommandMost;\n        Away := 0;\n",
    ),
)
