"""The way of a path through the rooms: ARCHITECTURE.md draws it, and a real check takes it."""

from __future__ import annotations

import io
import re
import sys
from functools import cache
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

from ros2cc_extract.cli.main import main

ROOT = Path(__file__).parents[2]
NODE = ROOT / 'launch_free_examples' / 'service_deadlock' / 'node.py'
DOWN = ('cli', 'report', 'pipeline', 'findings', 'verify', 'generator', 'checker', 'extract')
"""From the command to what it rests on."""
CALLED_BACK = {
    'Meter.step',  # progress
    'also_begun.<locals>.watch',  # progress of a search
    '_findings.<locals>.<genexpr>',  # a list that findings reads lazily
    '_promises.<locals>.<genexpr>',
}
Call = tuple[str, str, str]
ARROW = re.compile(r'^ *(\w+)->>(\w+): (\w+)$', re.MULTILINE)


@cache
def room_of(file: str) -> str | None:
    """The room of a file of ours that is a station of the way."""
    path = Path(file)
    if not path.is_relative_to(ROOT):
        return None
    parts = path.relative_to(ROOT).parts
    room = parts[1] if parts[0] == 'ros2cc_extract' else parts[0]
    return room if room in DOWN else None


def calls_between_rooms(node: Path) -> list[Call]:
    """Each function that another room calls, in the order of its first call."""
    calls: dict[Call, None] = {}

    def watch(frame: FrameType, event: str, arg: Any) -> None:
        room = room_of(frame.f_code.co_filename)
        if event != 'call' or room is None or frame.f_code.co_name == '<module>':
            return
        caller = frame.f_back
        while caller is not None and room_of(caller.f_code.co_filename) is None:
            caller = caller.f_back
        above = caller and room_of(caller.f_code.co_filename)
        if above is not None and above != room:
            calls.setdefault((above, room, frame.f_code.co_qualname))

    before = sys.getprofile()
    sys.setprofile(watch)
    try:
        main(['check', str(node), '--no-cache'], io.StringIO(), io.StringIO())
    finally:
        sys.setprofile(before)
    return list(calls)


@pytest.mark.skipif(sys.version_info < (3, 11), reason='code has no qualified name there')
def test_a_real_check_takes_the_way_that_is_drawn() -> None:
    calls = calls_between_rooms(NODE)
    drawn = ARROW.findall((ROOT / 'ARCHITECTURE.md').read_text())
    assert [call for call in calls if call in drawn] == drawn
    assert {(above, room) for above, room, _ in calls if is_down(above, room)} == {
        (above, room) for above, room, _ in drawn
    }
    climbs = {name for above, room, name in calls if not is_down(above, room)}
    assert climbs <= CALLED_BACK


def is_down(above: str, room: str) -> bool:
    """Whether a call leads further from the command."""
    return DOWN.index(above) < DOWN.index(room)
