"""Rule on what the drive block reads again and again: it has to be readable, and to fit into its plan."""

from driveblocks.maps.model import Drive
from driveblocks.maps.polls import polls
from driveblocks.maps.problem import Report


def check(drive: Drive, report: Report) -> None:
    """Note pins that no plan of reads can serve; what is not readable at all was told where it stands."""
    if report.problems:
        return
    try:
        polls(drive)
    except ValueError as error:
        right = "ask for fewer registers, or for some that lie together"
        report.add(drive.operation.place("status"), str(error), right)
