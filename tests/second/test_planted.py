"""Mistakes of former texts, planted into the present one: the matrix sees each."""

import pytest
from tests.second.matrix import named, run
from tests.second.station import built

from structured_text.engines.embedded.engine import EmbeddedEngine

ENDS = "EndsByAnswer := NOT Send.MayMove AND (Send.Proved OR Asked.MonitorOnly OR Asked.SpeedOnly);"
TWO_STOPS = """  Orders(Order := RAMP_STOP);
  Slot.StopRegister := Orders.Register;
  Slot.StopWord := Orders.Value;
  Orders(Order := JOG_STOP"""
PLANTED = (
    # the end of a jog is what the line sends for a block that is not called
    (TWO_STOPS, TWO_STOPS.replace("RAMP_STOP", "JOG_STOP"),
     "CHF, full control, block not called for 12 s, at speed", {"stop", "prompt"}),
    # a stop in a mode that only reads, or only gives the reference, ends by proof alone, which there is none of
    (ENDS, ENDS.replace("Asked.MonitorOnly OR ", ""), "JSCC, MonitorOnly, nothing, at speed", {"contact", "close"}),
    (ENDS, ENDS.replace(" OR Asked.SpeedOnly", ""), "JSCC, SpeedOnly, StopAll pulse, at speed", {"contact", "close"}),
    # the mode is taken in the call of the restart, and no stop is sent
    ("PostStop := Rounds.Posts;", "PostStop := Rounds.Posts AND NOT Asked.SpeedOnly;",
     "CHF, full control, Restart into SpeedOnly, at speed", {"stop", "prompt"}),
    # what the line counts is what was on the wire
    (" Good := Good + 1;", " Good := Good + 2;", "CHF, full control, nothing, at speed", {"ends"}),
    ("CycleMs := Times.RoundMs;", "CycleMs := Times.SinceMs;", "CHF, full control, nothing, at speed", {"round"}),
    # what is kept of a fault, and which way it turns
    ("FirstFaultA := Amps;", "FirstFaultA := Volts;", "CHF, full control, a trip, at speed", {"first fault"}),
    ("FaultBack2 := Diagnosis.FaultBack1;", "FaultBack2 := Code;", "CHF, full control, a trip, at speed", {"faults"}),
    ("Reverse := CommOk AND DriveStatusBits.RunningReverse;", "Reverse := DriveStatusBits.RunningForward;",
     "CHF, MonitorOnly, nothing, at speed", {"direction"}),
    # the wire is neither left unused nor spoken on while a drive may answer, and what it says is kept
    ("AND (Times.SinceMs > Open.DueMs) THEN\n    IF", "AND (Times.SinceMs > Open.DueMs + 200) THEN\n    IF",
     "CHF, full control, a dead neighbour, at speed", {"waits"}),
    ("AND (Times.SinceMs > Open.DueMs) THEN\n    IF", "AND (Times.SinceMs > Open.OwnMs) THEN\n    IF",
     "CHF, full control, a dead neighbour, at speed", {"interrupts", "comm"}),
    ("Slots[Slot].LastErrorID := Talk.ErrorOf;", "Slots[Slot].LastErrorID := 0;",
     "CHF, full control, a dead neighbour, at speed", {"last error"}),
    ("Slots[Slot].RefusedAddress := Open.Register;", "Slots[Slot].RefusedReason := 0;",
     "GD200A, full control, it refuses to be read, at speed", {"refused what"}),
    ("Number := ParameterRetries, Usual := 1", "Number := ParameterRetries, Usual := 2",
     "CHF, full control, parameters without an answer, standstill", {"ends with"}),
    # what proves standstill is read after the stop; why a run has ended
    ("IF Anew OR Forget OR Reread THEN", "IF Anew OR Forget THEN",
     "CHF, full control, a start of 60 ms, standstill", {"proved"}),
    ("  ELSIF Ends <> 0 THEN\n    StopReason := Ends;", "  ELSIF Ends <> 0 THEN\n    StopReason := WHY_HELD;",
     "CHF, full control, the pin falls, at speed", {"why it ended"}),
    ("ZeroSpeed := CommOk AND", "ZeroSpeed := CommOk AND NOT",
     "CHF, full control, nothing, at speed", {"shows ZeroSpeed"}),
    ("FirstFaultMs := SinceStartMs;", "FirstFaultMs := 0;",
     "CHF, full control, a trip, at speed", {"first fault's time"}),
    # each slot counts its own requests, and the line its own scans and rounds; several words are those of the registers
    ("Slots[Slot].Replies := MIN(Slots[Slot].Replies, 254) + 1;", "Slots[0].Replies := MIN(Slots[0].Replies, 254) + 1;",
     "CHF, full control, a dead neighbour, at speed", {"counters"}),
    ("PollCount := UINT_TO_USINT(Open.Quantity MOD 17);", "PollCount := 16;",
     "CHF, full control, nothing, at speed", {"poll count"}),
    ("Times.LateScanMs := 10000;", "Times.LateScanMs := 9000;",
     "CHF, full control, a stall of 300 ms, at speed", {"scan late"}),
    ("WorstCycleMs := MAX(WorstCycleMs, CycleMs);", "WorstCycleMs := CycleMs;",
     "CHF, full control, a dead neighbour, at speed", {"worst round"}),
    ("ELSIF Why2 <> 0 THEN", "ELSIF Why3 <> 0 THEN",
     "JSCC, full control, parameters of several words, standstill", {"parameter"}),
    ("IF ElapsedMs > 0 THEN", "IF ElapsedMs > 1 THEN",
     "CHF, full control, scans of a millisecond, at speed", {"idle", "contact", "comm"}),
    ("IF Talk.ClearReads < 2 THEN", "IF Talk.ClearReads <= 2 THEN",
     "CHF, full control, nothing, at speed", {"echo known"}),
    # a lost read is repeated at once, with another length, once late replies are waited out; reads come between writes
    ("        Times.DrainMs := MAX(Times.DrainMs, Times.AttemptMs);", "        Times.DrainMs := Times.DrainMs;",
     "CHF, full control, replies lost, at speed", {"drains"}),
    ("IF Talk.Believed OR (Talk.Tries > Talk.More) OR NOT", "IF Talk.Believed OR TRUE OR NOT",
     "CHF, full control, replies lost, at speed", {"again at once"}),
    ("Track[Slot].Varied := NOT Track[Slot].Varied;", "Track[Slot].Varied := FALSE;",
     "CHF, full control, replies lost, at speed", {"other length"}),
    ("(Next.After >= MAX(PollAfter, 1))", "(Next.After >= 9)",
     "CHF, full control, replies lost, at speed", {"reads between"}),
    ("(USINT_TO_UDINT(Motors) - 1) * OnTop", "USINT_TO_UDINT(Motors) * OnTop",
     "CHF, full control, a dead neighbour, at speed", {"WorstStopMs"}),
    # the end of a jog that was refused is sent again
    ("JogRefused := Drops OR (JogRefused AND NOT Closed);", "JogRefused := JogRefused OR Drops;",
     "GD200A, jog, a stop is refused, at speed", {"prompt"}),
    # a stop does not become a weaker one
    ("    Rank := MAX(Rank, Asked.StopKind);", "    Rank := Asked.StopKind;",
     "CHF, full control, weaker and weaker stops, at speed", {"kind"}),
    # whose the time on the wire is, and what is made of it
    ("SilenceMs := 10,", "SilenceMs := 0,", "JSCC, full control, nothing, at speed", {"silence"}),
    ("Times.BusyMs := MB_Plus(Number := Times.BusyMs, More := Times.Passed);",
     "Times.BusyMs := MB_Plus(Number := Times.BusyMs, More := Times.Passed / 2);",
     "GD200A, full control, a run of more than a minute, at speed", {"load"}),
    ("IF (OnlineCount > 0) AND NOT Scan.Dark THEN", "IF FALSE THEN",
     "GD200A, full control, all but one are dead, at speed", {"quarter"}),
    ("ELSIF Free AND Moves AND NOT Commanded THEN", "ELSIF Free AND Moves THEN",
     "CHF, full control, references of others never rest, standstill", {"parameter"}),
    ("AND NOT (Repeated AND Online", "AND NOT (FALSE AND Online",
     "CHF, MonitorOnly, all others trip, ramping down", {"parameter"}),
    ("Next.TurnDead := (Next.Chosen + 1) MOD 8;", "Next.TurnDead := 0;",
     "GD200A, full control, all but one are dead, at speed", {"silent"}),
    ("LateReplies := MB_Plus(Number := LateReplies, More := 1);",
     "LateReplies := MB_Plus(Number := LateReplies, More := 2);",
     "CHF, full control, a run of more than a minute, at speed", {"late"}),
    ("* 2 + MARGIN_MS;", "* 2 + LEAST_MS;", "CHF, full control, nothing, at speed", {"turn-round"}),
    ("+ 2 * UINT_TO_UDINT(ScanMs);", "+ 5 * UINT_TO_UDINT(ScanMs);",
     "CHF, full control, a dead neighbour, at speed", {"CutToContactMs"}),
    # what is seldom: the highest address, a second minute, another fault, a drive that is not ready
    ("(Number <= Highest)", "(Number < Highest)",
     "CHF, full control, its highest address, standstill", {"address"}),
    ("RunMs := RunMs - MINUTE_MS;", "RunMs := RunMs;",
     "CHF, full control, a run of more than a minute, at speed", {"minutes"}),
    ("IF Fault AND NOT Rest.CodeOpen THEN", "IF Fault THEN",
     "CHF, full control, one fault after another, at speed", {"another code"}),
    ("ELSIF NOT Seen.ReadyShown THEN", "ELSIF Seen.ReadyShown THEN",
     "SN300G5, full control, nothing, standstill", {"bars"}),
    # what a restart leaves, why nobody answers, and whose a drive is that may move
    ("Anew := Link.Restarted OR Unit.Moved;", "Anew := Link.Restarted AND Unit.Moved;",
     "PF4, full control, Restart, at speed", {"keeps"}),
    ("Replied := Replied AND NOT Seen.Restarted;", "Replied := Replied OR NOT Seen.Restarted;",
     "CHF, full control, a restart while it is dead, at speed", {"silent since"}),
    ("Dark := SupplyOff AND NOT Slot.Online", "Dark := SupplyOff OR NOT Slot.Online",
     "SN300G5, full control, another address for a dead drive, at speed", {"bound"}),
    ("Refuses := Asked.Motion OR NOT CanResetFault OR", "Refuses := Asked.Motion OR",
     "SN300G5, full control, a trip and a held reset, at speed", {"why"}),
    ("SpeedRead := FALSE;", "SpeedRead := TRUE;",
     "PF4, full control, a start of 300 ms, standstill", {"proved"}),
)  # fmt: skip
SEEDS = 6


@pytest.mark.parametrize(("old", "new", "cell", "rules"), PLANTED)
@pytest.mark.thorough
def test_a_planted_mistake_is_seen(old: str, new: str, cell: str, rules: set[str]) -> None:
    counted: list[int] = []

    def edit(text: str) -> str:
        counted.append(text.count(old))
        return text.replace(old, new)

    stations = built(EmbeddedEngine(), edit)
    assert any(counted), "the mistake has its place"
    found: set[str] = set()
    for seed in range(SEEDS):
        found |= set(run(named(cell), seed, stations).rules)
        if found & rules:
            return
    pytest.fail(f"no {rules}: {found or 'nothing'}")
