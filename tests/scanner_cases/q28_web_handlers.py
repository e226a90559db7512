"""Point 28: handlers of a web server are called by it, later, in threads of its own."""
# live: no, nobody asks the web server

import threading

import rclpy
from flask import Flask
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import SetBool

app = Flask(__name__)
rclpy.init()
node = Node('panel')


def client_of(name):
    return node.create_client(SetBool, name)


@app.route('/light')
def light():
    return client_of('/light')


@app.route('/state')
def state():
    return 'on'


class Board:
    def __init__(self, server):
        @server.get('/watch')
        def watch():
            self.watch('lamp')

        server.add_url_rule('/door', view_func=self.door)

    def watch(self, topic):
        node.create_subscription(String, topic, self.on_msg, 10)

    def door(self):
        return client_of('/door')

    def on_msg(self, msg):
        pass


def tick():
    pass


def main():
    board = Board(app)
    node.create_timer(1.0, tick)
    threading.Thread(target=app.run, daemon=True).start()
    rclpy.spin(node)
    return board


if __name__ == '__main__':
    main()

# expect:
# unit panel: SingleThreadedExecutor x1 rclpy.spin, main
#   group panel_default EXCLUSIVE default
#   timer tick in panel_default every 1
#   subscription on_msg in panel_default key=lamp conditional when=later
#   client light_client in panel_default key=/light conditional when=later
#   client door_client in panel_default key=/door conditional when=later
#   activity thread run daemon UNRESOLVED
