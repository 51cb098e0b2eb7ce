/* SPDX-License-Identifier: MIT */
/* test_cli_manuals.c - manuals describe every option, member and kind of finding, and man and mandoc print no warning.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "files.h"
#include "fixture.h"
#include "verify.h"

/* The pages: octreel, its commands and, in section 5, kinds of files. */
typedef struct page {
    char name[24];
    bool topic;
} page;

static page pages[40] = {{"octreel", false}};
static size_t page_count = 1;

/* "  record  film a session", "  help session  what ..." */
static int list_pages(void **state)
{
    (void)state;
    command_result help = run_octreel(NULL, "help");
    for (const char *line = help.out; *line; line += strcspn(line, "\n") + 1) {
        page *p = &pages[page_count];
        p->topic = sscanf(line, "  help %23[a-z] ", p->name) == 1;
        page_count += p->topic ||
                      (strncmp(line, "  ", 2) == 0 && strncmp(line, "  help", 6) != 0 && line[2] != ' ' &&
                       sscanf(line, "  %23[a-z]  ", p->name) == 1 && strncmp(line + 2 + strlen(p->name), "  ", 2) == 0);
    }
    command_release(&help);
    return page_count > 12 ? 0 : -1;
}

/* "  -o, --output DIR" in help, "\fB\-\-output\fR" in a manual. */
static void assert_has_options(const char *manual, const char *help, const char *page)
{
    size_t found = 0;
    for (const char *line = help; *line; line += strcspn(line, "\n") + 1) {
        char name[40], macro[80];
        if (strlen(line) < 9 || strncmp(line + 6, "--", 2) != 0 || sscanf(line + 8, "%39[a-z-]", name) != 1)
            continue;
        size_t used = (size_t)snprintf(macro, sizeof macro, "\\fB\\-\\-\\fR\\fB");
        for (const char *at = name; *at; at++)
            used += (size_t)snprintf(macro + used, sizeof macro - used, *at == '-' ? "\\%c" : "%c", *at);
        if (!strstr(manual, macro))
            fail_msg("the manual of %s lacks --%s", page, name);
        found++;
    }
    assert_true(found >= 3); /* the options that every command has */
}

static void every_option_is_in_the_manual(void **state)
{
    (void)state;
    for (size_t i = 1; !pages[i].topic; i++) {
        command_result manual = run_octreel(NULL, "help --man %s", pages[i].name);
        command_result help = run_octreel(NULL, "help %s", pages[i].name);
        assert_done(&manual);
        assert_has_options(manual.out, help.out, pages[i].name);
        command_release(&manual);
        command_release(&help);
    }
}

static void every_manual_has_its_sections(void **state)
{
    static const char *const sections[] = {"NAME",        "SYNOPSIS", "DESCRIPTION", "OPTIONS",
                                           "EXIT STATUS", "EXAMPLES", "ENVIRONMENT", "SEE ALSO"};
    (void)state;
    for (size_t i = 0; i < page_count; i++) {
        command_result manual = run_octreel(NULL, "help --man %s", pages[i].name);
        assert_int_equal(strncmp(manual.out, ".TH \"octreel", 12), 0);
        for (size_t n = 0; n < sizeof sections / sizeof sections[0]; n++) {
            char heading[32];
            snprintf(heading, sizeof heading, "\n.SH %s\n", sections[n]);
            const bool wanted = !pages[i].topic || strcmp(sections[n], "DESCRIPTION") == 0;
            if (wanted && !strstr(manual.out, heading))
                fail_msg("the manual of %s has no section %s", pages[i].name, sections[n]);
        }
        command_release(&manual);
    }
    command_result none = run_octreel(NULL, "help --man recrd");
    assert_trouble(&none, "did you mean record?");
}

/* The manual of octreel refers to all commands, and every manual to the kinds of files. */
static void manual_refers_to_the_commands_it_mentions(void **state)
{
    static const struct {
        const char *page, *commands;
    } rows[] = {{"record", ".BR octreel (1),\n.BR octreel\\-join (1),\n.BR octreel\\-film (1),\n.BR octreel\\-verify "
                           "(1),\n.BR octreel\\-session (5)"},
                {"octreel", ".BR octreel\\-record (1),\n.BR octreel\\-play (1),\n.BR octreel\\-join (1)"}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        command_result manual = run_octreel(NULL, "help --man %s", rows[i].page);
        const char *references = strstr(manual.out, "\n.SH SEE ALSO\n");
        assert_non_null(references);
        if (!strstr(references, rows[i].commands))
            fail_msg("%s: %s", rows[i].page, references);
        assert_int_equal(strstr(manual.out, "\n.SH COMMANDS\n") != NULL, strcmp(rows[i].page, "octreel") == 0);
        command_release(&manual);
    }
}

static const char *const library_manuals[] = {OCTREE_MANUAL, OCTREE_BODIES_MANUAL};

/* The test fails if a program that checks manuals prints anything. */
static void assert_content(void **state, const char *program, const char *command)
{
    const temp_folder *own = *state;
    if (!is_program_installed(program)) {
        print_message("%s is not installed: the manuals are not checked\n", program);
        skip();
    }
    for (size_t i = 0; i < page_count + 2; i++) {
        command_result said = run_script("cd %s && %s help --man %s > page && %s %s 2>&1 >/dev/null", own->name,
                                         octreel_program(), i < page_count ? pages[i].name : pages[0].name, command,
                                         i < page_count ? "page" : shell_quote(library_manuals[i - page_count]).text);
        if (*said.out || *said.err)
            fail_msg("%s: %s%s", i < page_count ? pages[i].name : library_manuals[i - page_count], said.out, said.err);
        command_release(&said);
    }
}

/* As lintian does. */
static void man_prints_no_warnings(void **state)
{
    assert_content(state, "groff", "LC_ALL=C.UTF-8 groff -man -ww -Tutf8 -rLL=80n");
}

static void mandoc_prints_no_warnings(void **state)
{
    assert_content(state, "mandoc", "mandoc -Tlint -Wwarning");
}

/* Functions are declared at the beginning of a line. */
static size_t assert_manual_has_every_function(const char *header_path, const char *manual_path)
{
    char *header = file_read(header_path, NULL), *manual = file_read(manual_path, NULL);
    size_t found = 0;
    for (const char *line = header; *line; line += strcspn(line, "\n") + 1) {
        const char *end = line + strcspn(line, "(\n"), *at = end;
        char wanted[72];
        while (at > line && (at[-1] == '_' || (at[-1] >= 'a' && at[-1] <= 'z')))
            at--;
        if (*end != '(' || at == line || at == end || *line < 'a' || strncmp(line, "typedef", 7) == 0)
            continue;
        snprintf(wanted, sizeof wanted, "%.*s(", (int)(end - at), at);
        if (!strstr(manual, wanted))
            fail_msg("%s does not describe %s", manual_path, wanted);
        found++;
    }
    free(header);
    free(manual);
    return found;
}

static void library_manuals_have_every_function(void **state)
{
    (void)state;
    assert_true(assert_manual_has_every_function(OCTREE_FOLDER "/octree.h", OCTREE_MANUAL) > 40);
    assert_true(assert_manual_has_every_function(OCTREE_FOLDER "/bodies.h", OCTREE_BODIES_MANUAL) > 20);
}

/* The test fails unless the text contains every name of a member in the JSON text. */
static void assert_names_are_told(const char *json, const char *text)
{
    for (const char *at = strchr(json, '"'); at; at = strchr(at, '"')) {
        const size_t length = strcspn(at + 1, "\"") + 2;
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        at += length;
        if (*at == ':' && !strstr(text, name))
            fail_msg("octreel help does not describe %s", name);
    }
}

/* A game with everything that a tick can have: queries, wrong answers, foreign nodes, and a gap. */
static void manual_describes_every_member_of_a_recording(void **state)
{
    static const char session[] =
        "{\"octreel\":\"session\",\"version\":2,\"keys\":\"wd\",\"ticks\":3,\"points\":[[1,1,1],[2,2,2],[3,3,3]],"
        "\"player\":{\"position\":[0,0,0],\"step\":1,\"box_size\":2,\"sweep\":true},\"queries\":["
        "{\"nearest\":[0,0,0],\"answer\":[3],\"skip\":2},{\"knearest\":2,\"at\":[0,0,0],\"answer\":[9]},"
        "{\"radius\":9,\"at\":[1,1,1],\"answer\":[1,77],\"mode\":\"float\",\"epsilon\":0.1},"
        "{\"range\":{\"min\":[0,0,0],\"max\":[9,9,9]},\"answer\":[1],\"visited\":[5],\"pruned\":[6]}],"
        "\"foreign_nodes\":[{\"id\":1,\"box\":{\"min\":[0,0,0],\"max\":[2,2,2]},\"points\":[1,3]},"
        "{\"id\":2,\"parent\":1,\"box\":{\"min\":[0,0,0],\"max\":[5,5,5]}}]}\n"
        "{\"tick\":2,\"edits\":[{\"remove\":99}]}\n{\"tick\":3,\"gap\":\"none\"}\n";
    const temp_folder *own = *state;
    command_result told = run_octreel(NULL, "help recording");
    file_write_text(place_in(*state, "s.json").path, session);
    command_result filmed = run_octreel(
        NULL,
        "record -q %s/s.json --size 32x32 -o %s/film --slice z=1 --depths 1:2 --leaves --region 0,0,0,9,9,9 --look 1,2 "
        "--center 1,2,3 --zoom 2 --color-points height --shade edl --tree both --diagram beside --labels",
        own->name, own->name);
    assert_done(&filmed);
    command_release(&filmed);
    static const char *const files[] = {"ticks.jsonl", "recording.json", "renderer.json"};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        char *json = file_read(place_below(place_in(*state, "film").path, files[i]).path, NULL);
        assert_names_are_told(json, told.out);
        free(json);
    }
    command_release(&told);
}

/* Of a recording that fits and one that does not, so that there is a finding with a fact. */
static void manual_describes_every_member_of_a_summary(void **state)
{
    static const char *const commands[][2] = {{"record", "record -q --keys wd --size 32x32 --ticks 0: -o film --json"},
                                              {"join", "join film --json"},
                                              {"verify", "verify film --json"},
                                              {"verify", "verify spoilt --json"}};
    const temp_folder *own = *state;
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        command_result told =
            run_script("%s help %s; %s help recording", octreel_program(), commands[i][0], octreel_program());
        command_result said = run_script("cd %s && %s %s", own->name, octreel_program(), commands[i][1]);
        assert_int_equal(said.status, i == 3 ? 1 : 0);
        assert_names_are_told(said.out, told.out);
        command_release(&told);
        command_release(&said);
        said = run_script("cd %s && rm -rf spoilt && cp -r film spoilt && sed -i 's/moved/mowed/' spoilt/ticks*",
                          own->name);
        assert_done(&said);
        command_release(&said);
    }
}

static void manual_describes_every_kind_of_finding(void **state)
{
    static const char *const kinds[] = {
#define KIND(name, word, words) "\"" word "\"",
        VERIFY_KIND_MAP(KIND)
#undef KIND
    };
    (void)state;
    command_result told = run_octreel(NULL, "help verify");
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (!strstr(told.out, kinds[i]))
            fail_msg("octreel help verify does not describe %s", kinds[i]);
    command_release(&told);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, temp_folder_make, nested_folder_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_option_is_in_the_manual),
        cmocka_unit_test(every_manual_has_its_sections),
        cmocka_unit_test(manual_refers_to_the_commands_it_mentions),
        IN_FOLDER(man_prints_no_warnings),
        IN_FOLDER(mandoc_prints_no_warnings),
        cmocka_unit_test(library_manuals_have_every_function),
        IN_FOLDER(manual_describes_every_member_of_a_recording),
        IN_FOLDER(manual_describes_every_member_of_a_summary),
        cmocka_unit_test(manual_describes_every_kind_of_finding),
    };
    return cmocka_run_group_tests(tests, list_pages, NULL);
}
