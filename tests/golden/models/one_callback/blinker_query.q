/*
there is no deadlock: some step is always possible
*/
A[] not deadlock

/*
blink can run
*/
E<> cb_running(0)

/*
group blinker_default is closed while blink runs
*/
A[] cb_running(0) imply group_closed[cb_group_table[0]]

/*
group blinker_default is always open to further threads
*/
A[] not group_closed[0]

/*
blink never starves: once a poll has seen it ready, it runs
*/
(executor.schedule_start and executor.ready_set_copy[0] and !cb_running(0)) --> cb_running(0)
