/* SPDX-License-Identifier: MIT */
/* record_game.c - films a game loop that has a spatial index of its own.
 *
 *   cc record_game.c $(pkg-config --cflags --libs octreel) -o record_game && ./record_game
 *
 * It writes my-flight/, a recording like those of `octreel record`: look at my-flight/index.html, and let
 * `octreel audit my-flight` check the answers. With an octree of your own, pass it to octreel_recorder_tick() in place
 * of the points; the recorder then asks it only for what changed. */
#include <octreel/recorder.h>
#include <stdio.h>

int main(void)
{
    octreel_recorder_def def = octreel_recorder_def_default();
    def.folder = "my-flight";
    def.replace = true; /* an older recording in the folder is removed */
    octreel_error error;
    octreel_recorder *recorder = NULL;
    if (octreel_recorder_open(&def, &recorder, &error) != OCTREEL_OK) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    octreel_status status = OCTREEL_OK;
    for (int tick = 0; tick < 100 && status == OCTREEL_OK; tick++) {
        /* the game: a hundred points that drift, and the answer of its index to one query */
        octree_point points[100];
        for (int i = 0; i < 100; i++)
            points[i] = (octree_point){{i * 9.0 - tick, i % 10 * 90.0, tick * 5.0}, (uint64_t)i};
        const uint64_t found = 50;
        const octree_query query = {.kind = OCTREE_QUERY_NEAREST,
                                    .target = {450.0 - tick, 9, tick * 5.0},
                                    .answered = true,
                                    .answer = &found,
                                    .answer_count = 1};
        /* a worker thread draws and writes the frame while the game goes on */
        const octreel_tick_info info = {.points = points, .point_count = 100, .queries = &query, .query_count = 1};
        status = octreel_recorder_tick(recorder, NULL, &info);
    }
    if (status == OCTREEL_OK)
        status = octreel_recorder_close(recorder); /* completes the recording */
    if (status != OCTREEL_OK)
        fprintf(stderr, "%s\n", octreel_recorder_error(recorder));
    octreel_recorder_destroy(recorder);
    return status != OCTREEL_OK;
}
