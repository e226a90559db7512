"""Follows launch files that a test writes into a package."""

from __future__ import annotations

from pathlib import Path

from ros2cc_extract.extract.launch.api import Launch, launch
from ros2cc_extract.files import DISK
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.system.launched import Launched

HEAD = """\
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition, UnlessCondition
from launch.event_handlers import OnProcessExit, OnProcessStart
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import ComposableNode
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

def generate_launch_description():
"""


def package(folder: Path, name: str = 'robot') -> Path:
    """A package below ``folder``."""
    home = folder / name
    (home / 'launch').mkdir(parents=True, exist_ok=True)
    (home / 'package.xml').write_text(f'<package><name>{name}</name></package>')
    return home


def followed(folder: Path, text: str, name: str = 'a.launch.py', **arguments: str) -> Launch:
    """What a launch file starts; a Python one gets what it imports."""
    path = package(folder) / 'launch' / name
    path.write_text(HEAD + text if name.endswith('.py') else text)
    return launch(path, arguments, root=folder, files=DISK)


def told(process: Launched) -> str:
    """One line of the facts that most tests ask for."""
    words = [process.kind, *(str(each) for each in (process.package, process.executable) if each)]
    words += process.command
    facts = {'name': process.name, 'ns': process.namespace}
    words += [f'{key}={shown(value)}' for key, value in facts.items() if value is not None]
    words += map(str, process.remaps)
    words += [f'{each.name}={shown(each.value)}' for each in process.parameters]
    words += [f'?{fact}' for fact, _ in process.open]
    if process.conditional is not None:
        words.append('perhaps')
    if process.later:
        words.append(f'after {process.later}')
    return ' '.join(words)


def shown(value: object) -> str:
    """A value, and only that it is not known of others."""
    return '?' if isinstance(value, Unknown) else str(value)


def lines(found: Launch) -> list[str]:
    """All processes, one line each."""
    return [told(process) for process in found.processes]
