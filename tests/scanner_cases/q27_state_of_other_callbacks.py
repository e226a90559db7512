"""Point 27: what a test in a callback reads, other callbacks may have changed, in any order."""

import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger

SETTINGS = {'loud': False}
STOPPED = False


class Shared:
    def __init__(self):
        self.ready = False


class Job:
    pass


class Worker(Node):
    def __init__(self):
        super().__init__('worker')
        self.client = self.create_client(Trigger, 'go')
        self.shared = Shared()
        self.modes = {'fast': False}
        self.names = set()
        self.job = None
        self.begin()
        told = False

        def speak():
            if told:
                time.sleep(0.01)

        def hear(msg):
            nonlocal told
            told = True

        self.create_timer(1.0, speak)
        self.create_timer(2.0, self.look)
        self.create_timer(3.0, self.begin)
        self.create_subscription(String, 'heard', hear, 10)
        self.create_subscription(String, 'order', self.on_order, 10)

    def begin(self):
        if self.job is not None:
            raise RuntimeError('busy')
        self.job = Job()
        time.sleep(0.02)
        self.client.call_async(Trigger.Request()).add_done_callback(self.done)

    def done(self, future):
        self.job = None

    def look(self):
        if self.shared.ready:
            time.sleep(0.03)
        if self.modes['fast'] or SETTINGS['loud']:
            time.sleep(0.04)
        if 'ann' in self.names:
            time.sleep(0.05)
        if STOPPED:
            time.sleep(0.06)
        idle = self.job is None
        if idle:
            time.sleep(0.07)
        time.sleep(0.08 if self.client is None else 0.09)

    def on_order(self, msg):
        global STOPPED
        STOPPED = True
        SETTINGS['loud'] = True
        self.shared.ready = True
        self.modes['fast'] = True
        self.names.add(msg.data)


def main():
    rclpy.init()
    rclpy.spin(Worker())


if __name__ == '__main__':
    main()

# expect:
# unit worker: SingleThreadedExecutor x1 rclpy.spin, main
#   group worker_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   timer speak in worker_default every 1
#     blocks time.sleep conditional 0.01 s @36
#     reads Worker.__init__.told @35
#   timer look in worker_default every 2
#     blocks time.sleep conditional 0.03 s @60
#     blocks time.sleep conditional 0.04 s @62
#     blocks time.sleep conditional 0.05 s @64
#     blocks time.sleep conditional 0.06 s @66
#     blocks time.sleep conditional 0.07 s @69
#     blocks time.sleep 0.09 s @70
#     reads Worker.shared @59
#     reads Shared.ready @59
#     reads Worker.modes item 'fast' @61
#     reads q27_state_of_other_callbacks.SETTINGS item 'loud' @61
#     reads Worker.names @63
#     reads q27_state_of_other_callbacks.STOPPED @65
#     reads Worker.job @67
#   timer begin in worker_default every 3
#     blocks time.sleep 0.02 s @52
#     reads Worker.job @49
#     writes Worker.job rests under Worker.job (flag) @51
#     changes done_callback @53
#   subscription hear in worker_default key=heard
#     writes Worker.__init__.told @40
#   subscription on_order in worker_default key=order
#     reads q27_state_of_other_callbacks.SETTINGS item 'loud' @75
#     reads Worker.shared @76
#     reads Worker.modes item 'fast' @77
#     writes q27_state_of_other_callbacks.STOPPED @74
#     writes q27_state_of_other_callbacks.SETTINGS update in_place keeps_size item 'loud' @75
#     writes Shared.ready @76
#     writes Worker.modes update in_place keeps_size item 'fast' @77
#     writes Worker.names update in_place @78
#   client go_client in worker_default key=go
#   done_callback done in no_group key=go
#     writes Worker.job clears @56
