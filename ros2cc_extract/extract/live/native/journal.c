/*
 * What the hook does on the way of a callback, in C: one step is noted in some 30 ns.
 *
 * The Python of `journal.py`, `groups.py` and `steps.py` says the same and is what runs where this
 * was not built for the interpreter; the tests hold one against the other. A wrapper here calls
 * what it wraps with what it was given, gives back what that gave, and hands each failure of its
 * own to `lose`.
 */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#ifdef Py_GIL_DISABLED
#error "The journal relies on the lock of the interpreter; the Python of journal.py does not."
#endif

/* One step, as `events.py` unpacks it. */
typedef struct {
    int64_t clock_ns;
    uint64_t thread;
    uint32_t what;
    uint32_t number;
} Event;

enum { FIRST_CAPACITY = 1024, MOST_ARGUMENTS = 16 };

static PyObject *str_number, *str_callback_group, *str_only_executor, *str_handler, *str_record,
    *str_submitted, *str_suspended;

/* ---- Journal: the steps that the hook's thread has not taken yet ---- */

typedef struct {
    PyObject_HEAD
    Event *events;
    size_t capacity, first, count, kept;
} Journal;

static PyTypeObject JournalType;

static void grow(Journal *self) {
    size_t wanted = self->capacity ? 2 * self->capacity : FIRST_CAPACITY;
    if (wanted > self->kept) wanted = self->kept;
    Event *larger = malloc(wanted * sizeof(Event));
    if (!larger) return;
    for (size_t i = 0; i < self->count; i++) {
        larger[i] = self->events[(self->first + i) % self->capacity];
    }
    free(self->events);
    self->events = larger;
    self->capacity = wanted;
    self->first = 0;
}

/* The oldest step makes room when as many are kept as may be. */
static void put(Journal *self, Event event) {
    if (self->count == self->capacity && self->capacity < self->kept) grow(self);
    if (self->capacity == 0) return;
    if (self->count == self->capacity) {
        self->first = (self->first + 1) % self->capacity;
        self->count--;
    }
    size_t at = self->first + self->count++;
    self->events[at < self->capacity ? at : at - self->capacity] = event;
}

static void note(Journal *self, uint32_t what, uint32_t number) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    put(self, (Event){(int64_t)now.tv_sec * 1000000000 + now.tv_nsec,
                      PyThread_get_thread_ident(), what, number});
}

static PyObject *journal_new(PyTypeObject *type, PyObject *args, PyObject *kwargs) {
    static char *names[] = {"kept", NULL};
    Py_ssize_t kept;
    if (!PyArg_ParseTupleAndKeywords(args, kwargs, "n", names, &kept)) return NULL;
    if (kept < 1) {
        PyErr_SetString(PyExc_ValueError, "kept must be at least 1");
        return NULL;
    }
    Journal *self = (Journal *)type->tp_alloc(type, 0);
    if (self) self->kept = (size_t)kept;
    return (PyObject *)self;
}

static void journal_dealloc(Journal *self) {
    free(self->events);
    Py_TYPE(self)->tp_free((PyObject *)self);
}

static int small(PyObject *object, uint32_t *value) {
    unsigned long number = PyLong_AsUnsignedLong(object);
    if (number == (unsigned long)-1 && PyErr_Occurred()) return -1;
    if (number > UINT32_MAX) {
        PyErr_SetString(PyExc_OverflowError, "a number of an event has 32 bits");
        return -1;
    }
    *value = (uint32_t)number;
    return 0;
}

static PyObject *journal_note(Journal *self, PyObject *const *args, Py_ssize_t count) {
    uint32_t what, number;
    if (count != 2) {
        PyErr_SetString(PyExc_TypeError, "note() takes what happened and whose number");
        return NULL;
    }
    if (small(args[0], &what) < 0 || small(args[1], &number) < 0) return NULL;
    note(self, what, number);
    Py_RETURN_NONE;
}

static PyObject *journal_put(Journal *self, PyObject *args) {
    long long clock_ns;
    unsigned long long thread;
    unsigned int what, number;
    if (!PyArg_ParseTuple(args, "LKII", &clock_ns, &thread, &what, &number)) return NULL;
    put(self, (Event){clock_ns, thread, what, number});
    Py_RETURN_NONE;
}

static PyObject *journal_take(Journal *self, PyObject *most_object) {
    Py_ssize_t most = PyLong_AsSsize_t(most_object);
    if (most == -1 && PyErr_Occurred()) return NULL;
    size_t count = most < 0 ? 0 : (size_t)most < self->count ? (size_t)most : self->count;
    PyObject *taken = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)(count * sizeof(Event)));
    /* Making it may have run other code that has taken steps itself. */
    if (!taken) return NULL;
    Event *to = (Event *)PyBytes_AS_STRING(taken);
    if (count > self->count) {
        Py_DECREF(taken);
        return PyBytes_FromStringAndSize(NULL, 0);
    }
    for (size_t i = 0; i < count; i++) to[i] = self->events[(self->first + i) % self->capacity];
    if (count) self->first = (self->first + count) % self->capacity;
    self->count -= count;
    return taken;
}

static PyObject *journal_clear(Journal *self, PyObject *Py_UNUSED(none)) {
    self->first = self->count = 0;
    Py_RETURN_NONE;
}

static Py_ssize_t journal_length(Journal *self) { return (Py_ssize_t)self->count; }

static PyMethodDef journal_methods[] = {
    {"note", (PyCFunction)(void (*)(void))journal_note, METH_FASTCALL, NULL},
    {"put", (PyCFunction)journal_put, METH_VARARGS, NULL},
    {"take", (PyCFunction)journal_take, METH_O, NULL},
    {"clear", (PyCFunction)journal_clear, METH_NOARGS, NULL},
    {NULL}};

static PySequenceMethods journal_as_sequence = {.sq_length = (lenfunc)journal_length};

static PyTypeObject JournalType = {
    PyVarObject_HEAD_INIT(NULL, 0)
    .tp_name = "_journal.Journal",
    .tp_doc = "The last steps, at most ``kept`` of them.",
    .tp_basicsize = sizeof(Journal),
    .tp_flags = Py_TPFLAGS_DEFAULT,
    .tp_new = journal_new,
    .tp_dealloc = (destructor)journal_dealloc,
    .tp_methods = journal_methods,
    .tp_as_sequence = &journal_as_sequence,
};

/* ---- Wrapper: stands in the place of a method; what it does is its `call` ---- */

typedef struct {
    PyObject_HEAD
    vectorcallfunc call;
    PyObject *original, *lose, *dict;
    Journal *journal;
    /* Of a take and of a group's method: what to note. */
    uint32_t what, otherwise, number;
    /* What this kind of wrapper needs besides; see where it is made. */
    PyObject *first, *second, *third;
} Wrapper;

static PyTypeObject WrapperType;

static int wrapper_traverse(Wrapper *self, visitproc visit, void *arg) {
    Py_VISIT(self->original);
    Py_VISIT(self->lose);
    Py_VISIT(self->dict);
    Py_VISIT(self->journal);
    Py_VISIT(self->first);
    Py_VISIT(self->second);
    Py_VISIT(self->third);
    return 0;
}

static int wrapper_clear(Wrapper *self) {
    Py_CLEAR(self->original);
    Py_CLEAR(self->lose);
    Py_CLEAR(self->dict);
    Py_CLEAR(self->journal);
    Py_CLEAR(self->first);
    Py_CLEAR(self->second);
    Py_CLEAR(self->third);
    return 0;
}

static void wrapper_dealloc(Wrapper *self) {
    PyObject_GC_UnTrack(self);
    wrapper_clear(self);
    Py_TYPE(self)->tp_free((PyObject *)self);
}

/* As a function does: found on an instance, it becomes a method of that. */
static PyObject *wrapper_bind(PyObject *self, PyObject *instance, PyObject *Py_UNUSED(type)) {
    if (!instance || instance == Py_None) {
        Py_INCREF(self);
        return self;
    }
    return PyMethod_New(self, instance);
}

static PyGetSetDef wrapper_attributes[] = {
    {"__dict__", PyObject_GenericGetDict, PyObject_GenericSetDict, NULL, NULL}, {NULL}};

static PyTypeObject WrapperType = {
    PyVarObject_HEAD_INIT(NULL, 0)
    .tp_name = "_journal.Wrapper",
    .tp_doc = "Calls what it wraps, and notes that it was called.",
    .tp_basicsize = sizeof(Wrapper),
    .tp_flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_HAVE_VECTORCALL |
                Py_TPFLAGS_METHOD_DESCRIPTOR,
    .tp_vectorcall_offset = offsetof(Wrapper, call),
    .tp_call = PyVectorcall_Call,
    .tp_dictoffset = offsetof(Wrapper, dict),
    .tp_descr_get = wrapper_bind,
    .tp_getset = wrapper_attributes,
    .tp_traverse = (traverseproc)wrapper_traverse,
    .tp_clear = (inquiry)wrapper_clear,
    .tp_dealloc = (destructor)wrapper_dealloc,
};

static Wrapper *wrap(vectorcallfunc call, PyObject *original, PyObject *lose, Journal *journal,
                     PyObject *first, PyObject *second, PyObject *third) {
    Wrapper *self = PyObject_GC_New(Wrapper, &WrapperType);
    if (!self) return NULL;
    self->call = call;
    self->original = Py_NewRef(original);
    self->lose = Py_NewRef(lose);
    self->dict = NULL;
    self->journal = (Journal *)Py_NewRef((PyObject *)journal);
    self->what = self->otherwise = self->number = 0;
    self->first = Py_XNewRef(first);
    self->second = Py_XNewRef(second);
    self->third = Py_XNewRef(third);
    PyObject_GC_Track(self);
    return self;
}

/* Count a failure of our own; -1 for what no hook may swallow, such as a Ctrl-C. */
static int swallow(Wrapper *self) {
    if (!PyErr_ExceptionMatches(PyExc_Exception)) return -1;
    PyObject *type, *error, *traceback;
    PyErr_Fetch(&type, &error, &traceback);
    PyErr_NormalizeException(&type, &error, &traceback);
    PyObject *done = PyObject_CallOneArg(self->lose, error);
    Py_XDECREF(type);
    Py_XDECREF(error);
    Py_XDECREF(traceback);
    if (!done) return -1;
    Py_DECREF(done);
    return 0;
}

/* Swallow what failed after the original was called; without its result when that must not be. */
static PyObject *after_all(Wrapper *self, PyObject *result) {
    if (swallow(self) < 0) Py_CLEAR(result);
    return result;
}

/* The record of an entity, from the recorder's dictionary by identity, else by its `find`. */
static PyObject *record_of(PyObject *entities, PyObject *entity) {
    PyObject *key = PyLong_FromVoidPtr(entity);
    if (!key) return NULL;
    PyObject *record = PyObject_GetItem(entities, key);
    Py_DECREF(key);
    return record;
}

static int number_of(PyObject *record, uint32_t *number) {
    PyObject *value = PyObject_GetAttr(record, str_number);
    if (!value) return -1;
    int done = small(value, number);
    Py_DECREF(value);
    return done;
}

/* 1 where an attribute is true, 0 where it is not, -1 on an error. */
static int is_true(PyObject *object, PyObject *name) {
    PyObject *value = PyObject_GetAttr(object, name);
    if (!value) return -1;
    int answer = PyObject_IsTrue(value);
    Py_DECREF(value);
    return answer;
}

/* ---- group_method: beginning_execution and ending_execution ---- */

/* first: the recorder's entities; second: its note_entity; third: the class, whose wrapper counts. */
static int is_reported_by(Wrapper *self, PyObject *group) {
    if ((PyObject *)Py_TYPE(group) == self->third) return 1;
    PyObject *name = PyDict_GetItemString(self->dict, "__name__");
    PyObject *found = name ? PyObject_GetAttr((PyObject *)Py_TYPE(group), name) : NULL;
    if (!found) return -1;
    Py_DECREF(found);
    return found == (PyObject *)self;
}

static int report_group(Wrapper *self, PyObject *group, PyObject *entity, uint32_t what) {
    int reported = is_reported_by(self, group);
    if (reported < 1) return reported;
    PyObject *record = record_of(self->first, entity);
    if (!record && PyErr_ExceptionMatches(PyExc_KeyError)) {
        PyErr_Clear();
        record = PyObject_CallFunctionObjArgs(self->second, group, entity, NULL);
    }
    uint32_t number;
    int done = record ? number_of(record, &number) : -1;
    Py_XDECREF(record);
    if (done == 0) note(self->journal, what, number);
    return done;
}

static PyObject *call_group_method(Wrapper *self, PyObject *const *args, size_t flags,
                                   PyObject *names) {
    PyObject *result = PyObject_Vectorcall(self->original, args, flags, names);
    if (!result) return NULL;
    Py_ssize_t count = PyVectorcall_NARGS(flags) + (names ? PyTuple_GET_SIZE(names) : 0);
    int truth = PyObject_IsTrue(result);
    int done = truth < 0 || count != 2
                   ? truth
                   : report_group(self, args[0], args[1], truth ? self->what : self->otherwise);
    return done < 0 ? after_all(self, result) : result;
}

static PyObject *group_method(PyObject *Py_UNUSED(module), PyObject *args) {
    PyObject *original, *owner, *entities, *find, *lose;
    Journal *journal;
    unsigned int what, otherwise;
    if (!PyArg_ParseTuple(args, "OOIIO!OOO", &original, &owner, &what, &otherwise, &JournalType,
                          &journal, &entities, &find, &lose)) {
        return NULL;
    }
    Wrapper *self = wrap((vectorcallfunc)call_group_method, original, lose, journal, entities,
                         find, owner);
    if (!self) return NULL;
    self->what = what;
    self->otherwise = otherwise;
    return (PyObject *)self;
}

/* ---- wait: WaitSet.wait, on the laps of an executor ---- */

/* first: the recorder; second: the code of a lap; third: finds the executor that a lap is of. */
static PyObject *waiting_executor(Wrapper *self, PyObject *lap) {
    PyObject *record = PyObject_GetAttr(self->first, str_only_executor);
    if (record != Py_None) return record;
    Py_DECREF(record);
    return PyObject_CallOneArg(self->third, lap);
}

/* 1 with the executor's number when it is one of ours that begins to wait here. */
static int begin_wait(Wrapper *self, uint32_t *number) {
    PyFrameObject *lap = PyEval_GetFrame();
    if (!lap) return 0;
    PyObject *code = (PyObject *)PyFrame_GetCode(lap);
    int ours = code == self->second;
    Py_DECREF(code);
    if (!ours) return 0;
    PyObject *record = waiting_executor(self, (PyObject *)lap);
    int done = !record ? -1 : record == Py_None ? 0 : number_of(record, number) < 0 ? -1 : 1;
    Py_XDECREF(record);
    return done;
}

static PyObject *call_wait(Wrapper *self, PyObject *const *args, size_t flags, PyObject *names) {
    uint32_t number = 0;
    int known = begin_wait(self, &number);
    if (known < 0 && swallow(self) < 0) return NULL;
    if (known > 0) note(self->journal, self->what, number);
    PyObject *result = PyObject_Vectorcall(self->original, args, flags, names);
    if (known > 0) note(self->journal, self->otherwise, number);
    return result;
}

static PyObject *wait_method(PyObject *Py_UNUSED(module), PyObject *args) {
    PyObject *original, *recorder, *lap, *asker, *lose;
    Journal *journal;
    unsigned int begin, end;
    if (!PyArg_ParseTuple(args, "OIIO!OOOO", &original, &begin, &end, &JournalType, &journal,
                          &recorder, &lap, &asker, &lose)) {
        return NULL;
    }
    Wrapper *self = wrap((vectorcallfunc)call_wait, original, lose, journal, recorder, lap, asker);
    if (!self) return NULL;
    self->what = begin;
    self->otherwise = end;
    return (PyObject *)self;
}

/* ---- make_handler: Executor._make_handler, and the take of what it makes ---- */

static PyObject *call_take(Wrapper *self, PyObject *const *args, size_t flags, PyObject *names) {
    PyObject *result = PyObject_Vectorcall(self->original, args, flags, names);
    if (result) note(self->journal, self->what, self->number);
    return result;
}

/* first: the recorder's entities; second: its note_entity. */
static PyObject *record_of_ready(Wrapper *self, PyObject *entity) {
    PyObject *record = record_of(self->first, entity);
    if (record || !PyErr_ExceptionMatches(PyExc_KeyError)) return record;
    PyErr_Clear();
    PyObject *group = PyObject_GetAttr(entity, str_callback_group);
    if (!group) return NULL;
    record = PyObject_CallFunctionObjArgs(self->second, group, entity, NULL);
    Py_DECREF(group);
    return record;
}

/* Take for take: the one that rclpy gave, in another that notes what it did. */
static PyObject *make_traced(Wrapper *self, PyObject *record, uint32_t number,
                             PyObject *const *args, size_t flags, PyObject *names) {
    Py_ssize_t count = PyVectorcall_NARGS(flags) + (names ? PyTuple_GET_SIZE(names) : 0);
    Wrapper *take = wrap((vectorcallfunc)call_take, args[3], self->lose, self->journal, NULL,
                         NULL, NULL);
    if (!take) return NULL;
    take->what = self->what;
    take->number = number;
    PyObject *given[MOST_ARGUMENTS];
    memcpy(given, args, (size_t)count * sizeof(PyObject *));
    given[3] = (PyObject *)take;
    PyObject *task =
        PyObject_Vectorcall(self->original, given, (size_t)PyVectorcall_NARGS(flags), names);
    Py_DECREF(take);
    if (!task) return NULL;
    if (PyObject_SetAttr(task, str_record, record) < 0) return after_all(self, task);
    note(self->journal, self->otherwise, number);
    return task;
}

static PyObject *call_make_handler(Wrapper *self, PyObject *const *args, size_t flags,
                                   PyObject *names) {
    Py_ssize_t given = PyVectorcall_NARGS(flags);
    Py_ssize_t count = given + (names ? PyTuple_GET_SIZE(names) : 0);
    PyObject *record = NULL, *task;
    uint32_t number = 0;
    int known = 0;
    if (given >= 4 && count <= MOST_ARGUMENTS) {
        record = record_of_ready(self, args[1]);
        known = record && number_of(record, &number) == 0;
        if (!known && swallow(self) < 0) {
            Py_XDECREF(record);
            return NULL;
        }
    }
    task = known ? make_traced(self, record, number, args, flags, names)
                 : PyObject_Vectorcall(self->original, args, flags, names);
    Py_XDECREF(record);
    return task;
}

static PyObject *make_handler(PyObject *Py_UNUSED(module), PyObject *args) {
    PyObject *original, *entities, *find, *lose;
    Journal *journal;
    unsigned int take, collect;
    if (!PyArg_ParseTuple(args, "OIIO!OOO", &original, &take, &collect, &JournalType, &journal,
                          &entities, &find, &lose)) {
        return NULL;
    }
    Wrapper *self = wrap((vectorcallfunc)call_make_handler, original, lose, journal, entities,
                         find, NULL);
    if (!self) return NULL;
    self->what = take;
    self->otherwise = collect;
    return (PyObject *)self;
}

/* ---- submit: of a pool of threads, which is not kept alive ---- */

/* first: a weak reference to the pool. */
static int report_submit(Wrapper *self, PyObject *task) {
    PyObject *record = PyObject_GetAttr(task, str_record);
    if (!record) {
        if (!PyErr_ExceptionMatches(PyExc_AttributeError)) return -1;
        PyErr_Clear();
        return 0;
    }
    uint32_t number;
    int done = 0;
    if (record != Py_None) {
        int told = is_true(task, str_submitted);
        done = told;
        if (told == 0) done = PyObject_SetAttr(task, str_submitted, Py_True);
        if (told == 0 && done == 0) done = number_of(record, &number);
        if (told == 0 && done == 0) note(self->journal, self->what, number);
    }
    Py_DECREF(record);
    return done;
}

static PyObject *call_submit(Wrapper *self, PyObject *const *args, size_t flags,
                             PyObject *names) {
    Py_ssize_t given = PyVectorcall_NARGS(flags);
    Py_ssize_t count = given + (names ? PyTuple_GET_SIZE(names) : 0);
    if (given > 0 && report_submit(self, args[0]) < 0 && swallow(self) < 0) return NULL;
    PyObject *pool = PyObject_CallNoArgs(self->first);
    if (!pool) return NULL;
    PyObject **all = PyMem_Malloc((size_t)(count + 1) * sizeof(PyObject *));
    if (!all) {
        Py_DECREF(pool);
        return PyErr_NoMemory();
    }
    all[0] = pool;
    memcpy(all + 1, args, (size_t)count * sizeof(PyObject *));
    PyObject *result = PyObject_Vectorcall(self->original, all, (size_t)given + 1, names);
    PyMem_Free(all);
    Py_DECREF(pool);
    return result;
}

static PyObject *submit_function(PyObject *Py_UNUSED(module), PyObject *args) {
    PyObject *original, *pool, *lose;
    Journal *journal;
    unsigned int submit;
    if (!PyArg_ParseTuple(args, "OIO!OO", &original, &submit, &JournalType, &journal, &pool,
                          &lose)) {
        return NULL;
    }
    Wrapper *self = wrap((vectorcallfunc)call_submit, original, lose, journal, pool, NULL, NULL);
    if (self) self->what = submit;
    return (PyObject *)self;
}

/* ---- run: Task.__call__, where there is nothing to tell but that it went on as it was ---- */

/* first: the class of records of work outside groups; second: the whole of it, in Python;
 * third: what to do when a run ends that has not come to its own end. */
static int is_plain(Wrapper *self, PyObject *task, PyObject **record) {
    *record = PyObject_GetAttr(task, str_record);
    if (!*record) return -1;
    if (*record == Py_None || (PyObject *)Py_TYPE(*record) == self->first) return 0;
    int suspended = is_true(task, str_suspended);
    return suspended < 0 ? -1 : !suspended;
}

static int end_run(Wrapper *self, PyObject *task, PyObject *record) {
    PyObject *handler = PyObject_GetAttr(task, str_handler);
    if (!handler) return -1;
    int over = handler == Py_None;
    Py_DECREF(handler);
    if (over) return 0;
    PyObject *done = PyObject_CallFunctionObjArgs(self->third, task, record, NULL);
    Py_XDECREF(done);
    return done ? 0 : -1;
}

static PyObject *call_run(Wrapper *self, PyObject *const *args, size_t flags, PyObject *names) {
    if (PyVectorcall_NARGS(flags) != 1 || names) {
        return PyObject_Vectorcall(self->original, args, flags, names);
    }
    PyObject *record = NULL;
    int plain = is_plain(self, args[0], &record);
    if (plain < 0 && swallow(self) < 0) return NULL;
    if (plain < 1) {
        Py_XDECREF(record);
        return PyObject_Vectorcall(plain ? self->original : self->second, args, flags, names);
    }
    PyObject *result = PyObject_Vectorcall(self->original, args, flags, names);
    PyObject *type = NULL, *error = NULL, *traceback = NULL;
    if (!result) PyErr_Fetch(&type, &error, &traceback);
    int done = end_run(self, args[0], record);
    Py_DECREF(record);
    if (done < 0 && swallow(self) < 0) {
        Py_CLEAR(result);
        Py_XDECREF(type);
        Py_XDECREF(error);
        Py_XDECREF(traceback);
    } else if (!result) {
        PyErr_Restore(type, error, traceback);
    }
    return result;
}

static PyObject *run_method(PyObject *Py_UNUSED(module), PyObject *args) {
    PyObject *original, *work, *whole, *end, *lose;
    Journal *journal;
    if (!PyArg_ParseTuple(args, "OO!OOOO", &original, &JournalType, &journal, &work, &whole, &end,
                          &lose)) {
        return NULL;
    }
    return (PyObject *)wrap((vectorcallfunc)call_run, original, lose, journal, work, whole, end);
}

/* ---- The module ---- */

static PyMethodDef functions[] = {
    {"group_method", group_method, METH_VARARGS,
     "(original, owner, what, otherwise, journal, entities, find, lose)"},
    {"wait_method", wait_method, METH_VARARGS,
     "(original, begin, end, journal, recorder, lap, asker, lose)"},
    {"make_handler", make_handler, METH_VARARGS,
     "(original, take, collect, journal, entities, find, lose)"},
    {"submit_function", submit_function, METH_VARARGS, "(original, what, journal, pool_ref, lose)"},
    {"run_method", run_method, METH_VARARGS,
     "(original, journal, class_of_work, whole, end, lose)"},
    {NULL}};

static struct PyModuleDef module = {
    PyModuleDef_HEAD_INIT,
    .m_name = "_journal",
    .m_doc = "What the hook does on the way of a callback; see journal.py.",
    .m_size = -1,
    .m_methods = functions,
};

static const struct {
    PyObject **name;
    const char *text;
} NAMES[] = {
    {&str_number, "number"},
    {&str_callback_group, "callback_group"},
    {&str_only_executor, "only_executor"},
    {&str_handler, "_handler"},
    {&str_record, "_ros2cc_record"},
    {&str_submitted, "_ros2cc_submitted"},
    {&str_suspended, "_ros2cc_suspended"},
};

PyMODINIT_FUNC PyInit__journal(void) {
    for (size_t i = 0; i < sizeof(NAMES) / sizeof(NAMES[0]); i++) {
        if (!(*NAMES[i].name = PyUnicode_InternFromString(NAMES[i].text))) return NULL;
    }
    if (PyType_Ready(&JournalType) < 0 || PyType_Ready(&WrapperType) < 0) return NULL;
    PyObject *self = PyModule_Create(&module);
    if (self && PyModule_AddObjectRef(self, "Journal", (PyObject *)&JournalType) < 0) {
        Py_CLEAR(self);
    }
    return self;
}
