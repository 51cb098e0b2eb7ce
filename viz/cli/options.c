/* options.c - the values of options, and the sentences for those that do not fit. */
#include "command.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Names, by their place; null beyond the last. */
typedef const char *name_at(int i);

static const char *camera_at(int i)
{
    return view_camera_name((view_camera)i);
}

static const char *layer_at(int i)
{
    return view_layer_name((view_layer)i);
}

static void print_names(FILE *out, name_at *name)
{
    for (int i = 0; name(i); i++)
        fprintf(out, "%s%s", i ? ", " : "", name(i));
}

void print_view_options(FILE *out)
{
    fputs("      --size WxH        picture in pixels (default 1280x720; a side is 1 to 16384)\n"
          "      --camera NAME     one of ",
          out);
    print_names(out, camera_at);
    fputs(" (default iso)\n      --layers LIST     with commas between, of ", out);
    print_names(out, layer_at);
    fputs("\n                        (default all; -text leaves one out)\n", out);
}

/* "octreel: there is no camera "x"; there are iso, top ..." */
static bool no_such(const char *kind, const char *text, int length, name_at *name)
{
    fprintf(stderr, "octreel: there is no %s \"%.*s\"; there are ", kind, length, text);
    print_names(stderr, name);
    fputc('\n', stderr);
    return false;
}

int trouble(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("octreel: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return EXIT_TROUBLE;
}

/* A decimal whole number at *text, which is moved behind it. False on a sign, no digits, or more than `max`. */
static bool take_number(const char **text, uint64_t max, uint64_t *value)
{
    char *end;
    if (**text < '0' || **text > '9')
        return false;
    errno = 0;
    const unsigned long long number = strtoull(*text, &end, 10);
    if (errno || number > max)
        return false;
    *value = number;
    *text = end;
    return true;
}

bool read_count(const char *option, const char *text, uint64_t min, uint64_t max, uint64_t *value)
{
    const char *at = text;
    if (take_number(&at, max, value) && *at == 0 && *value >= min)
        return true;
    trouble("%s takes a whole number from %" PRIu64 " to %" PRIu64 ", not \"%s\"", option, min, max, text);
    return false;
}

bool read_size(const char *text, view *v)
{
    const char *at = text;
    uint64_t width, height;
    if (take_number(&at, INT32_MAX, &width) && *at == 'x' && (at++, take_number(&at, INT32_MAX, &height)) && *at == 0) {
        v->width = (int)width;
        v->height = (int)height;
        return true;
    }
    trouble("--size takes pixels as in 1280x720, not \"%s\"", text);
    return false;
}

bool read_camera(const char *text, view *v)
{
    return view_camera_parse(text, &v->camera) || no_such("camera", text, (int)strlen(text), camera_at);
}

bool read_layers(const char *text, view *v)
{
    const char *bad;
    return view_layers_parse(text, &v->layers, &bad) || no_such("layer", bad, (int)strcspn(bad, ","), layer_at);
}
