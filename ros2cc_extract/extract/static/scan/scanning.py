"""
One scan: the programs from their entries, then what no entry reaches.

Files are followed in pieces, in children where there are several cores. What a file gives
does not depend on which child follows it: in the second round each gets what the others covered,
and follows a file again where one before it in the order of files has covered more since.
"""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

from ros2cc_extract.deadline import Patience, TimeOverError, ended_by
from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld
from ros2cc_extract.extract.static.packaging.api import declarations, notes_of
from ros2cc_extract.extract.static.program.entry_points import entries_of
from ros2cc_extract.extract.static.program.project import FollowedFile, Project
from ros2cc_extract.extract.static.program.relevance import replaces_rclpy
from ros2cc_extract.extract.static.program.relevant_files import scanned_files
from ros2cc_extract.extract.static.program.runtime_limits import forget_programs
from ros2cc_extract.extract.static.program.source import SourceFile
from ros2cc_extract.extract.static.python.values.values import Class
from ros2cc_extract.extract.static.scan.runs import run_entry
from ros2cc_extract.extract.static.scan.runs_without_entry import run_library
from ros2cc_extract.extract.static.units.entity_aliases import each_once
from ros2cc_extract.extract.static.units.units import joined_of, specs_of, wholes_of
from ros2cc_extract.extract.static.units.whole_program.node_graphs import graphs_of
from ros2cc_extract.jobs.process_pool import ProcessPool
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.joined_executors import Joined
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.node_graph import NodeGraph

Progress = Callable[[int, int], None]
Numbers = tuple[int, ...]

LONGEST_MESSAGE = 300
DEFECT = 'this is a defect of the tool; ROS2CC_TRACEBACK=1 shows where'
PIECES_PER_CHILD = 12
WORTH_SHARING_BYTES = 100_000
SMALLEST_PIECE_BYTES = 20_000
"""Below that, sending work around costs more than doing it."""


INTERRUPTED = 'interrupted'


@dataclass(frozen=True)
class Piece:
    """
    Files to follow: from their entries, or from what none of ``covered`` reaches.

    :param numbers: of files in the order of the scan; none to ask what was read on the way.
    """

    numbers: Numbers
    covered: frozenset[Place] | None = None


@dataclass(frozen=True)
class Found:
    """
    What following one file gave.

    :param joined: units that wait for each other, as one.
    :param wholes: all units of a program in one, where it has several.
    :param nodes: what its nodes have in the graph.
    :param perhaps: the same of functions that only spin, which may be starts: where they stand.
    :param cut: why it was not followed to its end; empty where it was.
    """

    units: tuple[Spec, ...] = ()
    noticed: tuple[Diagnostic, ...] = ()
    covered: frozenset[Place] = frozenset()
    perhaps: tuple[tuple[Place, Found], ...] = ()
    joined: tuple[Joined, ...] = ()
    wholes: tuple[Spec, ...] = ()
    nodes: tuple[NodeGraph, ...] = ()
    cut: str = ''


@dataclass(frozen=True)
class Read:
    """What one process has read: trouble with files, and files that were not given."""

    unread: tuple[Diagnostic, ...]
    followed: frozenset[FollowedFile]


@dataclass(frozen=True)
class Answer:
    """What was found in each file of a piece; what was read, where no file was named."""

    found: tuple[Found, ...] = ()
    read: Read | None = None


def scan_project(
    project: Project, processes: int, progress: Progress | None, patience: Patience
) -> tuple[Extraction, frozenset[FollowedFile]]:
    """
    Follow everything; also returns files that were read but not given.

    :param processes: at most so many share the work.
    """
    files = scanned_files(project)
    if sum(len(source.data) for source in files) < WORTH_SHARING_BYTES:
        processes = 1
    worker = _Worker(project, files)
    pieces = _pieces(files, processes)
    processes = min(processes, len(pieces))
    with ProcessPool(worker.answer, processes) as pool:
        return _Scan(project, files, pieces, pool, worker, progress, patience).run()


def _pieces(files: Sequence[SourceFile], processes: int) -> list[Numbers]:
    """Neighbours stay together, since they import each other."""
    if processes == 1:
        return [(number,) for number in range(len(files))]
    size = sum(len(source.data) for source in files) // (processes * PIECES_PER_CHILD)
    pieces: list[list[int]] = []
    filled = 0
    for number, source in enumerate(files):
        if not pieces or filled >= max(size, SMALLEST_PIECE_BYTES):
            pieces.append([])
            filled = 0
        pieces[-1].append(number)
        filled += len(source.data)
    return [tuple(piece) for piece in pieces]


class _Worker:
    """Follows files, in a child or here."""

    def __init__(self, project: Project, files: Sequence[SourceFile]) -> None:
        self._project = project
        self._files = files
        installed = declarations(project.disk, project.script_folders(), project.shown)
        self._scripts = frozenset((each.module, each.function) for each in installed.scripts)
        self.unread_programs = notes_of(installed.unread)

    def answer(self, piece: Piece) -> Answer:
        """Follow a piece."""
        if not piece.numbers:
            return Answer(read=Read(self._unread(), frozenset(self._project.followed())))
        files = [self._files[number] for number in piece.numbers]
        return Answer(tuple(self._found_in_time(source, piece.covered) for source in files))

    def _found_in_time(self, source: SourceFile, covered: frozenset[Place] | None) -> Found:
        deadline = self._project.deadline
        if deadline is None:
            return self._found_in(source, covered)
        if deadline.is_over:
            return Found(cut=deadline.reason)
        try:
            with ended_by(deadline):
                found = self._found_in(source, covered)
        except TimeOverError:
            return Found(cut=deadline.reason)
        return replace(found, cut=deadline.reason) if deadline.is_over else found

    def _found_in(self, source: SourceFile, covered: frozenset[Place] | None) -> Found:
        """What one file gives; what goes wrong with it does not end the scan of the others."""
        try:
            return self._follow(source, covered)
        except RecursionError:
            return _failed(source, 'nested-too-deeply', 'nested too deeply to be followed')
        except MemoryError:
            return _failed(source, 'internal-error', 'there is not enough memory to follow it')
        except Exception as error:
            if os.environ.get('ROS2CC_TRACEBACK'):
                raise
            message = ' '.join(f'{type(error).__name__}: {error}'.split())[:LONGEST_MESSAGE]
            return _failed(source, 'internal-error', f'cannot be followed: {message}', DEFECT)
        finally:
            forget_programs()

    def _follow(self, source: SourceFile, covered: frozenset[Place] | None) -> Found:
        if b'modules' in source.data and source.tree and replaces_rclpy(source.tree):
            return Found()
        if covered is None:
            return self._from_entries(source)
        return self._from_rest(source, covered)

    def _from_entries(self, source: SourceFile) -> Found:
        found: list[Found] = []
        perhaps: list[tuple[Place, Found]] = []
        for entry in entries_of(source, self._scripts):
            each = _found(run_entry(self._project, entry).world, entry.label)
            if entry.place is None:
                found.append(each)
            else:
                perhaps.append((entry.place, each))
            forget_programs()
        return replace(_joined(found), perhaps=tuple(perhaps))

    def _from_rest(self, source: SourceFile, covered: frozenset[Place]) -> Found:
        rest = run_library(self._project, source, covered)
        found = _found(rest.world, None) if rest is not None else Found()
        del rest
        forget_programs()
        return found

    def _unread(self) -> tuple[Diagnostic, ...]:
        return tuple(d for source in self._project.files for d in source.diagnostics)


class _Scan:
    """Hands the pieces out and puts together what comes back."""

    def __init__(
        self,
        project: Project,
        files: Sequence[SourceFile],
        pieces: Sequence[Numbers],
        pool: ProcessPool[Piece, Answer],
        worker: _Worker,
        progress: Progress | None,
        patience: Patience,
    ) -> None:
        self._project = project
        self._worker = worker
        self._files = files
        self._pieces = pieces
        self._pool = pool
        self._progress = progress or (lambda done, total: None)
        self._done = 0
        self._patience = patience
        self._is_interrupted = False

    def run(self) -> tuple[Extraction, frozenset[FollowedFile]]:
        """Both rounds."""
        first = self._ask([Piece(numbers) for numbers in self._pieces], None)
        from_entries = _with_starts([found for answer, _ in first for found in answer.found])
        homes = [home for _, home in first]
        from_rest = self._rest(from_entries, homes)
        read = self._read()
        every = list(zip(from_entries, from_rest, strict=True))
        noticed = [d for pair in every for found in pair for d in found.noticed]
        cut = [found.cut or other.cut for found, other in every]
        noticed.extend(self._reported_as_cut(cut))
        noticed.extend(self._worker.unread_programs)
        unread = (*self._project.barred, *(d for each in read for d in each.unread))
        extraction = Extraction(
            units=each_once([unit for pair in every for found in pair for unit in found.units]),
            joined=tuple(
                dict.fromkeys(each for pair in every for found in pair for each in found.joined)
            ),
            wholes=tuple(each for pair in every for found in pair for each in found.wholes),
            nodes=tuple(each for pair in every for found in pair for each in found.nodes),
            diagnostics=_sorted([*noticed, *unread]),
            files_seen=tuple(source.shown for source in self._project.given),
            cut=next(filter(None, cut), ''),
            interrupted=self._is_interrupted,
        )
        return extraction, frozenset(file for each in read for file in each.followed)

    def _rest(self, first: Sequence[Found], homes: Sequence[int | None]) -> list[Found]:
        """Follow what no entry reaches, as if one file were followed after the other."""
        covered = _Covered(first)
        ahead = self._ahead(covered, homes) if self._pool.size > 1 else {}
        covered.grown.clear()
        rest: list[Found] = []
        with self._ended_by_interrupt():
            for number, source in enumerate(() if self._is_interrupted else self._files):
                found = ahead.get(number)
                if found is None or source.shown in covered.grown:
                    found = self._worker.answer(Piece((number,), covered.of([source]))).found[0]
                if not ahead:
                    self._step(1)
                covered.add(found)
                rest.append(found)
        return [*rest, *[Found(cut=INTERRUPTED)] * (len(self._files) - len(rest))]

    def _ahead(self, covered: _Covered, homes: Sequence[int | None]) -> dict[int, Found]:
        """Follow every file as if none before it covered more than the entries did."""
        pieces = [
            Piece(numbers, covered.of(self._files[number] for number in numbers))
            for numbers in self._pieces
        ]
        found = (found for answer, _ in self._ask(pieces, homes) for found in answer.found)
        return dict(enumerate(found))

    def _ask(
        self, pieces: Sequence[Piece], by: Sequence[int | None] | None
    ) -> list[tuple[Answer, int | None]]:
        found: dict[int, tuple[Answer, int | None]] = {}
        with self._ended_by_interrupt():
            for number, given in self._pool.each(pieces, by) if not self._is_interrupted else ():
                found[number] = given
                self._step(len(pieces[number].numbers))
        return [
            found.get(number) or (Answer((Found(cut=INTERRUPTED),) * len(piece.numbers)), None)
            for number, piece in enumerate(pieces)
        ]

    @contextmanager
    def _ended_by_interrupt(self) -> Iterator[None]:
        """End what is within on an interrupt, where results so far are to be reported."""
        try:
            yield
        except KeyboardInterrupt:
            if not self._patience.keeps_interrupted:
                raise
            self._is_interrupted = True

    def _reported_as_cut(self, cut: Sequence[str]) -> Iterator[Diagnostic]:
        """Report once what may be missing, at the first file of it."""
        places = [source.shown for source, why in zip(self._files, cut, strict=True) if why]
        if places:
            yield Diagnostic(
                severity=Severity.WARNING,
                slug='not-followed',
                place=Place(places[0], 1, 1),
                message=f'{len(places)} of {len(cut)} files are not followed to their end: '
                f'{next(filter(None, cut))}',
                help='what they would create is missing from the units',
            )

    def _step(self, files: int) -> None:
        self._done += files
        self._progress(self._done, 2 * len(self._files))

    def _read(self) -> list[Read]:
        has_children = self._pool.size > 1 and not self._is_interrupted
        children = range(self._pool.size if has_children else 0)
        asked = self._pool.ask([Piece(())] * len(children), list(children))
        answers = [*(answer for answer, _ in asked), self._worker.answer(Piece(()))]
        return [answer.read for answer in answers if answer.read is not None]


class _Covered:
    """
    What was followed already, by file.

    :ivar grown: files that have more covered since.
    """

    def __init__(self, found: Iterable[Found]) -> None:
        self.grown: set[str] = set()
        self._places: dict[str, set[Place]] = defaultdict(set)
        for each in found:
            self.add(each)

    def add(self, found: Found) -> None:
        """Count what ``found`` covers."""
        for place in found.covered:
            if place not in self._places[place.file]:
                self._places[place.file].add(place)
                self.grown.add(place.file)

    def of(self, files: Iterable[SourceFile]) -> frozenset[Place]:
        """What is covered of these files."""
        return frozenset(p for file in files for p in self._places.get(file.shown, ()))


def _failed(source: SourceFile, slug: str, message: str, mend: str = '') -> Found:
    place = Place(source.shown, 1, 1)
    noticed = Diagnostic(
        severity=Severity.ERROR, slug=slug, place=place, message=message, help=mend
    )
    return Found(noticed=(noticed,))


def _found(world: RosWorld, label: str | None) -> Found:
    units = tuple(specs_of(world, label))
    joined = tuple(joined_of(world, label, units))
    wholes = tuple(wholes_of(world, label, units))
    nodes = tuple(graphs_of(world, label))
    return Found(
        units,
        tuple(world.diagnostics),
        _covered(world),
        joined=joined,
        wholes=wholes,
        nodes=nodes,
    )


def _joined(parts: Iterable[Found]) -> Found:
    found = list(parts)
    return Found(
        tuple(unit for part in found for unit in part.units),
        tuple(diagnostic for part in found for diagnostic in part.noticed),
        frozenset(place for part in found for place in part.covered),
        joined=tuple(each for part in found for each in part.joined),
        wholes=tuple(each for part in found for each in part.wholes),
        nodes=tuple(each for part in found for each in part.nodes),
    )


def _with_starts(found: Sequence[Found]) -> list[Found]:
    """Take what may be starts for such, but what others call."""
    if any(each.cut for each in found):  # who calls them may not have been followed
        return [replace(each, perhaps=()) for each in found]
    certain = frozenset(place for each in found for place in each.covered)
    perhaps = [pair for each in found for pair in each.perhaps]
    called = {
        place
        for place, mine in perhaps
        for start, other in perhaps
        if place in other.covered and start not in mine.covered
    }
    return [
        _joined([each, *(f for at, f in each.perhaps if at not in certain and at not in called)])
        for each in found
    ]


def _covered(world: RosWorld) -> frozenset[Place]:
    functions = (function.place for function in world.called.values())
    classes = (
        cls.place for instance in world.instances for cls in instance.mro if isinstance(cls, Class)
    )
    return frozenset((*functions, *classes))


def _sorted(found: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(sorted(dict.fromkeys(found), key=lambda d: (d.place, d.slug, d.message)))
