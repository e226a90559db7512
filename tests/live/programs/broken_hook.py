"""
Runs a program of this folder with a hook that is broken: WHAT PROGRAM, see ``BREAKS``.

What is written in C cannot be broken from here as its like in Python can; what it is given can.
"""

import gc
import runpy
import sys
from pathlib import Path

modules = {
    name.rpartition('.')[2]: sys.modules[f'_ros2cc_live.{name}']
    for name in ('hook.wrapping', 'recorder.journal', 'recorder.record', 'hook.writer')
}
(hook,) = [each for each in gc.get_objects() if type(each) is modules['wrapping'].Hook]


def fail(*arguments: object, **named: object) -> None:
    raise RuntimeError('broken on purpose')


class BrokenEntities(dict):  # type: ignore[type-arg]
    """Knows nobody."""

    get = __getitem__ = fail


class BrokenLock:
    """Can never be had."""

    __enter__ = __exit__ = fail


def break_notes() -> None:
    for name in ('note_added', 'note_removed', 'note_entity', 'note_task', 'look_around'):
        setattr(modules['record'].Recorder, name, fail)
    modules['wrapping'].trace_creation = fail


def break_journal() -> None:
    modules['journal'].PlainJournal.note = modules['journal'].PlainJournal.put = fail


def break_entities() -> None:
    hook.recorder.entities = BrokenEntities()


def break_lock() -> None:
    hook.recorder.lock = BrokenLock()


def break_clock() -> None:
    modules['journal'].get_ident = sys.modules['_ros2cc_live.hook.steps'].get_ident = fail


def break_writer() -> None:
    modules['writer'].snapshot = fail


BREAKS = {
    'notes': break_notes,
    'journal': break_journal,
    'entities': break_entities,
    'lock': break_lock,
    'clock': break_clock,
    'writer': break_writer,
}
what, name = sys.argv[1:]
BREAKS[what]()
program = Path(__file__).with_name(name)
runpy.run_path(str(program), run_name='__main__')
print('lost', bool(hook.recorder.loss_count))
