/*
there is no deadlock: all that arrives can be served
*/
A[] (deadlock imply cb_all_served())

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
blink never starves: once something has arrived for it, it runs
*/
(cb_waiting[0] > 0 and !cb_running(0)) --> cb_running(0)

/*
blink never overlaps itself
*/
A[] cb_runs(0) <= 1

/*
no two callbacks ever run at the same time: groups and threads have no effect
*/
A[] forall (a : ThreadId) forall (b : ThreadId) (thread_running[a] and thread_running[b] imply a == b)
