"""Child processes of the live tests: isolated, watched, and cleaned up by process group."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import IO

# For a hang, not for slowness: a busy machine may take ten times what an idle one does.
WATCHDOG_S = 240.0
LOOK_EVERY_S = 0.02
# What pybind11 makes of a KeyboardInterrupt in the middle of a conversion.
HIDDEN_INTERRUPT = 'RuntimeError: Unable to convert call argument'


def _hear_signals() -> None:
    """A job in the background ignores these, and so would every child."""
    for name in (signal.SIGINT, signal.SIGHUP, signal.SIGTERM):
        signal.signal(name, signal.SIG_DFL)


class Child:
    """A process whose output, stdout and stderr together, is read line by line."""

    def __init__(
        self, command: Sequence[str], env: Mapping[str, str], pass_fds: Sequence[int] = ()
    ) -> None:
        self.lines: list[str] = []
        self.process = subprocess.Popen(
            command,
            env={**env, 'PYTHONUNBUFFERED': '1'},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            pass_fds=pass_fds,
            start_new_session=True,
            preexec_fn=_hear_signals,
            text=True,
        )
        self._watchdog = threading.Timer(WATCHDOG_S, self._kill)
        self._watchdog.daemon = True
        self._watchdog.start()

    def close(self) -> None:
        """Kill what is left of the process and its children."""
        self._kill()
        self._watchdog.cancel()
        self._stdout.close()
        self.process.wait()

    def read_until(self, satisfied: Callable[[list[str]], bool]) -> list[str]:
        """
        Read output until ``satisfied`` holds of all lines so far.

        :raises AssertionError: when the process ends, or the watchdog ends it, before that.
        """
        while not satisfied(self.lines):
            line = self._stdout.readline()
            assert line, f'ended too early, having said:\n{"".join(self.lines)}'
            self.lines.append(line)
        return self.lines

    def wait_for(self, happened: Callable[[], bool]) -> None:
        """
        Wait until ``happened`` gives true, looking again and again.

        :raises AssertionError: when the process ends, or the watchdog ends it, before that.
        """
        while not happened():
            if self.process.poll() is not None:
                assert happened(), f'ended too early:\n{self.end()}\n{self.text}'
                return
            threading.Event().wait(LOOK_EVERY_S)

    def sleep(self, seconds: float) -> None:
        """Let the process run, to see what it does not do; one that ends meanwhile is no error."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(seconds)

    def end(self, signal_number: signal.Signals | None = None) -> int:
        """Send a signal if one is given, read the rest of the output, give the exit status."""
        if signal_number is not None:
            self.process.send_signal(signal_number)
        self.lines.extend(self._stdout)
        return self.process.wait()

    def end_well(self, signal_number: signal.Signals) -> None:
        """End a program that handles the signal; see that it does, unless rclpy is in its way."""
        status = self.end(signal_number)
        assert status == 0 or self.is_interrupted_in_rclpy, self.text

    @property
    def is_interrupted_in_rclpy(self) -> bool:
        """Whether the signal came while C code of rclpy made a message, which hides it."""
        return HIDDEN_INTERRUPT in self.text

    @property
    def text(self) -> str:
        return ''.join(self.lines)

    @property
    def _stdout(self) -> IO[str]:
        assert self.process.stdout is not None
        return self.process.stdout

    def _kill(self) -> None:
        """Kill whatever is left of the session that this process leads."""
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            return
