from robot_base import RobotBase


class Robot(RobotBase):
    def __init__(self):
        super().__init__('robot')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass
