/* SPDX-License-Identifier: MIT */
/* naive.c - see naive.h. */
#include "naive.h"

#include <GL/gl.h>
#include "glyphs.h"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The library is opened at run time, because a program linked with it would pay for its start before the measurement.
 */
#define GL_FUNCTIONS(X)                                                                                                \
    X(void, Viewport, (GLint, GLint, GLsizei, GLsizei))                                                                \
    X(void, ClearColor, (GLfloat, GLfloat, GLfloat, GLfloat))                                                          \
    X(void, Clear, (GLbitfield))                                                                                       \
    X(void, MatrixMode, (GLenum))                                                                                      \
    X(void, LoadMatrixd, (const GLdouble *))                                                                           \
    X(void, EnableClientState, (GLenum))                                                                               \
    X(void, VertexPointer, (GLint, GLenum, GLsizei, const void *))                                                     \
    X(void, ColorPointer, (GLint, GLenum, GLsizei, const void *))                                                      \
    X(void, PointSize, (GLfloat))                                                                                      \
    X(void, LineWidth, (GLfloat))                                                                                      \
    X(void, DrawArrays, (GLenum, GLint, GLsizei))                                                                      \
    X(void, Finish, (void))                                                                                            \
    X(GLenum, GetError, (void))

typedef struct vertex {
    GLfloat x, y, z;
    GLubyte color[4];
} vertex;

typedef struct vertex_list {
    vertex *items;
    size_t count, room;
    bool out_of_memory;
} vertex_list;

struct naive {
    OSMesaContext context;
    void (*destroy)(OSMesaContext);
    int width, height;
    uint8_t *pixels; /* red, green, blue, alpha; rows from the top */
    vertex_list vertices;
#define GL_MEMBER(result, name, parameters) result(*name) parameters;
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
};

/* ---- OSMesa ------------------------------------------------------------------------------------------------- */

static bool find(void *library, const char *name, void *function)
{
    void *found = dlsym(library, name);
    memcpy(function, &found, sizeof found);
    return found != NULL;
}

static bool open_mesa(naive *n, void *library)
{
    OSMesaContext (*create)(GLenum, OSMesaContext);
    GLboolean (*make_current)(OSMesaContext, void *, GLenum, GLsizei, GLsizei);
    void (*pixel_store)(GLint, GLint);
    if (!find(library, "OSMesaCreateContext", &create) || !find(library, "OSMesaMakeCurrent", &make_current) ||
        !find(library, "OSMesaPixelStore", &pixel_store) || !find(library, "OSMesaDestroyContext", &n->destroy))
        return false;
#define GL_FIND(result, name, parameters)                                                                              \
    if (!find(library, "gl" #name, &n->name))                                                                          \
        return false;
    GL_FUNCTIONS(GL_FIND)
#undef GL_FIND
    n->context = create(OSMESA_RGBA, NULL);
    if (!n->context || !make_current(n->context, n->pixels, GL_UNSIGNED_BYTE, n->width, n->height))
        return false;
    pixel_store(OSMESA_Y_UP, 0);
    return true;
}

naive *naive_open(int width, int height, const char **why)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so"};
    void *library = NULL;
    for (size_t i = 0; !library && i < sizeof names / sizeof names[0]; i++)
        library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
    naive *n = calloc(1, sizeof *n);
    *why = "OSMesa gives no context";
    if (n) {
        n->width = width;
        n->height = height;
        n->pixels = calloc((size_t)width * (size_t)height, 4);
    }
    if (n && n->pixels && library && open_mesa(n, library))
        return n;
    if (!library)
        *why = "OSMesa, which the naive way draws through, cannot be loaded (Debian: libosmesa6)";
    naive_close(n);
    return NULL;
}

void naive_close(naive *n)
{
    if (n && n->context)
        n->destroy(n->context);
    if (n) {
        free(n->pixels);
        free(n->vertices.items);
    }
    free(n);
}

/* ---- Vertices ----------------------------------------------------------------------------------------------- */

static void add_vertex(vertex_list *list, double x, double y, double z, theme_color color)
{
    if (list->count == list->room) {
        const size_t room = list->room ? 2 * list->room : 4096;
        vertex *items = realloc(list->items, room * sizeof *items);
        list->out_of_memory |= !items;
        if (!items)
            return;
        list->items = items;
        list->room = room;
    }
    list->items[list->count++] = (vertex){(GLfloat)x, (GLfloat)y, (GLfloat)z, {color.r, color.g, color.b, 255}};
}

static theme_color color_of(scene_style style)
{
    return theme_color_at(theme_color_index(style.role, 0));
}

static void flush(naive *n, GLenum kind)
{
    n->VertexPointer(3, GL_FLOAT, sizeof(vertex), &n->vertices.items[0].x);
    n->ColorPointer(4, GL_UNSIGNED_BYTE, sizeof(vertex), n->vertices.items[0].color);
    if (n->vertices.count)
        n->DrawArrays(kind, 0, (GLsizei)n->vertices.count);
    n->vertices.count = 0;
}

static void add_box(naive *n, const scene_box *box)
{
    static const uint8_t edges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                         {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    const theme_color color = color_of(box->style);
    for (int i = 0; i < 12; i++)
        for (int end = 0; end < 2; end++) {
            const unsigned corner = edges[i][end];
            add_vertex(&n->vertices, (corner & 1 ? box->box.max : box->box.min)[0],
                       (corner & 2 ? box->box.max : box->box.min)[1], (corner & 4 ? box->box.max : box->box.min)[2],
                       color);
        }
}

/* ---- The picture -------------------------------------------------------------------------------------------- */

/* The matrix of camera_transform() and camera_project(), column by column. */
static void look_through(naive *n, const camera *c)
{
    const double near = c->near, far = c->far_depth * 2, w = 2.0 / n->width, h = 2.0 / n->height;
    const double *axes[3] = {c->right, c->up, c->forward};
    double rows[3][4], matrix[16];
    for (int row = 0; row < 3; row++) {
        rows[row][3] = 0;
        for (int i = 0; i < 3; i++) {
            rows[row][i] = axes[row][i] * 2 * c->scale / c->size;
            rows[row][3] += axes[row][i] * (-2 * c->origin[i] / c->size - c->half[i] - c->eye[i]);
        }
    }
    for (int i = 0; i < 4; i++) {
        const double one = i == 3, depth = c->perspective ? rows[2][i] : one;
        matrix[4 * i] = rows[0][i] * c->zoom * w + (c->middle[0] * w - 1) * depth;
        matrix[4 * i + 1] = rows[1][i] * c->zoom * h + (1 - c->middle[1] * h) * depth;
        matrix[4 * i + 2] = c->perspective
                                ? rows[2][i] * (far + near) / (far - near) - one * 2 * far * near / (far - near)
                                : rows[2][i] / (2 * far);
        matrix[4 * i + 3] = depth;
    }
    n->LoadMatrixd(matrix);
}

static void look_flat(naive *n)
{
    const double w = 2.0 / n->width, h = 2.0 / n->height;
    n->LoadMatrixd((const double[16]){w, 0, 0, 0, 0, -h, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1});
}

static void draw_lines(naive *n, const scene *s, bool in_picture)
{
    for (size_t i = 0; i < s->segments.count; i++) {
        const scene_segment *segment = &s->segments.items[i];
        for (int end = 0; end < 2 && segment->in_picture == in_picture; end++)
            add_vertex(&n->vertices, segment->ends[end][0], segment->ends[end][1],
                       in_picture ? 0 : segment->ends[end][2], color_of(segment->style));
    }
    flush(n, GL_LINES);
}

/* Markers of one size follow each other: the points, and the few others. */
static void draw_markers(naive *n, const scene *s)
{
    for (size_t i = 0; i < s->markers.count; i++) {
        const scene_marker *m = &s->markers.items[i];
        add_vertex(&n->vertices, m->at[0], m->at[1], m->at[2], color_of(m->style));
        if (i + 1 == s->markers.count || m[1].style.width != m->style.width) {
            n->PointSize((GLfloat)(2 * (m->style.width * s->unit / 2) + 1));
            flush(n, GL_POINTS);
        }
    }
}

static void draw_panels(naive *n, const scene *s)
{
    for (size_t i = 0; i < s->panels.count; i++) {
        const scene_panel *p = &s->panels.items[i];
        for (int corner = 0; corner < 4; corner++)
            add_vertex(&n->vertices, p->x + (corner == 1 || corner == 2 ? p->width : 0),
                       p->y + (corner >= 2 ? p->height : 0), 0, color_of(p->style));
    }
    flush(n, GL_QUADS);
}

/* Draw the rectangles of a letter whose cell is at x and y. */
static void draw_letter(naive *n, const lettering *l, const scene_label *label, char letter, double x, double y)
{
    const glyph_set *set = &glyph_sets[l->face];
    const unsigned i = (unsigned char)letter - (unsigned)GLYPH_FIRST;
    for (unsigned j = set->first[i]; j < set->first[i + 1]; j++) {
        const glyph_part *p = &set->parts[j];
        for (int corner = 0; corner < 4; corner++)
            add_vertex(&n->vertices, x + (p->x + (corner == 1 || corner == 2 ? p->width : 0)) * l->multiple,
                       y + (p->y + (corner >= 2 ? p->height : 0)) * l->multiple, 0, color_of(label->style));
    }
}

static void draw_labels(naive *n, const scene *s)
{
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        const lettering *letters = scene_label_lettering(s, label);
        double seen[3], at[2] = {label->at[0], label->at[1]};
        if (label->in_world) {
            camera_transform(&s->camera, label->at, seen);
            camera_project(&s->camera, seen, at);
        }
        for (int j = 0; label->text[j]; j++)
            draw_letter(n, letters, label, label->text[j], (int)at[0] + j * letters->width, (int)at[1]);
    }
    flush(n, GL_QUADS);
}

bool naive_draw(naive *n, const scene *s)
{
    const theme_color ground = theme_color_at(theme_color_index(ROLE_BACKGROUND, 0));
    n->Viewport(0, 0, n->width, n->height);
    n->ClearColor((float)ground.r / 255, (float)ground.g / 255, (float)ground.b / 255, 1);
    n->Clear(GL_COLOR_BUFFER_BIT);
    n->EnableClientState(GL_VERTEX_ARRAY);
    n->EnableClientState(GL_COLOR_ARRAY);
    n->MatrixMode(GL_PROJECTION);
    look_through(n, &s->camera);
    for (size_t i = 0; i < s->boxes.count; i++)
        add_box(n, &s->boxes.items[i]);
    flush(n, GL_LINES);
    draw_markers(n, s);
    draw_lines(n, s, false);
    look_flat(n);
    draw_panels(n, s);
    draw_lines(n, s, true);
    draw_labels(n, s);
    n->Finish();
    return !n->vertices.out_of_memory && n->GetError() == GL_NO_ERROR;
}

static bool write_png(const naive *n, FILE *file)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info || setjmp(png_jmpbuf(png)) != 0) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)n->width, (png_uint_32)n->height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    png_set_filler(png, 0, PNG_FILLER_AFTER); /* leaves alpha out */
    for (int y = 0; y < n->height; y++)
        png_write_row(png, n->pixels + (size_t)y * (size_t)n->width * 4);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return true;
}

bool naive_write(const naive *n, const char *path)
{
    FILE *file = fopen(path, "wb");
    const bool whole = file && write_png(n, file);
    return file && fclose(file) == 0 && whole;
}
