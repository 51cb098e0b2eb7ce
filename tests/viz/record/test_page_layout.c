/* SPDX-License-Identifier: MIT */
/* test_page_layout.c - the picture of index.html fills the window and has its text beside it, the key p shows recorded
 * pixels, and an address opens exactly the view that it was copied from. Wrong addresses are reported and ignored. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "browser.h"
#include "driven_page.h"
#include "fixture.h"
#include "recording_file.h"
#include "recordings.h"
#include "view_options.h"

/* A recording of the default session, and the reports of its page from drive_layout.js. */
typedef struct driven {
    void *folder; /* a temp_folder */
    char *said;   /* null if the page cannot play */
} driven;

static int drive_page(void **state)
{
    driven *d = calloc(1, sizeof *d);
    *state = d;
    if (!d || temp_folder_make(&d->folder) != 0)
        return -1;
    const place film = place_in(d->folder, "film"), page = place_below(film.path, "index.html");
    const octree_session session = octree_session_default();
    const film_options options = small_film(film.path);
    assert_filmed(&session, &options);
    d->said = run_scripts_in_playing_page(d->folder, page.path, (const char *const[]){"drive_layout.js", NULL});
    return 0;
}

static int forget_page(void **state)
{
    driven *d = *state;
    const int status = nested_folder_remove(&d->folder);
    free(d->said);
    free(d);
    return status;
}

static const driven *need_page(void **state)
{
    const driven *d = *state;
    skip_without_playing_page(place_below(place_in(d->folder, "film").path, "index.html").path);
    return d;
}

static void picture_fills_the_window_beside_its_text(void **state)
{
    const driven *d = need_page(state);
    assert_reported_value(d->said, "fills", "true");
    assert_reported_value(d->said, "title", "tick 41");
    assert_reported_value(d->said, "caption", "a: player to (-600, -500, -350)");
    assert_reported_value(d->said, "row", "true");
    assert_reported_value(d->said, "symbols", "true");
    assert_reported_value(d->said, "wider without the column", "true");
}

static void recorded_pixels_are_those_of_the_frame(void **state)
{
    const driven *d = need_page(state);
    char digest[16];
    snprintf(digest, sizeof digest, "%08x", compute_png_digest(frame_place(place_in(d->folder, "film").path, 41).path));
    assert_reported_value(d->said, "frame", "frame_000041.png");
    assert_reported_value(d->said, "exact", digest);
}

static void tap_opens_the_facts_and_fingers_turn_and_zoom(void **state)
{
    const driven *d = need_page(state);
    assert_reported_value(d->said, "sheet before", "false");
    assert_reported_value(d->said, "sheet after a tap", "true");
    assert_reported_value(d->said, "sheet after Esc", "false");
    assert_reported_value(d->said, "one sheet at a time", "false true");
    assert_reported_value(d->said, "a finger turns", "true");
    assert_reported_value(d->said, "two fingers zoom", "true");
}

static void slow_pictures_lose_pixels_while_the_view_moves(void **state)
{
    const driven *d = need_page(state);
    assert_reported_value(d->said, "coarse while it moves", "true");
    assert_reported_value(d->said, "coarser while it is slow",
                          "0.50 0.50 0.35 0.50 0.50 0.35 0.25 0.25 0.36 0.50 0.50");
    assert_reported_value(d->said, "all pixels if they are fast", "true");
}

static void help_opens_at_its_beginning(void **state)
{
    assert_reported_value(need_page(state)->said, "help begins", "0 help-title");
}

static void every_control_has_a_name_and_the_keyboard_reaches_it(void **state)
{
    const driven *d = need_page(state);
    assert_reported_value(d->said, "without a name", "");
    assert_reported_value(d->said, "beyond the keyboard", "0");
}

static void link_opens_exactly_the_view(void **state)
{
    const driven *d = need_page(state);
    assert_reported_value(d->said, "link",
                          "#t=41&view=--camera+top+--layers+points,nodes+--zoom+2.5+--slice+z=100&select=node+7/7");
    assert_reported_value(d->said, "without the view", "3 ");
    assert_reported_value(d->said, "link opens the same", "true");
    assert_reported_value(d->said, "copied", "true");
}

static void link_holds_the_keys_and_the_query_of_the_user(void **state)
{
    const driven *d = need_page(state);
    assert_reported_value(d->said, "played link", "#t=35&keys=30:wwdnn&ask={\"radius\":300,\"at\":[0,0,0]}");
    assert_reported_value(d->said, "as recorded again", "252 3");
    assert_reported_value(d->said, "played link opens the same", "true");
}

static void depths_mean_the_same_on_the_page_and_the_command_line(void **state)
{
    static const char *const texts[] = {"2:5", "2:", ":5", "2", "02:"};
    const driven *d = need_page(state);
    const view_option *option = view_find_option("depths");
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        view v = view_make_default();
        octreel_error error;
        char name[32], expected[32];
        assert_true(option->parse(option, texts[i], &v, &error));
        snprintf(name, sizeof name, "depths %s", texts[i]);
        snprintf(expected, sizeof expected, "[%u,%u]", v.filter.min_depth, v.filter.max_depth);
        assert_reported_value(d->said, name, expected);
    }
}

static void wrong_address_shows_the_recorded_view_and_a_sentence(void **state)
{
    const driven *d = need_page(state);
    size_t addresses = 0;
    for (const char *at = d->said; (at = strstr(at, "\nwrong ")) != NULL; addresses++) {
        static const char expected[] = "0 The address has a part that cannot be shown";
        at = strchr(at, '\t') + 1;
        if (strncmp(at, expected, strlen(expected)) != 0)
            fail_msg("an address shows %.*s", (int)strcspn(at, "\n"), at);
    }
    assert_true(addresses > 20);
    char *told = find_reported_value(d->said, "no query");
    assert_non_null(strstr(told, "query"));
    free(told);
    assert_reported_value(d->said, "errors", "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(picture_fills_the_window_beside_its_text),
        cmocka_unit_test(recorded_pixels_are_those_of_the_frame),
        cmocka_unit_test(tap_opens_the_facts_and_fingers_turn_and_zoom),
        cmocka_unit_test(slow_pictures_lose_pixels_while_the_view_moves),
        cmocka_unit_test(help_opens_at_its_beginning),
        cmocka_unit_test(every_control_has_a_name_and_the_keyboard_reaches_it),
        cmocka_unit_test(link_opens_exactly_the_view),
        cmocka_unit_test(link_holds_the_keys_and_the_query_of_the_user),
        cmocka_unit_test(depths_mean_the_same_on_the_page_and_the_command_line),
        cmocka_unit_test(wrong_address_shows_the_recorded_view_and_a_sentence),
    };
    return cmocka_run_group_tests(tests, drive_page, forget_page);
}
