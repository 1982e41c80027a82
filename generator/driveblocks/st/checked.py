"""What the checker hands to those who run, export or document ST."""

from __future__ import annotations

from dataclasses import dataclass, field

from driveblocks.st.problems import Problem
from driveblocks.st.tree import Configuration, Function, FunctionBlock, Program, Unit
from driveblocks.st.types import Type


@dataclass(slots=True)
class Checked:
    """Sources whose every expression has its type. All tables are keyed by upper-case name, in source order.

    `types` holds the declared types only (not the elementary ones, not the blocks). `callees_first` lists the
    functions and function blocks so that each stands behind all that it calls or contains; recursion is an error.
    """

    units: list[Unit] = field(default_factory=list)
    types: dict[str, Type] = field(default_factory=dict)
    functions: dict[str, Function] = field(default_factory=dict)
    blocks: dict[str, FunctionBlock] = field(default_factory=dict)
    programs: dict[str, Program] = field(default_factory=dict)
    configurations: dict[str, Configuration] = field(default_factory=dict)
    callees_first: list[Function | FunctionBlock] = field(default_factory=list)


@dataclass(slots=True)
class Analysis:
    """What files that were analysed together came to: what could be typed, and every problem in order of place."""

    checked: Checked
    problems: list[Problem]
