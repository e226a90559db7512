// Processes of case2; each number is a place in the tables of the declarations.
TMR1 = Callback(0);
TMR2 = Callback(1);
SUB1 = Callback(2);
SUB2 = Callback(3);
ME = CallbackGroup(EXCLUSIVE, 0);
THR1 = Thread(0);
THR2 = Thread(1);
THR3 = Thread(2);
THR4 = Thread(3);
EXEC = Executor();

system
    EXEC,
    THR1,
    THR2,
    THR3,
    THR4,
    ME,
    TMR1,
    TMR2,
    SUB1,
    SUB2;
