"""Runs a program of this folder with a hook whose every recording function raises."""

import runpy
import sys
from pathlib import Path

hook = sys.modules['_ros2cc_live.hook']
recorder = sys.modules['_ros2cc_live.record'].Recorder


def fail(*arguments: object, **named: object) -> None:
    raise RuntimeError('broken on purpose')


for name in ('note_added', 'note_removed', 'note_entity', 'note_task', 'look_around'):
    setattr(recorder, name, fail)
hook.trace_creation = fail
program = Path(__file__).with_name(sys.argv[1])
runpy.run_path(str(program), run_name='__main__')
