// Callback model of case2, profile paper
const int NUM_CB = 4;
const int NUM_CB_GROUP = 1;
const int NUM_THREAD = 4;

// How often each callback may become ready.
const int MAX_CYCLE = 1;

typedef int[0, NUM_CB - 1] CbId;
typedef int[0, NUM_CB_GROUP - 1] GroupId;
typedef int[0, NUM_THREAD - 1] ThreadId;

typedef int[0, 3] CbType;
const CbType TMR = 0;
const CbType SUB = 1;
const CbType SRV = 2;
const CbType CLT = 3;

typedef int[0, 1] GroupType;
const GroupType REENTRANT = 0;
const GroupType EXCLUSIVE = 1;

// Callbacks in the order in which the executor looks at them: TMR1, TMR2, SUB1, SUB2
const GroupId cb_group_table[NUM_CB] = {0, 0, 0, 0};
const CbType cb_type_table[NUM_CB] = {TMR, TMR, SUB, SUB};

// Callback groups: ME
bool group_closed[NUM_CB_GROUP];
chan group_close[NUM_CB_GROUP];
chan group_open[NUM_CB_GROUP];

// Which callbacks are ready now.
bool ready_set[NUM_CB];

// Threads: THR1, THR2, THR3, THR4
// The assignment of a thread that does not run is the one it had last.
bool thread_running[NUM_THREAD];
CbId thread_cb_assign_table[NUM_THREAD];
chan cb_assign_signal[NUM_THREAD];
broadcast chan thread_free;

bool cb_running(CbId c) {
    return exists (t : ThreadId) (thread_running[t] && thread_cb_assign_table[t] == c);
}
