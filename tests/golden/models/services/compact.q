/*
there is no deadlock: some step is always possible
*/
A[] not deadlock

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
home never starves: once a poll has seen it ready, it runs
*/
(executor.schedule_start and executor.ready_set_copy[0] and !cb_running(0)) --> cb_running(0)

/*
plan_reply never starves: once a poll has seen it ready, it runs
*/
(executor.schedule_start and executor.ready_set_copy[1] and !cb_running(1)) --> cb_running(1)

/*
on_joint never starves: once a poll has seen it ready, it runs
*/
(executor.schedule_start and executor.ready_set_copy[2] and !cb_running(2)) --> cb_running(2)

/*
watchdog never starves: once a poll has seen it ready, it runs
*/
(executor.schedule_start and executor.ready_set_copy[3] and !cb_running(3)) --> cb_running(3)
