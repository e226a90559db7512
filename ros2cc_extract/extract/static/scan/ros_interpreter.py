"""The interpreter that knows rclpy, and notes what a program does concurrently."""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.model import model
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld
from ros2cc_extract.extract.static.libraries.rclpy.notes import RosNotes
from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.python.interpreter import Interpreter


class RosInterpreter(RosNotes, Interpreter):
    """One run of one program."""

    world: RosWorld

    def __init__(self, project: Project) -> None:
        world = RosWorld(lists_builtin=project.lists_builtin, parameters=project.parameters)
        super().__init__(project, model(), world)
