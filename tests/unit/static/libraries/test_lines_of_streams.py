"""A loop over a stream waits for each of its lines."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import subprocess
import sys
import rclpy
import serial
from rclpy.node import Node

class Reader(Node):
    def __init__(self):
        super().__init__('reader')
        self.port = serial.Serial('/dev/ttyUSB0')
        self.child = subprocess.Popen(['tail', '-f', 'log'], stdout=subprocess.PIPE)
        self.lines = ['one', 'two']
        self.create_timer(1.0, self.read)

    def read(self):
        for line in {}:
            print(line)

rclpy.init()
rclpy.spin(Reader())
"""


@pytest.mark.parametrize(
    ('stream', 'calls'),
    [
        ('self.port', ['Serial.readline']),
        ('self.child.stdout', ['BufferedReader.readline']),
        ('sys.stdin', ['sys.stdin.readline']),
        ('self.lines', []),
        ('open("log")', []),
    ],
)
def test_who_goes_over_a_stream_reads_its_lines(stream: str, calls: list[str]) -> None:
    (unit,) = scan_text(PROGRAM.format(stream)).units
    read = next(each for each in unit.callbacks if each.name == 'read')
    assert [block.call for block in read.blocking] == calls
