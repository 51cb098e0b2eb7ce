/* SPDX-License-Identifier: MIT */
/* cmd_digest.c - octreel digest: the pixels of many frames as a small text file. */
#include "command.h"
#include "digest_file.h"
#include "png_read.h"

#include <stdio.h>

static bool write_file(const diff_side *side, const char *path, octreel_error *error)
{
    file_writer file;
    if (!file_writer_open(&file, path, error))
        return false;
    return digest_file_write(file.stream, side, error) ? file_writer_close(&file, error) : file_writer_abandon(&file);
}

static int write_digests(const char *folder, const char *path, image_color background)
{
    const output_file output = {"-o", path};
    diff_side side;
    octreel_error error;
    if (!diff_side_open(&side, folder, &error))
        return print_error("%s", error.text);
    int status = EXIT_DONE;
    if (side.no_frames)
        status = print_error("%s was recorded without frames, of which there could be digests", folder);
    else if (side.count == 0)
        status = print_error("%s: there is no PNG in it", folder);
    else if (!diff_side_spared(&side, &output, &error) || !digest_all(&side, background, &error) ||
             !write_file(&side, path, &error))
        status = print_error("%s", error.text);
    diff_side_release(&side);
    return status;
}

typedef struct arguments {
    const char *path;
    image_color background;
} arguments;

static const command_option options[] = {
    {"output", "FILE", "where it goes (default: -, standard output)", .read = read_file, OPTION_VALUE(arguments, path)},
    {"background", "RRGGBB", "what transparent pixels are laid over (default ffffff, white)", .read = read_color,
     OPTION_VALUE(arguments, background)},
    {0},
};

static int run(int argc, char **argv)
{
    arguments a = {.path = "-", .background = IMAGE_WHITE};
    const int status = command_read_arguments(&command_digest, &a, argc, argv);
    return status == COMMAND_GO_ON ? write_digests(argv[optind], a.path, a.background) : status;
}

const command command_digest = {
    .name = "digest",
    .run = run,
    .options = options,
    .line = "write digests of many frames, a small reference for diff",
    .usage = "FOLDER [-o FILE] [OPTION ...]",
    .about = "Write a digest of each frame's pixels as text, one line a frame: a baseline of a few kilobytes that "
             "octreel diff takes in place of pictures. FOLDER is a recording or a folder of PNGs; a single PNG will "
             "do, and so will -, one from standard input.\n",
    .more = "The file: \"octreel-digests 1\", \"background ffffff\", and then, in the order of the names' bytes, lines "
            "such as\n\n"
            "    0123456789abcdef 1280x720 frame_000000.png\n",
    .examples = "octreel digest frames -o frames.digests\n"
                "octreel diff frames.digests frames\n",
    .least = 1,
    .most = 1,
    .takes = "one folder of frames",
    .inputs = {FILE_KIND(PNG) | FILE_KIND(FOLDER) | FILE_KIND(RECORDING)},
};
