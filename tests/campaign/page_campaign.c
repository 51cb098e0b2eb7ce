/* SPDX-License-Identifier: MIT */
/* page_campaign.c - random inputs to the page of a recording, in headless Chromium: keys, drags, clicks, scrubs,
 * controls, queries and dropped files, as drive_campaign.js makes them. No input may raise an exception, and the page
 * must show the same as an engine that has played the session from its beginning. */
#include <getopt.h>
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "browser.h"
#include "driven_page.h"
#include "files.h"
#include "fixture.h"
#include "program.h"
#include "recordings.h"

const char program_name[] = "octreel-page-campaign";

enum { INPUTS_A_PAGE = 20000 }; /* then another browser starts, with another seed */

typedef struct options {
    uint64_t seed, inputs;
} options;

static options asked;
static uint64_t findings;

static options read_options(int argc, char **argv)
{
    static const struct option known[] = {{"seed", required_argument, NULL, 's'},
                                          {"inputs", required_argument, NULL, 'n'},
                                          {"help", no_argument, NULL, 'h'},
                                          {0}};
    options o = {.seed = 1, .inputs = 1000000};
    for (int option; (option = getopt_long(argc, argv, "", known, NULL)) >= 0;)
        switch (option) {
        case 's':
            o.seed = (uint64_t)parse_whole_number("--seed", optarg, 0, 4294967295.0);
            break;
        case 'n':
            o.inputs = (uint64_t)parse_whole_number("--inputs", optarg, 1, 1e9);
            break;
        case 'h':
            puts("usage: octreel-page-campaign [--seed N] [--inputs N]\n"
                 "Sends random inputs to the page of the default session in a browser (default: seed 1, a million "
                 "inputs).");
            exit_with_status(EXIT_DONE);
        default:
            exit(EXIT_TROUBLE); /* getopt has said why */
        }
    if (optind < argc)
        stop_with_error("unknown argument \"%s\"; see --help", argv[optind]);
    return o;
}

static uint64_t number_said(const char *said, const char *what)
{
    char *text = find_reported_value(said, what);
    const uint64_t number = strtoull(text, NULL, 10);
    free(text);
    return number;
}

/* Returns the number of inputs. */
static uint64_t drive(const temp_folder *own, const place *page, uint64_t seed, uint64_t inputs)
{
    const place given = place_in(own, "given.js");
    char text[128];
    snprintf(text, sizeof text, "const given = {seed: %" PRIu64 ", inputs: %" PRIu64 "};\n", seed, inputs);
    file_write_text(given.path, text);
    char *said =
        run_scripts_in_playing_page(own, page->path, (const char *const[]){given.path, "drive_campaign.js", NULL});
    const uint64_t done = number_said(said, "inputs"), found = number_said(said, "findings");
    if (found > 0)
        printf("seed %" PRIu64 ", %" PRIu64 " inputs:%s", seed, done, strstr(said, "\nfinding "));
    fflush(stdout);
    findings += found;
    free(said);
    return done;
}

static void no_input_raises_an_error_or_shows_a_wrong_tick(void **state)
{
    const place film = place_in(*state, "film"), page = place_below(film.path, "index.html");
    const octree_session session = octree_session_default();
    film_options o = small_film(film.path);
    uint64_t done = 0;
    skip_without_browser();
    o.every = 4;
    assert_filmed(&session, &o);
    skip_without_playing_page(page.path);
    for (uint64_t i = 0; done < asked.inputs; i++) {
        const uint64_t left = asked.inputs - done;
        done += drive(*state, &page, asked.seed + i, left < INPUTS_A_PAGE ? left : INPUTS_A_PAGE);
        if (isatty(STDERR_FILENO))
            fprintf(stderr, "\r%" PRIu64 " inputs, %" PRIu64 " findings", done, findings);
    }
    printf("%" PRIu64 " inputs: %" PRIu64 " findings\n", done, findings);
    assert_int_equal(findings, 0);
}

static int make_folder(void **state)
{
    return temp_folder_make(state);
}

int main(int argc, char **argv)
{
    asked = read_options(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(no_input_raises_an_error_or_shows_a_wrong_tick, make_folder,
                                        nested_folder_remove),
    };
    exit_with_status(cmocka_run_group_tests(tests, NULL, NULL) ? EXIT_FINDING : EXIT_DONE);
}
