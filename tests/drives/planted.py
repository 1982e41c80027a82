"""Mistakes that somebody could make in a drive block, each as an edit of its text, and the test that has to find it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from unittest.mock import patch

from tests.drives import test_identity, test_modes, test_reset, test_start, test_stop
from tests.drives.station import built

from structured_text.engines.embedded.engine import EmbeddedEngine

CHF, SN, CIA, PUL = ("CHF",), ("SN300G5",), ("CIA",), ("PUL",)
THREE = ("CHF", "JSCC", "SN300G5")
never_stored = test_start.test_an_edge_is_never_stored
needs_release = test_start.test_what_stops_a_motor_needs_a_release_and_a_new_edge


@dataclass(frozen=True)
class Planted:
    """A mistake: its name, what is in the text, what instead, the test that tells, and the drives that it needs."""

    name: str
    old: str
    new: str
    test: Callable[[], None]
    kinds: Sequence[str] = CHF

    def edit(self, text: str) -> str:
        """The text with the mistake in it, where it belongs there."""
        return text.replace(self.old, self.new)

    def found(self) -> bool:
        """Whether its test turns red."""
        stations = built(EmbeddedEngine(), self.edit, self.kinds)
        with patch("tests.drives.bench.library", lambda: stations):
            try:
                self.test()
            except AssertionError:
                return True
        return False

    @property
    def by(self) -> str:
        """The name of the test."""
        test = self.test
        if not isinstance(test, partial):
            return test.__name__
        return f"{test.func.__name__}[{'-'.join(map(str, test.args))}]"


PLANTED = (
    Planted(
        "a stop is sent once",
        "      AND ((SinceMs >= UNREAD_MS) OR",
        "      AND (State > 9) AND ((SinceMs >= UNREAD_MS) OR",
        partial(test_stop.test_a_stop_is_sent_at_once_and_again_until_the_motor_is_at_standstill, "CHF"),
    ),
    Planted(
        "an edge that comes too early is not held",
        "  Held := Barred OR (Asked.Motion AND NOT Starts AND NOT UnderWay);\n  MotionMemory := Asked.Motion;",
        "  Held := Barred;\n  MotionMemory := Asked.Motion AND (Starts OR UnderWay);",
        test_start.test_an_edge_before_the_stop_is_confirmed_is_lost,
    ),
    *(
        Planted(
            f"{what} does not count", f"  ELSIF {old} THEN\n    Asked.Bar", "  ELSIF FALSE THEN\n    Asked.Bar", test
        )
        for what, old, test in (
            ("SupplyOff", "SupplyOff", partial(never_stored, "no supply")),
            ("a missing line", "NOT Seen.Linked", partial(never_stored, "no line")),
            ("a fault", "Seen.FaultPresent", partial(never_stored, "a fault")),
            ("StopAll", "StopAll", partial(never_stored, "StopAll")),
            ("SpeedOnly", "SpeedOnly", partial(never_stored, "only speed")),
            ("MonitorOnly", "MonitorOnly", partial(never_stored, "only reads")),
            ("Enable", "NOT Enable", partial(needs_release, "Enable")),
            ("a stop pin", "QuickStop OR CoastStop", partial(needs_release, "CoastStop")),
            ("both directions", "Asked.BothWays", partial(needs_release, "both directions")),
            ("a setting that is missing", "Seen.Missing", partial(needs_release, "no time to stop")),
            (
                "a reference that is no number",
                "Asked.Motion AND (Seen.ReferenceErrorID <> 0)",
                partial(needs_release, "no number"),
            ),
        )
    ),
    Planted(
        "a shared slot does not count",
        "  Shared := (Slot.Alive <> AliveSeen) AND NOT Restarted",
        "  Shared := (Slot.Alive <> AliveSeen) AND NOT Started",
        test_modes.test_two_blocks_on_one_slot_are_stopped,
    ),
    Planted(
        "a refresh goes out after a dip of the supply",
        "  ELSIF Ran AND NOT Seen.Moving THEN",
        "  ELSIF FALSE THEN",
        partial(test_start.test_a_short_dip_of_the_supply_starts_nothing, "CHF"),
    ),
    Planted(
        "a run of its own is taken over",
        "  Stirs := (State = STOPPED) AND (Seen.Moving OR (Seen.ProofRead AND NOT Seen.Stands));",
        "  Stirs := FALSE;",
        partial(test_start.test_a_keypad_that_starts_or_stops_is_answered_by_a_stop, "CHF"),
    ),
    Planted(
        "a start is sent without its reference",
        "  IF Starts THEN\n    Next := SET_SPEED;",
        "  IF Starts THEN\n    Next := Asked.Order;",
        test_start.test_no_run_before_its_reference_is_acknowledged,
    ),
    Planted(
        "run does not wait for its reference",
        "  ELSIF (State = REFERRING) AND Run.Taken AND NOT Run.Answered THEN",
        "  ELSIF (State = REFERRING) AND (Send.SinceStartMs > 40) THEN",
        test_start.test_no_run_before_its_reference_is_acknowledged,
    ),
    Planted(
        "a run without an answer is left alone",
        "  ELSIF ErrorID <> 0 THEN\n    Ends :=",
        "  ELSIF FALSE THEN\n    Ends :=",
        test_start.test_a_run_that_nobody_acknowledges_is_stopped_until_confirmed,
    ),
    Planted(
        "settings are not verified",
        "SettingsGood := NOT ",
        "SettingsGood := TRUE OR NOT ",
        test_start.test_what_gives_the_reference_its_meaning_is_read_first,
        SN,
    ),
    Planted(
        "a setting may change while it runs",
        "  ELSIF Seen.SettingsRead AND NOT Seen.SettingsGood THEN\n    Ends :=",
        "  ELSIF FALSE THEN\n    Ends :=",
        test_start.test_a_setting_that_changes_while_it_runs_stops_it,
        SN,
    ),
    Planted(
        "standstill is believed by words read before",
        "  Reread := Closes AND (State = STOPPING) AND NOT Acknowledged;",
        "  Reread := FALSE;",
        test_stop.test_words_read_before_the_acknowledgement_prove_nothing,
    ),
    Planted(
        "a stop at standstill is believed by words read before",
        " AND (Covered >= Rank) AND (State = STOPPING);",
        " AND (Covered >= Rank);",
        test_stop.test_a_stop_at_standstill_is_proved_by_words_read_after_it,
    ),
    Planted(
        "the frequency was read before the status",
        " AND (Seen.Stands OR Reads.SpeedRead);",
        ";",
        test_stop.test_the_frequency_is_read_last,
    ),
    Planted(
        "StopConfirmed without the acknowledgement",
        " AND NOT Overwritten AND NOT Follows AND NOT Open;",
        " AND NOT Overwritten AND NOT Follows AND (SinceMs > 200);",
        partial(test_stop.test_a_stop_that_nobody_acknowledges_is_not_confirmed, "CHF"),
    ),
    Planted(
        "StopConfirmed by frequency alone",
        "Seen.Stands := Proof.StandstillProven AND",
        "Seen.Stands := ZeroSpeed AND",
        partial(test_stop.test_standstill_needs_status_and_frequency, "CHF", 0x1001, 5),
    ),
    Planted(
        "old words are shown after a lost connection",
        "  CommOk := Link.Linked AND Slot.Online AND (Reads.StatusAgeMs <= Usual.StaleMs) AND NOT Unit.Moved;",
        "  CommOk := Link.Linked AND (Reads.StatusAgeMs <= 65535) AND NOT Unit.Moved;",
        test_stop.test_nothing_stale_is_shown_as_good,
    ),
    Planted(
        "a reset while a run pin is held",
        "  Refuses := Asked.Motion OR NOT CanResetFault",
        "  Refuses := NOT CanResetFault",
        partial(test_reset.test_no_reset_while_a_run_pin_is_held, "RunForward"),
    ),
    Planted(
        "a reset is repeated without end",
        "((Seen.FaultCode <> Code) OR (Tries >= RESETS))",
        "(Seen.FaultCode <> Code)",
        test_reset.test_a_reset_that_nobody_answers_is_tried_three_times,
    ),
    Planted(
        "a repeated reset does not look at the fault",
        "((Seen.FaultCode <> Code) OR (Tries >= RESETS))",
        "(Tries >= RESETS)",
        test_reset.test_another_fault_is_not_reset_by_a_repetition,
    ),
    Planted(
        "a reset starts again",
        "  Starts := Startable AND Asked.Motion AND NOT MotionMemory AND NOT Barred;",
        "  Starts := Startable AND Asked.Motion;",
        test_reset.test_a_run_pin_held_through_a_reset_starts_nothing,
    ),
    Planted(
        "a repeated stop cuts a reset of two writes",
        "  Stirs := (State = STOPPED) AND (Seen.Moving OR (Seen.ProofRead AND NOT Seen.Stands));",
        "  Stirs := (State = STOPPED) AND (Seen.Moving OR NOT Seen.Stands);",
        partial(test_reset.test_a_reset_ends_the_fault_and_starts_nothing, "CIA"),
        CIA,
    ),
    Planted(
        "with MonitorOnly a fault is answered",
        "    StopDue := Asked.SpeedOnly OR NOT Asked.MonitorOnly;",
        "    StopDue := Startled OR Asked.SpeedOnly OR NOT Asked.MonitorOnly;",
        partial(test_modes.test_with_monitor_only_it_stops_and_then_only_reads, "CHF"),
    ),
    Planted(
        "with SpeedOnly a stop is sent",
        "    StopDue := NOT Asked.SpeedOnly OR NewHalt;",
        "    StopDue := NOT Asked.SpeedOnly OR Run.Answered OR NewHalt;",
        partial(test_modes.test_with_speed_only_it_writes_the_reference_and_starts_nothing, "CHF"),
    ),
    Planted(
        "an address is taken while the motor turns",
        "\n    AND (StopConfirmed OR (Served = 0) OR Wrong "
        "OR (NOT Started AND (NOT Heard OR (LineError = ERROR_DOUBLED)))\n      OR Dark);",
        ";",
        test_modes.test_the_address_is_taken_while_the_stop_is_confirmed,
    ),
    Planted(
        "a poll starves",
        "  IF Turn = 0 THEN\n    NextEntry := 1;",
        "  IF Turn = 9 THEN\n    NextEntry := 1;",
        partial(test_start.test_from_power_up_to_a_turning_motor_and_back, "CHF", "rtu"),
    ),
    Planted(
        "the other direction needs no stop",
        "  ELSIF Asked.Order <> Order THEN",
        "  ELSIF Asked.Order = 0 THEN",
        partial(test_start.test_the_other_direction_goes_through_stop_and_a_new_edge, "CHF"),
    ),
    Planted(
        "no refresh",
        "  Refreshes := Feeds OR ((RefreshMs > 0) AND (RefreshedMs >= RefreshMs));",
        "  Refreshes := FALSE;",
        test_start.test_the_reference_alone_is_refreshed_while_it_runs,
    ),
    Planted(
        "a reference is written in every scan",
        "      GoodWord := SentWord;\n",
        "",
        test_start.test_a_reference_is_written_when_it_changes,
    ),
    Planted(
        "a parameter while the motor turns",
        "AllowUnknown := AllowUnknown, Stopped := StopConfirmed);",
        "AllowUnknown := AllowUnknown, Stopped := TRUE);",
        test_modes.test_parameters_and_starts_exclude_each_other,
    ),
    Planted(
        "a start while a parameter waits",
        " AND NOT Seen.WriteWaits AND",
        " AND",
        partial(never_stored, "a parameter waits"),
    ),
    Planted(
        "the next write of a path does not wait for its state",
        "StepReached := Reached,",
        "StepReached := TRUE,",
        test_start.test_a_path_of_states_is_walked_in_its_order,
        CIA,
    ),
    Planted(
        "a pulse is cut short",
        "StepHoldMs := Orders.HoldMs",
        "StepHoldMs := 0",
        test_start.test_a_pulse_is_as_long_as_the_map_says,
        PUL,
    ),
    Planted(
        "a stop waits for the one before",
        "  NewHalt := Asked.Halted AND (NOT HaltedMemory OR (Asked.StopKind > Rounds.Rank));",
        "  NewHalt := Asked.Halted AND NOT HaltedMemory;",
        test_stop.test_a_harder_stop_replaces_a_softer_one,
        CIA,
    ),
    Planted(
        "a drive that is not ready stays so",
        "      OR ((Asked.Bar = 0) AND NOT Seen.ReadyShown AND",
        "      OR (FALSE AND NOT Seen.ReadyShown AND",
        test_stop.test_a_drive_that_is_not_ready_gets_the_word_of_a_stop_again,
        CIA,
    ),
    Planted(
        "a missing line is not overdue",
        " OR (NOT Link.Linked AND NOT Link.Restarted AND NOT SupplyOff);",
        ";",
        test_stop.test_a_line_that_is_no_longer_called_is_reported,
    ),
    Planted(
        "the first fault is overwritten",
        "    IF NOT Latched THEN\n      Latched := TRUE;\n",
        "    IF TRUE THEN\n      Latched := TRUE;\n",
        test_reset.test_the_first_fault_and_the_last_eight,
    ),
    Planted(
        "what does not follow is let run",
        "AND Taken AND (TakenMs > FollowWithinMs) THEN",
        "AND Failed AND (TakenMs > FollowWithinMs) THEN",
        test_start.test_a_drive_that_does_not_follow_is_stopped,
        ("JSCC",),
    ),
    Planted(
        "a fault posts no stop",
        " OR (Seen.FaultPresent AND Seen.CommOk AND NOT FaultMemory) OR CommLost",
        " OR CommLost",
        partial(test_stop.test_a_fault_posts_a_stop, "SN300G5"),
        SN,
    ),
    Planted(
        "a lost connection posts no stop",
        " OR CommLost OR Slot.Unattended;",
        " OR Slot.Unattended;",
        partial(test_stop.test_a_stop_follows_a_lost_connection, "CHF"),
    ),
    Planted(
        "a word is taken from the wrong place",
        "      DCBusVoltageWord := Words[2];",
        "      DCBusVoltageWord := Words[3];",
        test_modes.test_each_drive_shows_its_own_words,
    ),
    Planted(
        "a stop pin sends the plain stop",
        "  ELSIF Order = COAST_STOP THEN",
        "  ELSIF Order > 99 THEN",
        partial(test_stop.test_each_stop_pin_sends_its_stop_or_the_one_there_is, "CHF", "CoastStop", "coast_stop"),
    ),
    Planted(
        "a jog is never ended",
        "    OtherOwed := CanStopJog AND NOT JogRefused AND (JogPosted OR NOT Proved);",
        "    OtherOwed := FALSE;\n    Rank := JOG_STOP;",
        partial(test_stop.test_a_stop_is_sent_at_once_and_again_until_the_motor_is_at_standstill, "CHF"),
    ),
    Planted(
        "other bits of the command word are lost",
        "  Value := KeepWord AND WORD#16#00FC;",
        "  Value := WORD#16#0000;",
        test_stop.test_only_the_drives_own_bits_change_with_a_stop,
        SN,
    ),
    Planted(
        "both directions in one word",
        " OR WORD#16#0001;",
        " OR WORD#16#0003;",
        partial(test_start.test_from_power_up_to_a_turning_motor_and_back, "SN300G5", "rtu"),
        SN,
    ),
    Planted(
        "a stop is sent to whoever it is",
        "  MayStop := Known OR (Unanswered AND NOT Wrong);",
        "  MayStop := TRUE;",
        partial(test_identity.test_not_one_write_reaches_another_drive, test_identity.begin),
        CIA,
    ),
    Planted(
        "a drive that was exchanged passes for the one before",
        "(SilentMs >= SILENT_MS) OR ",
        "",
        partial(test_identity.test_not_one_write_reaches_another_drive, partial(test_identity.exchanged, off=False)),
        CIA,
    ),
    Planted(
        "a refusal is no other drive",
        "  ELSIF (Shown AND NOT Matches) OR Refused THEN",
        "  ELSIF Shown AND NOT Matches THEN",
        test_identity.test_a_refusal_is_another_drive,
        CIA,
    ),
    Planted(
        "a drive that does not answer is never stopped",
        "  MayStop := Known OR (Unanswered AND NOT Wrong);",
        "  MayStop := Known;",
        test_identity.test_an_unanswered_read_does_not_keep_the_stop_back,
        CIA,
    ),
    Planted(
        "its own maximum is not looked at",
        "  SameMaximum := ",
        "  SameMaximum := TRUE OR ",
        test_identity.test_its_own_maximum_must_be_full_scale,
        CIA,
    ),
    Planted(
        "an edge keeps a reset in hand whatever else is asked for",
        "  Gone := (Stage <> NO_RESET) AND",
        "  Gone := NOT Edge AND (Stage <> NO_RESET) AND",
        test_reset.test_a_reset_that_waits_is_taken_back_for_reading_only_though_its_pin_rises_anew,
    ),
    Planted(
        "a stop is repeated though the one after a restart waits",
        "    Posts := (Follows OR Repeats) AND NOT FirstWaits AND NOT LeftOut;",
        "    Posts := Follows OR Repeats;",
        test_modes.test_a_restart_that_waits_for_the_bus_repeats_no_stop,
        CIA,
    ),
)
