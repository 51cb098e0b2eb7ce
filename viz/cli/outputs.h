/* SPDX-License-Identifier: MIT */
/* outputs.h - the outputs given on a command line, and the check that they replace no file that the user may need. */
#ifndef CLI_OUTPUTS_H
#define CLI_OUTPUTS_H

#include <stdbool.h>
#include <stddef.h>

/* An output given on a command line: a file, a folder, or a folder and the main file in it. */
typedef struct output_file {
    const char *option; /* the option as it was typed, such as "-o" */
    const char *path;   /* the path of the file, or "-" for standard output; null: no file */
    const char *folder; /* the folder that the option names; null: the option names a file, or was not given */
} output_file;

/* Checks the outputs of a command before anything is written. Two outputs that are the same file are always refused.
 * Two outputs that go to standard output are always refused, too; with `json`, the JSON report is such an output.
 * Unless `force` is true, these outputs are also refused:
 * - a file that is an input or lies in an input folder and is read there;
 * - a file of a recording, even if it does not exist yet;
 * - a baseline, a session, a point cloud or a frame;
 * - a folder that is or contains the current folder, unless it holds a recording.
 * Two paths are the same file if device and inode are the same. Pipes and devices are never refused. If an output is
 * refused, prints an error and returns false. Cost: a call of stat() for each file in an input folder. */
bool check_outputs(const output_file *outputs, size_t count, char *const *inputs, int input_count, bool json,
                   bool force);

/* Checks that an output page overwrites no file, except a page that octreel wrote earlier. If it would, prints an error
 * and returns false. */
bool check_page_output(const output_file *output, bool force);

/* Returns whether one of the output files is standard output. Reports are then printed on standard error or not at
 * all. */
bool is_standard_output_taken(const output_file *outputs, size_t count);

/* The table row of the option --force. */
#define FORCE_OPTION(type, member, text)                                                                               \
    {                                                                                                                  \
        "force", NULL, text, .read = read_flag, OPTION_VALUE(type, member)                                             \
    }

#define FORCE_FILES                                                                                                    \
    "write outputs even over an input, a baseline, a session, a point cloud or a file of a recording, and into a "     \
    "folder that is or contains the current folder"

#endif
