"""Where units come from: Python sources are scanned, YAML files are read."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TextIO

from ros2cc_extract.deadline import PATIENT, Patience
from ros2cc_extract.diagnostics import BARRED, UNREAD, Diagnostic, Severity
from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.program.given_parameters import NONE_GIVEN, GivenParameters
from ros2cc_extract.files import DISK, Files, read_named, read_stream, real_path
from ros2cc_extract.pipeline.progress import bar
from ros2cc_extract.source_locations import Place, shown_name
from ros2cc_extract.spec.model import Spec

SPEC_SUFFIXES = ('.yaml', '.yml')
FOREIGN_SUFFIXES = (
    '.c',
    '.cc',
    '.cpp',
    '.h',
    '.hpp',
    '.json',
    '.jsonl',
    '.md',
    '.txt',
    '.toml',
    '.xml',
)
"""Suffixes of files that are not meant as Python, though one of plain words would parse."""
STANDARD_INPUT = Path('-')
MOST_BYTES = 64_000_000
RECORDING_SUFFIX = '.json'
NOT_FOLLOWED = 'not-followed'
"""Slug of what may hide callbacks and stands in no unit."""


def scan_sources(
    paths: Sequence[Path],
    stderr: TextIO,
    *,
    cached: bool = True,
    lists_builtin: bool = False,
    parameters: GivenParameters = NONE_GIVEN,
    files: Files = DISK,
    patience: Patience = PATIENT,
) -> Extraction:
    """
    Scan Python files and directories, with progress.

    :param cached: take an earlier result when no file has changed since.
    :param lists_builtin: also list what rclpy makes by itself for every node.
    :param parameters: what a launch sets for the nodes.
    :param files: those of the disk, or of another revision.

    Nodes without any callback, such as those that only publish, are reported and left out: neither
    the published format nor a model has a place for them.
    """
    from ros2cc_extract.extract.static.api import scan

    for path in paths:
        _refuse_foreign(path, files)
    folder = _cache_folder(stderr) if cached else None
    with bar(stderr, 'reading') as meter:
        extraction = scan(
            paths,
            progress=meter.step,
            cache=folder,
            lists_builtin=lists_builtin,
            parameters=parameters,
            files=files,
            patience=patience,
        )
    left_out = [unit for unit in extraction.units if not unit.callbacks]
    for unit in left_out:
        known = ' known' if _missing(unit) else ''
        print(f'{_where(unit)}: unit {unit.name} has no{known} callback, left out', file=stderr)
    return replace(
        extraction,
        units=tuple(unit for unit in extraction.units if unit.callbacks),
        idle=tuple(left_out),
        diagnostics=(*extraction.diagnostics, *(d for unit in left_out for d in _missing(unit))),
    )


def _cache_folder(stderr: TextIO) -> Path | None:
    """Where earlier results are kept; nothing is read from where others could have put it."""
    from ros2cc_extract.cache_file import default_cache_folder, who_can_change

    folder = default_cache_folder()
    others = who_can_change(folder) if folder is not None else None
    if others is not None:
        words = f'{folder}: not used as a cache, as other users can change {others}'
        print(f'{words}; let XDG_CACHE_HOME name a folder that is yours alone', file=stderr)
        return None
    return folder


def _refuse_foreign(path: Path, files: Files) -> None:
    """
    Ask again about a file that its name says to be no Python; scripts need not end in ``.py``.

    :raises InputError: then.
    """
    suffix = path.suffix.lower()
    if suffix not in (*SPEC_SUFFIXES, *FOREIGN_SUFFIXES):
        return
    if files.is_folder(path) or not files.exists(path):
        return
    if suffix in SPEC_SUFFIXES:
        raise InputError(
            'is a specification, and no Python', Place(str(path)), f'`verify {path}` reads it'
        )
    raise InputError('is no Python file by its name', Place(str(path)), 'name a node or a folder')


def _missing(unit: Spec) -> list[Diagnostic]:
    """Why a unit without callbacks may have some all the same: as open as any other fact."""
    return [
        Diagnostic(
            severity=Severity.NOTE,
            slug=NOT_FOLLOWED,
            place=fact.source,
            message=f'{fact.reason}: unit {unit.name} is left out, and may have callbacks',
            help='check what it names too, or observe the node by ros2cc-extract run',
        )
        for fact in unit.unresolved
        if fact.fact == 'entities' and fact.source is not None
    ]


def _where(unit: Spec) -> str:
    return str(unit.executor.source or (unit.sources[0] if unit.sources else unit.entry or '?'))


def load_units(path: Path, stderr: TextIO, *, lists_builtin: bool = False) -> tuple[Spec, ...]:
    """
    Read a YAML file or a recording of the live hook, or scan anything else as source.

    What comes through a pipe, ``-`` or one without a suffix in its name, is YAML.

    :param lists_builtin: of source also list what rclpy makes by itself.
    :raises InputError: when there is no unit in it.
    """
    if path == STANDARD_INPUT:
        from ros2cc_extract.spec.yaml.yaml_io import read_specs

        return read_specs(_read_standard_input(), '<stdin>')
    if path.suffix in SPEC_SUFFIXES or (not path.suffix and path.is_fifo()):
        from ros2cc_extract.spec.yaml.yaml_io import load_specs

        return load_specs(path)
    if path.suffix == RECORDING_SUFFIX:
        from ros2cc_extract.extract.live.recordings.collect import specs_of
        from ros2cc_extract.extract.live.recordings.recording import read_recording

        return specs_of(read_recording(path, Path.cwd()))
    extraction = scan_sources([path], stderr, lists_builtin=lists_builtin)
    print_diagnostics(extraction.diagnostics, stderr)
    if not extraction.units:
        raise InputError('no rclpy node found', Place(str(path)), 'nothing to model')
    return extraction.units


def _read_standard_input() -> str:
    try:
        return read_stream(sys.stdin.buffer, MOST_BYTES, '<stdin>').decode('utf-8')
    except UnicodeDecodeError as error:
        raise InputError(f'no UTF-8 text (byte {error.start})', Place('<stdin>')) from None


def read_input(path: Path) -> str:
    """
    Read a text file that the user named.

    :raises InputError: when it is not there, or no text.
    """
    try:
        return read_named(path, MOST_BYTES).decode('utf-8')
    except UnicodeDecodeError:
        raise InputError('no UTF-8 text', Place(str(path))) from None


def print_diagnostics(diagnostics: Sequence[Diagnostic], stderr: TextIO) -> None:
    """Print what the scan noticed, one line each."""
    for diagnostic in diagnostics:
        mend = f'; {diagnostic.help}' if diagnostic.help else ''
        line = f'{diagnostic.place}: {diagnostic.severity.value}: {diagnostic.message}{mend}'
        print(line, file=stderr)


def has_unread(diagnostics: Sequence[Diagnostic]) -> bool:
    """True when a file could not be read or parsed."""
    return any(diagnostic.slug in UNREAD for diagnostic in diagnostics)


def has_barred(diagnostics: Sequence[Diagnostic]) -> bool:
    """True when the system did not let us read a file, or look into a folder."""
    return any(diagnostic.slug in BARRED for diagnostic in diagnostics)


def nothing_read(paths: Sequence[Path], extraction: Extraction) -> bool:
    """True when nothing of what one of ``paths`` names could be read: no file, or none at all."""
    unread = {d.place.file for d in extraction.diagnostics if d.slug in UNREAD}
    if not unread:
        return False
    seen = {file: real_path(file) for file in {*extraction.files_seen, *unread}}
    for path in paths:
        whole = real_path(shown_name(str(path)))
        mine = {file for file, at in seen.items() if whole in (at, *at.parents)}
        if mine and mine <= unread:
            return True
    return False
