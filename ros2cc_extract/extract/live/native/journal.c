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
#include <stdlib.h>
#include <string.h>
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

_Static_assert(sizeof(Event) == 24, "events.py unpacks it so");

/* REVISION: counted up, also in journal.py, when what Python calls here changes. */
enum { REVISION = 4, MOST_ARGUMENTS = 16 };

static PyObject *str_number, *str_callback_group, *str_only_executor, *str_handler, *str_record,
    *str_submitted, *str_suspended, *str_qualname;

/* ---- Journal: the steps that the hook's thread has not taken yet ---- */

/* A ring for all that may be kept; of its memory the system gives what was ever in use. */
typedef struct {
    PyObject_HEAD
    Event *events;
    size_t kept, first, count;
} Journal;

static PyTypeObject JournalType;

/* The oldest step makes room when as many are kept as may be. */
static void put(Journal *self, Event event) {
    if (self->count == self->kept) {
        self->first = (self->first + 1) % self->kept;
        self->count--;
    }
    self->events[(self->first + self->count++) % self->kept] = event;
}

static int64_t read_clock(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void put_here(Journal *self, int64_t clock_ns, uint32_t what, uint32_t number) {
    put(self, (Event){clock_ns, PyThread_get_thread_ident(), what, number});
}

static void note(Journal *self, uint32_t what, uint32_t number) {
    put_here(self, read_clock(), what, number);
}

/* Forget the oldest steps. An empty ring begins anew, and so uses few pages of its memory. */
static void forget(Journal *self, size_t count) {
    self->count -= count;
    self->first = self->count ? (self->first + count) % self->kept : 0;
}

static PyObject *journal_new(PyTypeObject *type, PyObject *args, PyObject *kwargs) {
    static char *names[] = {"kept", NULL};
    Py_ssize_t kept;
    if (!PyArg_ParseTupleAndKeywords(args, kwargs, "n", names, &kept)) return NULL;
    if (kept < 1) {
        PyErr_SetString(PyExc_ValueError, "kept must be at least 1");
        return NULL;
    }
    Event *events = calloc((size_t)kept, sizeof(Event));
    if (!events) return PyErr_NoMemory();
    Journal *self = (Journal *)type->tp_alloc(type, 0);
    if (!self) {
        free(events);
        return NULL;
    }
    self->events = events;
    self->kept = (size_t)kept;
    return (PyObject *)self;
}

static void journal_dealloc(PyObject *self) {
    free(((Journal *)self)->events);
    Py_TYPE(self)->tp_free(self);
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

static PyObject *journal_note(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    uint32_t what, number;
    if (count != 2) {
        PyErr_SetString(PyExc_TypeError, "note() takes what happened and whose number");
        return NULL;
    }
    if (small(args[0], &what) < 0 || small(args[1], &number) < 0) return NULL;
    note((Journal *)self, what, number);
    Py_RETURN_NONE;
}

static PyObject *journal_put(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    Event event;
    if (count != 4) {
        PyErr_SetString(PyExc_TypeError, "put() takes clock, thread, what and number");
        return NULL;
    }
    event.clock_ns = PyLong_AsLongLong(args[0]);
    if (event.clock_ns == -1 && PyErr_Occurred()) return NULL;
    event.thread = PyLong_AsUnsignedLongLong(args[1]);
    if (event.thread == (uint64_t)-1 && PyErr_Occurred()) return NULL;
    if (small(args[2], &event.what) < 0 || small(args[3], &event.number) < 0) return NULL;
    put((Journal *)self, event);
    Py_RETURN_NONE;
}

static PyObject *journal_take(PyObject *object, PyObject *most_object) {
    Journal *self = (Journal *)object;
    Py_ssize_t most = PyLong_AsSsize_t(most_object);
    if (most == -1 && PyErr_Occurred()) return NULL;
    size_t count = most < 0 ? 0 : (size_t)most < self->count ? (size_t)most : self->count;
    PyObject *taken = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)(count * sizeof(Event)));
    if (!taken || !count) return taken;
    size_t until_end = self->kept - self->first;
    size_t at_once = count < until_end ? count : until_end;
    char *to = PyBytes_AS_STRING(taken);
    memcpy(to, self->events + self->first, at_once * sizeof(Event));
    memcpy(to + at_once * sizeof(Event), self->events, (count - at_once) * sizeof(Event));
    forget(self, count);
    return taken;
}

static PyObject *journal_clear(PyObject *self, PyObject *Py_UNUSED(none)) {
    forget((Journal *)self, ((Journal *)self)->count);
    Py_RETURN_NONE;
}

static Py_ssize_t journal_length(PyObject *self) { return (Py_ssize_t)((Journal *)self)->count; }

static PyMethodDef journal_methods[] = {
    {"note", (PyCFunction)(void (*)(void))journal_note, METH_FASTCALL, NULL},
    {"put", (PyCFunction)(void (*)(void))journal_put, METH_FASTCALL, NULL},
    {"take", journal_take, METH_O, NULL},
    {"clear", journal_clear, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL}};

static PySequenceMethods journal_as_sequence = {.sq_length = journal_length};

static PyTypeObject JournalType = {
    PyVarObject_HEAD_INIT(NULL, 0)
    .tp_name = "_journal.Journal",
    .tp_doc = "The last steps, at most ``kept`` of them.",
    .tp_basicsize = sizeof(Journal),
    .tp_flags = Py_TPFLAGS_DEFAULT,
    .tp_new = journal_new,
    .tp_dealloc = journal_dealloc,
    .tp_methods = journal_methods,
    .tp_as_sequence = &journal_as_sequence,
};

/* ---- Wrapper: stands in the place of a method; what it does is its `call` ---- */

typedef struct {
    PyObject_HEAD
    vectorcallfunc call;
    PyObject *original, *lose, *dict, *weak_references;
    Journal *journal;
    /* Of a take and of a group's method: what to note. */
    uint32_t what, otherwise, number;
    /* What this kind of wrapper needs besides; see where it is made. */
    PyObject *first, *second, *third;
} Wrapper;

static PyTypeObject WrapperType;

/* There is no tp_clear: a wrapper may be called as long as anybody has it, also by what runs while
 * the garbage collector takes a cycle apart. It is made with all that it refers to and none of it
 * is put there later but its dictionary, so each of its cycles goes through something else that
 * can be cleared. Tuples rely on the same. */
static int wrapper_traverse(PyObject *object, visitproc visit, void *arg) {
    Wrapper *self = (Wrapper *)object;
    Py_VISIT(self->original);
    Py_VISIT(self->lose);
    Py_VISIT(self->dict);
    Py_VISIT(self->journal);
    Py_VISIT(self->first);
    Py_VISIT(self->second);
    Py_VISIT(self->third);
    return 0;
}

static void wrapper_dealloc(PyObject *object) {
    Wrapper *self = (Wrapper *)object;
    PyObject_GC_UnTrack(object);
    if (self->weak_references) PyObject_ClearWeakRefs(object);
    Py_DECREF(self->original);
    Py_DECREF(self->lose);
    Py_XDECREF(self->dict);
    Py_DECREF(self->journal);
    Py_XDECREF(self->first);
    Py_XDECREF(self->second);
    Py_XDECREF(self->third);
    Py_TYPE(object)->tp_free(object);
}

/* As a function does: found on an instance, it becomes a method of that. */
static PyObject *wrapper_bind(PyObject *self, PyObject *instance, PyObject *Py_UNUSED(type)) {
    return instance && instance != Py_None ? PyMethod_New(self, instance) : Py_NewRef(self);
}

static PyObject *wrapper_repr(PyObject *self) {
    PyObject *name = PyObject_GetAttr(self, str_qualname);
    if (!name) {
        PyErr_Clear();
        return PyBaseObject_Type.tp_repr(self);
    }
    PyObject *text = PyUnicode_FromFormat("<function %S at %p>", name, (void *)self);
    Py_DECREF(name);
    return text;
}

/* Functions are pickled by their name, and are their own copies. */
static PyObject *wrapper_reduce(PyObject *self, PyObject *Py_UNUSED(none)) {
    return PyObject_GetAttr(self, str_qualname);
}

static PyMethodDef wrapper_methods[] = {{"__reduce__", wrapper_reduce, METH_NOARGS, NULL},
                                        {NULL, NULL, 0, NULL}};

static PyGetSetDef wrapper_attributes[] = {
    {"__dict__", PyObject_GenericGetDict, PyObject_GenericSetDict, NULL, NULL},
    {NULL, NULL, NULL, NULL, NULL}};

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
    .tp_weaklistoffset = offsetof(Wrapper, weak_references),
    .tp_descr_get = wrapper_bind,
    .tp_repr = wrapper_repr,
    .tp_methods = wrapper_methods,
    .tp_getset = wrapper_attributes,
    .tp_traverse = wrapper_traverse,
    .tp_dealloc = wrapper_dealloc,
};

static Wrapper *wrap(vectorcallfunc call, PyObject *original, PyObject *lose, Journal *journal,
                     PyObject *first, PyObject *second, PyObject *third) {
    Wrapper *self = PyObject_GC_New(Wrapper, &WrapperType);
    if (!self) return NULL;
    self->call = call;
    self->original = Py_NewRef(original);
    self->lose = Py_NewRef(lose);
    self->dict = self->weak_references = NULL;
    self->journal = (Journal *)Py_NewRef((PyObject *)journal);
    self->what = self->otherwise = self->number = 0;
    self->first = Py_XNewRef(first);
    self->second = Py_XNewRef(second);
    self->third = Py_XNewRef(third);
    PyObject_GC_Track(self);
    return self;
}

/* Take the exception that is set, and set it again. */
#if PY_VERSION_HEX < 0x030C0000
static PyObject *take_error(void) {
    PyObject *type, *error, *traceback;
    PyErr_Fetch(&type, &error, &traceback);
    PyErr_NormalizeException(&type, &error, &traceback);
    if (traceback) PyException_SetTraceback(error, traceback);
    Py_XDECREF(type);
    Py_XDECREF(traceback);
    return error;
}

static void give_error(PyObject *error) {
    PyErr_Restore(Py_NewRef((PyObject *)Py_TYPE(error)), error, PyException_GetTraceback(error));
}
#else
#define take_error PyErr_GetRaisedException
#define give_error PyErr_SetRaisedException
#endif

/* As what is raised while another exception is dealt with: it reports that. */
static void raise_during(PyObject *error) {
    PyObject *newer = take_error(), *known = PyException_GetContext(newer);
    if (!known && newer != error) PyException_SetContext(newer, Py_NewRef(error));
    Py_XDECREF(known);
    Py_DECREF(error);
    give_error(newer);
}

/* Count a failure of our own; -1 for what no hook may swallow, such as a Ctrl-C. */
static int swallow(Wrapper *self) {
    if (!PyErr_ExceptionMatches(PyExc_Exception)) return -1;
    PyObject *error = take_error();
    PyObject *done = PyObject_CallOneArg(self->lose, error);
    if (!done) {
        raise_during(error);
        return -1;
    }
    Py_DECREF(done);
    Py_DECREF(error);
    return 0;
}

/* Swallow what failed after the original was called; without its result when that must not be. */
static PyObject *after_all(Wrapper *self, PyObject *result) {
    if (swallow(self) < 0) Py_CLEAR(result);
    return result;
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

/* first: the recorder's entities by identity; second: its note_entity, for one that is not there.
 * Of a group that is not given the entity knows. */
static PyObject *record_of(Wrapper *self, PyObject *group, PyObject *entity) {
    PyObject *key = PyLong_FromVoidPtr(entity);
    if (!key) return NULL;
    PyObject *record = Py_XNewRef(PyDict_GetItemWithError(self->first, key));
    Py_DECREF(key);
    if (record || PyErr_Occurred()) return record;
    group = group ? Py_NewRef(group) : PyObject_GetAttr(entity, str_callback_group);
    if (!group) return NULL;
    record = PyObject_CallFunctionObjArgs(self->second, group, entity, NULL);
    Py_DECREF(group);
    return record;
}

/* ---- group_method: beginning_execution and ending_execution ---- */

/* third: the class that was wrapped, the name of its method, and what knows what is taken off. */
static int is_reported_by(Wrapper *self, PyObject *group) {
    PyObject *type = (PyObject *)Py_TYPE(group);
    if (type == PyTuple_GET_ITEM(self->third, 0)) return 1;
    PyObject *found = PyObject_GetAttr(type, PyTuple_GET_ITEM(self->third, 1));
    if (!found) return -1;
    Py_DECREF(found);
    return found == (PyObject *)self;
}

/* The entity is what a group is asked about, by place or by name; borrowed. */
static PyObject *asked_about(PyObject *const *args, Py_ssize_t given, PyObject *names) {
    if (given > 1) return args[1];
    for (Py_ssize_t i = 0; given && names && i < PyTuple_GET_SIZE(names); i++) {
        PyObject *name = PyTuple_GET_ITEM(names, i);
        if (PyUnicode_CompareWithASCIIString(name, "entity") == 0) return args[given + i];
    }
    PyErr_SetString(PyExc_KeyError, "entity");
    return NULL;
}

static int report_group(Wrapper *self, int64_t clock_ns, PyObject *group, PyObject *entity,
                        PyObject *result) {
    int reported = is_reported_by(self, group);
    if (reported < 1) return reported;
    PyObject *record = record_of(self, group, entity);
    if (!record) return -1;
    uint32_t number;
    int truth = PyObject_IsTrue(result);
    int done = truth < 0 ? -1 : number_of(record, &number);
    Py_DECREF(record);
    if (done == 0) put_here(self->journal, clock_ns, truth ? self->what : self->otherwise, number);
    return done;
}

/* Whether the callback that ends here was ended by something from outside. */
static int is_taken_off(Wrapper *self) {
    PyObject *type, *error, *traceback, *answer;
    PyErr_GetExcInfo(&type, &error, &traceback);
    int taken_off = 0;
    if (error && error != Py_None) {
        PyObject *frame = (PyObject *)PyEval_GetFrame();
        answer = PyObject_CallFunctionObjArgs(PyTuple_GET_ITEM(self->third, 2), error,
                                              frame ? frame : Py_None, NULL);
        taken_off = answer ? PyObject_IsTrue(answer) : -1;
        Py_XDECREF(answer);
    }
    Py_XDECREF(type);
    Py_XDECREF(error);
    Py_XDECREF(traceback);
    return taken_off;
}

/* As groups.py says: a group is entered before its begin is reported, and left after its end. */
static PyObject *call_group_method(PyObject *wrapper, PyObject *const *args, size_t flags,
                                   PyObject *names) {
    Wrapper *self = (Wrapper *)wrapper;
    int is_end = self->what == self->otherwise;
    int64_t clock_ns = is_end ? read_clock() : 0;
    PyObject *result = PyObject_Vectorcall(self->original, args, flags, names);
    if (!result) return NULL;
    if (!is_end) clock_ns = read_clock();
    int taken_off = is_end ? is_taken_off(self) : 0;
    if (taken_off > 0) return result;
    if (taken_off < 0) return after_all(self, result);
    PyObject *entity = asked_about(args, PyVectorcall_NARGS(flags), names);
    if (entity && report_group(self, clock_ns, args[0], entity, result) == 0) return result;
    return after_all(self, result);
}

static PyObject *group_method(PyObject *Py_UNUSED(module), PyObject *args) {
    PyObject *original, *owner, *entities, *find, *lose;
    Journal *journal;
    unsigned int what, otherwise;
    if (!PyArg_ParseTuple(args, "OO!IIO!O!OO", &original, &PyTuple_Type, &owner, &what, &otherwise,
                          &JournalType, &journal, &PyDict_Type, &entities, &find, &lose)) {
        return NULL;
    }
    if (PyTuple_GET_SIZE(owner) != 3) {
        PyErr_SetString(PyExc_ValueError, "owner must be a class, a name and a function");
        return NULL;
    }
    Wrapper *self = wrap(call_group_method, original, lose, journal, entities, find, owner);
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

static PyObject *call_wait(PyObject *wrapper, PyObject *const *args, size_t flags,
                           PyObject *names) {
    Wrapper *self = (Wrapper *)wrapper;
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
    Wrapper *self = wrap(call_wait, original, lose, journal, recorder, lap, asker);
    if (!self) return NULL;
    self->what = begin;
    self->otherwise = end;
    return (PyObject *)self;
}

/* ---- make_handler: Executor._make_handler, and the take of what it makes ---- */

static PyObject *call_take(PyObject *wrapper, PyObject *const *args, size_t flags,
                           PyObject *names) {
    Wrapper *self = (Wrapper *)wrapper;
    PyObject *result = PyObject_Vectorcall(self->original, args, flags, names);
    if (result) note(self->journal, self->what, self->number);
    return result;
}

/* The executor, an entity, its node and the take are given by place: a traced take for that. */
static PyObject *traced_take(Wrapper *self, PyObject *const *args, Py_ssize_t given,
                             Py_ssize_t count, PyObject **record) {
    if (given < 4 || count > MOST_ARGUMENTS) {
        PyErr_SetString(PyExc_ValueError, "a handler was asked for in a way not known");
        return NULL;
    }
    uint32_t number;
    *record = record_of(self, NULL, args[1]);
    if (!*record || number_of(*record, &number) < 0) return NULL;
    Wrapper *take = wrap(call_take, args[3], self->lose, self->journal, NULL, NULL, NULL);
    if (!take) return NULL;
    take->what = self->what;
    take->number = number;
    return (PyObject *)take;
}

static PyObject *call_make_handler(PyObject *wrapper, PyObject *const *args, size_t flags,
                                   PyObject *names) {
    Wrapper *self = (Wrapper *)wrapper;
    Py_ssize_t given = PyVectorcall_NARGS(flags);
    Py_ssize_t count = given + (names ? PyTuple_GET_SIZE(names) : 0);
    PyObject *changed[MOST_ARGUMENTS], *record = NULL, *task;
    PyObject *take = traced_take(self, args, given, count, &record);
    if (take) {
        memcpy(changed, args, (size_t)count * sizeof(PyObject *));
        changed[3] = take;
        task = PyObject_Vectorcall(self->original, changed, (size_t)given, names);
        if (task && PyObject_SetAttr(task, str_record, record) < 0) {
            task = after_all(self, task);
        } else if (task) {
            note(self->journal, self->otherwise, ((Wrapper *)take)->number);
        }
        Py_DECREF(take);
    } else if (swallow(self) < 0) {
        task = NULL;
    } else {
        task = PyObject_Vectorcall(self->original, args, flags, names);
    }
    Py_XDECREF(record);
    return task;
}

static PyObject *make_handler(PyObject *Py_UNUSED(module), PyObject *args) {
    PyObject *original, *entities, *find, *lose;
    Journal *journal;
    unsigned int take, collect;
    if (!PyArg_ParseTuple(args, "OIIO!O!OO", &original, &take, &collect, &JournalType, &journal,
                          &PyDict_Type, &entities, &find, &lose)) {
        return NULL;
    }
    Wrapper *self = wrap(call_make_handler, original, lose, journal, entities, find, NULL);
    if (!self) return NULL;
    self->what = take;
    self->otherwise = collect;
    return (PyObject *)self;
}

/* ---- submit: of a pool of threads, which is not kept alive ---- */

/* first: a weak reference to the pool. */
static int report_first_submit(Wrapper *self, PyObject *task, PyObject *record) {
    uint32_t number;
    int submitted = is_true(task, str_submitted);
    if (submitted) return submitted;
    if (PyObject_SetAttr(task, str_submitted, Py_True) < 0) return -1;
    if (number_of(record, &number) < 0) return -1;
    note(self->journal, self->what, number);
    return 0;
}

static int report_submit(Wrapper *self, PyObject *task) {
    PyObject *record = PyObject_GetAttr(task, str_record);
    if (!record) {
        if (!PyErr_ExceptionMatches(PyExc_AttributeError)) return -1;
        PyErr_Clear();
        return 0;
    }
    int done = record == Py_None ? 0 : report_first_submit(self, task, record);
    Py_DECREF(record);
    return done;
}

static PyObject *call_submit(PyObject *wrapper, PyObject *const *args, size_t flags,
                             PyObject *names) {
    Wrapper *self = (Wrapper *)wrapper;
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
    if (count) memcpy(all + 1, args, (size_t)count * sizeof(PyObject *));
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
    Wrapper *self = wrap(call_submit, original, lose, journal, pool, NULL, NULL);
    if (self) self->what = submit;
    return (PyObject *)self;
}

/* ---- run: Task.__call__, where there is nothing to report but that it went on ---- */

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

static PyObject *call_run(PyObject *wrapper, PyObject *const *args, size_t flags,
                          PyObject *names) {
    Wrapper *self = (Wrapper *)wrapper;
    if (PyVectorcall_NARGS(flags) != 1 || names) {
        return PyObject_Vectorcall(self->original, args, flags, names);
    }
    PyObject *record = NULL;
    int plain = is_plain(self, args[0], &record);
    if (plain < 0 && swallow(self) < 0) {
        Py_XDECREF(record);
        return NULL;
    }
    if (plain < 1) {
        Py_XDECREF(record);
        return PyObject_Vectorcall(plain ? self->original : self->second, args, flags, names);
    }
    PyObject *result = PyObject_Vectorcall(self->original, args, flags, names);
    PyObject *error = result ? NULL : take_error();
    int done = end_run(self, args[0], record);
    Py_DECREF(record);
    if (done == 0 || swallow(self) == 0) {
        if (error) give_error(error);
        return result;
    }
    Py_XDECREF(result);
    if (error) raise_during(error);
    return NULL;
}

static PyObject *run_method(PyObject *Py_UNUSED(module), PyObject *args) {
    PyObject *original, *work, *whole, *end, *lose;
    Journal *journal;
    if (!PyArg_ParseTuple(args, "OO!OOOO", &original, &JournalType, &journal, &work, &whole, &end,
                          &lose)) {
        return NULL;
    }
    return (PyObject *)wrap(call_run, original, lose, journal, work, whole, end);
}

/* ---- The module ---- */

static PyMethodDef functions[] = {
    {"group_method", group_method, METH_VARARGS,
     "(original, (owner, name, is_taken_off), what, otherwise, journal, entities, find, lose)"},
    {"wait_method", wait_method, METH_VARARGS,
     "(original, begin, end, journal, recorder, lap, asker, lose)"},
    {"make_handler", make_handler, METH_VARARGS,
     "(original, take, collect, journal, entities, find, lose)"},
    {"submit_function", submit_function, METH_VARARGS, "(original, what, journal, pool_ref, lose)"},
    {"run_method", run_method, METH_VARARGS,
     "(original, journal, class_of_work, whole, end, lose)"},
    {NULL, NULL, 0, NULL}};

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
    {&str_qualname, "__qualname__"},
};

PyMODINIT_FUNC PyInit__journal(void) {
    for (size_t i = 0; i < sizeof(NAMES) / sizeof(NAMES[0]); i++) {
        if (!(*NAMES[i].name = PyUnicode_InternFromString(NAMES[i].text))) return NULL;
    }
    if (PyType_Ready(&JournalType) < 0 || PyType_Ready(&WrapperType) < 0) return NULL;
    PyObject *self = PyModule_Create(&module);
    if (self && (PyModule_AddObjectRef(self, "Journal", (PyObject *)&JournalType) < 0 ||
                 PyModule_AddIntConstant(self, "REVISION", REVISION) < 0)) {
        Py_CLEAR(self);
    }
    return self;
}
