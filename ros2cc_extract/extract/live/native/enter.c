/*
 * What is loaded into a running process to run a script in it: a thread of its own does.
 *
 * The process loads this in a thread that was stopped in a system call. That thread holds the lock
 * of the dynamic linker meanwhile, so the constructor waits for nothing: it starts a thread and
 * returns. The new thread asks for the lock of the interpreter as every thread does, runs the
 * script, and lets the linker take this library away when nothing of it runs any more.
 *
 * What is called of CPython is looked up in the process, so that one library is for all versions;
 * nothing of Python.h is needed.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Of what CPython's headers define (Include/compile.h), the same from 3.10 to 3.14. */
enum { FILE_INPUT = 257, MOST_SCRIPT_BYTES = 1 << 20 };

/* Beside this file are the script, `.py`, and the files that report how far it came. */
static char stem[PATH_MAX];

static int open_beside(const char *ending, int flags) {
    char path[PATH_MAX + 16];
    strcpy(path, stem);
    strcat(path, ending);
    return open(path, flags | O_CLOEXEC | O_NOFOLLOW, 0600);
}

static void tell(const char *ending) {
    int file = open_beside(ending, O_WRONLY | O_CREAT | O_EXCL);
    if (file >= 0)
        close(file);
}

/* Give the script, to be freed; NULL where it has been taken away, as by who has given up. */
static char *script(void) {
    int file = open_beside(".py", O_RDONLY);
    char *text = file < 0 ? NULL : malloc(MOST_SCRIPT_BYTES + 1);
    size_t length = 0;
    ssize_t count = 0;
    while (text != NULL && length < MOST_SCRIPT_BYTES &&
           (count = read(file, text + length, MOST_SCRIPT_BYTES - length)) > 0)
        length += (size_t)count;
    if (file >= 0)
        close(file);
    if (text != NULL)
        text[count < 0 ? 0 : length] = '\0';
    return text;
}

#define FROM_PYTHON(result, name, ...)                                                             \
    result (*name)(__VA_ARGS__) = (result(*)(__VA_ARGS__))dlsym(RTLD_DEFAULT, #name)

/* With the lock of the interpreter; an exception is the script's own concern. */
static void run_script(const char *text) {
    FROM_PYTHON(void *, PyDict_New, void);
    FROM_PYTHON(void *, PyEval_GetBuiltins, void);
    FROM_PYTHON(int, PyDict_SetItemString, void *, const char *, void *);
    FROM_PYTHON(void *, PyRun_StringFlags, const char *, int, void *, void *, void *);
    FROM_PYTHON(void, PyErr_Clear, void);
    FROM_PYTHON(void, Py_DecRef, void *); /* takes NULL */
    void *names = PyDict_New();
    if (names != NULL &&
        PyDict_SetItemString(names, "__builtins__", PyEval_GetBuiltins()) == 0)
        Py_DecRef(PyRun_StringFlags(text, FILE_INPUT, names, names, NULL));
    PyErr_Clear();
    Py_DecRef(names);
}

/*
 * Let glibc close this library when the thread has left it: two references, of who loaded it and
 * of this look-up. musl has no such function, and never unloads.
 */
static void unload_in_the_end(void) {
    typedef void Destructor(void *);
    int (*at_exit)(Destructor *, void *, void *) =
        (int (*)(Destructor *, void *, void *))dlsym(RTLD_DEFAULT, "__cxa_thread_atexit_impl");
    void *of_libc = dlsym(RTLD_DEFAULT, "dlclose");
    Destructor *close_library = (Destructor *)of_libc;
    Dl_info self;
    if (at_exit == NULL || of_libc == NULL || dladdr((void *)stem, &self) == 0)
        return;
    /* It waits here until the library is loaded: the linker's lock is not given up before. */
    void *handle = dlopen(self.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
    if (handle != NULL) {
        at_exit(close_library, handle, of_libc);
        at_exit(close_library, handle, of_libc);
    }
}

static void *run(void *unused) {
    pthread_setname_np(pthread_self(), "ros2cc-extract");
    unload_in_the_end();
    FROM_PYTHON(int, Py_IsInitialized, void);
    FROM_PYTHON(int, PyGILState_Ensure, void);
    FROM_PYTHON(void, PyGILState_Release, int);
    if (Py_IsInitialized == NULL || !Py_IsInitialized()) {
        tell(".refused");
        return unused;
    }
    int state = PyGILState_Ensure();
    char *text = script();
    if (text != NULL) {
        tell(".begun");
        run_script(text);
    }
    PyGILState_Release(state);
    free(text);
    return unused;
}

/* In the thread that was stopped: without the interpreter, and with nothing that it may hold. */
__attribute__((constructor)) static void hand_over(void) {
    Dl_info self;
    if (dladdr((void *)stem, &self) == 0)
        return;
    size_t length = strlen(self.dli_fname);
    if (length <= 3 || length >= PATH_MAX || strcmp(self.dli_fname + length - 3, ".so") != 0)
        return;
    memcpy(stem, self.dli_fname, length - 3);
    int file = open_beside(".py", O_RDONLY);
    if (file < 0)
        return; /* loaded by somebody else, for nothing */
    close(file);
    /* The process's signals are for its own threads. */
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    pthread_attr_t detached;
    pthread_t thread;
    pthread_attr_init(&detached);
    pthread_attr_setdetachstate(&detached, PTHREAD_CREATE_DETACHED);
    if (pthread_create(&thread, &detached, run, NULL) != 0)
        tell(".refused");
    pthread_attr_destroy(&detached);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}
