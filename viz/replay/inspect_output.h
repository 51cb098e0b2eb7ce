/* inspect_output.h - the files that are made of clouds: one that is named, or one a cloud in a folder. */
#ifndef RECORD_INSPECT_OUTPUT_H
#define RECORD_INSPECT_OUTPUT_H

#include "folder.h"

/* What an option names. */
typedef struct inspect_output {
    const char *option; /* as it is typed: "-o" */
    const char *given;  /* its value; null where nothing is to be made */
    const char *ending; /* of the files: ".png" */
    bool folder;        /* found out by inspect_output_check() */
} inspect_output;

/* A folder is what is there as one, what ends in a slash, and all that is named for several clouds. False, with a
 * sentence, where that is a file, has the ending of one, or two clouds would have the same file. */
bool inspect_output_check(inspect_output *output, char *const *clouds, size_t count, octreel_error *error);

/* False, with a sentence, where a file that would be made is a cloud, or two of them are one: of any two outputs that
 * were checked. */
bool inspect_outputs_spare(const inspect_output outputs[2], char *const *clouds, size_t count, octreel_error *error);

/* The path of a cloud's file: what is named, or in that folder, which is made, the cloud's name and the ending, as in
 * scan.pcd.png. Owned by the caller; null with a sentence. */
char *inspect_output_path(const inspect_output *output, const char *cloud, octreel_error *error);

/* The last part of a path. */
const char *inspect_base_name(const char *path);

/* What a cloud is called among several: that last part, or its whole path where another one's ends in the same. */
const char *inspect_told_name(const char *cloud, char *const *clouds, size_t count);

#endif
