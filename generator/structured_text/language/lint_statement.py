"""Rules about statements."""

from structured_text.language import tree
from structured_text.language.lint_scope import Scope


def pou(scope: Scope) -> None:
    """All rules about the statements of one POU."""
    if not scope.pou.body:
        text = f"matiec refuses a {scope.pou.word} without statements: write one that does no harm"
        if not (isinstance(scope.pou, tree.FunctionBlock) and scope.pou.extras):
            scope.add(scope.pou.name_at, "empty-body", text)
    for statement in scope.statements:
        if isinstance(statement, tree.Empty):
            scope.add(statement.at, "empty-statement", "matiec refuses a lone semicolon: remove it")
        elif isinstance(statement, tree.Continue):
            scope.add(statement.at, "continue", "STruC++ and IronPLC refuse CONTINUE: use IF")
        elif isinstance(statement, tree.If):
            _if(scope, statement)
        elif isinstance(statement, tree.Case):
            _case(scope, statement)
        elif isinstance(statement, tree.For | tree.While | tree.RepeatUntil):
            _loop(scope, statement)


def _branch(scope: Scope, at: int, body: list[tree.Statement], what: str) -> None:
    """A branch or loop has a statement."""
    if not body:
        scope.add(at, "empty-branch", f"matiec refuses {what} without statements: write one, or leave the branch out")


def _if(scope: Scope, statement: tree.If) -> None:
    """IF."""
    for branch in statement.branches:
        _branch(scope, branch.at, branch.body, "a branch of IF")
    if statement.otherwise is not None:
        _branch(scope, statement.end - 1, statement.otherwise, "ELSE")


def _case(scope: Scope, statement: tree.Case) -> None:
    """CASE."""
    if not statement.branches:
        scope.add(statement.at, "empty-branch", "matiec refuses a CASE with nothing but ELSE: write one branch")
    for branch in statement.branches:
        _branch(scope, branch.at, branch.body, "a branch of CASE")
        for label in branch.labels:
            for each in (label.low, label.high) if isinstance(label, tree.LabelRange) else (label,):
                _label(scope, each)
    if statement.otherwise is None:
        text = "a CASE without ELSE does nothing for a value that nobody thought of: write ELSE"
        scope.add(statement.at, "case-without-else", text)
    else:
        _branch(scope, statement.end - 1, statement.otherwise, "ELSE")


def _label(scope: Scope, label: tree.Expression) -> None:
    """A label is decimal and has no prefix."""
    if (
        isinstance(label, tree.Literal)
        and label.kind is tree.LiteralKind.INTEGER
        and (label.base != 10 or label.prefix)
    ):
        text = f"matiec refuses the label {label.text}: write {label.value!r}"
        scope.add(label.at, "case-label", text)


def _loop(scope: Scope, statement: tree.For | tree.While | tree.RepeatUntil) -> None:
    if isinstance(statement, tree.For):
        text = (
            "a FOR that should run once runs zero times on Beremiz's matiec, and its control variable ends at "
            "another value: use WHILE"
        )
        scope.add(statement.at, "for-zero-trips", text)
    _branch(scope, statement.at, statement.body, "a loop")
