/* fault.c - one sentence for a failed operation on a PNG file. */
#include "fault.h"

#include <stdio.h>
#include <string.h>

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* A path or a keyword may hold anything; the sentence stays on one line. */
static void flatten(char *text)
{
    for (; *text != '\0'; text++)
        *text = (unsigned char)*text < ' ' ? '?' : *text;
}

bool image_fault_report(const image_fault *fault, const char *doing, const char *reason)
{
    char what[200];
    snprintf(what, sizeof what, ": %s%s", doing, reason);
    size_t room = sizeof fault->error->text - strlen(what) - 1;
    size_t length = strlen(fault->path);
    const char *shown = fault->path + (length - smaller(length, room));
    snprintf(fault->error->text, sizeof fault->error->text, "%s%s", shown, what);
    flatten(fault->error->text);
    return false;
}

_Noreturn void image_fault_raise(png_structp png, png_const_charp message)
{
    const image_fault *fault = (const image_fault *)png_get_error_ptr(png);
    image_fault_report(fault, "", message);
    png_longjmp(png, 1);
}
