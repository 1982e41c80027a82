"""Rule on what is read of a drive: it has to be readable, and to fit into the plan of reads."""

from collections.abc import Callable

from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Place, Report
from driveblocks.meaning.polls import identity_read, polls


def check(drive: Drive, report: Report) -> None:
    """Note pins or an identity that no plan of reads can serve; what is not readable was reported at its place."""
    if report.problems:
        return
    plans: list[tuple[Callable[[Drive], object], Place]] = [(polls, drive.operation.place("status"))]
    plans += [(identity_read, drive.identity.place("all"))] if drive.identity else []
    for plan, place in plans:
        try:
            plan(drive)
        except ValueError as error:
            report.add(place, str(error), "ask for fewer registers, or for some that lie together")
