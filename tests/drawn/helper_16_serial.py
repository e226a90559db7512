"""A fake serial port with the usual blocking read."""
import queue
import threading
import time
from typing import Optional


class FakeSerial:
    """Delivers a few NMEA-like lines after opening, then goes silent."""

    def __init__(self, device: str, lines: int = 20, period: float = 0.05) -> None:
        self.device = device
        self.is_open = True
        self._rx: 'queue.Queue[bytes]' = queue.Queue()
        self._feeder = threading.Thread(target=self._feed, args=(lines, period), daemon=True)
        self._feeder.start()

    def _feed(self, lines: int, period: float) -> None:
        for i in range(lines):
            self._rx.put(f'$FIX,{50.0 + i * 1e-5:.6f},{8.0 + i * 1e-5:.6f}\n'.encode())
            time.sleep(period)

    def readline(self, timeout: Optional[float] = None) -> bytes:
        """Next line; b'' after `timeout` or after `cancel_read`."""
        try:
            return self._rx.get(timeout=timeout)
        except queue.Empty:
            return b''

    def cancel_read(self) -> None:
        self._rx.put(b'')

    def close(self) -> None:
        self.is_open = False
