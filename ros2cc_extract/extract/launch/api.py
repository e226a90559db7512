"""The door to launch files: which there are, and what they start; nothing of them is ever run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from ros2cc_extract.diagnostics import Diagnostic
from ros2cc_extract.extract.launch.execution import Execution, shown_path
from ros2cc_extract.extract.launch.language.actions import Action
from ros2cc_extract.extract.launch.language.context import Context
from ros2cc_extract.extract.launch.language.recognition import XML, YAML
from ros2cc_extract.extract.launch.markup.files import read_frontend
from ros2cc_extract.extract.launch.python.files import read_python
from ros2cc_extract.extract.launch.workspace.packages import Known, Packages
from ros2cc_extract.files import Files
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.system.launched import Launched


@dataclass(frozen=True)
class Launch:
    """
    What a launch file starts.

    :param files: that were read, as they are shown.
    :param changes_states: it may itself configure or activate life-cycle nodes.
    :param packages: around the first of them.
    """

    processes: tuple[Launched, ...]
    noticed: tuple[Diagnostic, ...]
    files: tuple[str, ...]
    packages: Packages
    changes_states: bool = False


def launch(
    path: Path,
    arguments: Mapping[str, str],
    *,
    root: Path,
    files: Files,
    known: Known | None = None,
) -> Launch:
    """
    Follow a launch file.

    :param arguments: ``name:=value`` of the command line.
    :param root: places are shown relative to it.
    :param known: packages that were found for other launch files.
    """
    packages = Packages(files, path, lambda file: shown_path(file, root), known)

    def load(file: Path, context: Context) -> Sequence[Action]:
        if file.suffix in (XML, *YAML, '.launch'):
            return read_frontend(file, shown_path(file, root), files)
        return read_python(file, root, files, packages, context)

    execution = Execution(Context(dict(arguments)), packages, load)
    execution.include(path.absolute())
    shown = dict.fromkeys(shown_path(file, root) for file in execution.files)
    return Launch(
        tuple(execution.found),
        tuple(execution.noticed),
        tuple(shown),
        packages,
        execution.changes_states,
    )
