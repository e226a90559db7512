"""The abstract machine put together: it follows a program's set-up and never runs it."""

from __future__ import annotations

from ros2cc_extract.extract.static.assignments import Assignments
from ros2cc_extract.extract.static.attributes import Attributes
from ros2cc_extract.extract.static.calls import Calls
from ros2cc_extract.extract.static.comprehensions import Comprehensions
from ros2cc_extract.extract.static.effects import Effects
from ros2cc_extract.extract.static.expressions import Expressions
from ros2cc_extract.extract.static.imports import Imports
from ros2cc_extract.extract.static.instances import Instances
from ros2cc_extract.extract.static.libraries import Libraries
from ros2cc_extract.extract.static.project import Project
from ros2cc_extract.extract.static.statements import Statements
from ros2cc_extract.extract.static.store import Store
from ros2cc_extract.extract.static.world import World

RUN_LIMIT = 800_000
"""Statements and expressions of a whole run: some seconds."""


class Interpreter(
    Statements,
    Assignments,
    Expressions,
    Attributes,
    Calls,
    Instances,
    Comprehensions,
    Libraries,
    Imports,
    Effects,
):
    """One run of one program."""

    def __init__(self, project: Project) -> None:
        self.store = Store()
        self.world = World(lists_builtin=project.lists_builtin)
        self.steps = self.step_limit = 0
        self.steps_left = RUN_LIMIT
        self.stack = []
        self.creating = []
        self.beginning = []
        self.project = project
        self.deadline = project.deadline
        self.modules = {}
        self._changed = {}
