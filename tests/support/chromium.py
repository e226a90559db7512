"""A page in a headless Chromium, driven by its DevTools protocol over two pipes."""

from __future__ import annotations

import base64
import fcntl
import json
import os
import select
import shutil
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

CHROMIUM = shutil.which('chromium') or shutil.which('chromium-browser')
FLAGS = (
    '--headless',
    '--no-sandbox',
    '--disable-gpu',
    '--disable-quic',
    '--disable-dev-shm-usage',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
    '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1',  # nothing from the net
    '--remote-debugging-pipe',
)
ANSWER_S = 30.0
# Chromium reads commands at 3 and answers at 4: the ends of the pipes are put there from above.
LOWEST = 10


class Page:
    """
    One tab.

    :param commands: what Chromium reads; ``answers`` is what it writes.
    """

    def __init__(self, commands: int, answers: int) -> None:
        self._commands, self._answers, self._rest = commands, answers, b''
        self._number, self._session = 0, ''
        target = self.ask('Target.createTarget', url='about:blank')['targetId']
        asked = self.ask('Target.attachToTarget', targetId=target, flatten=True)
        self._session = asked['sessionId']

    def ask(self, method: str, **parameters: Any) -> Any:
        """Send one command and give what comes of it."""
        self._number += 1
        message: dict[str, Any] = {'id': self._number, 'method': method, 'params': parameters}
        if self._session:
            message['sessionId'] = self._session
        os.write(self._commands, json.dumps(message).encode() + b'\0')
        end = time.monotonic() + ANSWER_S
        while True:
            heard = self._next(end)
            if heard.get('id') == self._number:
                return heard.get('result') or heard

    def _next(self, end: float) -> dict[str, Any]:
        while b'\0' not in self._rest:
            if not select.select([self._answers], [], [], max(0.0, end - time.monotonic()))[0]:
                raise TimeoutError('Chromium does not answer')
            self._rest += os.read(self._answers, 1 << 16) or b'{"id": -1}\0'
        message, self._rest = self._rest.split(b'\0', 1)
        return dict(json.loads(message))

    def value(self, script: str) -> Any:
        """Evaluate a script in the page."""
        asked = self.ask('Runtime.evaluate', expression=script, returnByValue=True)
        return asked['result'].get('value')

    def wait(self, script: str, seconds: float) -> None:
        """Wait until a script is true."""
        end = time.monotonic() + seconds
        while not self.value(script):
            assert time.monotonic() < end, f'{script} is not true after {seconds} s'
            time.sleep(0.1)

    def picture(self, path: Path, width: int, height: int) -> None:
        """Look at the page at a size."""
        size = {'width': width, 'height': height, 'deviceScaleFactor': 1, 'mobile': width < 600}
        self.ask('Emulation.setDeviceMetricsOverride', **size)
        time.sleep(0.5)
        shot = self.ask('Page.captureScreenshot', format='png')
        path.write_bytes(base64.b64decode(shot['data']))


@contextmanager
def opened(profile: Path) -> Iterator[Page]:
    """Start Chromium with a profile of its own, and end it."""
    read_by_it, commands = os.pipe()
    answers, written_by_it = os.pipe()
    high = [fcntl.fcntl(end, fcntl.F_DUPFD, LOWEST) for end in (read_by_it, written_by_it)]
    given = [(os.POSIX_SPAWN_DUP2, end, to) for to, end in zip((3, 4), high, strict=True)]
    quiet = [(os.POSIX_SPAWN_OPEN, end, os.devnull, os.O_RDWR, 0) for end in (0, 1, 2)]
    command = [str(CHROMIUM), *FLAGS, f'--user-data-dir={profile}']
    process = os.posix_spawn(
        command[0], command, os.environ, file_actions=[*given, *quiet], setpgroup=0
    )
    for end in (*high, read_by_it, written_by_it):
        os.close(end)
    try:
        yield Page(commands, answers)
    finally:
        os.killpg(process, signal.SIGKILL)  # with all that it started
        os.waitpid(process, 0)
        os.close(commands)
        os.close(answers)
