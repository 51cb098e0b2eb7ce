/* SPDX-License-Identifier: MIT */
/* test_laz_child.c - a child process that misbehaves instead of producing records. */
#include "clouds.h"
#include "laz_child.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SOME = 100 };

static bool put_points(FILE *records, uint64_t count)
{
    unsigned char record[LAS_RECORD_READ] = {0};
    for (uint64_t i = 0; i < count; i++) {
        record[0] = (unsigned char)i;
        if (fwrite(record, 1, sizeof record, records) != sizeof record)
            return false;
    }
    return true;
}

static bool put_all(void *context, FILE *records, FILE *why)
{
    (void)context, (void)why;
    return put_points(records, SOME);
}

static bool put_without_end(void *context, FILE *records, FILE *why)
{
    (void)context, (void)why;
    return put_points(records, UINT64_MAX);
}

static bool put_none(void *context, FILE *records, FILE *why)
{
    (void)context, (void)records, (void)why;
    return true;
}

static bool put_one_less(void *context, FILE *records, FILE *why)
{
    (void)context, (void)why;
    return put_points(records, SOME - 1);
}

static bool put_half_a_record(void *context, FILE *records, FILE *why)
{
    (void)context, (void)why;
    return put_points(records, SOME - 1) && fwrite("half", 1, 4, records) == 4;
}

static bool put_a_reason(void *context, FILE *records, FILE *why)
{
    (void)context;
    put_points(records, 3);
    fputs("point 4 is \033[31mred\n", why);
    return false;
}

/* More than a pipe holds, before any record. */
static bool put_reasons_without_end(void *context, FILE *records, FILE *why)
{
    (void)context, (void)records;
    for (int i = 0; i < 1 << 20; i++)
        fputc('a', why);
    return false;
}

static bool crash(void *context, FILE *records, FILE *why)
{
    (void)context, (void)why;
    put_points(records, 3);
    raise(SIGSEGV);
    return true;
}

static bool be_killed(void *context, FILE *records, FILE *why)
{
    (void)context, (void)why;
    put_points(records, SOME);
    raise(SIGKILL); /* what was put was not sent */
    return true;
}

static bool complain(void *context, FILE *records, FILE *why)
{
    (void)context, (void)why;
    fputs("ERROR: this must not be seen\n", stderr);
    return put_points(records, SOME);
}

static bool hang(void *context, FILE *records, FILE *why)
{
    volatile uint64_t turns = 0;
    (void)context, (void)records, (void)why;
    do
        turns++;
    while (turns > 0);
    return true;
}

typedef struct taken {
    uint64_t count, most; /* refuses what is beyond */
} taken;

static bool take(void *context, const unsigned char *record)
{
    taken *t = context;
    assert_int_equal(record[0], t->count % 256);
    return ++t->count <= t->most;
}

typedef struct misbehaviour {
    laz_produce *put;
    uint64_t points;
    const char *sentence; /* null: all are there */
} misbehaviour;

static void each_misbehaviour_of_the_child_gives_one_sentence(void **state)
{
    static const misbehaviour rows[] = {
        {put_all, SOME, NULL},
        {put_without_end, SOME, NULL},
        {complain, SOME, NULL},
        {put_none, 0, "a.laz: cannot be decompressed: liblaszip stopped early; the data is probably damaged"},
        {put_one_less, SOME - 1,
         "a.laz: cannot be decompressed: liblaszip stopped early; the data is probably damaged"},
        {put_half_a_record, SOME - 1,
         "a.laz: cannot be decompressed: liblaszip stopped early; the data is probably damaged"},
        {put_a_reason, 0, "a.laz: point 4 is ?[31mred?"},
        {crash, 0, "a.laz: cannot be decompressed: liblaszip crashed; the data is probably damaged"},
        {be_killed, 0, "a.laz: cannot be decompressed: liblaszip crashed; the data is probably damaged"},
        {hang, 0, "a.laz: cannot be decompressed within 1 s of processor time"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const laz_child child = {rows[i].put, NULL, 1};
        octreel_error error = {""};
        cloud none = {0};
        const cloud_file file = {.name = "a.laz", .error = &error, .out = &none};
        taken t = {0, SOME};
        assert_int_equal(laz_child_read_records(&child, &file, SOME, take, &t), rows[i].sentence == NULL);
        assert_string_equal(error.text, rows[i].sentence ? rows[i].sentence : "");
        assert_int_equal(t.count, rows[i].points);
    }
}

static void an_endless_reason_does_not_block(void **state)
{
    const laz_child child = {put_reasons_without_end, NULL, 1};
    octreel_error error = {""};
    cloud none = {0};
    const cloud_file file = {.name = "a.laz", .error = &error, .out = &none};
    (void)state;
    assert_false(laz_child_read_records(&child, &file, SOME, take, &(taken){0, SOME}));
    assert_int_equal(strncmp(error.text, "a.laz: aaaaaaaa", 15), 0);
}

/* Who takes points refuses one: the process that goes on putting them ends. */
static void refusing_a_record_ends_the_child(void **state)
{
    const laz_child child = {put_without_end, NULL, 1};
    octreel_error error = {""};
    cloud none = {0};
    const cloud_file file = {.name = "a.laz", .error = &error, .out = &none};
    taken t = {0, 5};
    (void)state;
    assert_false(laz_child_read_records(&child, &file, UINT64_MAX, take, &t));
    assert_int_equal(t.count, 6);
    assert_string_equal(error.text, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_misbehaviour_of_the_child_gives_one_sentence),
        cmocka_unit_test(an_endless_reason_does_not_block),
        cmocka_unit_test(refusing_a_record_ends_the_child),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
