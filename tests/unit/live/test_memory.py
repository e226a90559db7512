"""A recording needs no more memory the longer its process runs."""

from __future__ import annotations

import gc
import sys
from pathlib import Path
from typing import Any

import pytest

from ros2cc_extract.extract.live.hook import groups
from ros2cc_extract.extract.live.hook.groups import reporting
from ros2cc_extract.extract.live.hook.writer import Writer
from ros2cc_extract.extract.live.recorder import journal
from ros2cc_extract.extract.live.recorder.events import (
    BEGIN,
    COLLECT,
    END,
    REFUSED,
    TAKE,
    WAIT,
    WOKEN,
)
from ros2cc_extract.extract.live.recorder.record import Recorder

# Of a second or so each at 1 kHz; the last 256 durations and periods are kept for the median.
CALLBACKS = 400
FIRST_ROUNDS, MORE_ROUNDS = 60, 150
# For 60,000 callbacks; what else happens in this process meanwhile is among them.
ALLOWED_BLOCKS = 2000


class Group:
    """As much of a callback group as is looked at."""

    def beginning_execution(self, entity: Any) -> bool:
        return True

    def ending_execution(self, entity: Any) -> None:
        """Free the group."""


class Entity:
    """As much of an entity, and of an executor, as is looked at."""

    callback: Any = None
    callback_group: Any = None


@pytest.mark.parametrize('traced', [False, True])
@pytest.mark.parametrize('kind', ['plain', 'native'])
def test_memory_stays(
    kind: str, traced: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if kind == 'plain':
        monkeypatch.setattr(groups, 'native', None)
        monkeypatch.setattr(journal, 'native', None)
    recorder = Recorder(traced=traced)
    writer = Writer(recorder, lambda: str(tmp_path / 'recording.json'), traced=traced)
    for name, what, otherwise in (
        ('beginning_execution', BEGIN, REFUSED),
        ('ending_execution', END, END),
    ):
        method = reporting(recorder, Group, name, what, otherwise)
        monkeypatch.setattr(Group, name, method)
    group, entity, executor = Group(), Entity(), Entity()
    number = recorder.note_executor(executor).number

    def run(rounds: int) -> int:
        for _ in range(rounds):
            for _ in range(CALLBACKS):
                group.beginning_execution(entity)
                for what in (WAIT, WOKEN, COLLECT, TAKE) if traced else ():
                    recorder.journal.note(what, number)
                group.ending_execution(entity)
            writer.update()
        gc.collect()
        return sys.getallocatedblocks()

    before = run(FIRST_ROUNDS)
    assert run(MORE_ROUNDS) - before < ALLOWED_BLOCKS
    (record,) = recorder.all_entities
    assert record.timings.runs == CALLBACKS * (FIRST_ROUNDS + MORE_ROUNDS)
