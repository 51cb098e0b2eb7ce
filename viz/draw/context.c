/* SPDX-License-Identifier: MIT */
/* context.c - chooses and opens an off-screen GL context. context_osmesa.c and context_egl.c load their libraries with
 * functions of this file. */
#include "context.h"

#include "cores.h"

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    context_opener *open; /* function that opens a context of this kind; null: this kind was not compiled in */
} kinds[DRAW_CONTEXTS] = {
    [DRAW_AUTO] = {"auto", context_open},
#ifdef OCTREEL_OSMESA
    [DRAW_OSMESA] = {"osmesa", context_osmesa_open},
#else
    [DRAW_OSMESA] = {"osmesa", NULL},
#endif
#ifdef OCTREEL_EGL
    [DRAW_EGL] = {"egl", context_egl_open},
#else
    [DRAW_EGL] = {"egl", NULL},
#endif
};

const char *draw_context_name(int kind)
{
    return (unsigned)kind < DRAW_CONTEXTS ? kinds[kind].name : NULL;
}

bool draw_context_is_built(draw_context kind)
{
    return (unsigned)kind < DRAW_CONTEXTS && kinds[kind].open;
}

static draw_context_report *report;

void draw_context_set_report(draw_context_report *function)
{
    report = function;
}

/* Report that `kind` is used instead of the preferred kind. Report nothing if the library of the preferred kind is not
 * installed. */
static void report_fallback(int kind, int preferred, const octreel_error *why)
{
    if (report && kind != preferred && !strstr(why->text, strerror(ENOENT)))
        report(kinds[kind].name, kinds[preferred].name, why->text);
}

/* Open the first kind of context that can be opened. If no kind can be opened, the error is the error of the first
 * kind. */
static context *open_first_available(const renderer_choice *choice, octreel_error *error)
{
    octreel_error *reason = error, later;
    int first = DRAW_AUTO;
    for (int i = DRAW_AUTO + 1; i < DRAW_CONTEXTS; i++) {
        if (!kinds[i].open)
            continue;
        first = first ? first : i;
        context *c = kinds[i].open(choice, reason);
        if (c) {
            report_fallback(i, first, error);
            return c;
        }
        reason = &later;
    }
    return NULL;
}

context *context_open(const renderer_choice *choice, octreel_error *error)
{
    if (choice->context == DRAW_AUTO)
        return open_first_available(choice, error);
    if (draw_context_is_built(choice->context))
        return kinds[choice->context].open(choice, error);
    error_set(error, "this program was built without the %s context", draw_context_name(choice->context));
    return NULL;
}

void *context_create(const context *face, size_t size, const char *const names[2], const char *sentence,
                     octreel_error *error)
{
    void *library = dlopen(names[0], RTLD_NOW | RTLD_LOCAL);
    library = library ? library : dlopen(names[1], RTLD_NOW | RTLD_LOCAL);
    context *c = library ? calloc(1, size) : NULL;
    if (c) {
        *c = *face;
        c->library = library;
    } else if (library) {
        error_no_memory(error);
    } else {
        error_set(error, "%s: %s", sentence, dlerror());
    }
    return c;
}

/* Copy the bits of the symbol's address into the function pointer. ISO C has no cast from an object pointer to a
 * function pointer, but POSIX promises that both have the same bits. */
bool context_find_symbol(void *library, const char *name, void *function, size_t size)
{
    void *symbol = dlsym(library, name);
    memcpy(function, &symbol, size);
    return symbol != NULL;
}

/* ---- Threads -------------------------------------------------------------------------------------------------- */

static void *wait_for_lock(void *lock)
{
    pthread_mutex_lock(lock);
    pthread_mutex_unlock(lock);
    return NULL;
}

/* Returns whether this process can run `wanted` more threads at the same time. */
static bool can_start_threads(unsigned wanted)
{
    enum { MOST = 34 };
    pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    pthread_t threads[MOST];
    unsigned count = 0;
    wanted = wanted < MOST ? wanted : MOST;
    pthread_mutex_lock(&lock);
    while (count < wanted && pthread_create(&threads[count], NULL, wait_for_lock, &lock) == 0)
        count++;
    pthread_mutex_unlock(&lock);
    for (unsigned i = 0; i < count; i++)
        pthread_join(threads[i], NULL);
    return count == wanted;
}

/* llvmpipe starts one thread per core, at most 32. Mesa starts two more threads for its disk cache. */
void context_limit_threads(void)
{
    if (!can_start_threads(count_cores() + 2))
        setenv("LP_NUM_THREADS", "0", 0);
}
