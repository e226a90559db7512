"""EffectLog: waits for what is outside of the program, and for what could not be followed."""
# live: no, the module tools is not there
import socket
import subprocess
import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from tools import make_door, watch


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.door = make_door()
        self.line = socket.socket()
        self.line.settimeout(2.0)
        self.open_line = socket.socket()
        self.names = {'a': 1}
        self.given, self.stopped = threading.Event(), threading.Event()
        watch(self.given)
        self.create_timer(1.0, self.ask_outside)
        self.create_timer(1.0, self.ask_unknown)
        self.create_timer(1.0, self.wait_for_others)

    def stop(self):
        self.stopped.set()

    def ask_outside(self):
        subprocess.run(['gcc'], timeout=3.0)
        self.line.recv(64)
        self.open_line.accept()
        input()
        child = subprocess.Popen(['cat'], stdout=subprocess.PIPE)
        child.stdout.readline()

    def ask_unknown(self):
        self.door.wait()
        self.door.join(timeout=2.0)
        self.door.acquire(blocking=False)
        self.door.get('key')
        self.names.get('a')
        ', '.join(self.door.words)

    def wait_for_others(self):
        self.given.wait()
        self.stopped.wait()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer ask_outside in a_default every 1
#     blocks subprocess.run 3.0 s @31
#     blocks socket.recv 2.0 s @32
#     blocks socket.accept @33
#     blocks input @34
#     blocks BufferedReader.readline @36
#   timer ask_unknown in a_default every 1
#     blocks unknown wait on ? @39
#       ended by ?
#     blocks unknown wait on ? 2.0 s @40
#       ended by ?
#     reads A.door @39
#     reads A.door @40
#     reads A.door @41
#     reads A.door item 'key' @42
#     reads A.names item 'a' @43
#     reads A.door @44
#   timer wait_for_others in a_default every 1
#     blocks Event.wait on given @47
#       ended by ?
#     blocks Event.wait on stopped @48
#       ended by ?
