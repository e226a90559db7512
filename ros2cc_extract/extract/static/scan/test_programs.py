"""Tests: each is a program of its own, with what is prepared for it."""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.state import nodes_of
from ros2cc_extract.extract.static.libraries.rclpy.tables.executors import remove_node
from ros2cc_extract.extract.static.python.values.unknown_callers import unknown_arguments
from ros2cc_extract.extract.static.python.values.values import Bound, Class, Function, Instance
from ros2cc_extract.extract.static.scan.ros_interpreter import RosInterpreter

PREPARING = ('setUp', 'asyncSetUp', 'setup_method')
"""Methods that are called before each test."""


def begin_test(machine: RosInterpreter, instance: Instance) -> Instance:
    """
    Start a program of its own, on an object of its own.

    Each test begins with ``rclpy.init`` and ends with ``rclpy.shutdown``, which leaves no global
    executor behind (rclpy 7.1.6, ``__init__.py``).
    """
    end_test(machine)
    return _set_up_for_test(machine, instance)


def end_test(machine: RosInterpreter) -> None:
    """What the global executor served is free again: ``rclpy.shutdown`` has ended it."""
    executor = machine.world.global_executor
    if executor is not None:
        for node in nodes_of(executor):
            remove_node(machine, executor, node)
    machine.world.global_executor = None


def _set_up_for_test(machine: RosInterpreter, instance: Instance) -> Instance:
    """The object of its own that each test has, prepared (``unittest/case.py``)."""
    found = (
        cls.slots[name]
        for name in PREPARING
        for cls in instance.mro
        if isinstance(cls, Class) and name in cls.slots
    )
    prepare = next((each for each in found if isinstance(each, Function)), None)
    if prepare is None:
        return instance
    fresh = Instance(instance.cls, instance.place)
    machine.prepare(fresh)
    call = unknown_arguments(prepare, prepare.place, skip=1)
    machine.run_if_coroutine(machine.call(Bound(fresh, prepare), call), prepare.place)
    return fresh
