/*
there is no dead-lock: some step is always possible
*/
A[] not deadlock

/*
front_on_scan can run
*/
E<> cb_running(0)

/*
rear_on_scan can run
*/
E<> cb_running(1)

/*
tick_lambda can run
*/
E<> cb_running(2)

/*
front_on_scan and rear_on_scan never run at the same time
*/
A[] not (cb_running(0) and cb_running(1))

/*
front_on_scan and tick_lambda never run at the same time
*/
A[] not (cb_running(0) and cb_running(2))

/*
rear_on_scan and tick_lambda never run at the same time
*/
A[] not (cb_running(1) and cb_running(2))

/*
group scan_default is closed while front_on_scan runs
*/
A[] cb_running(0) imply group_closed[cb_group_table[0]]

/*
group scan_default is closed while rear_on_scan runs
*/
A[] cb_running(1) imply group_closed[cb_group_table[1]]

/*
group scan_default is closed while tick_lambda runs
*/
A[] cb_running(2) imply group_closed[cb_group_table[2]]

/*
front_on_scan and rear_on_scan can run at the same time
*/
E<> (cb_running(0) and cb_running(1))

/*
front_on_scan and tick_lambda can run at the same time
*/
E<> (cb_running(0) and cb_running(2))

/*
rear_on_scan and tick_lambda can run at the same time
*/
E<> (cb_running(1) and cb_running(2))

/*
group scan_default is always open to further threads
*/
A[] not group_closed[0]

/*
front_on_scan never starves: once a poll has seen it ready, it runs
*/
(executor.schedule_start and executor.ready_set_copy[0] and !cb_running(0)) --> cb_running(0)

/*
rear_on_scan never starves: once a poll has seen it ready, it runs
*/
(executor.schedule_start and executor.ready_set_copy[1] and !cb_running(1)) --> cb_running(1)

/*
tick_lambda never starves: once a poll has seen it ready, it runs
*/
(executor.schedule_start and executor.ready_set_copy[2] and !cb_running(2)) --> cb_running(2)
