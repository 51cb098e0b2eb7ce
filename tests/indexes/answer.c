/* SPDX-License-Identifier: MIT */
/* answer.c - octree-answer INDEX: reads points and queries from standard input and writes the answers of an index, in
 * the form of apart.h. Exit status: 0 answered, 1 refused, 2 error. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "apart.h"
#include "index.h"
#include "program.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

const char program_name[] = "octree-answer";

static const spatial_index *find_index(const char *name)
{
    size_t i = 0;
    while (all_indexes[i] && strcmp(all_indexes[i]->name, name) != 0)
        i++;
    if (!all_indexes[i])
        stop_with_error("there is no index \"%s\"", name);
    return all_indexes[i];
}

static void *read_array(size_t size, uint64_t count)
{
    void *const array = resize_memory(NULL, (count + 1) * size);
    if (fread(array, size, count, stdin) != count)
        stop_with_error("standard input ends early");
    return array;
}

static void flush_subnormals(void)
{
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040); /* flush to zero, and denormals are zero */
#endif
}

int main(int argc, char **argv)
{
    const spatial_index *const index = find_index(argc == 2 ? argv[1] : "");
    const apart_question *const question = read_array(sizeof *question, 1);
    const octree_point *const points = read_array(sizeof *points, question->point_count);
    const octree_query *const queries = read_array(sizeof *queries, question->query_count);
    apart_answer *const answers = resize_memory(NULL, question->query_count * sizeof *answers);
    if (question->flush)
        flush_subnormals();
    void *const self = index->create(points, question->point_count, &question->world, 0);
    if (!self)
        return EXIT_FINDING;
    for (uint64_t i = 0; i < question->query_count; i++) {
        answers[i].count = index->ask(self, &queries[i], answers[i].ids, APART_IDS);
        if (answers[i].count == INDEX_REFUSED)
            return EXIT_FINDING;
    }
    fwrite(answers, sizeof *answers, question->query_count, stdout);
    exit_with_status(EXIT_DONE);
}
