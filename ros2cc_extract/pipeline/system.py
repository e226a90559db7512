"""From launch files to a system: each process scanned by itself, under its own names."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path

from ros2cc_extract.diagnostics import UNREAD, Diagnostic, Severity
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.launch.api import Launch, launch
from ros2cc_extract.extract.launch.execution import UNSET
from ros2cc_extract.extract.launch.workspace.packages import Executable, Known
from ros2cc_extract.extract.static.program.given_parameters import GivenParameters
from ros2cc_extract.files import Files
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.pipeline.units_in_systems import with_neighbours
from ros2cc_extract.source_locations import Unknown, shown_name
from ros2cc_extract.spec.model import Spec, Unresolved
from ros2cc_extract.spec.node_graph import NodeGraph
from ros2cc_extract.spec.system.launched import Launched
from ros2cc_extract.spec.system.model import NOT_FOLLOWED, Process, System, SystemNode
from ros2cc_extract.spec.system.nodes import system_node
from ros2cc_extract.spec.system.own_answers import with_own_answers
from ros2cc_extract.spec.system.parameters import parameters_for

_PYTHON = re.compile(r'(?:.*/)?python3?(?:\.\d+)?')
_NO_CODE = ('container', 'composable')
Scan = Callable[[Sequence[Path], GivenParameters], Extraction]


@dataclass(frozen=True)
class Scanned:
    """
    A system, and all that was scanned of it as one.

    :param paths: the Python files that its processes run.
    """

    system: System
    extraction: Extraction
    paths: tuple[Path, ...]


@dataclass
class Kept:
    """What several systems of one workspace share: its packages, and scans of its files."""

    packages: Known = field(default_factory=dict)
    scans: dict[object, Extraction] = field(default_factory=dict)


def scan_system(
    files_of_launch: Sequence[Path],
    arguments: Mapping[str, str],
    scan: Scan,
    files: Files,
    kept: Kept | None = None,
) -> Scanned:
    """
    Follow launch files, and scan what they start.

    :param scan: scans files under the parameters that are set for them.
    """
    root, kept = Path.cwd(), kept or Kept()
    launches = [
        launch(path, arguments, root=root, files=files, known=kept.packages)
        for path in files_of_launch
    ]
    builder = _Builder(scan, root, kept.scans)
    processes = [p for each in launches for p in builder.processes(each)]
    noticed = tuple(d for each in launches for d in each.noticed)
    outside = tuple(_diagnostic(p) for p in processes if p.outside is not None)
    sources = tuple(dict.fromkeys(file for each in launches for file in each.files))
    system = System(
        name=', '.join(shown_name(path.name) for path in files_of_launch),
        processes=tuple(processes),
        sources=sources,
        unresolved=tuple(unresolved_of(processes, noticed)),
        changes_states=any(each.changes_states for each in launches),
    )
    extraction = builder.extraction([*noticed, *outside], sources)
    settled = with_neighbours(system)
    units = _units_of_all(system, settled, extraction.units)
    return Scanned(settled, replace(extraction, units=units), builder.paths)


def _units_of_all(before: System, after: System, units: Sequence[Spec]) -> tuple[Spec, ...]:
    """The units of a scan, each as it is in every process that has it."""
    changed: dict[Spec, dict[Spec, None]] = defaultdict(dict)
    for old, new in zip(before.processes, after.processes, strict=True):
        for one, other in zip(old.units, new.units, strict=True):
            changed[one][other] = None
    return tuple(dict.fromkeys(each for unit in units for each in changed.get(unit, (unit,))))


class _Builder:
    """Makes processes, and keeps what was scanned for them."""

    def __init__(self, scan: Scan, root: Path, scans: dict[object, Extraction]) -> None:
        self._scan = scan
        self._root = root
        self._names: dict[str, int] = {}
        self._scans = scans
        self._kept: dict[int, Extraction] = {}
        self._paths: dict[Path, None] = {}

    @property
    def paths(self) -> tuple[Path, ...]:
        return tuple(self._paths)

    def processes(self, started: Launch) -> Iterator[Process]:
        for launched in started.processes:
            executable = _executable(launched, started)
            if isinstance(executable, Unknown):
                yield Process(name=self._name(launched), launched=launched, outside=executable)
            else:
                yield self._scanned(launched, executable)

    def _scanned(self, launched: Launched, executable: Executable) -> Process:
        assert executable.file is not None
        path = executable.file
        shown = path.relative_to(self._root) if path.is_relative_to(self._root) else path
        self._paths[shown] = None
        file = shown_name(shown.as_posix())
        found = self._scan_once(shown, _given(launched, ()))
        entry = _entry(found, file, executable.function)
        graphs = [each for each in found.nodes if each.entry == entry]
        known = _given(launched, [system_node(each, launched) for each in graphs])
        if known != _given(launched, ()):
            found = self._scan_once(shown, known)
            graphs = [each for each in found.nodes if each.entry == entry]
        nodes = tuple(system_node(graph, launched) for graph in _named(graphs))
        found = _with_own_answers(found, entry, nodes)
        self._kept.setdefault(id(found), found)
        process = Process(
            name=self._name(launched),
            launched=launched,
            file=file,
            entry=entry,
            nodes=nodes,
            units=tuple(unit for unit in found.units if unit.entry == entry and entry),
            whole=next((each for each in found.wholes if each.entry == entry), None),
        )
        if entry is None:
            return replace(process, outside=_without_start(found, file))
        return process

    def _scan_once(self, path: Path, parameters: GivenParameters) -> Extraction:
        key = (path, parameters.key)
        if key not in self._scans:
            self._scans[key] = self._scan([path], parameters)
        return self._scans[key]

    def _name(self, launched: Launched) -> str:
        file = next((w for w in reversed(launched.command) if w.endswith('.py')), '')
        words = file or ''.join(launched.command[:1])
        facts = (launched.name, launched.executable, words)
        given = next((fact for fact in facts if isinstance(fact, str) and fact), launched.kind)
        name = (given.rpartition('/')[2] or given).removesuffix('.py')
        number = self._names[name] = self._names.get(name, 0) + 1
        return name if number == 1 else f'{name}_{number}'

    def extraction(self, noticed: Sequence[Diagnostic], sources: Sequence[str]) -> Extraction:
        """All scans as one."""
        launches = Extraction(units=(), diagnostics=tuple(noticed), files_seen=tuple(sources))
        return as_one([launches, *self._kept.values()])


def as_one(found: Sequence[Extraction]) -> Extraction:
    """Several scans as one; what several of them found stands in it once."""
    reported = dict.fromkeys(d for each in found for d in each.diagnostics)
    return Extraction(
        units=tuple(dict.fromkeys(unit for each in found for unit in each.units)),
        diagnostics=tuple(sorted(reported, key=lambda d: (d.place, d.slug, d.message))),
        files_seen=tuple(dict.fromkeys(file for each in found for file in each.files_seen)),
        joined=tuple(dict.fromkeys(each for e in found for each in e.joined)),
        wholes=tuple(dict.fromkeys(each for e in found for each in e.wholes)),
        nodes=tuple(each for e in found for each in e.nodes),
        cut=next((each.cut for each in found if each.cut), ''),
        interrupted=any(each.interrupted for each in found),
    )


def _with_own_answers(
    found: Extraction, entry: str | None, nodes: tuple[SystemNode, ...]
) -> Extraction:
    """The scan with the units of a process as its names let them ask themselves."""
    units = tuple(
        with_own_answers(unit, nodes) if unit.entry == entry else unit for unit in found.units
    )
    return found if units == found.units else replace(found, units=units)


def _given(launched: Launched, nodes: Sequence[SystemNode]) -> GivenParameters:
    values, are_all = parameters_for(launched, nodes)
    return GivenParameters(values, are_all)


def _executable(launched: Launched, started: Launch) -> Executable | Unknown:
    """The Python file of a process, or why it has none."""
    if launched.kind in _NO_CODE:
        return Unknown(f'a {launched.kind} node is no Python', launched.source)
    if launched.kind == 'process':
        return _of_command(launched, started)
    package, name = launched.package or '', launched.executable
    if isinstance(package, Unknown):
        return Unknown(package.reason, package.at or launched.source)
    if isinstance(name, Unknown):
        return Unknown(name.reason, name.at or launched.source)
    if name is None:
        return Unknown('no executable is found', launched.source)
    if not package:
        return _python_file(Path(name), launched, started)
    if started.packages.folder(package) is None:
        return Unknown(f'package {package} is not found', launched.source)
    found = started.packages.executable(package, name)
    if found is None:
        return Unknown(_not_found(package, name, started), launched.source)
    if found.file is None:
        return Unknown(f'executable {name} of package {package} is no Python', launched.source)
    return found


def _not_found(package: str, name: str, started: Launch) -> str:
    """Why an executable is not known: nothing declares it, or that could not be read."""
    why = f'executable {name} was not found among what package {package} installs'
    unread = started.packages.unread(package)
    return f'{why}, of which not all could be read: {unread[0]}' if unread else why


def _of_command(launched: Launched, started: Launch) -> Executable | Unknown:
    """``python3 file.py``, ``file.py``."""
    words = [word for word in launched.command if not word.startswith('-')]
    if words and _PYTHON.fullmatch(words[0]):
        words = words[1:]
    if not words or not words[0].endswith('.py'):
        shown = ' '.join(launched.command[:3]) or 'of this process'
        return Unknown(f'command {shown} runs no Python file', launched.source)
    return _python_file(Path(words[0]), launched, started)


def _python_file(path: Path, launched: Launched, started: Launch) -> Executable | Unknown:
    if not started.packages.has(path):
        return Unknown(f'{path} is not there', launched.source)
    return Executable(path.absolute())


def _entry(found: Extraction, file: str, function: str | None) -> str | None:
    """Which of the starts of a file the process is."""
    starts = [*(unit.entry for unit in found.units), *(node.entry for node in found.nodes)]
    known = dict.fromkeys(entry for entry in starts if entry is not None)
    mine = [entry for entry in known if entry.startswith(f'{file}:')]
    wanted = f'{file}:{function or "main"}'
    if wanted in mine:
        return wanted
    return mine[0] if len(mine) == 1 else None


def _named(graphs: Sequence[NodeGraph]) -> list[NodeGraph]:
    """The nodes of a program; one that is not known may be one of those that are."""
    known = [each for each in graphs if isinstance(each.name, str)]
    return known or list(graphs)


def _without_start(found: Extraction, file: str) -> Unknown:
    """Why no node is started in a file that a process runs."""
    for each in found.diagnostics:
        if each.slug in UNREAD and each.place.file == file:
            return Unknown(f'its file cannot be read: {each.message}', each.place)
    return Unknown('no start of a node is found in its file')


def _diagnostic(process: Process) -> Diagnostic:
    why = process.outside
    assert why is not None
    return Diagnostic(
        severity=Severity.NOTE,
        slug='outside-system',
        place=process.launched.source,
        message=f'process {process.name} is outside: {why.reason}',
        help='what it offers and asks for is not known',
    )


def unresolved_of(
    processes: Sequence[Process], noticed: Sequence[Diagnostic]
) -> Iterator[Unresolved]:
    """What of processes and of the files that start them could not be found out."""
    for diagnostic in noticed:
        subject, action = NOT_FOLLOWED
        fact = 'argument' if diagnostic.slug == UNSET else action
        yield Unresolved(
            subject=subject, fact=fact, reason=diagnostic.message, source=diagnostic.place
        )
    for process in processes:
        facts = list(process.launched.open)
        if process.outside is not None:
            facts.append(('code', process.outside))
        if process.launched.conditional is not None:
            facts.append(('condition', process.launched.conditional))
        for fact, why in facts:
            source = why.at or process.launched.source
            yield Unresolved(subject=process.name, fact=fact, reason=why.reason, source=source)
        for node in process.nodes:
            if isinstance(node.name, Unknown):
                yield Unresolved(
                    subject=process.name, fact='node_name', reason=node.name.reason,
                    source=node.name.at or node.source,
                )  # fmt: skip
            for endpoint in node.endpoints:
                if isinstance(endpoint.name, Unknown):
                    yield Unresolved(
                        subject=str(node.own_name), fact=endpoint.kind.what,
                        reason=endpoint.name.reason, source=endpoint.source,
                    )  # fmt: skip
