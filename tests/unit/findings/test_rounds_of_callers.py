"""CC301: what a loop of a caller reads in its next round is not read back by the round before."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

READER = """
import threading
import time
import rclpy
import scans
from rclpy.node import Node
from std_msgs.msg import String


class Source:
    def __init__(self, device):
        self.device = device

    def collect(self, callback):
        while True:
            try:
                for packet in self.device:
                    {each}
            except Exception as error:
                {handler}


class Depth(Node):
    def __init__(self):
        super().__init__('depth')
        self.key = None
        self.create_subscription(String, 'key', self.on_key, 10)
        self.source = Source(scans.open())
        threading.Thread(target=self.source.collect, args=(self.on_packet,)).start()

    def on_key(self, msg):
        self.store(msg.data)

    def store(self, key):
        self.key = key

    def on_packet(self, packet):
        {packet}

    def rest(self):
        time.sleep(0.05)
        if self.key is not None:
            print('stored')


rclpy.init()
rclpy.spin(Depth())
"""
APART = """if isinstance(packet, Exception):
            self.store('again')
            return
        self.rest()"""
ALSO = """if packet.is_first():
            self.store('first')
        else:
            self.rest()"""
IN_A_ROW = """if packet.is_first():
            self.store('first')
        self.rest()"""
CALL = 'callback(packet)'


def _read_back(each: str, packet: str, handler: str = 'print(error)') -> list[str]:
    text = READER.format(each=each, packet=packet, handler=handler)
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    return [f.message for f in found if 'waits and reads' in f.message]


@pytest.mark.parametrize(
    ('each', 'packet'),
    [
        (CALL, APART),
        (f'if packet.complete():\n                        {CALL}', APART),
        (CALL, ALSO),
    ],
)
def test_the_next_round_of_a_caller_is_another_run(each: str, packet: str) -> None:
    assert not _read_back(each, packet.replace('isinstance(packet, Exception)', 'not packet'))


def test_a_caught_exception_is_one() -> None:
    assert not _read_back(CALL, APART, 'callback(error)')
    assert _read_back(CALL, APART.replace('Exception', 'KeyError'), 'callback(error)')
    assert _read_back(CALL, ALSO, 'callback(error)')


@pytest.mark.parametrize(
    ('imports', 'is_said'),
    [('import scans', False), ('import scans\nfrom scans import OSError', True)],
)
def test_a_name_may_stand_for_another_exception(imports: str, is_said: bool) -> None:
    text = READER.replace('import scans', imports).replace('Exception as', 'OSError as')
    handled = text.format(each=CALL, packet=APART, handler='callback(error)')
    units = scan_text(handled).units
    found = findings_of(units, [], [None] * len(units))
    assert any('waits and reads' in each.message for each in found) == is_said


@pytest.mark.parametrize(
    ('each', 'packet'),
    [
        (CALL, IN_A_ROW),
        (f'{CALL}\n                    callback(packet.tail())', ALSO),
    ],
)
def test_one_round_reads_back_what_it_has_stored(each: str, packet: str) -> None:
    assert _read_back(each, packet)
