"""The interpreter follows a program of a library that has nothing to do with ROS, by its table."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass, field

from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.python.builtins import builtin_functions
from ros2cc_extract.extract.static.python.interpreter import Interpreter
from ros2cc_extract.extract.static.python.machine.library_state import LibraryState
from ros2cc_extract.extract.static.python.machine.library_table import (
    Library,
    LibraryClass,
    LibraryModel,
)
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Instance,
    Module,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place

PROGRAM = """
import kitchen
from kitchen.tools import Oven as Stove, ring

class MyOven(Stove):
    def __init__(self, degrees=200):
        super().__init__(degrees)
        self.name = 'mine'

    def bake_all(self, dishes):
        for dish in dishes:
            self.bake(dish)
        return len(dishes)

oven = MyOven()
number = oven.bake_all(['bread', 'pie'])
if ring(3) == 3:
    oven.bake('cake')
else:
    oven.bake('soup')
heat = oven.degrees + 20
with kitchen.Oven(90) as cold:
    if cold.is_hot():
        cold.bake('ice')
other = kitchen.melt(oven)
"""


@dataclass(eq=False)
class OvenState(LibraryState):
    """What the table keeps of an oven."""

    is_block = True

    degrees: Value = NONE
    baked: list[tuple[object, int]] = field(default_factory=list)


def set_up(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    receiver.state.degrees = call.argument(0, 'degrees') or Const(180)
    return NONE


def bake(machine: Machine, receiver: Value, call: Call) -> Value:
    """Note the dish, and on how many open branches it is baked."""
    assert isinstance(receiver, Instance)
    dish = call.args[0]
    assert isinstance(dish, Const)
    receiver.state.baked.append((dish.value, len(machine.world.path)))
    return NONE


def is_hot(machine: Machine, receiver: Value, call: Call) -> Value:
    return machine.mystery('how hot it is', call.place)


def degrees(machine: Machine, receiver: Instance, place: Place) -> Value:
    return receiver.state.degrees


def ring(machine: Machine, receiver: Value, call: Call) -> Value:
    """Rings as often as it is told to."""
    return call.args[0]


KITCHEN = Library(
    classes={
        'kitchen.Oven': LibraryClass(
            state=lambda machine, instance: OvenState(),
            init=set_up,
            methods={'bake': bake, 'is_hot': is_hot},
            properties={'degrees': degrees},
        )
    },
    functions={'kitchen.ring': ring},
    aliases={'kitchen.tools.Oven': 'kitchen.Oven', 'kitchen.tools.ring': 'kitchen.ring'},
)


def followed(text: str, *tables: Library) -> tuple[Module, World]:
    project = Project.of_text(text, 'meal.py')
    model = LibraryModel([builtin_functions.TABLE, *tables])
    machine = Interpreter(project, model, World())
    return machine.follow(project.given[0]), machine.world


def test_a_program_does_what_the_table_of_its_library_says() -> None:
    module, _ = followed(PROGRAM, KITCHEN)
    oven = module.slots['oven']

    assert oven.state.baked == [('bread', 0), ('pie', 0), ('cake', 0)]
    assert module.slots['number'] == Const(2)
    assert module.slots['heat'] == Const(220)
    assert oven.slots['name'] == Const('mine')


def test_what_the_table_leaves_open_is_a_branch() -> None:
    module, _ = followed(PROGRAM, KITCHEN)

    assert module.slots['cold'].state.baked == [('ice', 1)]


def test_what_no_table_has_is_unknown_with_a_reason() -> None:
    module, _ = followed(PROGRAM, KITCHEN)
    (other,) = options_of(module.slots['other'])

    assert isinstance(other, Mystery)
    assert other.unknown.reason == 'result of kitchen.melt, which is not scanned'


def test_without_the_table_nothing_of_the_library_is_known() -> None:
    module, _ = followed(PROGRAM)

    assert module.slots['oven'].state is None
    assert isinstance(module.slots['heat'], Mystery)


def test_the_interpreter_needs_none_of_the_rooms_above_it() -> None:
    """Nor do the tables of Python's own functions: a process that has both loads no other room."""
    check = (
        'import sys\n'
        'import ros2cc_extract.extract.static.python.interpreter\n'
        'import ros2cc_extract.extract.static.python.builtins.builtin_functions\n'
        "rooms = {name.split('.')[3] for name in sys.modules"
        " if name.startswith('ros2cc_extract.extract.static.')}\n"
        'print(*sorted(rooms))\n'
    )
    run = subprocess.run([sys.executable, '-c', check], capture_output=True, text=True, check=True)

    assert run.stdout.split() == ['program', 'python']
