/* SPDX-License-Identifier: MIT */
/* fuzz_session.c - libFuzzer entry of the session reader and writer: an accepted session is written and must read back
 * to the same bytes. Inputs change value by value. Build with clang -fsanitize=fuzzer,address,undefined. */
#include "session_file.h"
#include "support/edited_json.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

const char *__asan_default_options(void);

/* An input may request a hundred million points. */
const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1:max_allocation_size_mb=32";
}

/* One of eight inputs changes byte by byte, and so do inputs without an object. */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    const size_t made = seed % 8 ? edited_json(data, size, most, seed) : 0;
    return made ? made : LLVMFuzzerMutate(data, size, most);
}

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
