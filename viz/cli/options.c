/* options.c - the values of options, and the sentences for those that do not fit. */
#include "command.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char view_options_help[] =
    "      --size WxH        picture in pixels (default 1280x720; a side is 1 to 16384)\n"
    "      --camera NAME     iso, top, front, side, follow or orbit (default iso)\n"
    "      --layers LIST     of world,nodes,points,range,nearest,player,box,text (default all); -text leaves one out\n";

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
    if (view_camera_parse(text, &v->camera))
        return true;
    trouble("there is no camera \"%s\"; there are iso, top, front, side, follow, orbit", text);
    return false;
}

bool read_layers(const char *text, view *v)
{
    const char *bad;
    if (view_layers_parse(text, &v->layers, &bad))
        return true;
    trouble("there is no layer \"%.*s\"; there are world, nodes, points, range, nearest, player, box, text, all, none",
            (int)strcspn(bad, ","), bad);
    return false;
}
