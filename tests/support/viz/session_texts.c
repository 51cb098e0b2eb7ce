/* SPDX-License-Identifier: MIT */
#include "session_texts.h"
#include "fixture.h"
#include "text.h"

#include <string.h>

session_file session_of_text(const char *text)
{
    session_file file;
    octreel_error error = {""};
    if (!session_parse("s.json", "", text, strlen(text), &file, &error))
        fail_msg("%s", error.text);
    return file;
}

void assert_session_refused(const char *text, const char *sentence)
{
    session_file file;
    octreel_error error = {""};
    if (session_parse("s.json", "", text, strlen(text), &file, &error))
        fail_msg("accepted instead of: %s", sentence);
    assert_string_equal(error.text, sentence);
    assert_int_equal(file.session.foreign_count, 0);
    assert_int_equal(file.session.foreign_pairs_count, 0);
}

char *text_of_session(const octree_session *session, const point_values *values)
{
    char *text;
    text_stream s;
    assert_true(text_stream_begin(&s));
    assert_true(session_write(session, values, s.stream));
    assert_true(text_stream_end(&s, &text));
    return text;
}
