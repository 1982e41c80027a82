"""Results as JUnit XML, as continuous integration reads it.

A suite per program and engine; a case per scene, and per check of what is no scene.
"""

from xml.etree import ElementTree

from driveblocks.bench.outcome import ERROR, FAILED, PASSED, Outcome, Result, Run
from driveblocks.bench.record import table
from structured_text.visible import visible


def text(run: Run) -> str:
    """The XML. Apart from the times, the same results give the same text."""
    root = ElementTree.Element("testsuites", name="driveblocks", time=f"{run.seconds:.3f}")
    for result in run.results:
        root.append(_suite(result))
    for kind in ("tests", "failures", "errors"):
        root.set(kind, str(sum(int(suite.attrib[kind]) for suite in root)))
    for each in root.iter():
        # XML 1.0 cannot hold control characters, not even as references.
        each.text = each.text and visible(each.text)
        each.attrib = {name: visible(value) for name, value in each.attrib.items()}
    ElementTree.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, encoding="unicode")}\n'


def _cases(result: Result) -> list[list[Outcome]]:
    cases: dict[str, list[Outcome]] = {}
    for number, outcome in enumerate(result.outcomes):
        cases.setdefault(outcome.scene or str(number), []).append(outcome)
    return list(cases.values())


def _worst(outcomes: list[Outcome]) -> str:
    states = {outcome.status for outcome in outcomes}
    return next((each for each in (ERROR, FAILED) if each in states), PASSED)


def _suite(result: Result) -> ElementTree.Element:
    cases = _cases(result)
    states = [_worst(case) for case in cases]
    suite = ElementTree.Element(
        "testsuite",
        name=f"{result.unit}.{result.program} on {result.engine}",
        tests=str(len(cases)),
        failures=str(states.count(FAILED)),
        errors=str(states.count(ERROR)),
        skipped="0",
        time=f"{result.seconds:.3f}",
    )
    properties = ElementTree.SubElement(suite, "properties")
    for name, value in (("engine", result.engine), *result.properties):
        ElementTree.SubElement(properties, "property", name=name, value=value)
    each = result.seconds / max(len(result.outcomes), 1)
    for case in cases:
        suite.append(_case(result, case, each * len(case)))
    return suite


def _case(result: Result, outcomes: list[Outcome], seconds: float) -> ElementTree.Element:
    first, worst = outcomes[0], _worst(outcomes)
    name = first.scene or first.words
    classname = f"{result.unit}.{result.program}"
    case = ElementTree.Element("testcase", classname=classname, name=name, time=f"{seconds:.6f}")
    bad = [outcome for outcome in outcomes if outcome.status != PASSED]
    if bad:
        kind = {FAILED: "failure", ERROR: "error"}[worst]
        wrong = ElementTree.SubElement(case, kind, message=bad[0].message, type=worst)
        details = [_detail(outcome) for outcome in bad]
        if bad[0].scene and result.record and bad[0] is result.bad[0]:
            details.append(table(result.record))
        wrong.text = "\n\n".join(details)
    return case


def _detail(outcome: Outcome) -> str:
    """What failed, where and how. The place follows a blank: readers of JUnit XML look for ` file:line` in the text."""
    lines = [outcome.words, f"at {outcome.place}"] if outcome.path else [outcome.words]
    if outcome.expected or outcome.actual:
        lines += [f"expected: {outcome.expected}", f"actual: {outcome.actual}"]
    else:
        lines.append(outcome.message)
    return "\n".join(lines)
