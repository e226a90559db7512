#!/usr/bin/env python3
"""
Does all that a release needs and that can be done without publishing anything.

``python -m release.check [DIR]``: DIR holds what ``make wheels`` made. Versions, dependencies and
the changelog agree; ``package.xml`` is what bloom accepts; twine accepts the files, auditwheel
the wheels; a wheel is built from the sources alone.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from xml.etree import ElementTree

import yaml
from packaging.requirements import Requirement

from release import audit
from release.sources import ROOT, build, unpacked
from release.targets import SYSTEMS, VERSIONS
from ros2cc_extract.version import __version__

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

WORK = ROOT / 'build' / 'check'
SCHEMA = 'PACKAGE_SCHEMA'
"""Names the file package_format3.xsd of REP 149, where it is at hand."""
NAMES = {
    'PyYAML': ('python3-yaml', 'pyyaml'),
    'Jinja2': ('python3-jinja2', 'jinja2'),
    'lark': ('python3-lark-parser', 'lark'),
    'rich': ('python3-rich', 'rich'),
    'tomli': (None, 'tomli'),
}
"""Of each dependency its key in rosdep, and its name in conda; of tomli rosdep knows nothing."""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('folder', type=Path, nargs='?', default=ROOT / 'dist')
    parser.add_argument(
        '--unreleased', action='store_true', help='the changelog may still say "Unreleased"'
    )
    args = parser.parse_args()
    folder = args.folder.resolve()
    checks: dict[str, Callable[[], Iterator[str]]] = {
        'versions agree': versions,
        'dependencies agree': dependencies,
        'package.xml is valid': package_xml,
        'the changelog has the version': lambda: changelog(unreleased=args.unreleased),
        'all wheels are there': lambda: absent(folder),
        'auditwheel': lambda: audited(folder),
        'twine': lambda: twine(folder),
        'a wheel from the sources alone': lambda: from_sources(folder),
    }
    failed = 0
    for name, check in checks.items():
        faults = list(check())
        failed += bool(faults)
        print(f'{"FAILED" if faults else "ok":8}{name}', *faults, sep='\n        ', flush=True)
    print(f'{len(checks) - failed} of {len(checks)} checks passed')
    return 1 if failed else 0


def package() -> ElementTree.Element:
    return ElementTree.parse(ROOT / 'package.xml').getroot()


def recipe() -> dict[str, object]:
    text = (ROOT / 'release/robostack/recipe.yaml').read_text(encoding='utf-8')
    loaded: dict[str, object] = yaml.safe_load(text)
    return loaded


def versions() -> Iterator[str]:
    said = {
        'package.xml': package().findtext('version'),
        'release/robostack/recipe.yaml': recipe()['context']['version'],  # type: ignore[index]
    }
    for place, version in said.items():
        if version != __version__:
            yield f'{place} says {version}, and version.py {__version__}'


def dependencies() -> Iterator[str]:
    """Hold ``package.xml`` and the recipe against ``pyproject.toml``."""
    text = (ROOT / 'pyproject.toml').read_text(encoding='utf-8')
    needed = [Requirement(line) for line in tomllib.loads(text)['project']['dependencies']]
    keys = {NAMES[each.name][0] for each in needed} - {None}
    told = {each.text for each in package().iter('exec_depend')}
    if keys != told:
        yield f'package.xml runs with {sorted(told)}, and pyproject.toml with {sorted(keys)}'
    run: list[object] = recipe()['requirements']['run']  # type: ignore[index]
    conda = {line['then'] if isinstance(line, dict) else line for line in run} - {'python'}
    wanted = {f'{NAMES[each.name][1]} {each.specifier}' for each in needed}
    if conda != wanted:
        yield f'the recipe runs with {sorted(conda)}, and pyproject.toml with {sorted(wanted)}'


def package_xml() -> Iterator[str]:
    from catkin_pkg.package import InvalidPackage, parse_package

    path = ROOT / 'package.xml'
    try:
        # Also raises what bloom would refuse.
        warnings: list[str] = []
        parse_package(str(path), warnings=warnings).validate(warnings)
        yield from warnings
    except InvalidPackage as error:
        yield str(error)
    schema = os.environ.get(SCHEMA)
    if schema:
        import xmlschema

        yield from (str(error.reason) for error in xmlschema.XMLSchema(schema).iter_errors(path))


def changelog(*, unreleased: bool = False) -> Iterator[str]:
    """Look for the section of this version; between releases the newest has another heading."""
    text = (ROOT / 'CHANGELOG.md').read_text(encoding='utf-8')
    newest = re.search(r'^## \[?([\w.]+)', text, re.MULTILINE)
    accepted = (__version__, 'Unreleased') if unreleased else (__version__,)
    if not newest or newest[1] not in accepted:
        yield f'the newest section of CHANGELOG.md is not "## {__version__}"'


def absent(folder: Path) -> Iterator[str]:
    names = [path.name for path in folder.glob('*')]
    if f'ros2cc_extract-{__version__}.tar.gz' not in names:
        yield 'no source distribution'
    for system in SYSTEMS:
        tag = system.tags[0]
        missing = [v for v in VERSIONS if not any(is_for(name, v, tag) for name in names)]
        if missing:
            yield f'{tag}: no wheel for CPython {", ".join(missing)}'


def is_for(name: str, version: str, tag: str) -> bool:
    start = f'ros2cc_extract-{__version__}-cp{version.replace(".", "")}-'
    return name.startswith(start) and tag in name


def audited(folder: Path) -> Iterator[str]:
    for wheel in sorted(folder.glob('*.whl')):
        yield from audit.faults(wheel)


def twine(folder: Path) -> Iterator[str]:
    files = [*folder.glob('*.whl'), *folder.glob('*.tar.gz')]
    command = [sys.executable, '-m', 'twine', 'check', '--strict', *files]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        yield done.stdout + done.stderr


def from_sources(folder: Path) -> Iterator[str]:
    """Build a wheel, native parts too, from the archive with nothing else at hand."""
    archive = folder / f'ros2cc_extract-{__version__}.tar.gz'
    if not archive.exists():
        yield 'no source distribution'
        return
    (WORK / 'wheel').mkdir(parents=True, exist_ok=True)
    for old in (WORK / 'wheel').iterdir():
        old.unlink()
    source = unpacked(archive, WORK / 'unpacked')
    wheel = build('wheel', source, WORK / 'wheel', native='required')
    yield from (f'{part} is not in {wheel.name}' for part in audit.missing(wheel))


if __name__ == '__main__':
    sys.exit(main())
