"""
Names of the calls that wait for what is outside of the program: processes, sockets, ports, people.

Sources: CPython 3.12, ``subprocess.py``, ``socket``, ``select``, ``urllib/request.py``; pyserial
3.5, ``serial/serialutil.py``; requests 2.32, ``api.py``; OpenCV 4, ``waitKey`` and ``videoio``.
What each does stands in ``outside_calls.py``.
"""

from __future__ import annotations

from ros2cc_extract.light_dataclasses import dataclass

WAIT_KEY = 'cv2.waitKey'


@dataclass(frozen=True)
class OutsideRow:
    """
    One call that waits.

    :param position: where its time-out may stand; by name it is ``timeout`` everywhere.
    :param takes_limit: it keeps to the time-out of its object.
    """

    position: int | None = None
    takes_limit: bool = False


_BY_NAME = OutsideRow()

OF_CHILDREN = frozenset(['os.wait', 'os.waitpid'])
"""Waits for the end of a child of this process."""

_LIMITED = OutsideRow(takes_limit=True)

FUNCTIONS: dict[str, OutsideRow] = {
    'subprocess.run': _BY_NAME,
    'subprocess.call': _BY_NAME,
    'subprocess.check_call': _BY_NAME,
    'subprocess.check_output': _BY_NAME,
    'subprocess.getoutput': _BY_NAME,
    'subprocess.getstatusoutput': _BY_NAME,
    'os.system': _BY_NAME,
    'os.read': _BY_NAME,
    'os.wait': _BY_NAME,
    'os.waitpid': _BY_NAME,
    'builtins.input': _BY_NAME,
    'sys.stdin.read': _BY_NAME,
    'sys.stdin.readline': _BY_NAME,
    'sys.stdin.readlines': _BY_NAME,
    'select.select': OutsideRow(3),
    'signal.pause': _BY_NAME,
    'signal.sigwait': _BY_NAME,
    'socket.create_connection': OutsideRow(1),
    'urllib.request.urlopen': OutsideRow(2),
    'requests.request': _BY_NAME,
    'requests.get': _BY_NAME,
    'requests.post': _BY_NAME,
    'requests.put': _BY_NAME,
    'requests.patch': _BY_NAME,
    'requests.delete': _BY_NAME,
    'requests.head': _BY_NAME,
}

_RECEIVES = ('accept', 'recv', 'recv_into', 'recvfrom', 'recvfrom_into', 'recvmsg')
SENDS_OF_SOCKETS = ('connect', 'send', 'sendall', 'sendmsg', 'sendfile')
"""Once its buffers are full, a stream sends only as fast as its peer reads; a datagram goes."""
_SOCKET = dict.fromkeys((*_RECEIVES, *SENDS_OF_SOCKETS), _LIMITED)

_SERIAL = dict.fromkeys(('read', 'read_until', 'readline', 'readlines', 'readinto'), _LIMITED)

_REQUESTS = dict.fromkeys(('get', 'post', 'put', 'patch', 'delete', 'head', 'request'), _BY_NAME)

# What another program writes (``subprocess.py``, ``Popen.__init__``).
STREAM = 'io.BufferedReader'

_READS = dict.fromkeys(('read', 'read1', 'readinto', 'readline', 'readlines'), _BY_NAME)

CLASSES: dict[str, dict[str, OutsideRow]] = {
    'subprocess.Popen': {'wait': OutsideRow(0), 'communicate': OutsideRow(1)},
    STREAM: _READS,
    'socket.socket': _SOCKET,
    'serial.Serial': _SERIAL,
    'requests.Session': _REQUESTS,
    'selectors.DefaultSelector': {'select': OutsideRow(0)},
}

FRAMES = 'pipeline.wait_for_frames'
READS_OF_CAMERAS = frozenset({'VideoCapture.read', 'VideoCapture.grab', FRAMES})
"""They wait for the next frame, and end by themselves where none comes."""

CALLS = frozenset(
    [
        WAIT_KEY,
        *(name.removeprefix('builtins.') for name in FUNCTIONS),
        *(f'{name.rpartition(".")[2]}.{method}' for name, of in CLASSES.items() for method in of),
    ]
)
"""How these waits are called in a specification."""
