"""Web gateway: the dashboard reads the RFID tags seen by the gate over HTTP."""
import http.client
import json
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class GateSimulator(Node):
    """Publishes the tags which pass under the antenna."""

    def __init__(self):
        super().__init__('gate_simulator')
        self.count = 0
        self.pub = self.create_publisher(String, 'gate/tags', 50)
        self.create_timer(0.01, self.tick)

    def tick(self):
        self.count += 1
        self.pub.publish(String(data='TAG-%06d' % self.count))


class TagGateway(Node):
    def __init__(self):
        super().__init__('tag_gateway')
        self.declare_parameter('keep_seconds', 2.0)
        self.keep = self.get_parameter('keep_seconds').value
        self.lock = threading.Lock()
        self.seen = {}
        self.create_subscription(String, 'gate/tags', self.on_tag, 50)
        self.create_timer(0.5, self.expire)

    def on_tag(self, msg):
        with self.lock:
            self.seen[msg.data] = time.monotonic()

    def expire(self):
        limit = time.monotonic() - self.keep
        with self.lock:
            for tag in [t for t, stamp in self.seen.items() if stamp < limit]:
                del self.seen[tag]

    def snapshot(self):
        with self.lock:
            return dict(self.seen)


class Handler(BaseHTTPRequestHandler):
    def do_GET(self):
        gateway = self.server.gateway
        self.send_response(200)
        self.send_header('Content-Type', 'application/x-ndjson')
        self.end_headers()
        now = time.monotonic()
        for tag, stamp in gateway.snapshot().items():
            row = {'tag': tag, 'age': round(now - stamp, 3)}
            self.wfile.write(json.dumps(row).encode() + b'\n')

    def log_message(self, fmt, *args):
        pass


def serve(gateway):
    server = ThreadingHTTPServer(('127.0.0.1', 0), Handler)
    server.gateway = gateway
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


def dashboard(port, node, rounds=25):
    """What the browser does: ask for the table again and again."""
    for _ in range(rounds):
        time.sleep(0.2)
        conn = http.client.HTTPConnection('127.0.0.1', port, timeout=5)
        conn.request('GET', '/tags')
        rows = conn.getresponse().read().splitlines()
        conn.close()
        node.get_logger().info('table with %d rows' % len(rows))


def spin(executor):
    try:
        executor.spin()
    except ExternalShutdownException:
        pass


def main():
    rclpy.init()
    gateway = TagGateway()
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(gateway)
    executor.add_node(GateSimulator())
    spinner = threading.Thread(target=spin, args=(executor,))
    spinner.start()
    server = serve(gateway)
    dashboard(server.server_address[1], gateway)
    server.shutdown()
    rclpy.shutdown()
    spinner.join()


if __name__ == '__main__':
    main()
