"""Runs that are bounded in steps, depth and time: what is not followed to its end is said."""

from __future__ import annotations

import ast
from collections.abc import Callable

from ros2cc_extract.extract.static.python.machine.frame import BudgetError
from ros2cc_extract.extract.static.python.machine.incomplete_runs import note_cut
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.machine.world import Cut
from ros2cc_extract.extract.static.python.objects.reachable_texts import leads_nowhere
from ros2cc_extract.extract.static.scan.ros_interpreter import RosInterpreter
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import NOT_FOLLOWED, Blocking
from ros2cc_extract.spec.model import When

TOO_LONG = 'too long to be followed to its end'

STEP_LIMIT = 600_000
"""Statements and expressions of one set-up, callback or method; ``RUN_LIMIT`` holds for all."""


def guarded(
    machine: RosInterpreter,
    act: Callable[[], object],
    place: Place,
    text: ast.Module | None = None,
) -> str:
    """
    Do ``act``; a program too large to be followed ends in a diagnostic.

    :param text: the file that is run; where it leads to nothing of ROS, nothing is missing.
    :returns: why it was not followed to its end; empty where it was.
    """
    world = machine.world
    if not machine.steps_left or _is_late(machine):
        reason = _why_cut(machine)
        if not any(cut.reason == reason for cut in world.cut):
            world.cut.append(Cut(reason, place))
        return reason
    why = ''
    machine.steps, machine.step_limit = 0, min(STEP_LIMIT, machine.steps_left)
    try:
        act()
    except BudgetError:
        if world.nodes or text is None or not leads_nowhere(machine, text):
            why = _why_cut(machine)
    except RecursionError:
        why = 'nested too deeply to be followed'
    finally:
        machine.steps_left -= min(machine.steps, machine.steps_left)
        machine.stack.clear()
        machine.depth = 0
        world.path, world.count, world.chain, world.held = (), 1, (), ()
        world.stopped, world.effects, world.current, world.looking = False, None, None, ()
        world.shutting_down = False
        world.in_thread, world.when, world.thread = False, When.START, 0
        world.activity, world.again, world.second_pass = None, False, False
        world.limit = None
        machine.store.reset()
    if why:
        note_cut(world, place, why)
    return why


def note_cut_run(effects: EffectLog, why: str, place: Place) -> None:
    """A callback or thread was not followed to its end: it may wait for anything."""
    wait = Blocking(call=NOT_FOLLOWED, source=place, on=Unknown(why, place))
    if why and wait not in effects.blocking:
        effects.blocking.append(wait)


def _is_late(machine: RosInterpreter) -> bool:
    return machine.deadline is not None and machine.deadline.is_over


def _why_cut(machine: RosInterpreter) -> str:
    is_late = _is_late(machine) and machine.steps_left and machine.steps <= machine.step_limit
    return machine.deadline.reason if machine.deadline and is_late else TOO_LONG
