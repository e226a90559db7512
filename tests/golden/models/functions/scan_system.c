// Processes of scan; each number is a place in the tables of the declarations.
front_on_scan = Callback(0);
rear_on_scan = Callback(1);
tick_lambda = Callback(2);
scan_default = CallbackGroup(EXCLUSIVE, 0);
thread_0 = Thread(0);
executor = Executor();

system
    executor,
    thread_0,
    scan_default,
    front_on_scan,
    rear_on_scan,
    tick_lambda;
