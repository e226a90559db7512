"""
Substitutions of launch files: texts that are known only when the file is launched.

Source: launch (Jazzy) ``substitutions/``, launch_ros ``substitutions/``. ``evaluation.py`` finds
what they stand for.
"""

from __future__ import annotations

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown


@dataclass(frozen=True)
class Text:
    """A text as it stands."""

    text: str


@dataclass(frozen=True)
class Configuration:
    """``LaunchConfiguration``, ``$(var …)``: what an argument is set to."""

    name: Expression
    default: Expression | None = None


@dataclass(frozen=True)
class Variable:
    """``EnvironmentVariable``, ``$(env …)``: unknown before the launch."""

    name: Expression
    default: Expression | None = None


@dataclass(frozen=True)
class Share:
    """``FindPackageShare``, ``$(find-pkg-share …)``: the share folder of a package."""

    package: Expression


@dataclass(frozen=True)
class Path:
    """``PathJoinSubstitution``."""

    parts: tuple[Expression, ...]


@dataclass(frozen=True)
class Evaluated:
    """``PythonExpression``, ``$(eval …)``: computed by constants and operators alone."""

    text: Expression


@dataclass(frozen=True)
class Logic:
    """``not``, ``and``, ``or``, ``equals``, ``not-equals``, ``if`` of texts."""

    operator: str
    operands: tuple[Expression, ...]


@dataclass(frozen=True)
class ThisFile:
    """The path of the launch file, or of its folder."""

    is_folder: bool


@dataclass(frozen=True)
class Unresolved:
    """What is unknown before the launch."""

    why: Unknown


Substitution = (
    Text | Configuration | Variable | Share | Path | Evaluated | Logic | ThisFile | Unresolved
)
Expression = tuple[Substitution, ...]
"""Texts one behind the other."""


def text(value: str) -> Expression:
    """A text as it stands, as an expression."""
    return (Text(value),)


def unresolved(why: Unknown) -> Expression:
    """Return an expression whose value is unknown."""
    return (Unresolved(why),)
