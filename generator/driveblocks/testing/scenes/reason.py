"""The numbers of the reasons, as published, by the names that scenes give them."""

REASONS = {
    "RUNS": 0, "READY": 1, "RAMPING": 2, "STARTING": 3, "STOPPING": 4, "RESETTING": 5, "RELEASED": 6,
    "RESTARTED": 10, "NO_LINE": 11, "NO_SUPPLY": 12, "NO_REPLY": 13, "OFFLINE": 14, "LINE": 15, "FOREIGN": 16,
    "SHARED": 17, "LATE_SCAN": 18, "HEARTBEAT": 19, "DISABLED": 20, "STOP_PIN": 21, "STOP_ALL": 22, "BOTH": 23,
    "HELD": 24, "NOT_ABLE": 25, "MONITOR": 26, "SPEED_ONLY": 27, "STALE": 28, "SLOW_LINE": 29, "MISSING": 30,
    "UNCHECKED": 31, "REFERENCE": 32, "SETTING": 33, "UNREAD": 34, "WRITE_WAITS": 35, "FAULT": 40, "NOT_READY": 41,
    "NO_REFERENCE": 42, "NO_RUN": 43, "REFUSED": 44, "NOT_FOLLOWED": 45, "BY_ITSELF": 46, "NOT_STOPPED": 47,
    "NO_RESET": 48, "READ_REFUSED": 49,
}  # fmt: skip
