/*
there is no deadlock: all that arrives can be served
*/
A[] (deadlock imply cb_all_served())

/*
TMR1 can run
*/
E<> cb_running(0)

/*
TMR2 can run
*/
E<> cb_running(1)

/*
SUB1 can run
*/
E<> cb_running(2)

/*
SUB2 can run
*/
E<> cb_running(3)

/*
TMR1 and TMR2 never run at the same time
*/
A[] not (cb_running(0) and cb_running(1))

/*
TMR1 and SUB1 never run at the same time
*/
A[] not (cb_running(0) and cb_running(2))

/*
TMR1 and SUB2 never run at the same time
*/
A[] not (cb_running(0) and cb_running(3))

/*
TMR2 and SUB1 never run at the same time
*/
A[] not (cb_running(1) and cb_running(2))

/*
TMR2 and SUB2 never run at the same time
*/
A[] not (cb_running(1) and cb_running(3))

/*
SUB1 and SUB2 never run at the same time
*/
A[] not (cb_running(2) and cb_running(3))

/*
group ME is closed while TMR1 runs
*/
A[] cb_running(0) imply group_closed[cb_group_table[0]]

/*
group ME is closed while TMR2 runs
*/
A[] cb_running(1) imply group_closed[cb_group_table[1]]

/*
group ME is closed while SUB1 runs
*/
A[] cb_running(2) imply group_closed[cb_group_table[2]]

/*
group ME is closed while SUB2 runs
*/
A[] cb_running(3) imply group_closed[cb_group_table[3]]

/*
TMR1 and TMR2 can run at the same time
*/
E<> (cb_running(0) and cb_running(1))

/*
TMR1 and SUB1 can run at the same time
*/
E<> (cb_running(0) and cb_running(2))

/*
TMR1 and SUB2 can run at the same time
*/
E<> (cb_running(0) and cb_running(3))

/*
TMR2 and SUB1 can run at the same time
*/
E<> (cb_running(1) and cb_running(2))

/*
TMR2 and SUB2 can run at the same time
*/
E<> (cb_running(1) and cb_running(3))

/*
SUB1 and SUB2 can run at the same time
*/
E<> (cb_running(2) and cb_running(3))

/*
group ME is always open to further threads
*/
A[] not group_closed[0]

/*
TMR1 never starves: once something has arrived for it, it runs
*/
(cb_waiting[0] > 0 and !cb_running(0)) --> cb_running(0)

/*
TMR2 never starves: once something has arrived for it, it runs
*/
(cb_waiting[1] > 0 and !cb_running(1)) --> cb_running(1)

/*
SUB1 never starves: once something has arrived for it, it runs
*/
(cb_waiting[2] > 0 and !cb_running(2)) --> cb_running(2)

/*
SUB2 never starves: once something has arrived for it, it runs
*/
(cb_waiting[3] > 0 and !cb_running(3)) --> cb_running(3)

/*
TMR1 never overlaps itself
*/
A[] cb_runs(0) <= 1

/*
TMR2 never overlaps itself
*/
A[] cb_runs(1) <= 1

/*
SUB1 never overlaps itself
*/
A[] cb_runs(2) <= 1

/*
SUB2 never overlaps itself
*/
A[] cb_runs(3) <= 1

/*
no two callbacks ever run at the same time: groups and threads have no effect
*/
A[] forall (a : ThreadId) forall (b : ThreadId) (thread_running[a] and thread_running[b] imply a == b)
