"""
Answers that hold for every part of one shape, kept within a unit, between units and in the cache.

Only verdicts are kept: asking for a run searches the part once more.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import field
from pathlib import Path

from ros2cc_extract.cache_file import load_value, store_value
from ros2cc_extract.checker.api import CheckResult, Verdict
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.plain_data import Packer

Question = tuple[object, ...]
Role = tuple[str, tuple[int, ...], tuple[int, ...]]
"""A query by its family and by places of callbacks and groups in a shape."""


@dataclass(frozen=True)
class Answered:
    """
    One verdict.

    :param seconds: from the start of its search.
    :param has_run: a witness or counterexample was found.
    :param in_doubt: undecided for good, as something is not known.
    """

    verdict: Verdict
    reason: str | None
    seconds: float
    has_run: bool
    in_doubt: bool = False

    @property
    def is_final(self) -> bool:
        """Whether no limit has left it open."""
        return self.verdict is not Verdict.UNDECIDED or self.in_doubt


@dataclass(frozen=True)
class Entry:
    """
    What was asked of one shape.

    :param answers: by roles.
    :param check: of the search, without its answers.
    """

    answers: Mapping[Role, Answered]
    check: CheckResult

    @property
    def is_final(self) -> bool:
        """Whether no limit has cut the search short."""
        return all(each.is_final for each in self.answers.values())


_ENTRY: Packer[Entry] = Packer(Entry)


@dataclass
class Shelf:
    """
    Entries by question.

    :param folder: cache of the user, ``None`` for none.
    :param version: of the tool, on which every answer depends.
    """

    folder: Path | None = None
    version: str = ''
    entries: dict[Question, Entry] = field(default_factory=dict)

    def take(self, question: Question, ask: Callable[[], Entry]) -> Entry:
        """Give what is known, or ask and keep it."""
        entry = self.entries.get(question) or self._load(question)
        if entry is None:
            entry = ask()
            if not entry.is_final:
                return entry
            if self.folder is not None:
                store_value(self._path(question), entry, _ENTRY)
        self.entries[question] = entry
        return entry

    def _load(self, question: Question) -> Entry | None:
        if self.folder is None:
            return None
        return load_value(self._path(question), _ENTRY)

    def _path(self, question: Question) -> Path:
        assert self.folder is not None, 'only asked where there is one'
        text = f'{self.version}\0{question!r}'
        return self.folder / f'{hashlib.sha256(text.encode()).hexdigest()}.slice'
