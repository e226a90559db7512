"""CC109: the end of a child process is waited for while nobody reads what it writes."""

from __future__ import annotations

from pathlib import Path

import pytest
from finding_units import found, only

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.spec.model import Spec

NODE = """
import subprocess, threading
from subprocess import PIPE, Popen
import rclpy
from rclpy.node import Node

class Dumps(Node):
    def __init__(self):
        super().__init__('dumps')
        self.child = None
        self.create_timer(1.0, self.tick)

    def dump(self, child):
        {do}

    def read(self, stream):
        stream.read()

    def tick(self):
        self.child = {made}
        self.dump(self.child)

rclpy.init()
rclpy.spin(Dumps())
"""
WAIT = 'child.wait()'
PIPED = "Popen(['dump'], stdout=subprocess.PIPE)"


def scanned(do: str, made: str, folder: Path) -> Spec:
    path = folder / 'dumps.py'
    path.write_text(NODE.format(do=do, made=made), encoding='utf-8')
    (spec,) = scan([path], root=folder).units
    return spec


@pytest.mark.parametrize(
    ('do', 'made', 'expected'),
    [
        (WAIT, PIPED, ['CC109:14 warning']),
        (WAIT, "Popen(['dump'], stderr=PIPE)", ['CC109:14 warning']),
        (WAIT, "Popen(['dump'], -1, None, None, PIPE)", ['CC109:14 warning']),
        ('child.wait(); child.stdout.read()', PIPED, ['CC109:14 warning']),
        ('child.wait(timeout=0.5)', PIPED, []),
        ('child.communicate()', PIPED, ['CC121:14 note']),
        ('child.stdout.read(); child.wait()', PIPED, ['CC121:14 note', 'CC121:14 note']),
        (
            'threading.Thread(target=self.read, args=(child.stdout,)).start(); child.wait()',
            PIPED,
            ['CC121:14 note', 'CC121:17 note'],
        ),
        (
            'threading.Thread(target=lambda: child.stdout.read()).start(); child.wait()',
            PIPED,
            ['CC121:14 note', 'CC121:14 note'],
        ),
        (WAIT, "Popen(['dump'], stdout=subprocess.DEVNULL)", ['CC121:14 note']),
        (WAIT, "Popen(['dump'], stdout=open('log'))", ['CC121:14 note']),
        (WAIT, "Popen(['dump'])", ['CC121:14 note']),
    ],
)
def test_who_waits_for_a_child_reads_its_pipe(
    do: str, made: str, expected: list[str], tmp_path: Path
) -> None:
    told = found(scanned(do, made, tmp_path))
    assert [code for code in told if code.startswith('CC1')] == expected


def test_message(tmp_path: Path) -> None:
    finding = only(scanned(WAIT, PIPED, tmp_path), 'CC109')
    assert finding.message == (
        'Dumps.tick waits in Popen.wait for a child process while nothing reads the pipe of its '
        'stdout: once the pipe is full, the child waits for a reader, and it waits forever'
    )
    assert [remark.text for remark in finding.related] == []
