"""What the hook has recorded of a test program."""

from __future__ import annotations

import io
from pathlib import Path

from ros2cc_extract.extract.live.recordings.recording import Recording
from ros2cc_extract.extract.live.run import read_directory
from ros2cc_extract.spec.model import Callback, Spec

PROGRAMS = Path(__file__).with_name('programs')


def recordings_in(folder: Path) -> tuple[Recording, ...]:
    return tuple(read_directory(folder, io.StringIO()))


def timers_of(recording: Recording) -> int:
    return sum(entity.kind == 'timer' for entity in recording.entities)


def written(unit: Spec) -> list[Callback]:
    """Give the callbacks somebody wrote."""
    return [callback for callback in unit.callbacks if not callback.builtin]
