// Processes of arm; each number is a place in the tables of the declarations.
home = Callback(0);
plan_reply = Callback(1);
on_joint = Callback(2);
watchdog = Callback(3);
motion = CallbackGroup(EXCLUSIVE, 0);
replies = CallbackGroup(REENTRANT, 1);
thread_0 = Thread(0);
thread_1 = Thread(1);
executor = Executor();

system
    executor,
    thread_0,
    thread_1,
    motion,
    replies,
    home,
    plan_reply,
    on_joint,
    watchdog;
