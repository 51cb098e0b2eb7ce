/* SPDX-License-Identifier: MIT */
/* test_panel_rows.c - a view with its text apart writes the rows of the text column as JSON, with every word of the
 * column in the picture, and leaves the picture without them. */
#include "scenes.h"
#include "draw_list.h"
#include "json_write.h"
#include "layout.h"
#include "text.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

/* Build a tick with its text apart. Returns the rows as text, which the caller frees. */
static char *build_apart(scene *s, view v, const octree_game *game)
{
    text_stream stream;
    char *text;
    v.text_apart = true;
    assert_true(text_stream_begin(&stream));
    json_writer writer = {.out = stream.stream};
    json_write_begin_array(&writer);
    s->rows = &writer;
    build_tick(s, &v, game);
    s->rows = NULL;
    json_write_end_array(&writer);
    assert_true(text_stream_end(&stream, &text));
    return text;
}

/* A row has one of the forms of pen.h. */
static void assert_row(const json_t *row)
{
    const json_t *sign = json_object_get(row, "sign");
    assert_true(json_is_object(row));
    assert_true(json_is_string(json_object_get(row, "title")) || json_is_string(json_object_get(row, "caption")) ||
                json_is_string(json_object_get(row, "text")) || json_is_string(json_object_get(row, "name")) ||
                json_is_true(json_object_get(row, "rule")));
    for (size_t i = 0; i < json_array_size(sign); i++) {
        const json_t *part = json_array_get(sign, i);
        const size_t count = json_array_size(part);
        assert_true(count == 5 || count == 2);
        assert_true(json_is_string(json_array_get(part, count - 1)));
    }
}

static void assert_rows(const char *text)
{
    json_t *rows = json_loads(text, 0, NULL);
    assert_true(json_array_size(rows) > 10);
    assert_non_null(json_object_get(json_array_get(rows, 0), "title"));
    for (size_t i = 0; i < json_array_size(rows); i++)
        assert_row(json_array_get(rows, i));
    json_decref(rows);
}

/* Every text of the column in the picture is in the rows. A text that was cut ends in two dots; a row lists more ids
 * than the column, where "+2" counts the others. */
static void assert_same_words(const scene *s, const char *rows)
{
    size_t texts = 0;
    for (size_t i = 0; i < s->labels.count; i++) {
        const scene_label *label = &s->labels.items[i];
        const size_t length = strlen(label->text);
        const bool cut = length > 2 && strcmp(label->text + length - 2, "..") == 0;
        if (label->style.layer != LAYER_TEXT || cut || strstr(label->text, " +"))
            continue;
        if (!strstr(rows, label->text))
            fail_msg("\"%s\" is not in %s", label->text, rows);
        texts++;
    }
    assert_true(texts > 20);
}

static void rows_have_every_word_of_the_column(void **state)
{
    (void)state;
    const octree_session session = session_with_all_layers();
    octree_game *game = start_game(&session);
    const view v = view_of(1280, 1400, CAMERA_ISO, VIEW_ALL_LAYERS & ~VIEW_HEAT_LAYERS);
    scene in_picture = {0}, apart = {0};
    do {
        play_tick(game);
        build_tick(&in_picture, &v, game);
        char *rows = build_apart(&apart, v, game);
        assert_rows(rows);
        assert_same_words(&in_picture, rows);
        free(rows);
    } while (octree_game_tick(game)->number < 60);
    octree_game_destroy(game);
    scene_release(&in_picture);
    scene_release(&apart);
}

static void picture_without_its_text_is_wider(void **state)
{
    (void)state;
    const octree_session session = octree_session_default();
    octree_game *game = start_game(&session);
    view v = view_of(1280, 720, CAMERA_ISO, VIEW_ALL_LAYERS & ~VIEW_HEAT_LAYERS);
    scene s = {0};
    char *rows = build_apart(&s, v, game);
    const layer_counts text = count_layer(&s, LAYER_TEXT);
    assert_int_equal(text.labels + text.panels, 0);
    assert_true(count_layer(&s, LAYER_WORLD).labels > 0); /* the numbers of the axes stay */
    assert_int_equal(layout_panel_width(&s.view), 0);
    free(rows);
    v.text_apart = true;
    build_tick(&s, &v, game); /* nobody receives the rows */
    assert_int_equal(count_layer(&s, LAYER_TEXT).labels, 0);
    octree_game_destroy(game);
    scene_release(&s);
}

/* On a screen with twice the pixels, letters have twice the size. */
static void letters_suit_the_given_height(void **state)
{
    (void)state;
    view v = view_of(360, 500, CAMERA_ISO, VIEW_ALL_LAYERS);
    v.suited_height = 720;
    const int height = lettering_choose(&v, false).height;
    v.suited_height = 2160;
    assert_int_equal(lettering_choose(&v, false).height, 3 * height);
    assert_int_equal(view_pixels_per_unit(&v), 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_have_every_word_of_the_column),
        cmocka_unit_test(picture_without_its_text_is_wider),
        cmocka_unit_test(letters_suit_the_given_height),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
