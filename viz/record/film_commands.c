/* film_commands.c - see film_commands.h. */
#include "film_commands.h"

#include <inttypes.h>
#include <stdbool.h>
#include <string.h>

#define FRAMES_A_SECOND 15
#define SHEET_TILES 25
#define SHEET_COLUMNS 5
#define SHEET_TILE 320 /* pixels of its longer side */

/* ---- Paths -------------------------------------------------------------------------------------------------- */

/* Characters within single quotes. To ffmpeg a % belongs to a pattern, unless it is doubled. */
static void put_characters(FILE *out, const char *text, size_t length, bool pattern)
{
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '\'')
            fputs("'\\''", out);
        else
            putc(text[i], out);
        if (text[i] == '%' && pattern)
            putc('%', out);
    }
}

/* With "./" before it a path is no option, no protocol of ffmpeg's, and nothing that cd looks for elsewhere. */
static void put_path(FILE *out, const char *folder, size_t length, bool pattern, const char *rest)
{
    fputs(folder[0] == '/' ? "'" : "'./", out);
    put_characters(out, folder, length, pattern);
    fprintf(out, "%s'", rest);
}

/* Without the slashes at its end. */
static size_t name_length(const char *folder)
{
    size_t length = strlen(folder);
    while (length > 0 && folder[length - 1] == '/')
        length--;
    return length;
}

/* ".", "..", "/" and the like name no place beside them. */
static bool has_name(const char *folder, size_t length)
{
    size_t begin = length;
    while (begin > 0 && folder[begin - 1] != '/')
        begin--;
    return strspn(folder + begin, ".") < length - begin;
}

/* A file beside the folder, or within it where it has no name. */
static void put_result(FILE *out, const char *folder, const char *suffix)
{
    char within[32];
    const size_t length = name_length(folder);
    snprintf(within, sizeof within, "/film%s", suffix);
    put_path(out, folder, length, false, has_name(folder, length) ? suffix : within);
}

/* ---- Commands ----------------------------------------------------------------------------------------------- */

/* ffmpeg's own numbering ends, without a word, at the first number that is missing: where there are gaps the frames
 * come through a pipe. */
static void put_input(FILE *out, const film_options *options, uint64_t frames)
{
    const char *folder = options->folder;
    const size_t length = name_length(folder);
    fputs("    ", out);
    if (options->every == 1 || frames < 2) {
        fprintf(out, "ffmpeg -framerate %d -i ", FRAMES_A_SECOND);
        put_path(out, folder, length, true, "/frame_%06d.png");
        return;
    }
    fprintf(out, "seq -f 'frame_%%06.0f.png' 0 %" PRIu64 " %" PRIu64 " | (cd ", options->every,
            options->every * (frames - 1));
    put_path(out, folder, length, false, "/");
    fprintf(out, " && xargs cat) | ffmpeg -f png_pipe -framerate %d -i -", FRAMES_A_SECOND);
}

/* yuv420p, which every player shows, has even sides. */
static void put_film(FILE *out, const film_options *options, uint64_t frames)
{
    const bool odd = options->view.width % 2 || options->view.height % 2;
    put_input(out, options, frames);
    fprintf(out, "%s -pix_fmt yuv420p ", odd ? " -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2'" : "");
    put_result(out, options->folder, ".mp4");
}

static void put_animation(FILE *out, const film_options *options, uint64_t frames)
{
    put_input(out, options, frames);
    fputs(" -plays 0 ", out);
    put_result(out, options->folder, ".apng");
}

/* A side of a tile, whose longer side is never made longer. */
static int tile_side(int side, int longer)
{
    const int scaled = longer > SHEET_TILE ? (int)((int64_t)side * SHEET_TILE / longer) : side;
    return scaled > 0 ? scaled : 1;
}

/* Every n-th frame, so that all of the film is seen at a glance. */
static void put_sheet(FILE *out, const film_options *options, uint64_t frames)
{
    const view *v = &options->view;
    const int longer = v->width > v->height ? v->width : v->height;
    const uint64_t step = (frames + SHEET_TILES - 1) / SHEET_TILES, tiles = (frames + step - 1) / step;
    const uint64_t columns = tiles < SHEET_COLUMNS ? tiles : SHEET_COLUMNS;
    put_input(out, options, frames);
    fprintf(out, " -vf 'select=not(mod(n\\,%" PRIu64 ")),scale=%d:%d,tile=%" PRIu64 "x%" PRIu64 "'", step,
            tile_side(v->width, longer), tile_side(v->height, longer), columns, (tiles + columns - 1) / columns);
    fputs(" -frames:v 1 -update 1 ", out);
    put_result(out, options->folder, "_sheet.png");
}

static const struct {
    const char *name;
    void (*put)(FILE *out, const film_options *options, uint64_t frames);
} commands[] = {
    {"a film", put_film},
    {"an animated PNG", put_animation},
    {"a contact sheet", put_sheet},
};

void film_commands(FILE *out, const film_options *options, uint64_t frames)
{
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        fprintf(out, "  %s\n", commands[i].name);
        commands[i].put(out, options, frames);
        putc('\n', out);
    }
}
