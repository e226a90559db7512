"""One source file: read, decoded and parsed at first need; trouble becomes a diagnostic."""

from __future__ import annotations

import ast
import errno
import hashlib
import io
import re
import tokenize
import warnings
from dataclasses import field
from functools import cached_property
from pathlib import Path

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.program.newer_syntax import WITHOUT_FILE, needs_newer_python
from ros2cc_extract.files import DISK, Files
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

SIZE_LIMIT_BYTES = 8_000_000
TOKEN_LIMIT = 900_000
"""A syntax tree takes 300 to 1,100 bytes for each token, and all of it should fit into 1 GB."""

_TOKEN = re.compile(rb'\w+|[^\s\w]')

_CREATES = re.compile(rb'\.create_(?:subscription|timer|service|client)\(')


@dataclass(eq=False)
class SourceFile:
    """
    A Python file of the project.

    :param shown: path as shown to the user.
    :param module_name: dotted name by which the program imports it.
    :param package: dotted name of the package it is in, empty outside packages.
    :param named: the user named this very file; its errors are always reported.
    :param files: where it is read from.
    """

    path: Path
    shown: str
    module_name: str
    package: str
    given_text: str | None = None
    named: bool = False
    files: Files = DISK
    diagnostics: list[Diagnostic] = field(default_factory=list)

    @cached_property
    def data(self) -> bytes:
        """The bytes of the file; empty when they cannot be read."""
        if self.given_text is not None:
            return self.given_text.encode('utf-8', 'surrogatepass')
        try:
            data = self.files.read(self.path, SIZE_LIMIT_BYTES)
        except OSError as error:
            if error.errno == errno.EFBIG:
                return self._too_large(f'larger than {SIZE_LIMIT_BYTES // 1_000_000} MB')
            self._complain('unreadable-file', 0, 0, f'cannot be read: {error.strerror or error}')
            return b''
        if len(data) > TOKEN_LIMIT and sum(1 for _ in _TOKEN.finditer(data)) > TOKEN_LIMIT:
            return self._too_large(f'more than {TOKEN_LIMIT} words and signs')
        return data

    def _too_large(self, why: str) -> bytes:
        self._complain('file-too-large', 0, 0, f'file is too large to be scanned: {why}')
        return b''

    @property
    def digest(self) -> str:
        """Return a digest that distinguishes contents."""
        return digest_of(self.data)

    @property
    def mentions_ros(self) -> bool:
        """Whether the text names rclpy, or calls what a node of an unseen base class has."""
        return b'rclpy' in self.data or _CREATES.search(self.data) is not None

    @property
    def is_scanned(self) -> bool:
        """Whether it is worth parsing for its own sake; others are parsed when imported."""
        return self.named or self.mentions_ros

    @cached_property
    def tree(self) -> ast.Module | None:
        """The syntax tree, ``None`` if the text has none."""
        text = self._text()
        if text is None:
            return None
        try:
            with warnings.catch_warnings():
                warnings.simplefilter('ignore')
                return ast.parse(text, filename=self.shown)
        except SyntaxError as error:
            self._complain_of_syntax(error, text)
        except ValueError as error:
            self._complain('syntax-error', 1, 1, f'cannot be parsed: {error}')
        except (RecursionError, MemoryError):
            self._complain('nested-too-deeply', 1, 1, 'nested too deeply to be parsed')
        return None

    def _text(self) -> str | None:
        data = self.data
        if b'\0' in data[:4096] and not data.startswith((b'\xff\xfe', b'\xfe\xff')):
            self._complain('binary-file', 1, 1, 'is no text file')
            return None
        try:
            encoding, _ = tokenize.detect_encoding(io.BytesIO(data).readline)
            return data.decode(encoding).replace('\r\n', '\n').replace('\r', '\n')
        except (SyntaxError, UnicodeDecodeError, LookupError) as error:
            line = data[: getattr(error, 'start', 0) or 0].count(b'\n') + 1
            self._complain('undecodable-file', line, 1, f'cannot be decoded: {_reason(error)}')
            return None

    def _complain_of_syntax(self, error: SyntaxError, text: str) -> None:
        line, column = error.lineno or 1, error.offset or 1
        slug, message = 'syntax-error', f'syntax error: {error.msg}'
        if 'Missing parentheses' in (error.msg or '') or _looks_like_python_2(text, line):
            slug, message = 'python-2', f'Python 2 source: {error.msg}'
        if 'too many nested' in (error.msg or ''):
            slug = 'nested-too-deeply'
        newer = needs_newer_python(text, line) if slug == 'syntax-error' else None
        self._complain(slug, line, column, message, newer)

    def _complain(
        self, slug: str, line: int, column: int, message: str, mend: str | None = None
    ) -> None:
        self.diagnostics.append(
            Diagnostic(
                severity=Severity.ERROR,
                slug=slug,
                place=Place(self.shown, line, max(column, 1) if line else 0),
                message=message,
                help=mend or _HELP.get(slug, ''),
            )
        )


def digest_of(data: bytes) -> str:
    """A short text that differs where ``data`` does."""
    return hashlib.blake2b(data, digest_size=16).hexdigest()


_HELP = {
    'file-too-large': 'leave it out, or move the nodes out of it',
    'syntax-error': WITHOUT_FILE,
    'python-2': 'rclpy needs Python 3',
    'undecodable-file': 'save it as UTF-8 or declare its encoding in the first line',
}


def _looks_like_python_2(text: str, line: int) -> bool:
    lines = text.splitlines()
    if not 0 < line <= len(lines):
        return False
    statement = lines[line - 1].strip()
    return statement.startswith('print ') or (
        statement.startswith('except') and ',' in statement and '(' not in statement
    )


def _reason(error: Exception) -> str:
    if isinstance(error, UnicodeDecodeError):
        return f'byte 0x{error.object[error.start]:02x} is not {error.encoding}'
    return str(error).partition('\n')[0]
