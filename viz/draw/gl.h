/* gl.h - the GL functions that are used, by way of the context's own lookup. Private. */
#ifndef DRAW_GL_H
#define DRAW_GL_H

#include "context.h"

#include <GL/gl.h>
#include <GL/glext.h>

/* Result, name, parameters. */
#define GL_FUNCTIONS(X)                                                                                                \
    X(const GLubyte *, GetString, (GLenum name))                                                                       \
    X(void, GetIntegerv, (GLenum name, GLint * value))                                                                 \
    X(GLenum, GetError, (void))                                                                                        \
    X(void, GenFramebuffers, (GLsizei count, GLuint * names))                                                          \
    X(void, BindFramebuffer, (GLenum target, GLuint name))                                                             \
    X(void, GenRenderbuffers, (GLsizei count, GLuint * names))                                                         \
    X(void, BindRenderbuffer, (GLenum target, GLuint name))                                                            \
    X(void, RenderbufferStorage, (GLenum target, GLenum format, GLsizei width, GLsizei height))                        \
    X(void, FramebufferRenderbuffer, (GLenum target, GLenum attachment, GLenum kind, GLuint name))                     \
    X(GLenum, CheckFramebufferStatus, (GLenum target))                                                                 \
    X(void, Viewport, (GLint x, GLint y, GLsizei width, GLsizei height))                                               \
    X(void, Disable, (GLenum what))                                                                                    \
    X(void, ShadeModel, (GLenum mode))                                                                                 \
    X(void, PixelStorei, (GLenum name, GLint value))                                                                   \
    X(void, ReadBuffer, (GLenum buffer))                                                                               \
    X(void, DrawBuffer, (GLenum buffer))                                                                               \
    X(void, ClearColor, (GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha))                                     \
    X(void, Clear, (GLbitfield mask))                                                                                  \
    X(void, MatrixMode, (GLenum mode))                                                                                 \
    X(void, LoadIdentity, (void))                                                                                      \
    X(void, EnableClientState, (GLenum array))                                                                         \
    X(void, VertexPointer, (GLint size, GLenum type, GLsizei stride, const void *pointer))                             \
    X(void, ColorPointer, (GLint size, GLenum type, GLsizei stride, const void *pointer))                              \
    X(void, DrawElements, (GLenum mode, GLsizei count, GLenum type, const void *indices))                              \
    X(void, ReadPixels, (GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, void *pixels))

typedef struct gl {
#define GL_MEMBER(result, name, parameters) result(GLAPIENTRY *name) parameters;
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
} gl;

/* Look all of them up. False, and a sentence that names the first one that is missing. */
bool gl_load(gl *functions, const context *c, octreel_error *error);

#endif
