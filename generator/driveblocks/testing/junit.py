"""Results as JUnit XML, as continuous integration reads it: a suite per program and engine, a case per check."""

from pathlib import Path
from xml.etree import ElementTree

from driveblocks.console import visible
from driveblocks.testing.outcome import ERROR, FAILED, Outcome, Result, Run


def write(run: Run, path: Path) -> None:
    """Write the file. Raises OSError."""
    path.write_text(text(run), encoding="utf-8", newline="\n")


def text(run: Run) -> str:
    """The XML. Apart from the times, the same results give the same text."""
    root = ElementTree.Element(
        "testsuites",
        name="driveblocks",
        tests=str(run.count()),
        failures=str(run.count(FAILED)),
        errors=str(run.count(ERROR)),
        time=f"{run.seconds:.3f}",
    )
    for result in run.results:
        root.append(_suite(result))
    for each in root.iter():
        # XML 1.0 cannot hold control characters, not even as references.
        each.text = each.text and visible(each.text)
        each.attrib = {name: visible(value) for name, value in each.attrib.items()}
    ElementTree.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, encoding="unicode")}\n'


def _suite(result: Result) -> ElementTree.Element:
    suite = ElementTree.Element(
        "testsuite",
        name=f"{result.unit}.{result.program} on {result.engine}",
        tests=str(len(result.outcomes)),
        failures=str(result.count(FAILED)),
        errors=str(result.count(ERROR)),
        skipped="0",
        time=f"{result.seconds:.3f}",
    )
    properties = ElementTree.SubElement(suite, "properties")
    for name, value in (("engine", result.engine), *result.properties):
        ElementTree.SubElement(properties, "property", name=name, value=value)
    each = result.seconds / max(len(result.outcomes), 1)
    for outcome in result.outcomes:
        suite.append(_case(f"{result.unit}.{result.program}", outcome, each))
    return suite


def _case(classname: str, outcome: Outcome, seconds: float) -> ElementTree.Element:
    case = ElementTree.Element("testcase", classname=classname, name=outcome.words, time=f"{seconds:.6f}")
    kinds = {FAILED: "failure", ERROR: "error"}
    if outcome.status in kinds:
        wrong = ElementTree.SubElement(case, kinds[outcome.status], message=outcome.message, type=outcome.status)
        wrong.text = _detail(outcome)
    return case


def _detail(outcome: Outcome) -> str:
    """What failed, where and how. The place follows a blank: readers of JUnit XML look for ` file:line` in the text."""
    lines = [outcome.words, f"at {outcome.place}"] if outcome.path else [outcome.words]
    if outcome.expected or outcome.actual:
        lines += [f"expected: {outcome.expected}", f"actual: {outcome.actual}"]
    else:
        lines.append(outcome.message)
    return "\n".join(lines)
