"""
The abstract interpreter of Python, put together: it follows a program and never runs it.

It knows the language and its built-in types. What a library does stands in a table of it, see
``library_table.py``. Code that needs more than the state of what is followed overrides the
hooks of ``observer.py``.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.program.source import SourceFile
from ros2cc_extract.extract.static.python.language.assignments import Assignments
from ros2cc_extract.extract.static.python.language.attributes import Attributes
from ros2cc_extract.extract.static.python.language.calls import Calls
from ros2cc_extract.extract.static.python.language.comprehensions import Comprehensions
from ros2cc_extract.extract.static.python.language.expressions import Expressions
from ros2cc_extract.extract.static.python.language.statements import Statements
from ros2cc_extract.extract.static.python.language.with_blocks import Blocks
from ros2cc_extract.extract.static.python.machine.library_table import LibraryModel
from ros2cc_extract.extract.static.python.machine.store import Store
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.objects.imports import Imports
from ros2cc_extract.extract.static.python.objects.instances import Instances
from ros2cc_extract.extract.static.python.objects.library_calls import LibraryCalls
from ros2cc_extract.extract.static.python.values.values import Module

RUN_LIMIT = 800_000
"""Statements and expressions of a whole run: some seconds."""


class Interpreter(
    Statements,
    Assignments,
    Expressions,
    Attributes,
    Calls,
    Blocks,
    Instances,
    Comprehensions,
    LibraryCalls,
    Imports,
):
    """
    One run of one program.

    :param project: the files that its imports may name.
    :param model: what is known of the libraries that it uses.
    :param world: what the run leaves behind.
    """

    def __init__(self, project: Project, model: LibraryModel, world: World) -> None:
        self.store = Store()
        self.world = world
        self.model = model
        self.steps = self.step_limit = 0
        self.steps_left = RUN_LIMIT
        self.stack = []
        self.creating = []
        self.beginning = []
        self.project = project
        self.deadline = project.deadline
        self.modules = {}
        self._changed = {}

    def follow(self, source: SourceFile) -> Module:
        """
        Run a program from the first line of its main file to the last; returns its globals.

        :raises BudgetError: it is too long to be followed to its end.
        """
        self.steps, self.step_limit = 0, self.steps_left
        return self.run_module(source, '__main__')
