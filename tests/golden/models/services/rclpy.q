/*
there is no deadlock: all that arrives can be served
*/
A[] (deadlock imply cb_all_served())

/*
home can run
*/
E<> cb_running(0)

/*
plan_reply can run
*/
E<> cb_running(1)

/*
on_joint can run
*/
E<> cb_running(2)

/*
watchdog can run
*/
E<> cb_running(3)

/*
home and plan_reply never run at the same time
*/
A[] not (cb_running(0) and cb_running(1))

/*
home and on_joint never run at the same time
*/
A[] not (cb_running(0) and cb_running(2))

/*
home and watchdog never run at the same time
*/
A[] not (cb_running(0) and cb_running(3))

/*
plan_reply and on_joint never run at the same time
*/
A[] not (cb_running(1) and cb_running(2))

/*
plan_reply and watchdog never run at the same time
*/
A[] not (cb_running(1) and cb_running(3))

/*
on_joint and watchdog never run at the same time
*/
A[] not (cb_running(2) and cb_running(3))

/*
group motion is closed while home runs
*/
A[] cb_running(0) imply group_closed[cb_group_table[0]]

/*
group replies is closed while plan_reply runs
*/
A[] cb_running(1) imply group_closed[cb_group_table[1]]

/*
group replies is closed while on_joint runs
*/
A[] cb_running(2) imply group_closed[cb_group_table[2]]

/*
group motion is closed while watchdog runs
*/
A[] cb_running(3) imply group_closed[cb_group_table[3]]

/*
home and plan_reply can run at the same time
*/
E<> (cb_running(0) and cb_running(1))

/*
home and on_joint can run at the same time
*/
E<> (cb_running(0) and cb_running(2))

/*
home and watchdog can run at the same time
*/
E<> (cb_running(0) and cb_running(3))

/*
plan_reply and on_joint can run at the same time
*/
E<> (cb_running(1) and cb_running(2))

/*
plan_reply and watchdog can run at the same time
*/
E<> (cb_running(1) and cb_running(3))

/*
on_joint and watchdog can run at the same time
*/
E<> (cb_running(2) and cb_running(3))

/*
group motion is always open to further threads
*/
A[] not group_closed[0]

/*
group replies is always open to further threads
*/
A[] not group_closed[1]

/*
home never starves: once something has arrived for it, it runs
*/
(cb_waiting[0] > 0 and !cb_running(0)) --> cb_running(0)

/*
plan_reply never starves: once something has arrived for it, it runs
*/
(cb_waiting[1] > 0 and !cb_running(1)) --> cb_running(1)

/*
on_joint never starves: once something has arrived for it, it runs
*/
(cb_waiting[2] > 0 and !cb_running(2)) --> cb_running(2)

/*
watchdog never starves: once something has arrived for it, it runs
*/
(cb_waiting[3] > 0 and !cb_running(3)) --> cb_running(3)

/*
home never overlaps itself
*/
A[] cb_runs(0) <= 1

/*
plan_reply never overlaps itself
*/
A[] cb_runs(1) <= 1

/*
on_joint never overlaps itself
*/
A[] cb_runs(2) <= 1

/*
watchdog never overlaps itself
*/
A[] cb_runs(3) <= 1

/*
no two callbacks ever run at the same time: groups and threads have no effect
*/
A[] forall (a : ThreadId) forall (b : ThreadId) (thread_running[a] and thread_running[b] imply a == b)
