/* SPDX-License-Identifier: MIT */
/* fuzz_session.c - libFuzzer entry of the session reader and writer: what is read is written, and reads back to the
 * same bytes. Build with clang -fsanitize=fuzzer,address,undefined; run with
 * ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=32 -malloc_limit_mb=64, for inputs may ask for a
 * hundred million points.
 */
#include "session_file.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static char *write_session(const session_file *file, size_t *size)
{
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    if (!out || !session_write(&file->session, &file->values, out) || fclose(out) != 0)
        abort();
    return text;
}

static void check_round_trip(const session_file *file)
{
    session_file again;
    octreel_error error;
    size_t size, size_again;
    char *text = write_session(file, &size);
    if (session_parse("again", "", text, size, &again, &error)) {
        char *text_again = write_session(&again, &size_again);
        if (size != size_again || memcmp(text, text_again, size) != 0)
            abort();
        free(text_again);
    } else if (!strstr(error.text, "out of memory")) {
        abort();
    }
    session_release(&again);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    enum { MANY_POINTS = 1000 };
    session_file file;
    octreel_error error = {""};
    if (!session_parse("fuzz", "", (const char *)data, size, &file, &error) && error.text[0] == '\0')
        abort();
    if (file.session.body_count <= MANY_POINTS && file.session.tree.leaf_capacity > 0)
        check_round_trip(&file);
    session_release(&file);
    return 0;
}
