"""What a target cannot say."""

from structured_text.language.problems import SourceError


class ExportError(SourceError):
    """Parts that a target has no form for; `problems` names the canonical file, line and column of each."""
