import this_is_no_file_of_the_tree


class Robot(this_is_no_file_of_the_tree.Robot):
    def __init__(self):
        self.create_task(self)
