/* SPDX-License-Identifier: MIT */
/* float_mode.h - makes public functions compute in the default floating-point mode, whatever mode the caller has.
 *
 * Problem: the caller's floating-point mode may make exact answers wrong. Games and audio code flush subnormal numbers
 * to zero, a program linked with -ffast-math does so from its start, and interval arithmetic rounds up and down. C has
 * no portable way to keep a compiler from moving arithmetic across a change of the mode: gcc ignores #pragma STDC
 * FENV_ACCESS, and a volatile asm statement orders only memory accesses and other volatile statements, not operations
 * on doubles.
 *
 * Idea: a public function first reads the mode (about 1 ns). In the default mode, which is the usual case, the function
 * simply runs. In any other mode the function sets the default mode, calls itself through a volatile pointer, and
 * restores the caller's mode (some 10 ns). The compiler does not know which function such a pointer calls, so it cannot
 * move the arithmetic of the inner call out of that call. All results of the inner call are complete before the mode is
 * restored. The arithmetic of the outer call runs only if the mode is already the default, so the compiler may move
 * this arithmetic.
 *
 * The caller's functions - visitors, tracers, allocators, executors - run in the caller's mode. If the library itself
 * calls a public function, it does so in the default mode, and the library's own visitors run in this mode.
 * float_mode_pause() and float_mode_resume() enclose nothing but the call of a caller's function.
 */
#ifndef OCTREE_FLOAT_MODE_H
#define OCTREE_FLOAT_MODE_H

#include "octree/octree.h"

/* Returns whether the thread's floating-point mode is the default: it rounds to nearest, keeps subnormal numbers, and
 * traps no floating-point exception. */
#if defined(__SSE2__)
#include <xmmintrin.h>

static inline bool float_mode_is_default(void)
{
    /* The tested bits of the register MXCSR are: flush to zero, rounding, the exception masks, and denormals are
     * zero. */
    return (_mm_getcsr() & 0xffc0u) == 0x1f80u;
}
#elif defined(__aarch64__) && defined(__GNUC__)
static inline bool float_mode_is_default(void)
{
    uint64_t control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    return control == 0;
}
#else
bool float_mode_is_default(void); /* Detects the floating-point mode by trying some operations. */
#endif

/* float_mode_enter() saves the thread's mode as the caller's mode and sets the default mode. float_mode_leave()
 * restores the caller's mode. */
void float_mode_enter(void);
void float_mode_leave(void);

/* The library calls these functions before and after it calls a function of the caller. float_mode_pause() restores the
 * caller's mode if the library has changed it, and returns whether it did. Pass this result to float_mode_resume(): if
 * the result is true, float_mode_resume() sets the default mode again. The caller's function may call the library. If
 * the caller's function does not return (longjmp, a C++ exception), the thread keeps the caller's mode. */
bool float_mode_pause(void);
void float_mode_resume(bool paused);

/* POINTER_TO_ITSELF declares `again`, a volatile pointer to the function, and CALL_ITSELF is this pointer. The compiler
 * cannot know which function a call through a volatile pointer calls. Without __typeof__, CALL_ITSELF is the function
 * itself, and the call is an ordinary recursion. */
#if defined(__GNUC__)
#define POINTER_TO_ITSELF(function) __typeof__(&(function)) volatile again = (function)
#define CALL_ITSELF(function) again
#define RARELY(condition) __builtin_expect(condition, 0)
#else
#define POINTER_TO_ITSELF(function) ((void)0)
#define CALL_ITSELF(function) function
#define RARELY(condition) (condition)
#endif

/* The first statement of a public function that computes with doubles. If the floating-point mode is not the default,
 * the statement calls the function again in the default mode with these arguments, and returns its result. */
#define RETURN_IN_DEFAULT_MODE(type, function, ...)                                                                    \
    do {                                                                                                               \
        if (RARELY(!float_mode_is_default())) {                                                                        \
            POINTER_TO_ITSELF(function);                                                                               \
            float_mode_enter();                                                                                        \
            type result_ = CALL_ITSELF(function)(__VA_ARGS__);                                                         \
            float_mode_leave();                                                                                        \
            return result_;                                                                                            \
        }                                                                                                              \
    } while (false)

/* ---- Arguments of that inner call: the caller's functions, to be called in the caller's mode ------------------- */

typedef struct caller_visitor {
    octree_point_visitor visit;
    void *context;
} caller_visitor;

typedef struct caller_node_visitor {
    octree_node_visitor visit;
    void *context;
} caller_node_visitor;

typedef struct caller_search {
    /* a copy of the caller's search options, in which the tracer is replaced by a function that calls the caller's
     * tracer in the caller's mode */
    octree_search search;
    octree_tracer trace;
    void *context;
} caller_search;

bool visit_in_caller_mode(const octree_point *point, void *context);
octree_walk_order visit_node_in_caller_mode(const octree_node *node, void *context);
const octree_search *copy_with_caller_tracer(const octree_search *how, caller_search *copy);

/* Two arguments for the inner call, which replace the caller's visitor and its context: a function that calls the
 * caller's visitor in the caller's mode, and the context of this function. A null visitor stays null. */
#define CALLER_VISITOR(visit, context)                                                                                 \
    (visit) ? visit_in_caller_mode : NULL, &(caller_visitor)                                                           \
    {                                                                                                                  \
        visit, context                                                                                                 \
    }
#define CALLER_NODE_VISITOR(visit, context)                                                                            \
    (visit) ? visit_node_in_caller_mode : NULL, &(caller_node_visitor)                                                 \
    {                                                                                                                  \
        visit, context                                                                                                 \
    }

/* An argument for the inner call: a copy of the caller's search options, whose tracer calls the caller's tracer in the
 * caller's mode. Options without a tracer are passed on without a copy. */
#define CALLER_SEARCH(how) copy_with_caller_tracer(how, &(caller_search){.context = NULL})

#endif
