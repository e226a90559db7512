"""Stand-in for a slow flash memory."""
import time
from typing import Dict


class FlashStore:
    BLOCK = 64
    BLOCK_TIME = 0.1

    def __init__(self) -> None:
        self._files: Dict[str, bytes] = {}

    def save(self, name: str, data: bytes) -> int:
        written = b''
        for start in range(0, len(data), self.BLOCK):
            written += self._write_block(data[start:start + self.BLOCK])
        self._files[name] = written
        return len(written)

    def _write_block(self, block: bytes) -> bytes:
        time.sleep(self.BLOCK_TIME)
        return block
