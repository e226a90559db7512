"""The plain run that comes first: which files have callbacks, and what goes wrong by itself."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ros2cc_extract.confirm.processes import Stimulus
from ros2cc_extract.confirm.statements import tree_of, values_compared
from ros2cc_extract.errors import InputError, Ros2ccError
from ros2cc_extract.explore.exploring import Exploration, note, plain
from ros2cc_extract.explore.failures import Kind
from ros2cc_extract.explore.points import points_of
from ros2cc_extract.explore.scenario import Scenario
from ros2cc_extract.explore.watching import Process, run_process
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.spec.model import Spec

# Of one service on their way, so that a re-entrant one may overlap itself.
AT_ONCE = 3


def first_look(
    command: Sequence[str],
    python: str,
    into: Exploration,
    *,
    given: Sequence[Path] | None = None,
    is_sent: bool = True,
    stubs: bool = False,
    everywhere: bool = False,
) -> tuple[Scenario, list[Spec]]:
    """
    Run the program once as it comes, and scan the files of the callbacks that have run.

    :param given: scan these instead.
    :param everywhere: as of a ``Scenario``.
    :return: what is to be explored, and what was read from source.
    :raises InputError: where no process of the command loads rclpy.
    """
    named = [Path(each) for each in command if each.endswith('.py') and Path(each).is_file()]
    first = list(given or named)
    stimulus = Stimulus(_values(first), AT_ONCE, is_sent=is_sent)
    scenario = Scenario(command=tuple(command), stimulus=stimulus)
    process = _run(scenario, python, stubs)
    if process.ended and _has_raised(process):
        # It may not stand messages of defaults, as a text that is to be a number.
        sent = Stimulus(stimulus.values, AT_ONCE, defaults=False, is_sent=is_sent)
        other = _run(Scenario(command=tuple(command), stimulus=sent), python, stubs)
        if not other.ended:
            stimulus, process = sent, other
    note(process, into)
    sources = list(given or dict.fromkeys([*named, *map(Path, filter(None, process.files))]))
    units = units_of(sources)
    return (
        Scenario(
            command=tuple(command),
            stimulus=Stimulus(
                _values(sources), AT_ONCE, defaults=stimulus.defaults, is_sent=is_sent
            ),
            points=points_of(units),
            known=tuple(process.labels),
            everywhere=everywhere,
        ),
        units,
    )


def _run(scenario: Scenario, python: str, stubs: bool) -> Process:
    process = plain(lambda rows: run_process(scenario, rows, python, stubs=stubs))
    if process.interrupted:
        raise KeyboardInterrupt
    if not process.started:
        said = [line for line in process.said.splitlines() if line.strip()]
        what = (
            f'no process of the command has loaded rclpy.executors: {said[-1]}'
            if said
            else ('no process of the command has loaded rclpy.executors, and it said nothing')
        )
        mend = 'give a command that runs a node, as you would type it; see --stub-missing'
        raise InputError(what, None, mend)
    return process


def _has_raised(process: Process) -> bool:
    failures = (each for seen in process.schedules for each in seen.failures)
    return any(each.kind is Kind.EXCEPTION for each in failures)


def units_of(sources: Sequence[Path]) -> list[Spec]:
    """What the scanner reads there; a file that cannot be read gives nothing."""
    found: list[Spec] = []
    for path in sources:
        try:
            found += scan([path], processes=1).units
        except Ros2ccError:
            continue
    return found


def _values(sources: Sequence[Path]) -> tuple[str | int | float, ...]:
    files = (path for path in sources if path.is_file())
    return tuple(
        dict.fromkeys(value for path in files for value in values_compared(tree_of(path)))
    )
