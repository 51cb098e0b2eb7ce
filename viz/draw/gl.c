/* gl.c - see gl.h. */
#include "gl.h"

#include <stdio.h>

bool gl_load(gl *functions, const context *c, octreel_error *error)
{
    const char *missing = NULL;
#define GL_LOOK_UP(result, name, parameters)                                                                           \
    functions->name = (result(GLAPIENTRY *) parameters)c->find(c, "gl" #name);                                         \
    if (!functions->name && !missing)                                                                                  \
        missing = "gl" #name;
    GL_FUNCTIONS(GL_LOOK_UP)
#undef GL_LOOK_UP
    if (missing)
        snprintf(error->text, sizeof error->text, "the %s context has no %s", c->name, missing);
    return !missing;
}
