"""The numbers of the reasons, as published, by the names that scenes give them, and those that no scene reaches."""

from driveblocks.bench.scenes.ability import Ability
from driveblocks.maps.trust import second_hand
from driveblocks.meaning.status import status
from driveblocks.meaning.words import MOTIONS

REASONS = {
    "RUNS": 0, "READY": 1, "RAMPING": 2, "STARTING": 3, "STOPPING": 4, "RESETTING": 5, "RELEASED": 6,
    "RESTARTED": 10, "NO_LINE": 11, "NO_SUPPLY": 12, "NO_REPLY": 13, "OFFLINE": 14, "LINE": 15, "FOREIGN": 16,
    "SHARED": 17, "LATE_SCAN": 18, "HEARTBEAT": 19, "DISABLED": 20, "STOP_PIN": 21, "STOP_ALL": 22, "BOTH": 23,
    "HELD": 24, "NOT_ABLE": 25, "MONITOR": 26, "SPEED_ONLY": 27, "STALE": 28, "SLOW_LINE": 29, "MISSING": 30,
    "UNCHECKED": 31, "REFERENCE": 32, "SETTING": 33, "UNREAD": 34, "WRITE_WAITS": 35, "FAULT": 40, "NOT_READY": 41,
    "NO_REFERENCE": 42, "NO_RUN": 43, "REFUSED": 44, "NOT_FOLLOWED": 45, "BY_ITSELF": 46, "NOT_STOPPED": 47,
    "NO_RESET": 48, "READ_REFUSED": 49, "LATE_REPLIES": 52, "NO_FAULT": 59, "FAULT_BACK": 60, "FORBIDDEN": 61,
}  # fmt: skip


def unreached(can: Ability, *, writes: bool) -> dict[str, str]:
    """Reasons that no scene of a family shows, and why; `writes`: some parameter can be written."""
    found = {"RELEASED": "it is in Diagnosis.StopReason alone, where a scene looks for it"}
    if can.settings_come_first:
        found["UNREAD"] = "the settings are read before the stop after power-up is confirmed"
    if not second_hand(can.drive):
        found["UNCHECKED"] = "the map was read off the manual"
    if not status(can.drive).verify:
        found["SETTING"] = "no setting of the drive that can be read gives the reference another meaning"
    if not status(can.drive).forbids:
        found["FORBIDDEN"] = "the map names nothing that forbids a start"
    if not can.shows("ready"):
        found["NOT_READY"] = "the drive does not show whether it is ready"
    if not can.can("fault_reset"):
        for name in ("RESETTING", "NO_FAULT", "FAULT_BACK"):
            found[name] = "the drive has no fault reset by the bus"
    if not writes:
        found["WRITE_WAITS"] = "the map lists no parameter that may be written"
    if set(can.motions) == set(MOTIONS):
        found["NOT_ABLE"] = "the drive has every command of motion"
    return found
