"""Rules on what a drive does by itself: when its line is silent, and to the motor when it trips."""

from driveblocks.maps.model import Drive, Setting, SilenceTime, Watchdog
from driveblocks.maps.problem import Place, Report
from driveblocks.maps.rules.access import known
from driveblocks.maps.rules.unique import unique


def check(drive: Drive, report: Report) -> None:
    """Note every rule that the watchdog or the output in a trip break."""
    settings = {setting.id: setting for setting in drive.settings}
    if drive.watchdog is not None:
        _watchdog(drive, drive.watchdog, settings, report)
    output = drive.faults.trip_output
    if output is not None and output.motor == "differs" and output.note is None:
        report.miss(output.place("motor"), "nothing says how it differs", "say so in a `note`")


def _watchdog(drive: Drive, watchdog: Watchdog, settings: dict[str, Setting], report: Report) -> None:
    off = watchdog.disabled_by
    if watchdog.time is not None:
        _time(drive, watchdog.time, settings, report)
    if off is not None and off.setting not in settings:
        report.miss(off.place("setting"), f"there is no setting `{off.setting}`", "name an entry of `settings`")
    elif off is not None:
        _possible(settings[off.setting], off.value, off.place("value"), report)
    if watchdog.fault is not None and watchdog.fault not in {fault.code for fault in drive.faults.codes}:
        wrong = f"there is no fault {watchdog.fault:02X}H"
        report.miss(watchdog.place("fault"), wrong, "name a code of `faults`")
    _fed(drive, watchdog, report)
    for one in watchdog.reactions:
        if one.does == "trips" and watchdog.fault is None:
            report.miss(one.place("does"), "the drive trips, and no fault is named", "add `fault`, a code of `faults`")
    _reactions(watchdog, settings, report)
    _needed(watchdog, settings, report)


def _fed(drive: Drive, watchdog: Watchdog, report: Report) -> None:
    """Note what feeds it twice, or by nothing that a drive block writes again."""
    if watchdog.feeds and watchdog.fed_by:
        wrong = f"`feeds: {watchdog.feeds}`, and `fed_by` names registers"
        report.add(watchdog.place("fed_by"), wrong, "keep the one that the manual says")
    for register in watchdog.fed_by:
        known(drive, register, "w", watchdog.place("fed_by"), report)
    runs = [write.register for each in drive.operation.commands if each.does == "run_forward" for write in each.writes]
    if watchdog.fed_by and not {*runs, drive.operation.reference.register} & {*watchdog.fed_by}:
        wrong = "no write of the drive block feeds it: neither the reference nor the run command is among `fed_by`"
        report.miss(watchdog.place("fed_by"), wrong, "name theirs, if the manual does; else say it in the `note`")


def _needed(watchdog: Watchdog, settings: dict[str, Setting], report: Report) -> None:
    """Note a setting that may let the motor run on without the line, of which nothing says what it must be."""
    runs = [one for one in watchdog.reactions if one.does in ("runs_on", "other_speed")]
    choice = settings.get(watchdog.chosen_by or "")
    if choice is not None and runs:
        _must(choice, f"the motor runs on without the line where {choice.id} is {runs[0].value}", report)
    off = settings.get(watchdog.disabled_by.setting) if watchdog.disabled_by else None
    if off is not None and watchdog.disabled_by:
        _must(off, f"the drive does not notice a silent line where {off.id} is {watchdog.disabled_by.value}", report)


def _must(setting: Setting, wrong: str, report: Report) -> None:
    if setting.needed is None:
        right = "say what it must be, as in `needed: {why: the motor stops when the line is cut: never 3}`"
        report.miss(setting.at, f"{wrong}, and nothing says what to set", right)


def _time(drive: Drive, time: SilenceTime, settings: dict[str, Setting], report: Report) -> None:
    if (time.setting is None) == (time.register is None):
        report.add(time.at, "the time has not exactly one place", "write either `setting` or `register`")
    elif time.setting is not None and time.setting not in settings:
        report.miss(time.place("setting"), f"there is no setting `{time.setting}`", "name an entry of `settings`")
    elif time.register is not None:
        known(drive, time.register, "r", time.place("register"), report)
    if time.milliseconds <= 0:
        report.add(
            time.place("milliseconds"), f"{time.milliseconds} ms is no time", "write how long one count is, in ms"
        )


def _possible(setting: Setting, value: int, place: Place, report: Report) -> None:
    values = [one.value for one in setting.values]
    if (values and value not in values) or (setting.range is not None and not setting.range.holds(value)):
        report.miss(place, f"{value} is no value of {setting.id}", "write one that the setting can have")


def _reactions(watchdog: Watchdog, settings: dict[str, Setting], report: Report) -> None:
    place, reactions = watchdog.place("reactions"), watchdog.reactions
    unique(reactions, "value", "reaction for", report, str)
    if watchdog.chosen_by is None:
        if len(reactions) != 1 or reactions[0].value is not None:
            wrong = "no setting chooses among the reactions"
            report.miss(place, wrong, "add `chosen_by`, or write one reaction without `value`")
    elif watchdog.chosen_by not in settings:
        wrong = f"there is no setting `{watchdog.chosen_by}`"
        report.miss(watchdog.place("chosen_by"), wrong, "name an entry of `settings`")
    else:
        _chosen(settings[watchdog.chosen_by], watchdog, report)


def _chosen(setting: Setting, watchdog: Watchdog, report: Report) -> None:
    for reaction in watchdog.reactions:
        if reaction.value is None:
            report.miss(reaction.at, f"a reaction without a value of {setting.id}", "add `value`")
        else:
            _possible(setting, reaction.value, reaction.place("value"), report)
    missing = {one.value for one in setting.values} - {one.value for one in watchdog.reactions}
    if missing:
        wrong = f"what {setting.id} = {min(missing)} does is missing"
        report.miss(watchdog.place("reactions"), wrong, "write what the drive does for each value of the setting")
