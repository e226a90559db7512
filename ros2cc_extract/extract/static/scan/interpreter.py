"""The abstract machine put together: it follows a program's set-up and never runs it."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.notes import Notes
from ros2cc_extract.extract.static.libraries.library_calls import Libraries
from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.python.language.assignments import Assignments
from ros2cc_extract.extract.static.python.language.attributes import Attributes
from ros2cc_extract.extract.static.python.language.calls import Calls
from ros2cc_extract.extract.static.python.language.comprehensions import Comprehensions
from ros2cc_extract.extract.static.python.language.expressions import Expressions
from ros2cc_extract.extract.static.python.language.statements import Statements
from ros2cc_extract.extract.static.python.machine.store import Store
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.objects.imports import Imports
from ros2cc_extract.extract.static.python.objects.instances import Instances

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
    Notes,
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
