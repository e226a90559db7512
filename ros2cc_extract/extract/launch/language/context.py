"""
What is set while a launch file is followed: configurations, namespace, remaps, parameters.

Source: launch (Jazzy) ``launch_context.py``: a group that is scoped restores all of it at its end;
an include is not scoped (``actions/include_launch_description.py``).
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import field, replace

from ros2cc_extract.extract.launch.language.actions import ParameterSource
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.system.names import Remap

Value = str | Unknown


@dataclass(frozen=True)
class Scope:
    """
    What holds at one point.

    :param perhaps: values of those configurations that are either these or not set at all, so that
        whoever asks for one either gets this or ends the launch.
    :param namespace: ``None`` before any is pushed.
    """

    configurations: dict[str, Value] = field(default_factory=dict)
    perhaps: dict[str, Value] = field(default_factory=dict)
    namespace: Value | None = None
    remaps: tuple[Remap, ...] = ()
    parameters: tuple[ParameterSource, ...] = ()


class Context:
    """
    The state of one launch.

    :ivar unset: arguments without a value that something asked for, by name, with the place.
    :ivar steps: of Python files that were followed.
    :ivar letters: of texts that were put together.
    """

    def __init__(self, arguments: dict[str, str]) -> None:
        self.scope = Scope(configurations=dict(arguments))
        self.file = ''
        self.unset: dict[str, Place | None] = {}
        self.steps = self.letters = 0

    def declare(self, name: str, default: Value | None) -> bool:
        """Set a configuration where it is not set yet; say whether it is set now."""
        scope = self.scope
        if name not in scope.configurations:
            if default is not None:
                self.set(name, default)
            return default is not None
        if default is not None and name in scope.perhaps:
            if default == scope.perhaps[name]:
                self.set(name, default)
            else:
                self.set(name, scope.configurations[name])  # one of two
        return True

    def set(self, name: str, value: Value) -> None:
        """Set a configuration for what follows in this scope."""
        known = {**self.scope.configurations, name: value}
        perhaps = {n: v for n, v in self.scope.perhaps.items() if n != name}
        self.scope = replace(self.scope, configurations=known, perhaps=perhaps)

    def unset_configuration(self, name: str) -> None:
        """Take a configuration away."""
        known, perhaps = (
            {n: v for n, v in each.items() if n != name}
            for each in (self.scope.configurations, self.scope.perhaps)
        )
        self.scope = replace(self.scope, configurations=known, perhaps=perhaps)

    def only(self, configurations: dict[str, Value]) -> None:
        """Keep no configuration but these."""
        self.scope = replace(self.scope, configurations=dict(configurations), perhaps={})

    @contextmanager
    def group(self) -> Iterator[None]:
        """What is set inside does not hold behind."""
        before = self.scope
        try:
            yield
        finally:
            self.scope = before

    def join(self, before: Scope, why: Unknown) -> bool:
        """
        What was changed since then was perhaps not: of that nothing is known from here on.

        Parameters that were pushed stay, and remaps that were pushed do not.

        :return: whether there were such remaps.
        """
        after = self.scope
        known, perhaps = dict(after.configurations), dict(after.perhaps)
        for name in {**before.configurations, **known}:
            old, new = before.configurations.get(name), known.get(name)
            if old == new:
                continue
            known[name] = why
            value = perhaps.pop(name, new)
            if value is not None and (old is None or before.perhaps.get(name) == value):
                perhaps[name] = value
        namespace = after.namespace if after.namespace == before.namespace else why
        self.scope = Scope(
            configurations=known,
            perhaps=perhaps,
            namespace=namespace,
            remaps=before.remaps,
            parameters=after.parameters,
        )
        return after.remaps != before.remaps

    @contextmanager
    def within(self, file: str) -> Iterator[None]:
        """Follow another file."""
        before, self.file = self.file, file
        try:
            yield
        finally:
            self.file = before
