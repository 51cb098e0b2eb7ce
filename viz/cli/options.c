/* SPDX-License-Identifier: MIT */
/* options.c - reads the values of options and reports values that do not fit. */
#include "options.h"
#include "file_kind.h"
#include "hint.h"
#include "number.h"
#include "text.h"
#include "view_options.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Prints one line on standard error. Control characters, such as those in file names, are printed as question marks. */
static void print_sentence(const char *format, va_list arguments)
{
    char sentence[1 << 14];
    vsnprintf(sentence, sizeof sentence, format, arguments);
    for (char *at = sentence; *at; at++)
        if ((unsigned char)*at < ' ' || *at == 127)
            *at = '?';
    fputs("octreel: ", stderr);
    write_escaped(stderr, sentence, escape_nothing);
    fputc('\n', stderr);
}

static bool quiet;

bool is_quiet(void)
{
    return quiet;
}

void print_note(const char *format, ...)
{
    va_list arguments;
    if (quiet)
        return;
    va_start(arguments, format);
    print_sentence(format, arguments);
    va_end(arguments);
}

int print_error(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_sentence(format, arguments);
    va_end(arguments);
    return EXIT_TROUBLE;
}

bool print_refusal(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_sentence(format, arguments);
    va_end(arguments);
    return false;
}

bool refuse_value(const command_option *option, const char *takes, const char *text)
{
    return print_refusal("--%s takes %s, not \"%s\"", option->name, takes, text);
}

static bool check_name_not_empty(const char *option, const char *name)
{
    return *name || print_refusal("%s: the name is empty", option);
}

bool check_names_not_empty(const char *command, char *const *names, int count)
{
    for (int i = 0; i < count; i++)
        if (!check_name_not_empty(command, names[i]))
            return false;
    return true;
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

bool read_count(const char *name, const char *text, uint64_t min, uint64_t max, uint64_t *value)
{
    const char *at = text;
    if (whole_number_parse(&at, max, value) && *at == 0 && *value >= min)
        return true;
    return print_refusal("%s takes a whole number from %" PRIu64 " to %" PRIu64 ", not \"%s\"", name, min, max, text);
}

char option_letter(const char *name)
{
    static const char *const lettered[] = {"output", "quiet", "help"};
    for (size_t i = 0; i < sizeof lettered / sizeof lettered[0]; i++)
        if (strcmp(name, lettered[i]) == 0)
            return *name;
    return 0;
}

/* An option as it is typed on the command line: "--every" or "-o". */
typedef struct typed_option {
    char text[32];
} typed_option;

static typed_option option_as_typed(const command_option *option)
{
    typed_option typed;
    const char letter = option_letter(option->name);
    snprintf(typed.text, sizeof typed.text, "%s%s", letter ? "-" : "--", letter ? (char[]){letter, 0} : option->name);
    return typed;
}

bool read_flag(const command_option *option, const char *text, void *into)
{
    (void)option, (void)text;
    return *(bool *)into = true;
}

bool read_choice(const command_option *option, const char *text, void *into)
{
    char known[64], meant[HINT_TEXT];
    hint h = hint_create(text, strlen(text));
    const int found = json_find_name(option->names, text);
    if (found >= 0) {
        *(int *)into = found;
        return true;
    }
    for (int i = 0; option->names(i); i++)
        hint_add_candidate(&h, option->names(i));
    return print_refusal("--%s: unknown value \"%s\"%schoose from %s", option->name, text, hint_format(&h, "", meant),
                         json_list_names(option->names, known, sizeof known));
}

bool read_quiet(const command_option *option, const char *text, void *into)
{
    (void)option, (void)text, (void)into;
    return quiet = true;
}

bool read_text(const command_option *option, const char *text, void *into)
{
    (void)option;
    *(const char **)into = text;
    return true;
}

bool read_name(const command_option *option, const char *text, void *into)
{
    return read_text(option, text, into) && check_name_not_empty(option_as_typed(option).text, text);
}

bool is_folder(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

bool fits_output_option(command_option_reader *reader, const char *path)
{
    const output_kind kind = output_kind_of_name(path);
    if (reader == read_picture_or_page)
        return kind == NAME_PNG || file_has_ending(path, ".html");
    if (reader == read_picture || reader == read_film)
        return kind == NAME_PNG || (reader == read_film && kind == NAME_FILM);
    return kind == NAME_OPEN || (reader == read_file && kind == NAME_FILE);
}

bool read_folder(const command_option *option, const char *text, void *into)
{
    const output_kind kind = output_kind_of_name(text);
    if (file_is_standard_stream(text))
        return print_refusal("%s needs a folder, but \"-\" is standard output; for a folder named -, write ./-",
                             option_as_typed(option).text);
    if (!read_name(option, text, into) || kind == NAME_OPEN || is_folder(text))
        return **(const char **)into != 0;
    return print_refusal("%s needs a folder, but \"%s\" names a %s%s", option_as_typed(option).text, text,
                         kind == NAME_FILE   ? "file"
                         : kind == NAME_FILM ? "film"
                                             : "picture",
                         kind == NAME_FILM ? ": record into a folder, then make a film of its frames with octreel film"
                                           : "");
}

static bool read_file_name(const command_option *option, const char *text, void *into)
{
    return read_name(option, text, into) &&
           (file_is_standard_stream(text) || !is_folder(text) ||
            print_refusal("%s needs a file, but \"%s\" is a folder", option_as_typed(option).text, text));
}

static bool read_picture_name(const command_option *option, const char *text, void *into)
{
    if (file_is_standard_stream(text) && isatty(STDOUT_FILENO))
        return print_refusal("%s - would print a PNG on the terminal: name a file, or redirect the output with | or >",
                             option_as_typed(option).text);
    return read_file_name(option, text, into);
}

bool read_picture(const command_option *option, const char *text, void *into)
{
    const output_kind kind = output_kind_of_name(text);
    return read_picture_name(option, text, into) &&
           (kind == NAME_OPEN || kind == NAME_PNG ||
            print_refusal("%s needs the name of a PNG file, not \"%s\"", option_as_typed(option).text, text));
}

bool read_picture_or_page(const command_option *option, const char *text, void *into)
{
    return read_picture_name(option, text, into) &&
           (output_kind_of_name(text) == NAME_OPEN || file_has_ending(text, ".png.html") ||
            print_refusal("%s needs the name of a PNG file or an .html page, not \"%s\"", option_as_typed(option).text,
                          text));
}

bool read_film(const command_option *option, const char *text, void *into)
{
    return read_picture_name(option, text, into) &&
           (output_kind_of_name(text) == NAME_OPEN || file_has_ending(text, ".png.apng.mp4.webm") ||
            print_refusal("%s needs the name of a film that ends with .png, .apng, .mp4 or .webm, not \"%s\"",
                          option_as_typed(option).text, text));
}

bool read_file(const command_option *option, const char *text, void *into)
{
    const output_kind kind = output_kind_of_name(text);
    return read_file_name(option, text, into) &&
           (kind == NAME_OPEN || kind == NAME_FILE ||
            print_refusal("%s writes text, but \"%s\" names a picture", option_as_typed(option).text, text));
}

bool read_whole(const command_option *option, const char *text, void *into)
{
    uint64_t value;
    if (!read_count(option_as_typed(option).text, text, option->min, option->max, &value))
        return false;
    if (option->size == sizeof value)
        memcpy(into, &value, sizeof value);
    else
        memcpy(into, &(uint32_t){(uint32_t)value}, sizeof(uint32_t));
    return true;
}

bool read_tick_range(const command_option *option, const char *text, uint64_t *first, uint64_t *last)
{
    const char *at = text;
    *first = 0;
    *last = UINT64_MAX;
    const bool begins = whole_number_parse(&at, UINT64_MAX - 1, first), open = *at == ':';
    at += open;
    const bool ends = open && whole_number_parse(&at, UINT64_MAX, last);
    if (open && (begins || ends) && *at == 0 && *first < *last)
        return true;
    return refuse_value(option, "a range of ticks such as 100:200 (ticks 100 to 199), 100: or :200", text);
}

bool read_color(const command_option *option, const char *text, void *into)
{
    const char *digits = text[0] == '#' ? text + 1 : text;
    if (strlen(digits) != 6 || strspn(digits, "0123456789abcdefABCDEF") != 6)
        return refuse_value(option, "a colour such as ff8000", text);
    const unsigned long value = strtoul(digits, NULL, 16);
    *(image_color *)into = (image_color){(uint8_t)(value >> 16), (uint8_t)(value >> 8), (uint8_t)value};
    return true;
}

const char *draw_fill_words_at(int index)
{
    static const char *const words[] = {
        [DRAW_FILL_INTEGERS] = "the integer rasterizer; OpenGL is never loaded",
        [DRAW_FILL_CHECKED] =
            ("the integer rasterizer; OSMesa also draws the first, every 100th and the last frame, and the pixels are "
             "compared (the default)"),
        [DRAW_FILL_GL] = "OpenGL, which takes 2 to 3 times as long"};
    return words[index];
}

/* ---- Options of a view -------------------------------------------------------------------------------------- */

static bool read_view_text(const command_option *option, const char *text, void *into)
{
    (void)option;
    *(const char **)into = text ? text : "";
    return true;
}

/* Fills in the row of the n-th view option. View options without a name exist only in recording.json and are
 * skipped. */
bool view_option_row(size_t n, command_option *option)
{
    const view_option *row;
    for (size_t i = 0; (row = view_option_at(i)); i++)
        if (row->name && n-- == 0) {
            *option = (command_option){row->name,
                                       row->value,
                                       row->help,
                                       .read = read_view_text,
                                       .offset = offsetof(view_options, values) + i * sizeof(const char *),
                                       .names = row->member.names,
                                       .words = row->words};
            return true;
        }
    return false;
}

const char *find_first_view_option(const view_options *given)
{
    for (size_t i = 0; view_option_at(i); i++)
        if (given->values[i])
            return view_option_at(i)->name;
    return NULL;
}

bool has_view_option(const view_options *given, const char *name)
{
    for (size_t i = 0; view_option_at(i); i++)
        if (given->values[i] && view_option_at(i)->name && strcmp(view_option_at(i)->name, name) == 0)
            return true;
    return false;
}

bool read_view(const view_options *given, view *v)
{
    octreel_error error;
    const view_option *option;
    for (size_t i = 0; (option = view_option_at(i)); i++)
        if (given->values[i] && !option->parse(option, given->values[i], v, &error))
            return print_refusal("%s", error.text);
    return true;
}

/* ---- Options of the renderer --------------------------------------------------------------------------------- */

static const char *context_words_at(int n)
{
    static const char *const words[DRAW_CONTEXTS] = {[DRAW_AUTO] = "the first of these that works",
                                                     [DRAW_OSMESA] = "Mesa's OSMesa, in memory",
                                                     [DRAW_EGL] = "EGL without a display"};
    return words[n];
}

bool renderer_option_row(size_t n, command_option *option)
{
    static const command_option rows[] = {
        {"context", "NAME", "how OpenGL draws without a window (default auto): one of", .read = read_choice,
         OPTION_VALUE(renderer_choice, context), .names = draw_context_name, .words = context_words_at},
        {"any-renderer", NULL,
         "with --context egl: allow a graphics card. Its frames are the same only for the same card and driver; the "
         "frames of llvmpipe, Mesa's software renderer, are the same everywhere",
         .read = read_flag, OPTION_VALUE(renderer_choice, any_renderer)},
    };
    if (n >= sizeof rows / sizeof rows[0])
        return false;
    *option = rows[n];
    return true;
}

bool check_renderer(const renderer_choice *choice)
{
    if (choice->fill == DRAW_FILL_INTEGERS && choice->context != DRAW_AUTO && !choice->any_renderer)
        return print_refusal(
            "--context has no effect with --fill integers, which loads no OpenGL: leave out one of them");
    if (!choice->any_renderer || choice->context == DRAW_EGL)
        return true;
    return print_refusal("--any-renderer works only with --context egl: add that option");
}
