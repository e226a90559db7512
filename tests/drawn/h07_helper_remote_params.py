import time

from rclpy.parameter import parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient


class RemoteParams:
    """Read parameters of another node."""

    POLL = 0.02

    def __init__(self, node, remote_name, callback_group=None):
        self._log = node.get_logger()
        self._client = AsyncParameterClient(
            node, remote_name, callback_group=callback_group)

    def available(self, timeout_sec):
        return self._client.wait_for_services(timeout_sec)

    def fetch(self, names):
        future = self._client.get_parameters(names)
        while not future.done():
            time.sleep(self.POLL)
        values = [parameter_value_to_python(v) for v in future.result().values]
        self._log.info('read %s' % ', '.join(names))
        return dict(zip(names, values))
