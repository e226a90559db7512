"""
Comments that accept a finding: ``# ros2cc: ignore[CC101] reason``.

A comment counts for its own line; one that stands alone counts for the next line of code. One
that accepts nothing is itself a finding, so that none outlives what it was written for.
"""

from __future__ import annotations

import io
import re
import tokenize
from collections.abc import Collection, Iterator, Mapping, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.rules.reading.diagnostics import UNUSED_IGNORE
from ros2cc_extract.findings.rules.registry import BY_CODE, BY_SLUG
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

_MARK = 'ros2cc:'
_COMMENT = re.compile(r'#\s*ros2cc:\s*ignore\[([^\]]*)\]\s*(.*)')


@dataclass(frozen=True)
class Ignore:
    """
    One comment.

    :param place: of the comment.
    :param line: of the code it is about.
    :param codes: of the rules, as written or by their slugs.
    """

    place: Place
    line: int
    codes: tuple[str, ...]
    reason: str


@dataclass(frozen=True)
class Suppressed:
    """
    Findings, less those that comments accept.

    :param kept: what is left, and a finding for each comment that accepts nothing.
    :param accepted: what was taken out, with the comment that accepts it.
    """

    kept: tuple[Finding, ...]
    accepted: tuple[tuple[Finding, Ignore], ...]


def suppress(
    findings: Sequence[Finding], sources: Mapping[str, str], checked: Collection[str] | None = None
) -> Suppressed:
    """
    Take out what comments in the sources accept.

    :param sources: text of the files, by the path that places name.
    :param checked: files whose findings are all known, all files by default; in others, such as
        modules that a checked file imports, a comment may be for a finding elsewhere.
    """
    ignores = [i for file in sorted(sources) for i in ignores_in(file, sources[file])]
    by_line: dict[tuple[str, int, str], Ignore] = {
        (ignore.place.file, ignore.line, code): ignore
        for ignore in ignores
        for code in ignore.codes
    }
    kept, accepted = [], []
    used: set[tuple[str, int, str]] = set()
    for finding in findings:
        key = (finding.place.file, finding.place.line, finding.code)
        if key in by_line:
            used.add(key)
            accepted.append((finding, by_line[key]))
        else:
            kept.append(finding)
    unused = [
        _unused(ignore, key[2])
        for key, ignore in by_line.items()
        if key not in used and (checked is None or key[0] in checked)
    ]
    ordered = sorted((*kept, *unused), key=lambda f: (f.place, f.code, f.message))
    return Suppressed(tuple(ordered), tuple(accepted))


def ignores_in(file: str, text: str) -> Iterator[Ignore]:
    """Find the comments of a file; a file that cannot be split into tokens has none."""
    if _MARK not in text:
        return
    code_lines = _code_lines(text)
    for token in _tokens(text):
        match = _COMMENT.match(token.string) if token.type == tokenize.COMMENT else None
        if match is not None:
            row, column = token.start
            line = (
                row if row in code_lines else min((n for n in code_lines if n > row), default=row)
            )
            codes = tuple(_code(word) for word in match[1].split(',') if word.strip())
            yield Ignore(Place(file, row, column + 1), line, codes, match[2].strip())


def _code(word: str) -> str:
    rule = BY_SLUG.get(word.strip().lower())
    return rule.code if rule else word.strip().upper()


def _code_lines(text: str) -> set[int]:
    return {
        token.start[0]
        for token in _tokens(text)
        if token.type
        not in (
            tokenize.COMMENT,
            tokenize.NL,
            tokenize.NEWLINE,
            tokenize.INDENT,
            tokenize.DEDENT,
            tokenize.ENDMARKER,
        )
    }


def _tokens(text: str) -> list[tokenize.TokenInfo]:
    try:
        return list(tokenize.generate_tokens(io.StringIO(text).readline))
    except (tokenize.TokenError, SyntaxError):
        return []


def _unused(ignore: Ignore, code: str) -> Finding:
    known = code in BY_CODE
    return Finding(
        code=UNUSED_IGNORE.code,
        severity=Severity.WARNING,
        place=ignore.place,
        message=f'{code} is not found here any more' if known else f'{code} is no rule',
        help='remove the comment' if known else 'see `ros2cc-extract explain` for the rules',
        subjects=(code,),
    )
