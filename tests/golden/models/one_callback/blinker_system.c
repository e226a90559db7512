// Processes of blinker; each number is a place in the tables of the declarations.
blink = Callback(0);
blinker_default = CallbackGroup(EXCLUSIVE, 0);
thread_0 = Thread(0);
executor = Executor();

system
    executor,
    thread_0,
    blinker_default,
    blink;
