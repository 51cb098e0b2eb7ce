/* SPDX-License-Identifier: MIT */
/* float_mode.c - sets and restores the floating-point mode, and calls the caller's functions in the caller's mode. See
 * float_mode.h. */
#include "float_mode.h"

/* True while a public function that changed the thread's mode is running. A thread runs at most one such function at a
 * time: inner calls find the default mode, and `changed` is false while a function of the caller runs. */
static _Thread_local bool changed;

/* ---- The control register ------------------------------------------------------------------------------------ */

#if defined(__SSE2__)
typedef unsigned float_control;

static float_control read_control(void)
{
    return _mm_getcsr();
}

static void write_control(const float_control *control)
{
    _mm_setcsr(*control);
}

static void write_default_control(void)
{
    _mm_setcsr(0x1f80u);
}
#elif defined(__aarch64__) && defined(__GNUC__)
typedef uint64_t float_control;

static float_control read_control(void)
{
    float_control control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    return control;
}

static void write_control(const float_control *control)
{
    __asm__ volatile("msr fpcr, %0" : : "r"(*control) : "memory");
}

static void write_default_control(void)
{
    write_control(&(float_control){0});
}
#else
#include <fenv.h>

typedef fenv_t float_control;

static float_control read_control(void)
{
    fenv_t control;
    fegetenv(&control);
    return control;
}

static void write_control(const float_control *control)
{
    fesetenv(control);
}

static void write_default_control(void)
{
    fesetenv(FE_DFL_ENV);
}

/* Detect the floating-point mode by its effect on some operations. The operands are volatile, so that the compiler does
 * not compute the results at compile time. After float_mode_enter(), the mode counts as the default even if fesetenv()
 * could not change it, because nothing more can be done. */
bool float_mode_is_default(void)
{
    static const volatile double one = 1, half_ulp = 0x1p-53, more = 0x1.8p-53, least = 0x1p-1074, normal = 0x1p-1022;
    const bool nearest = one + half_ulp == one && -one - half_ulp == -one && one + more > one && -one - more < -one;
    return changed || (nearest && least + least > 0 && normal * 0.5 > 0);
}
#endif

/* ---- The caller's mode --------------------------------------------------------------------------------------- */

/* the floating-point mode to restore; valid while `changed` is true */
static _Thread_local float_control caller_control;

void float_mode_enter(void)
{
    caller_control = read_control();
    write_default_control();
    changed = true;
}

void float_mode_leave(void)
{
    changed = false;
    write_control(&caller_control);
}

bool float_mode_pause(void)
{
    const bool paused = changed;
    if (paused)
        float_mode_leave();
    return paused;
}

void float_mode_resume(bool paused)
{
    if (paused)
        float_mode_enter();
}

/* ---- The caller's functions ---------------------------------------------------------------------------------- */

bool visit_in_caller_mode(const octree_point *point, void *context)
{
    const caller_visitor *caller = context;
    const bool paused = float_mode_pause();
    const bool more = caller->visit(point, caller->context);
    float_mode_resume(paused);
    return more;
}

octree_walk_order visit_node_in_caller_mode(const octree_node *node, void *context)
{
    const caller_node_visitor *caller = context;
    const bool paused = float_mode_pause();
    const octree_walk_order order = caller->visit(node, caller->context);
    float_mode_resume(paused);
    return order;
}

static void trace_in_caller_mode(octree_address node, octree_trace_kind kind, void *context)
{
    const caller_search *caller = context;
    const bool paused = float_mode_pause();
    caller->trace(node, kind, caller->context);
    float_mode_resume(paused);
}

const octree_search *copy_with_caller_tracer(const octree_search *how, caller_search *copy)
{
    if (!how || !how->trace)
        return how;
    *copy = (caller_search){*how, how->trace, how->trace_context};
    copy->search.trace = trace_in_caller_mode;
    copy->search.trace_context = copy;
    return &copy->search;
}
