"""Stand-ins for the mobile base: mode register and a gate around it."""
import enum
import threading


class BaseMode(enum.Enum):
    NAVIGATION = 'navigation'
    POSITION = 'position'


class ModeGate:
    """Serialises users of the mode register."""

    def __init__(self) -> None:
        self._mutex = threading.Lock()
        self.mode = BaseMode.NAVIGATION

    def begin(self) -> BaseMode:
        self._mutex.acquire()
        return self.mode

    def end(self) -> None:
        self._mutex.release()

    def __enter__(self) -> 'ModeGate':
        self.begin()
        return self

    def __exit__(self, *exc) -> None:
        self.end()


class WheelBase:
    def __init__(self) -> None:
        self.v = 0.0
        self.w = 0.0

    def drive(self, v: float, w: float) -> None:
        self.v, self.w = v, w

    def stop(self) -> None:
        self.drive(0.0, 0.0)
